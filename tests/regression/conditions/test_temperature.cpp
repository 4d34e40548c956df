// Bodies that are warmed: the balance of energy, and what is refused.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

struct Solid {
  std::string name, model, more;
};
void PrintTo(const Solid& solid, std::ostream* stream) { *stream << solid.name; }

std::string of_copper(const Solid& solid, const std::string& expansion, const std::string& name = "copper") {
  return section(name, key("Material Model", solid.model) + key("Density", "8930") + key("Young's Modulus", "117e9") +
                           key("Poisson's Ratio", "0.35") + key("Thermal Expansion Coefficient", expansion) +
                           solid.more);
}

std::string warmed(const std::string& set, const std::string& temperature) {
  return section("warm " + set,
                 key("Type", "Prescribed Temperature") + key("Node Set", set) + key("Value", temperature));
}

std::string held(const std::string& set, const std::string& axes, const std::string& way = "0") {
  return along(set + axes, "Prescribed Displacement", set, axes, way);
}

const Solid ordinary{"Ordinary", "Elastic", ""}, of_points{"Correspondence", "Elastic Correspondence", ""},
    silling{"Silling", "Elastic Correspondence", key("Stabilization", "Silling")},
    cells{"Quadratic", "Elastic Correspondence", key("Formulation", "Quadratic Correspondence")};
std::string name_of(const testing::TestParamInfo<Solid>& info) { return info.param.name; }

class Warmed : public testing::TestWithParam<Solid> {};

INSTANTIATE_TEST_SUITE_P(By, Warmed, testing::Values(ordinary, of_points, silling, cells), name_of);

// Fast: what the expansion gives is what the body stores and carries.
TEST_P(Warmed, FastExpansionKeepsTheBalance) {
  Parts parts;
  parts.materials = of_copper(GetParam(), "2e-5");
  parts.conditions = warmed("all", "293 + 200*sin(4e5*t)*(1 + 100*x)") + held("foot", "xyz");
  parts.times = key("Final Time", "1e-5");
  const RunFolder folder;
  Simulation run(folder, parts);
  double largest = 0;
  const Ledger end = run.go([&](const Ledger& now) { largest = std::max(largest, now.balance_error); });
  EXPECT_GT(end.external, 1e-4);
  EXPECT_GT(end.kinetic, 1e-2 * end.external);
  EXPECT_LT(largest, 2e-2);
}

std::string refusal(const Parts& parts) {
  const RunFolder folder;
  deck::Problems problems;
  deck::read(folder.write("deck.xml", parts.text()), folder.world, problems);
  return problems.text("deck.xml");
}

TEST(Temperature, IsRefusedWhereItWouldMeanNothing) {
  Parts parts;
  parts.conditions = warmed("all", "293 + t");
  parts.materials = copper(key("Yield Stress", "50e6") + section("Heating", key("Specific Heat", "383")));
  EXPECT_NE(refusal(parts).find("whose temperature follows from its flow"), std::string::npos);
  parts.conditions.clear();
  parts.materials = copper(key("Yield Stress", "50e6") + key("Thermal Expansion Coefficient", "1e-5") +
                           section("Heating", key("Specific Heat", "383")));
  EXPECT_NE(refusal(parts).find("by which it does not expand"), std::string::npos);
}

TEST(Temperature, IsRefusedInEquilibria) {
  Parts parts;
  parts.materials = of_copper(of_points, "2e-5");
  parts.conditions = warmed("all", "293 + t");
  parts.verlet = key("Number of Load Steps", "2");
  const RunFolder folder;
  deck::Problems problems;
  deck::read(folder.write("deck.xml", changed(parts.text(), R"(name="Verlet")", R"(name="QuasiStatic")")), folder.world,
             problems);
  EXPECT_NE(problems.text("").find("in equilibria"), std::string::npos);
}

}  // namespace
}  // namespace strut::regression
