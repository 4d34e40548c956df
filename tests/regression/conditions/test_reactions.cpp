// The forces of conditions in the history: what a body weighs, and what it does with its momentum.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "regression/stiff_ended_bar.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

constexpr double weight = 1e9 * 4e-3 * 4e-3 * 6e-3;  // N, of the block under a force of 1e9 N/m³
const std::string pull = along("weight", "Body Force", "all", "z", "-1e9");

// The history, of every step or every so many, of a run with these variables.
Table history_in(const RunFolder& folder, Parts parts, const std::vector<std::string>& variables, int frequency = 1) {
  std::string names;
  for (const std::string& name : variables) names += key(name, "true");
  parts.history = key("Filename", (folder / "history.csv").string()) + key("Frequency", std::to_string(frequency)) +
                  section("Variables", names);
  testing::internal::CaptureStdout();
  run(folder.write("deck.xml", parts.text()), folder.world);
  testing::internal::GetCapturedStdout();
  return read_history(folder / "history.csv");
}

Table history_of(const Parts& parts, const std::vector<std::string>& variables, const Lattice& lattice = {},
                 int frequency = 1) {
  return history_in(RunFolder(lattice), parts, variables, frequency);
}

// The impulse of means over the times between the rows.
double impulse(const std::vector<double>& force, const std::vector<double>& time, std::size_t until) {
  double sum = 0;
  for (std::size_t n = 1; n <= until; ++n) sum += force[n] * (time[n] - time[n - 1]);
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
  const Table table =
      history_of(parts, {"Reaction_X(hold)", "Reaction_Y(hold)", "Reaction_Z(hold)", "Instant_Reaction_Z(hold)"});
  const std::vector<double>&force = table.at("Reaction_Z(hold)"), &time = table.at("Time");
  ASSERT_EQ(time.size(), 1001u);
  for (std::size_t n = 1; n < time.size(); ++n) {
    ASSERT_NEAR(impulse(force, time, n) - weight * time[n], table.at("Momentum_Z")[n], 1e-11 * weight * 100e-6) << n;
    ASSERT_NEAR(table.at("Reaction_X(hold)")[n], 0, 1e-9 * weight);  // a block's own forces cancel but for round-off
    ASSERT_NEAR(table.at("Reaction_Y(hold)")[n], 0, 1e-9 * weight);
  }
  EXPECT_NEAR(impulse(force, time, time.size() - 1) / 100e-6, weight, 0.05 * weight);
  EXPECT_EQ(force[0], 0);  // nothing could have acted yet
  const std::vector<double>& instant = table.at("Instant_Reaction_Z(hold)");
  // At first of the held points alone, a layer of six; the mirror image of a body holds it once it is strained.
  const bool is_mirror = GetParam().find("Symmetry Plane") != std::string::npos;
  EXPECT_NEAR(instant[0], is_mirror ? 0 : weight / 6, 1e-9 * weight);
  // With steps of one length, and impulses in their middles, a mean is that of both ends.
  for (std::size_t n = 1; n < time.size(); ++n) {
    ASSERT_NEAR(force[n], 0.5 * (instant[n - 1] + instant[n]), 1e-9 * weight) << n;
  }
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
  const auto unexplained = [&](std::size_t n) { return momentum[n] - impulse(low, time, n) - impulse(high, time, n); };
  for (std::size_t n = 2; n < low.size(); ++n) {
    ASSERT_NEAR(unexplained(n), unexplained(1), 1e-11 * largest * 100e-6) << n;  // round-off of a sum
  }
}

// One condition along three axes is three conditions, to the last bit: so is each component of its reaction.
TEST(Reaction, OfOneConditionIsThatOfOneForEachAxis) {
  const std::string moved = "1e-6*sin(2e5*t)*(1 + 100*x)", load = "-1e9*(1 + 50*y)", start = "5*z/6e-3";
  const auto each = [](const std::string& type, const std::string& set, const std::string& axes,
                       const std::string& value) {
    std::string all;
    for (const char axis : axes) all += along(type + " " + axis, type, set, std::string(1, axis), value);
    return all;
  };
  Parts many, one;
  many.conditions = each("Initial Velocity", "all", "xy", start) + each("Body Force", "all", "yz", load) +
                    each("Prescribed Displacement", "foot", "xyz", moved) +
                    each("Prescribed Velocity", "top", "xz", "-3");
  one.conditions = along("start", "Initial Velocity", "all", "xy", start) +
                   along("load", "Body Force", "all", "yz", load) +
                   along("hold", "Prescribed Displacement", "foot", "zyx", moved) +
                   along("pull", "Prescribed Velocity", "top", "xz", "-3");
  std::vector<std::string> of_many = {"Reaction_X(Prescribed Displacement x)", "Reaction_Y(Prescribed Displacement y)",
                                      "Reaction_Z(Prescribed Displacement z)", "Reaction_X(Prescribed Velocity x)",
                                      "Reaction_Z(Prescribed Velocity z)"};
  std::vector<std::string> of_one = {"Reaction_X(hold)", "Reaction_Y(hold)", "Reaction_Z(hold)", "Reaction_X(pull)",
                                     "Reaction_Z(pull)"};
  const Table expected = history_of(many, of_many), found = history_of(one, of_one);
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [name, column] : expected) {
    const auto place = std::find(of_many.begin(), of_many.end(), name);
    const std::string& same = place == of_many.end() ? name : of_one[place - of_many.begin()];
    EXPECT_EQ(found.at(same), column) << name;
    EXPECT_TRUE(place == of_many.end() || column.back() != 0) << name << " is nothing";
  }
}

// However far apart the rows are. The pushed points start with their velocity.
TEST(Reaction, IsAMeanSinceTheRowBefore) {
  Parts parts;
  parts.node_sets = key("first", "z &lt; 1e-3") + key("last", "z &gt; 5e-3");
  parts.conditions = pull + along("hold", "Prescribed Displacement", "first", "z", "0") +
                     along("push", "Prescribed Velocity", "last", "z", "-20");
  parts.times = key("Final Time", "30.1e-6");
  const std::vector<std::string> names = {"Reaction_Z(hold)", "Reaction_Z(push)"};
  const double start = -20 * 8930 * 16e-9;  // kg m/s, of a layer of 4 × 4 points
  for (const int frequency : {1, 7, 1000}) {
    const Table table = history_of(parts, names, {}, frequency);
    const std::vector<double>&time = table.at("Time"), &momentum = table.at("Momentum_Z");
    ASSERT_EQ(time.size() == 2, frequency == 1000);
    for (std::size_t n = 1; n < time.size(); ++n) {
      const double forces = impulse(table.at(names[0]), time, n) + impulse(table.at(names[1]), time, n);
      // Round-off of a sum of some hundred steps.
      ASSERT_NEAR(start + forces - weight * time[n], momentum[n], 1e-11 * weight * 30e-6) << n;
    }
  }
}

// Friction acts between points, with couples on their neighborhoods, which reach the images behind the planes.
TEST(Reaction, OfSymmetryPlanesHasTheCouplesOfFriction) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0, 0, 0}, 4, 4, 2, 1e-3) + cubes(2, {0.4e-3, 0.3e-3, 2.05e-3}, 3, 3, 2, 1e-3));
  Parts parts = thrown_block(contact_of({{"block_1", "block_2"}}, "1e-3", "1e12", "0.3"));
  parts.node_sets = key("foot", "z &lt; 1e-3") + key("front", "(y &lt; 1e-3)*(z &lt; 2e-3)") +
                    key("back", "(y &gt; 3e-3)*(z &lt; 2e-3)");
  parts.conditions += along("slide", "Initial Velocity", "block_2", "xy", "60");
  parts.conditions += plane("z", "Symmetry Plane", "foot", "0 0 0", "0 0 1") +
                      plane("y", "Symmetry Plane", "front", "0 0 0", "0 1 0") +
                      plane("-y", "Symmetry Plane", "back", "0 4e-3 0", "0 -1 0");
  parts.times = key("Final Time", "3e-6");
  const Table table = history_in(folder, parts, {"Reaction_Z(z)", "Reaction_Y(y)", "Reaction_Y(-y)"});
  const std::vector<double>& time = table.at("Time");
  const auto given = [&](const std::string& name) { return impulse(table.at(name), time, time.size() - 1); };
  const auto gained = [&](const std::string& name) { return table.at(name).back() - table.at(name).front(); };
  const double round_off = 1e-12 * std::abs(table.at("Momentum_Z").front());  // of some hundred steps
  EXPECT_GT(gained("Momentum_Z"), 1e3 * round_off);
  EXPECT_GT(std::abs(given("Reaction_Y(y)")), 1e3 * round_off);
  EXPECT_NEAR(given("Reaction_Z(z)"), gained("Momentum_Z"), round_off);
  EXPECT_NEAR(given("Reaction_Y(y)") + given("Reaction_Y(-y)"), gained("Momentum_Y"), round_off);
}

// Points of the crushed foot are subcycled, and the step shrinks with the deformation by some percent at a time. The
// sum is that of 2000 steps of an impulse of 0.15 N s, some of which cancel.
class StoppedBar : public testing::TestWithParam<std::string> {};

TEST_P(StoppedBar, HasTheImpulsesOfSubstepsInItsReaction) {
  Lattice lattice;
  lattice.nz = 60;
  Parts parts;
  parts.materials = copper(key("Yield Stress", "100e6"));
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-227") + GetParam();
  parts.times = key("Final Time", "20e-6");
  for (const int frequency : {1, 20}) {
    const Table table = history_of(parts, {"Reaction_Z(wall)"}, lattice, frequency);
    const std::vector<double>& momentum = table.at("Momentum_Z");
    const double stopped = momentum.back() - momentum.front();
    EXPECT_GT(stopped, -0.05 * momentum.front());
    EXPECT_NEAR(impulse(table.at("Reaction_Z(wall)"), table.at("Time"), momentum.size() - 1), stopped, 1e-10 * stopped);
  }
}

INSTANTIATE_TEST_SUITE_P(By, StoppedBar,
                         testing::Values(plane("wall", "Rigid Plane", "all", "0 0 -0.2e-3", "0 0 1"),
                                         plane("wall", "Symmetry Plane", "foot", "0 0 0", "0 0 1")));

// The force of one of two planes is that through the bonds to its images: where a point has substeps and an image has
// none, too, or the other way about. The stiff end of the bar has them.
class BarBetweenPlanes : public testing::TestWithParam<std::string> {};

TEST_P(BarBetweenPlanes, HasTheImpulsesOfSubstepsInItsReactions) {
  Parts parts =
      stiff_ended_bar(changed(copper(), key("Density", "8930"), key("Density", "8930") + GetParam()), "1.17e9");
  parts.node_sets = key("low", "x &lt; 1e-3") + key("high", "x &gt; 3e-3");
  parts.conditions = along("flight", "Initial Velocity", "all", "x", "20*sin(900*x)*(1 + 50*z)") +
                     plane("left", "Symmetry Plane", "low", "0 0 0", "1 0 0") +
                     plane("right", "Symmetry Plane", "high", "4e-3 0 0", "-1 0 0");
  parts.times = key("Final Time", "9e-6");
  parts.verlet = key("Subcycling", "true");
  const Table table =
      history_of(parts, {"Reaction_X(left)", "Reaction_X(right)"}, {.nx = 4, .ny = 4, .nz = 20, .plate_layers = 4});
  const std::vector<double>&time = table.at("Time"), &momentum = table.at("Momentum_X");
  EXPECT_LT(time.size(), 20u) << "steps are as long as the soft part lets them be";
  for (std::size_t n = 1; n < time.size(); ++n) {
    const double given =
        impulse(table.at("Reaction_X(left)"), time, n) + impulse(table.at("Reaction_X(right)"), time, n);
    EXPECT_NEAR(given, momentum[n] - momentum[0], 1e-11 * momentum[0]) << n;  // round-off of a sum over points
  }
}

INSTANTIATE_TEST_SUITE_P(By, BarBetweenPlanes,
                         testing::Values("", key("Stabilization", "Silling"),
                                         key("Formulation", "Quadratic Correspondence")));

}  // namespace
}  // namespace strut::regression
