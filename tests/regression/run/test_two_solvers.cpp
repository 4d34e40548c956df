// Explicit steps after equilibria: the body goes on as it was, and so does what the history counts.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

// A history of equilibria up to 1 s, then of explicit steps.
Table history_of(Parts parts, const std::vector<std::string>& variables) {
  const RunFolder folder;
  std::string names;
  for (const std::string& name : variables) names += key(name, "true");
  parts.history =
      key("Filename", (folder / "history.csv").string()) + key("Frequency", "1") + section("Variables", names);
  parts.times = key("Final Time", "1");
  const std::string first = section("QuasiStatic", key("Number of Load Steps", "2"));
  const std::string next = section("Solver 2", key("Final Time", "1.000005") + section("Verlet", ""));
  const std::string deck = changed(parts.text(), section("Solver", parts.times + section("Verlet", parts.verlet)),
                                   section("Solver", parts.times + first) + next);
  testing::internal::CaptureStdout();
  run(folder.write("deck.xml", deck), folder.world);
  testing::internal::GetCapturedStdout();
  return read_history(folder / "history.csv");
}

std::string wall(const std::string& name, const std::string& place, const std::string& normal,
                 const std::string& travel = "") {
  return section(name, key("Type", "Rigid Plane") + key("Point", "0 0 " + place) + key("Normal", "0 0 " + normal) +
                           (travel.empty() ? "" : key("Travel Z", travel)));
}

const std::string stand = along("aside", "Prescribed Displacement", "foot", "xy", "0");

// The plane has pressed the bar by 0.02 spacings, and keeps it so: its force stays, and nothing moves. Equilibria leave
// points up to 1e-4 spacings inside of tools, half a percent of that.
TEST(TwoSolvers, ToolsGoOnPressing) {
  Parts parts;
  parts.conditions =
      stand + wall("floor", "0", "1") + wall("press", "6e-3", "-1", "-2e-5*t*(t &lt; 1) - 2e-5*(t &gt;= 1)");
  const Table table = history_of(parts, {"Reaction_Z(press)", "Reaction_Z(floor)"});
  const auto& force = table.at("Reaction_Z(press)");
  const auto& times = table.at("Time");
  ASSERT_GT(times.size(), 5u);
  EXPECT_LT(force[2], -1e3);
  for (std::size_t n = 3; n < times.size(); ++n) {
    EXPECT_NEAR(force[n], force[2], 1e-2 * std::abs(force[2])) << n;
    EXPECT_NEAR(table.at("Reaction_Z(floor)")[n], -force[2], 1e-2 * std::abs(force[2])) << n;
    EXPECT_LT(table.at("Kinetic_Energy")[n], 1e-4 * table.at("Elastic_Energy")[n]) << n;
  }
}

// The work of conditions includes that in equilibria: together it is the energy of the body.
TEST(TwoSolvers, WorkGoesOn) {
  Parts parts;
  parts.conditions = along("low", "Prescribed Displacement", "foot", "xyz", "0") +
                     along("high", "Prescribed Displacement", "top", "z", "1e-5*t");
  const Table table = history_of(parts, {});
  const std::size_t last = table.at("Time").size() - 1;
  ASSERT_GT(last, 5u);
  for (std::size_t n = 2; n <= last; ++n) {
    const double held = table.at("Kinetic_Energy")[n] + table.at("Elastic_Energy")[n] +
                        table.at("Stabilization_Energy")[n] + table.at("Plastic_Work")[n];
    EXPECT_NEAR(table.at("External_Work")[n], held, 2e-3 * held) << n;  // hypoelastic at a strain of 1.7e-3
  }
}

}  // namespace
}  // namespace strut::regression
