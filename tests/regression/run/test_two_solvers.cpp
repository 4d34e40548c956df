// Explicit steps after equilibria: the body goes on as it was, and so does what the history counts.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/errors.hpp"
#include "base/numbers.hpp"
#include "regression/bodies.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

// The bar's deck with equilibria up to 1 s, then explicit steps.
std::string deck_of(Parts parts, const std::string& load_steps = "2") {
  parts.times = key("Final Time", "1");
  const std::string first = section("QuasiStatic", key("Number of Load Steps", load_steps));
  const std::string next = section("Solver 2", key("Final Time", "1.000005") + section("Verlet", ""));
  return changed(parts.text(), section("Solver", parts.times + section("Verlet", parts.verlet)),
                 section("Solver", parts.times + first) + next);
}

std::string history_in(const RunFolder& folder) {
  return key("Filename", (folder / "history.csv").string()) + section("Variables", "");
}

// Its history. `when`: its rows.
Table history_of(Parts parts, const std::vector<std::string>& variables,
                 const std::string& when = key("Frequency", "1")) {
  const RunFolder folder;
  std::string names;
  for (const std::string& name : variables) names += key(name, "true");
  parts.history = key("Filename", (folder / "history.csv").string()) + when + section("Variables", names);
  testing::internal::CaptureStdout();
  run(folder.write("deck.xml", deck_of(parts)), folder.world);
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

const std::string held = along("low", "Prescribed Displacement", "foot", "xyz", "0");

// The load on what lies beyond an end, half a layer of six, is no part of either: the bar hangs at rest, but for the
// waves of the residual forces, 1e-6 of 8.8 N.
TEST(TwoSolvers, LoadsBesideANonReflectingEndStay) {
  Parts parts;
  parts.conditions =
      held + along("weight", "Body Force", "all", "z", "-1e8") +
      section("end", key("Type", "Non-Reflecting End") + key("Node Set", "top") + key("Normal", "0 0 1"));
  const Table table = history_of(parts, {"Reaction_Z(low)"});
  const auto& force = table.at("Reaction_Z(low)");
  ASSERT_GT(force.size(), 5u);
  for (std::size_t n = 2; n < force.size(); ++n) {
    EXPECT_NEAR(force[n], 1e8 * 5.5 * 16e-9, 1e-3) << n;
  }
}

// A bar of metal flows at both of its ends, which are held, the least: the average of the criterion lies below its
// largest value in equilibria, too, and above its least one.
TEST(TwoSolvers, CriteriaOfFailureAreAveragedInEquilibria) {
  const auto indicators = [](const std::string& radius) {
    Parts parts;
    parts.materials = section(
        "copper", key("Material Model", "Elastic Plastic Correspondence") + key("Density", "8930") +
                      key("Young's Modulus", "117e9") + key("Poisson's Ratio", "0.35") + key("Yield Stress", "400e6") +
                      section("Hardening", key("Type", "Linear") + key("Hardening Modulus", "1e9")));
    parts.damage = section("tearing", key("Damage Model", "Plastic Strain") + key("Failure Strain", "0.5") +
                                          key("Averaging Radius", radius));
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") +
                                        key("Damage Model", "tearing") + key("Horizon", "2.01e-3"));
    parts.conditions = held + along("high", "Prescribed Displacement", "top", "xyz", "2e-4*t");
    const Table table = history_of(parts, {"Max_Failure_Indicator", "Min_Failure_Indicator"});
    return std::pair(table.at("Max_Failure_Indicator")[2], table.at("Min_Failure_Indicator")[2]);
  };
  const auto [most, least] = indicators("0");
  const auto [averaged_most, averaged_least] = indicators("2e-3");
  EXPECT_LT(averaged_most, 0.9 * most);
  EXPECT_GT(averaged_least, least);
}

// Errors in keys that only the explicit steps use are raised before the equilibria begin.
TEST(TwoSolvers, ErrorsOfTheStepsComeBeforeTheEquilibria) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {along("blow", "Initial Velocity", "top", "z", "sqrt(0.5 - t)"), "Boundary Conditions > blow > Value"},
      {section("hammer", key("Type", "Rigid Plane") + key("Point", "0 0 7e-3") + key("Normal", "0 0 -1") +
                             key("Mass", "1e-3") + key("Force Z", "log(1 - t)")),
       "Boundary Conditions > hammer > Force Z"},
      {along("blow", "Initial Velocity", "top", "z", "1") + along("other", "Initial Velocity", "all", "z", "t"), ""},
      {along("way", "Prescribed Displacement", "top", "x", "1e-6*t") +
           along("as fast", "Prescribed Velocity", "top", "x", "1e-6"),
       ""},
      {along("blow", "Initial Velocity", "top", "z", "0") + along("other", "Initial Velocity", "all", "z", "t"),
       "Boundary Conditions > other: contradicts 'blow'"},
      {along("way", "Prescribed Velocity", "top", "x", "0") +
           along("late", "Prescribed Velocity", "top", "x", "(t &gt; 1)*5"),
       "Boundary Conditions > late: contradicts 'way'"},
      {section("end", key("Type", "Non-Reflecting End") + key("Node Set", "all") + key("Normal", "0 0 1")),
       "Boundary Conditions > end > Node Set"}};
  for (const auto& [conditions, expected] : wrong) {
    Parts parts;
    parts.conditions = held + conditions;
    const RunFolder folder;
    const std::filesystem::path deck = folder.write("deck.xml", deck_of(parts));
    std::string error;
    testing::internal::CaptureStdout();
    try {
      run(deck, folder.world);
    } catch (const Error& raised) {
      error = raised.what();
    }
    const std::string said = testing::internal::GetCapturedStdout();
    EXPECT_EQ(error.empty(), expected.empty()) << error;
    EXPECT_NE(error.find(expected), std::string::npos) << error;
    if (!expected.empty()) {
      EXPECT_EQ(said.find("iterations"), std::string::npos) << said;
    }
  }
}

// A result that ends between the final times of both solvers is not that of a completed run: --continue does not
// replace it, since there is no checkpoint to go on from.
TEST(TwoSolvers, RunThatEndsInTheStepsIsNotOver) {
  Parts parts;
  parts.conditions = held;
  const RunFolder folder;
  parts.history = history_in(folder);
  const std::string shorter = deck_of(parts), longer = changed(shorter, "1.000005", "1.00001");
  testing::internal::CaptureStdout();
  EXPECT_TRUE(run(folder.write("deck.xml", shorter), folder.world));
  const std::filesystem::path deck = folder.write("deck.xml", longer);
  EXPECT_THROW(run(deck, folder.world, Start::continued), Error);
  EXPECT_EQ(read_history(folder / "history.csv").at("Time").back(), 1.000005);
  EXPECT_TRUE(run(deck, folder.world));
  EXPECT_TRUE(run(deck, folder.world, Start::continued));
  const std::string said = testing::internal::GetCapturedStdout();
  if (folder.world.rank() != 0) return;
  EXPECT_NE(said.find("is of a run that is over"), std::string::npos) << said;
}

TEST(TwoSolvers, TimesMayBeNegative) {
  Parts parts;
  parts.conditions = held;
  const RunFolder folder;
  parts.history = history_in(folder);
  const std::string early =
      changed(deck_of(parts), key("Final Time", "1"), key("Initial Time", "-2") + key("Final Time", "-1"));
  testing::internal::CaptureStdout();
  EXPECT_TRUE(run(folder.write("deck.xml", changed(early, "1.000005", "-0.999995")), folder.world));
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(read_history(folder / "history.csv").at("Time").back(), -0.999995);
}

// By default each solver fills its own time, however much shorter that of the steps is.
TEST(TwoSolvers, BothWriteByDefault) {
  Parts parts;
  parts.conditions = held + along("blow", "Initial Velocity", "top", "z", "1");
  const std::vector<double> times = history_of(parts, {}, "").at("Time");
  const auto steps = std::count_if(times.begin(), times.end(), [](double t) { return t > 1; });
  EXPECT_EQ(static_cast<int>(times.size()) - steps, 3);  // the equilibria
  EXPECT_GT(steps, 10);                                  // a step is longer than a thousandth of their time
}

// An interval for both, which no step but the last one reaches, is told of.
TEST(TwoSolvers, AnIntervalLongerThanTheStepsIsTold) {
  Parts parts;
  parts.conditions = held;
  parts.history = key("Filename", "history.csv") + key("Interval", "0.1") + section("Variables", "");
  const RunFolder folder;
  const deck::Deck deck = deck::read(folder.write("deck.xml", deck_of(parts)), folder.world);
  ASSERT_EQ(deck.notes.size(), 1u);
  EXPECT_EQ(deck.notes[0], "History > Interval is 0.1 s, also in Solver 2, which lasts " + to_text(1.000005 - 1) +
                               " s: of its steps only the last one is written");
}

// A check looks at the steps, too.
TEST(TwoSolvers, ACheckTellsOfTheSteps) {
  Parts parts;
  parts.conditions = held + along("high", "Prescribed Displacement", "top", "z", "1e-5*t");
  const RunFolder folder;
  const std::filesystem::path deck = folder.write("deck.xml", deck_of(parts));
  testing::internal::CaptureStdout();
  check(deck, folder.world);
  const std::string said = testing::internal::GetCapturedStdout();
  if (folder.world.rank() != 0) return;
  const std::size_t next = said.find("Solver 2, with the body after these load steps:");
  ASSERT_NE(next, std::string::npos) << said;
  EXPECT_NE(said.find("critical time step", next), std::string::npos) << said;
}

// An end takes off inertia, and with it a fifth of the step: a check knows it, also if it makes only two load steps.
TEST(TwoSolvers, ACheckKnowsTheEndsOfTheSteps) {
  Parts parts;
  parts.conditions =
      stand + along("low", "Prescribed Displacement", "foot", "z", "1e-5*t") +
      section("end", key("Type", "Non-Reflecting End") + key("Node Set", "top") + key("Normal", "0 0 1"));
  const std::vector<double> times = history_of(parts, {}).at("Time");
  for (const char* load_steps : {"2", "4"}) {
    const RunFolder folder;
    const std::filesystem::path deck = folder.write("deck.xml", deck_of(parts, load_steps));
    testing::internal::CaptureStdout();
    check(deck, folder.world);
    const std::string said = testing::internal::GetCapturedStdout();
    if (folder.world.rank() != 0) continue;
    const std::string body = "Solver 2, with the body after ";
    const bool reaches_all = std::string(load_steps) == "2";
    EXPECT_NE(said.find(body + (reaches_all ? "these load steps:" : "the first 2 of 4 load steps, t = 0.5 s (")),
              std::string::npos)
        << said;
    const std::size_t at = said.find(" steps of ");
    ASSERT_NE(at, std::string::npos) << said;
    const double dt = times.at(3) - times.at(2);                          // the first one after two load steps
    EXPECT_NEAR(std::stod(said.substr(at + 10)), dt, 0.04 * dt) << said;  // the run takes 26 equal steps
  }
}

// One condition, or one body at rest, keeps all bonds from breaking in the equilibria.
TEST(TwoSolvers, TellOfBondsThatHoldInEquilibria) {
  const RunFolder folder(Lattice{.nz = 8, .plate_layers = 2});
  const auto told = [&](const std::string& material, const std::string& conditions) {
    Parts parts;
    parts.materials += changed(copper(material), "copper", "other");
    parts.damage = section("brittle", key("Damage Model", "Critical Stretch") + key("Critical Stretch", "0.01"));
    const std::string horizon = key("Horizon", "2.01e-3");
    parts.blocks =
        section("bar",
                key("Block Names", "bar") + key("Material", "copper") + horizon + key("Damage Model", "brittle")) +
        section("far", key("Block Names", "plate") + key("Material", "other") + horizon + key("Separate Body", "true"));
    parts.conditions = held + conditions;
    const deck::Deck deck = deck::read(folder.write("deck.xml", deck_of(parts)), folder.world);
    const std::string all = told_at_the_start(deck, folder.world).warnings;
    const std::string begin = "bonds break only from Solver 2 on, because of ";
    const std::size_t at = all.find(begin);
    return at == std::string::npos ? "" : all.substr(at + begin.size(), all.find(':', at) - at - begin.size());
  };
  EXPECT_EQ(told("", ""), "");
  EXPECT_EQ(told(key("Yield Stress", "2e8"), ""), "block 'plate' (its material or Damage Model)");
  EXPECT_EQ(told("", wall("press", "8e-3", "-1")), "tools");
}

// A Wall Time ends such a run without a checkpoint: that is told, and --continue does not replace what it has left.
TEST(TwoSolvers, AWallTimeLeavesNothingToGoOnFrom) {
  Parts parts;
  parts.conditions = held;
  const RunFolder folder;
  parts.history = history_in(folder);
  const std::string text =
      changed(deck_of(parts), key("Final Time", "1"), key("Final Time", "1") + key("Wall Time", "1e-9"));
  const std::filesystem::path deck = folder.write("deck.xml", text);
  testing::internal::CaptureStdout();
  EXPECT_FALSE(run(deck, folder.world, Start::continued));  // there is nothing yet
  const auto rows = read_history(folder / "history.csv");
  std::string error;
  try {
    run(deck, folder.world, Start::continued);
  } catch (const Error& raised) {
    error = raised.what();
  }
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_NE(error.find("Solver 2: a run of two solvers writes no checkpoint"), std::string::npos) << error;
  EXPECT_EQ(read_history(folder / "history.csv"), rows);
  if (folder.world.rank() != 0) return;
  EXPECT_NE(said.find("Solver > Wall Time ends a run of two solvers without a checkpoint"), std::string::npos) << said;
}

// The state that equilibria alone have left is not that of the run that begins anew: --continue would ask for one that
// does, again and again.
TEST(TwoSolvers, ARunThatBeginsAnewRemovesAnEarlierState) {
  const auto written = [](const RunFolder& folder, const std::string& text) {
    testing::internal::CaptureStdout();
    EXPECT_TRUE(run(folder.write("grown.xml", text), folder.world));
    testing::internal::GetCapturedStdout();
    folder.world.barrier();
  };
  Parts parts;
  parts.conditions = held;
  const RunFolder folder;
  parts.output =
      key("Output Filename", (folder / "run.e").string()) + section("Output Variables", key("Displacement", "true"));
  const std::string both = deck_of(parts);
  const std::string next = section("Solver 2", key("Final Time", "1.000005") + section("Verlet", ""));
  written(folder, changed(both, next, ""));
  EXPECT_TRUE(std::filesystem::exists("grown.restart"));
  const std::string from = "<ParameterList>\n" + section("Start From", key("Checkpoint", "grown.restart"));
  written(folder, changed(changed(both, "<ParameterList>\n", from), "run.e", "other.e"));
  EXPECT_TRUE(std::filesystem::exists("grown.restart")) << "the run has begun with it";
  written(folder, both);
  EXPECT_FALSE(std::filesystem::exists("grown.restart"));
  testing::internal::CaptureStdout();
  EXPECT_TRUE(run(folder / "grown.xml", folder.world, Start::continued));
  testing::internal::GetCapturedStdout();
  folder.world.barrier();
  std::filesystem::remove("grown.restart");
}

}  // namespace
}  // namespace strut::regression
