// The first frame and the first line of the history are of the initial time, as the deck says: no impulse has acted
// yet. And the last ones are of the final time, whatever step comes before.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

const std::string flight = along("flight", "Initial Velocity", "all", "z", "-40");
const std::string wall = plane("wall", "Rigid Plane", "all", "0 0 0", "0 0 1");
const std::string load = along("weight", "Body Force", "all", "xz", "-1e10");

// The velocity that a frame shows.
Vector velocity(const Body& body, int i) { return 0.5 * (body.previous_velocity[i] + body.velocity[i]); }

struct Case {
  const char* name;
  std::string conditions;
  Vector foot, others;  // m/s, the velocities of the points of "foot" and of all others
};

class AtTheInitialTime : public testing::TestWithParam<Case> {};

TEST_P(AtTheInitialTime, VelocitiesMomentumAndEnergyAreThoseOfTheDeck) {
  const auto& [name, conditions, foot, others] = GetParam();
  const RunFolder folder;
  Parts parts;
  parts.conditions = conditions;
  Simulation run(folder, parts);
  run.solver.advance_velocity(1);
  const Ledger first = run.solver.ledger();
  const Body& body = run.body();
  Vector momentum = Vector::Zero();
  double energy = 0;
  for (int i = 0; i < body.owned(); ++i) {
    const Vector& expected = run.in_set(i, "foot") ? foot : others;
    EXPECT_LT((velocity(body, i) - expected).norm(), 1e-13 * 40) << name << ", point " << body.domain.id(i);
    momentum += body.mass(i) * expected;
    energy += 0.5 * body.mass(i) * expected.squaredNorm();
  }
  run.world().sum(std::span(momentum.data(), 3));
  EXPECT_LT((first.momentum - momentum).norm(), 1e-13 * 40 * run.mass()) << name;  // round-off of a hundred points
  EXPECT_NEAR(first.kinetic, run.world().sum(energy), 1e-13 * 800 * run.mass()) << name;
  EXPECT_EQ(first.external + first.tools, 0) << name;
}

INSTANTIATE_TEST_SUITE_P(Of, AtTheInitialTime,
                         testing::Values(Case{"bodies that stand at a wall", flight + wall, {0, 0, -40}, {0, 0, -40}},
                                         Case{"bodies under a load", flight + load, {0, 0, -40}, {0, 0, -40}},
                                         Case{"a prescribed velocity and a load",
                                              along("pull", "Prescribed Velocity", "foot", "x", "1") + load,
                                              {1, 0, 0},
                                              {0, 0, 0}},
                                         Case{"a prescribed velocity that grows",
                                              flight + along("pull", "Prescribed Velocity", "foot", "x", "3 + 1e8*t"),
                                              {3, 0, -40},
                                              {0, 0, -40}},
                                         Case{"a displacement",
                                              along("pull", "Prescribed Displacement", "foot", "x", "2*t") + load,
                                              {2, 0, 0},
                                              {0, 0, 0}},
                                         Case{"a plane of symmetry",
                                              flight + load + along("aside", "Initial Velocity", "all", "x", "5") +
                                                  plane("half", "Symmetry Plane", "foot", "0 0 0", "1 0 0"),
                                              {0, 0, -40},
                                              {5, 0, -40}}));

// Points that are subcycled have the same first line as others.
TEST(AtTheInitialTime, SubcycledPointsHaveTheirInitialVelocities) {
  const RunFolder folder({.nx = 6, .ny = 6, .nz = 12, .plate_layers = 4});
  Parts parts;
  parts.materials = changed(changed(copper(), "\"copper\"", "\"soft\""), "117e9", "0.457e9") + copper();
  parts.blocks.clear();
  for (const auto& [block, material] : {std::pair{"bar", "soft"}, std::pair{"plate", "copper"}}) {
    parts.blocks += section(block, key("Block Names", block) + key("Material", material) +
                                       key("Horizon Factor", "1.75") + key("Separate Body", "true"));
  }
  parts.conditions = flight + wall;
  parts.times = key("Final Time", "2e-6");
  Simulation run(folder, parts);
  bool first = true;
  const Ledger last = run.go([&](const Ledger& now) {
    if (first) {
      EXPECT_NEAR(now.kinetic, 800 * run.mass(), 1e-12 * 800 * run.mass());
      EXPECT_NEAR(now.momentum[2], -40 * run.mass(), 1e-12 * 40 * run.mass());
    }
    first = false;
    EXPECT_LT(now.balance_error, 0.01);  // what contact with a wall takes at once is accounted for
  });
  EXPECT_GT(run.solver.most_substeps(), 1);
  EXPECT_LT(last.tools, 0);
}

TEST(AtTheInitialTime, AToolWithAMassHasItsInitialVelocity) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = section("punch", key("Type", "Rigid Plane") + key("Point", "0 0 -1") + key("Normal", "0 0 1") +
                                          key("Mass", "0.5") + key("Force X", "3e5") + key("Speed X", "-2"));
  Simulation run(folder, parts);
  run.solver.advance_velocity(1);
  EXPECT_NEAR(run.solver.ledger().tool_kinetic, 1, 1e-15);
}

// A body that falls freely by steps that do not divide its time: v = g t, and what gravity has done, at every step and
// at the end, to round-off.
TEST(AShortLastStep, HasVelocitiesAndEnergyOfItsTime) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = along("weight", "Body Force", "all", "z", "-8930e6");
  parts.times = key("Final Time", "1.03e-6");
  parts.verlet = key("Fixed dt", "1e-7");
  Simulation run(folder, parts);
  const Ledger last = run.go([&](const Ledger& now) {
    EXPECT_NEAR(now.momentum[2], -1e6 * now.time * run.mass(), 1e-12 * run.mass()) << now.time;
    EXPECT_LT(now.balance_error, 1e-12) << now.time;
    for (int i = 0; i < run.body().owned(); ++i) EXPECT_NEAR(velocity(run.body(), i)[2], -1e6 * now.time, 1e-12);
  });
  EXPECT_EQ(run.solver.steps(), 11);
  EXPECT_EQ(last.time, 1.03e-6);
}

// The end of a bar that another run pulled ever faster is let go. In the half step to the time of the checkpoint the
// forces against which it was held do not move it; its speed is that of half a step before.
TEST(AtTheStartFromAnother, PointsHaveTheSpeedAtWhichTheyWereHeld) {
  const RunFolder folder;
  const std::string checkpoint = (folder / "one.restart").string();
  Parts parts;
  parts.verlet = key("Fixed dt", "5e-8");  // a hundredth of the time
  const std::string foot = along("low", "Prescribed Displacement", "foot", "xyz", "0");
  const auto run_with = [&](const std::string& conditions, const std::string& more) {
    parts.conditions = conditions;
    testing::internal::CaptureStdout();
    run(folder.write("deck.xml", changed(parts.text(), "<ParameterList>\n", "<ParameterList>\n" + more)), folder.world);
    testing::internal::GetCapturedStdout();
  };
  run_with(foot + along("high", "Prescribed Velocity", "top", "z", "2e5*t"),
           section("Restart", key("Filename", checkpoint) + key("Interval", "1")));
  parts.history = key("Filename", (folder / "history.csv").string()) + key("Frequency", "1") +
                  section("Variables", key("Min_Velocity_Z(top)", "true") + key("Max_Velocity_Z(top)", "true"));
  run_with(foot, section("Start From", key("Checkpoint", checkpoint)));
  const Table table = read_history(folder / "history.csv");
  EXPECT_NEAR(table.at("Min_Velocity_Z(top)")[0], 1, 0.01);
  EXPECT_NEAR(table.at("Max_Velocity_Z(top)")[0], 1, 0.01);
}

}  // namespace
}  // namespace strut::regression
