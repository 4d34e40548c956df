// The forces of conditions in the history: what a body weighs, and what it does with its momentum.
#include <gtest/gtest.h>

#include "bodies.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

constexpr double step = 1e-7;                        // s
constexpr double weight = 1e9 * 4e-3 * 4e-3 * 6e-3;  // N, of the block under a force of 1e9 N/m³
const std::string pull = along("weight", "Body Force", "all", "z", "-1e9");

// The history, of every step, of a run with these variables.
Table history_of(Parts parts, const std::vector<std::string>& variables, const Lattice& lattice = {}) {
  const RunFolder folder(lattice);
  std::string names;
  for (const std::string& name : variables) names += key(name, "true");
  parts.history =
      key("Filename", (folder / "history.csv").string()) + key("Frequency", "1") + section("Variables", names);
  testing::internal::CaptureStdout();
  run(folder.write("deck.xml", parts.text()), folder.world);
  testing::internal::GetCapturedStdout();
  return read_history(folder / "history.csv");
}

// With the trapezoidal rule, which for steps of one length has the impulses of central differences.
double integral(const std::vector<double>& force, const std::vector<double>& time, std::size_t until) {
  double sum = 0;
  for (std::size_t n = 1; n <= until; ++n) sum += 0.5 * (force[n - 1] + force[n]) * (time[n] - time[n - 1]);
  return sum;
}

class HeldBody : public testing::TestWithParam<std::string> {};

// Whatever holds the block, its reaction and the weight make its momentum, at each step to round-off: a sum over 1000
// steps. It falls and bounces with periods of some 10 µs, so that in 100 µs the mean of the reaction is the weight but
// for its last momentum, some hundredths.
TEST_P(HeldBody, WeighsWhatItWeighs) {
  Parts parts;
  parts.node_sets = key("first", "z &lt; 1e-3");
  parts.conditions = pull + GetParam();
  parts.times = key("Final Time", "100e-6");
  parts.verlet = key("Fixed dt", "1e-7");
  const Table table = history_of(parts, {"Reaction_X(hold)", "Reaction_Y(hold)", "Reaction_Z(hold)"});
  const std::vector<double>&force = table.at("Reaction_Z(hold)"), &time = table.at("Time");
  ASSERT_EQ(time.size(), 1001u);
  for (std::size_t n = 1; n < time.size(); ++n) {
    ASSERT_NEAR(integral(force, time, n) - weight * time[n], table.at("Momentum_Z")[n], 1e-11 * weight * 100e-6) << n;
    ASSERT_NEAR(table.at("Reaction_X(hold)")[n], 0, 1e-9 * weight);  // a block's own forces cancel but for round-off
    ASSERT_NEAR(table.at("Reaction_Y(hold)")[n], 0, 1e-9 * weight);
  }
  EXPECT_NEAR(integral(force, time, time.size() - 1) / 100e-6, weight, 0.05 * weight);
  EXPECT_NEAR(force[0], weight / 6, 1e-9 * weight);  // at first of the held points alone, a layer of six
}

INSTANTIATE_TEST_SUITE_P(By, HeldBody,
                         testing::Values(along("hold", "Prescribed Displacement", "first", "z", "0"),
                                         along("hold", "Prescribed Velocity", "first", "z", "0"),
                                         plane("hold", "Symmetry Plane", "first", "0 0 0", "0 0 1"),
                                         plane("hold", "Rigid Plane", "all", "0 0 0.5e-3", "0 0 1")));

// Pulled so slowly, over 15 of its periods, that all of it is nearly at rest.
TEST(Reaction, OfTwoEndsIsEqualAndOpposite) {
  Parts parts;
  parts.node_sets = key("first", "z &lt; 1e-3") + key("last", "z &gt; 5e-3");
  parts.conditions = along("low", "Prescribed Displacement", "first", "z", "0") +
                     along("high", "Prescribed Displacement", "last", "z", "6e-6*(t/100e-6)^2*(3 - 2*t/100e-6)");
  parts.times = key("Final Time", "100e-6");
  parts.verlet = key("Fixed dt", "1e-7");
  const Table table = history_of(parts, {"Reaction_Z(low)", "Reaction_Z(high)", "Max_Displacement"});
  const std::vector<double>&low = table.at("Reaction_Z(low)"), &high = table.at("Reaction_Z(high)");
  const double largest = high.back();
  // E A ε with the points' distance of 5 mm and a block that is free to contract; its surfaces are softer.
  const double force = 117e9 * 16e-6 * 6e-6 / 5e-3;
  EXPECT_NEAR(largest, force, 0.2 * force);
  for (std::size_t n = 0; n < low.size(); ++n) EXPECT_NEAR(low[n] + high[n], 0, 0.01 * largest) << n;
  // The run starts with the velocity that the first step needs: with the momentum of the first row.
  const std::vector<double>&time = table.at("Time"), &momentum = table.at("Momentum_Z");
  const auto unexplained = [&](std::size_t n) {
    return momentum[n] - integral(low, time, n) - integral(high, time, n);
  };
  for (std::size_t n = 2; n < low.size(); ++n) {
    ASSERT_NEAR(unexplained(n), unexplained(1), 1e-11 * largest * 100e-6) << n;  // round-off of a sum
  }
}

// Points of the crushed foot are subcycled, and the step shrinks with the deformation by some percent at a time: an
// impulse between two kicks counts with the step before, by so much too little or too much.
TEST(Reaction, HoldsTheImpulsesOfSubsteps) {
  Lattice lattice;
  lattice.nz = 60;
  Parts parts;
  parts.materials = copper(key("Yield Stress", "100e6"));
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-227") +
                     plane("wall", "Rigid Plane", "all", "0 0 0.3e-3", "0 0 1");
  parts.times = key("Final Time", "20e-6");
  const Table table = history_of(parts, {"Reaction_Z(wall)"}, lattice);
  const std::vector<double>& momentum = table.at("Momentum_Z");
  const double stopped = momentum.back() - momentum.front();
  EXPECT_GT(stopped, -0.05 * momentum.front());
  EXPECT_NEAR(integral(table.at("Reaction_Z(wall)"), table.at("Time"), momentum.size() - 1), stopped, 0.01 * stopped);
}

}  // namespace
}  // namespace strut::regression
