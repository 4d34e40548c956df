// Bodies that are warmed: closed forms of free, clamped and layered bars, the balance of energy, and what is refused.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

constexpr double modulus = 117e9, poisson = 0.35, bulk = modulus / (3 * (1 - 2 * poisson));  // Pa, -, Pa

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
    cells{"Quadratic", "Elastic Correspondence", key("Formulation", "Quadratic Correspondence")},
    metal{"Plastic", "Elastic Plastic Correspondence", key("Yield Stress", "9e9")};
std::string name_of(const testing::TestParamInfo<Solid>& info) { return info.param.name; }

// The last frame of equilibria from 0 to 1 s, and the history.
struct Files {
  Table history;
  std::map<std::string, std::vector<double>> fields;  // of rank 0
  std::array<std::vector<double>, 3> places;
};

Files equilibria(Parts parts, const std::string& steps, const Lattice& lattice = {}) {
  const RunFolder folder(lattice);
  parts.times = key("Final Time", "1");
  parts.verlet = key("Number of Load Steps", steps);
  parts.output = key("Output Filename", (folder / "result.e").string()) + key("Output Frequency", "1") +
                 section("Output Variables", key("Displacement", "true") + key("Cauchy_Stress", "true") +
                                                 key("Thermal_Strain", "true") + key("Deformation_Gradient", "true"));
  parts.history = key("Filename", (folder / "history.csv").string()) + key("Frequency", "1") +
                  section("Variables", key("Max_Von_Mises_Stress", "true"));
  testing::internal::CaptureStdout();
  run(folder.write("deck.xml", changed(parts.text(), R"(name="Verlet")", R"(name="QuasiStatic")")), folder.world);
  testing::internal::GetCapturedStdout();
  Files files{read_history(folder / "history.csv"), {}, {}};
  if (folder.world.rank() > 0) return files;
  const io::ExodusResult result = io::read_result(folder / "result.e");
  for (std::size_t v = 0; v < result.nodal_names.size(); ++v)
    files.fields[result.nodal_names[v]] = result.nodal[v].back();
  for (std::size_t v = 0; v < result.element_names.size(); ++v)
    files.fields[result.element_names[v]] = result.element[v].back();
  files.places = result.places;
  return files;
}

double largest(const std::vector<double>& values, double less = 0) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value - less));
  return most;
}

class Warmed : public testing::TestWithParam<Solid> {};

// A free body, held at three layers of points along their normals: u = ε (X − X of the layer), and no stress.
TEST_P(Warmed, FreeBodyGrowsWithoutStress) {
  Parts parts;
  parts.materials = of_copper(GetParam(), "2e-5");
  parts.node_sets = key("left", "x &lt; 1e-3") + key("front", "y &lt; 1e-3");
  parts.conditions = warmed("all", "293 + 500*t") + held("left", "x") + held("front", "y") + held("foot", "z");
  const Files files = equilibria(parts, "4");
  EXPECT_LT(largest(files.history.at("Max_Von_Mises_Stress")), 1e-6 * modulus * 0.01);
  if (files.fields.empty()) return;
  const double strain = 0.01;
  EXPECT_LT(largest(files.fields.at("Thermal_Strain"), strain), 1e-15);
  for (int c = 0; c < 3; ++c) {
    const std::vector<double>& u = files.fields.at(std::string("Displacement") + "XYZ"[c]);
    for (std::size_t i = 0; i < u.size(); ++i) {
      // Equilibria are found to 1e-6 of the forces.
      ASSERT_NEAR(u[i], strain * (files.places[c][i] - 0.5e-3), 1e-6 * strain * 6e-3) << c << " " << i;
    }
  }
}

// Every point is held: the elastic stretch is 1/(1 + ε), and the pressure K times three logarithms of that, or, of the
// ordinary solid, 3 K ε. What the body stores is what its expansion gave.
TEST_P(Warmed, ClampedBodyIsUnderPressure) {
  Parts parts;
  parts.materials = of_copper(GetParam(), "2e-5");
  parts.conditions = warmed("all", "293 + 500*t") + held("all", "xyz");
  const Files files = equilibria(parts, "20");
  const double volume = 96e-9, strain = 0.01, by_law = std::log1p(strain);
  const bool adds_up = GetParam().model == "Elastic";
  const double whole = adds_up ? strain : by_law;
  // By rates, twenty mid-points of the logarithm err by (Δε)²/12 of it, 2e-8, and its work likewise.
  EXPECT_NEAR(files.history.at("Elastic_Energy").back(), 4.5 * bulk * whole * whole * volume,
              (adds_up ? 1e-12 : 1e-6) * bulk * whole * whole * volume);
  EXPECT_NEAR(files.history.at("External_Work").back(), files.history.at("Elastic_Energy").back(),
              (adds_up ? 1e-12 : 1e-6) * files.history.at("Elastic_Energy").back());
  if (files.fields.empty()) return;
  for (const char* axis : {"XX", "YY", "ZZ"}) {
    EXPECT_LT(largest(files.fields.at(std::string("Cauchy_Stress") + axis), -3 * bulk * whole), 1e-6 * 3 * bulk * whole)
        << axis;
  }
}

INSTANTIATE_TEST_SUITE_P(By, Warmed, testing::Values(ordinary, of_points, silling, cells, metal), name_of);

// A bar between two walls, free aside: σ = −E ln(1 + ε) along it, and the sides spread by (1 + ε)^(1 + ν).
class WarmedBar : public testing::TestWithParam<Solid> {};

TEST_P(WarmedBar, BetweenWallsIsPressed) {
  Parts parts;
  parts.materials = of_copper(GetParam(), "2e-5");
  parts.conditions =
      warmed("all", "293 + 500*t") + held("top", "z") + held("foot", "z") + held("left", "x") + held("front", "y");
  parts.node_sets = key("left", "x &lt; 1e-3") + key("front", "y &lt; 1e-3");
  const Files files = equilibria(parts, "20");
  if (files.fields.empty()) return;
  const double strain = 0.01, stress = -modulus * std::log1p(strain), spread = std::pow(1 + strain, 1 + poisson);
  // Twenty mid-points, and equilibria to 1e-6 of the forces.
  EXPECT_LT(largest(files.fields.at("Cauchy_StressZZ"), stress), 1e-5 * std::abs(stress));
  EXPECT_LT(largest(files.fields.at("Cauchy_StressXX")), 1e-5 * std::abs(stress));
  EXPECT_LT(largest(files.fields.at("Deformation_GradientXX"), spread), 1e-5 * strain);
}

INSTANTIATE_TEST_SUITE_P(By, WarmedBar, testing::Values(of_points, silling, cells, metal), name_of);

// The part beyond yield stays when the bar cools: a metal that yields at 50 MPa, between walls, is left in tension.
TEST(WarmedMetal, CooledBarIsLeftInTension) {
  Parts parts;
  parts.materials = of_copper({"", "Elastic Plastic Correspondence", key("Yield Stress", "50e6")}, "2e-5");
  parts.node_sets = key("left", "x &lt; 1e-3") + key("front", "y &lt; 1e-3");
  parts.conditions = warmed("all", "value = 293 + 200*t; if (t &gt; 0.5) { value = 293 + 200*(1 - t); }") +
                     held("top", "z") + held("foot", "z") + held("left", "x") + held("front", "y");
  const Files files = equilibria(parts, "20");
  if (files.fields.empty()) return;
  // Warmed by 100 K it would hold 234 MPa: it yields at −50 MPa, and cools to +50 MPa.
  EXPECT_LT(largest(files.fields.at("Cauchy_StressZZ"), 50e6), 1e-3 * 50e6);
}

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

// Two layers of unequal expansion: Timoshenko's curvature (1925) of a strip of one modulus, 3/2 Δα ΔT/h.
TEST(WarmedMetal, StripOfTwoMetalsBends) {
  Parts parts;
  const Lattice strip{.nx = 40, .ny = 2, .nz = 6, .plate_layers = 3};
  parts.materials = of_copper(cells, "2e-5") + of_copper(cells, "1e-5", "other");
  parts.blocks =
      section("low", key("Block Names", "bar") + key("Material", "copper") + key("Horizon Factor", "1.75")) +
      section("high", key("Block Names", "plate") + key("Material", "other") + key("Horizon Factor", "1.75"));
  parts.node_sets =
      key("left", "x &lt; 1e-3") + key("front", "y &lt; 1e-3") + key("edge", "x &lt; 1e-3 &amp;&amp; z &lt; 1e-3");
  parts.conditions = warmed("all", "293 + 100*t") + held("left", "x") + held("front", "y") + held("edge", "z");
  const Files files = equilibria(parts, "2", strip);
  if (files.fields.empty()) return;
  const double thickness = 6e-3, curvature = 1.5 * 1e-5 * 100 / thickness;
  const std::vector<double>& w = files.fields.at("DisplacementZ");
  double at_end = 0, in_middle = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    if (std::abs(files.places[2][i] - 0.5e-3) > 1e-6) continue;
    if (std::abs(files.places[0][i] - 39.5e-3) < 1e-6) at_end = w[i];
    if (std::abs(files.places[0][i] - 19.5e-3) < 1e-6) in_middle = w[i];
  }
  // w = κ x²/2 from the held layer.
  const double measured = (at_end - 2 * in_middle + 0) / (std::pow(39e-3, 2) / 2 - std::pow(19e-3, 2));
  EXPECT_NEAR(measured / curvature, 1, 0.05);
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

}  // namespace
}  // namespace strut::regression
