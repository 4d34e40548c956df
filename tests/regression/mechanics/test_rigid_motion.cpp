// Bodies that fly or rest as a whole are skipped until something reaches them, with the result of the full computation.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "verification/larger.hpp"

namespace strut::regression {
namespace {

constexpr double h = 1e-3;  // spacing, m

// A cube flies, at 20 m/s through a gap of half a spacing, against another at rest; a third stands far below, held at
// its foot. `third`: its material.
Parts scene(const RunFolder& folder, const std::string& third) {
  folder.write("points.txt", cubes(1, {0, 0, 0}, 4, 4, 4, h) + cubes(2, {0, 0, 4.5 * h}, 4, 4, 4, h) +
                                 cubes(3, {0, 0, -9 * h}, 4, 4, 4, h));
  Parts parts;
  parts.mesh_type = "Text File";
  parts.mesh_file = "points.txt";
  parts.materials += section("other", third);
  parts.blocks = "";
  for (const std::string block : {"block_1", "block_2", "block_3"}) {
    parts.blocks +=
        section(block, key("Block Names", block) + key("Material", block == "block_3" ? "other" : "copper") +
                           key("Horizon", "2.01e-3") + key("Separate Body", "true"));
  }
  parts.contact = contact_of({{"block_1", "block_2"}, {"block_1", "block_3"}}, "1e-3", "1e11");
  parts.node_sets = key("ground", "z &lt; -8.4e-3");
  parts.conditions = along("flight", "Initial Velocity", "block_2", "z", "-20") +
                     along("foot", "Prescribed Displacement", "ground", "z", "0");
  parts.times = key("Final Time", "50e-6");
  return parts;
}

const std::string correspondence = key("Material Model", "Elastic Correspondence") + key("Density", "8930") +
                                   key("Young's Modulus", "117e9") + key("Poisson's Ratio", "0.35");
// So stiff that its points are subcycled.
const std::string stiff = key("Material Model", "Elastic Correspondence") + key("Density", "8930") +
                          key("Young's Modulus", "4.8e14") + key("Poisson's Ratio", "0.35");
const std::string ordinary = key("Material Model", "Elastic") + key("Density", "8930") +
                             key("Young's Modulus", "117e9") + key("Poisson's Ratio", "0.35");

struct Outcome {
  std::vector<double> places;            // of all points, in the order of their ids, m
  std::vector<double> reached{0, 0, 0};  // when each body was reached, s
  double balance = 0;
};

// `nudged`: a point of each body starts with a velocity that differs from the others' in its last digit, so that all is
// computed from the first step on.
Outcome outcome_of(Simulation& run, bool nudged) {
  Body& body = run.body();
  for (int i = 0; nudged && i < body.owned(); ++i) {
    if (body.domain.cloud.ids[i] % 64 == 0) body.velocity[i][0] += 1e-15;
  }
  Outcome outcome;
  const Ledger end = run.go([&](const Ledger& now) {
    for (std::size_t b = 0; b < 3; ++b) {
      if (body.blocks[b].in_rigid_motion) outcome.reached[b] = now.time;
    }
  });
  outcome.balance = end.balance_error;
  outcome.places.assign(3 * 192, 0);
  for (int i = 0; i < body.owned(); ++i) {
    const Vector u = body.displacement(i);
    for (int c = 0; c < 3; ++c) outcome.places[3 * body.domain.cloud.ids[i] + c] = u[c];
  }
  body.domain.communicator.sum(outcome.places);
  return outcome;
}

class Undisturbed : public testing::TestWithParam<std::string> {};

TEST_P(Undisturbed, BodiesAreSkippedUntilTheyAreReached) {
  const RunFolder folder;
  Simulation skipping(folder, scene(folder, GetParam())), full(folder, scene(folder, GetParam()));
  const Outcome some = outcome_of(skipping, false), all = outcome_of(full, true);
  // The gap between the contact radii, half a spacing, is crossed in 25 µs: until the step in which it closes.
  const double closed = 0.5 * h / 20, step = skipping.solver.dt();
  EXPECT_NEAR(some.reached[0], closed, 2 * step);
  EXPECT_EQ(some.reached[0], some.reached[1]);
  EXPECT_EQ(skipping.solver.most_substeps() > 1, GetParam() == stiff);
  EXPECT_GT(some.reached[2], 49e-6) << "the third is never reached";
  for (const double time : all.reached) EXPECT_EQ(time, 0);
  double off = 0, largest = 0;
  for (std::size_t k = 0; k < all.places.size(); ++k) {
    off = larger(off, std::abs(some.places[k] - all.places[k]));
    largest = larger(largest, std::abs(all.places[k]));
  }
  EXPECT_LT(off, 1e-12 * largest);
  EXPECT_NEAR(some.balance, all.balance, 1e-9);
}

const std::vector<std::string> names{"Correspondence", "Stiff", "Ordinary"};
INSTANTIATE_TEST_SUITE_P(Third, Undisturbed, testing::Values(correspondence, stiff, ordinary),
                         [](const auto& info) { return names[info.index]; });

// A cube flies half a spacing before it meets a plane. No bond breaks, because its energy is a tenth of the necessary
// one; a rank that took the points of other ranks at their positions before the flight would break all bonds to them.
TEST(Undisturbed, ABodyIsWholeWhenItIsFirstStrained) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0, 0, 0}, 4, 4, 4, h));
  Parts parts;
  parts.mesh_type = "Text File";
  parts.mesh_file = "points.txt";
  parts.materials = section("glass", ordinary);
  parts.damage = section("tough", key("Damage Model", "Bond Energy") + key("Fracture Energy", "1e5"));
  parts.blocks = section("cube", key("Block Names", "all") + key("Material", "glass") + key("Horizon", "2.01e-3") +
                                     key("Damage Model", "tough"));
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-20") +
                     section("wall", key("Type", "Rigid Plane") + key("Point", "0 0 -1e-3") + key("Normal", "0 0 1"));
  parts.times = key("Final Time", "80e-6");
  Simulation run(folder, parts);
  const Ledger end = run.go([](const Ledger&) {});
  EXPECT_LT(end.tools, 0) << "it has met the plane";
  EXPECT_EQ(end.fracture, 0);
}

// In the first strained step, too, bonds across a symmetry plane have their far ends behind it: a half that breaks in
// this step, and in later ones, as its top is torn off, has half of the whole's energies.
TEST(Undisturbed, AHalfThatBreaksInItsFirstStepIsHalfOfTheWhole) {
  const RunFolder folder;
  folder.write("whole.txt", cubes(1, {-3 * h, 0, 0}, 6, 4, 4, h));
  folder.write("half.txt", cubes(1, {0, 0, 0}, 3, 4, 4, h));
  Parts parts;
  parts.mesh_type = "Text File";
  parts.materials = section("glass", ordinary);
  parts.damage = section("brittle", key("Damage Model", "Critical Stretch") + key("Critical Stretch", "1e-3"));
  parts.blocks = section("cube", key("Block Names", "all") + key("Material", "glass") + key("Horizon", "2.01e-3") +
                                     key("Damage Model", "brittle"));
  parts.node_sets = key("top", "z &gt; 3e-3") + key("inner", "x &lt; 1e-3");
  parts.conditions = along("flight", "Initial Velocity", "top", "z", "40");
  parts.times = key("Final Time", "4e-7");
  parts.verlet = key("Fixed dt", "5e-8");
  Parts of_half = parts;
  parts.mesh_file = "whole.txt", of_half.mesh_file = "half.txt";
  of_half.conditions += plane("mirror", "Symmetry Plane", "inner", "0 0 0", "1 0 0");
  Simulation whole(folder, parts), half(folder, of_half);
  const auto nothing = [](const Ledger&) {};
  const Ledger all = whole.go(nothing), half_of_it = half.go(nothing);
  EXPECT_GT(all.fracture, 1e-3 * all.kinetic);
  EXPECT_NEAR(2 * half_of_it.fracture, all.fracture, 1e-9 * all.fracture);  // round-off of stretches of 1e-3
  EXPECT_NEAR(2 * half_of_it.kinetic, all.kinetic, 1e-9 * all.kinetic);
}

// A cube on a lattice, no bond of which may break, rests beside one whose bonds may: also on a rank that has none of
// these it is asked neither for clusters nor for breaks, and in the end it has not moved.
TEST(Undisturbed, ABodyThatMayNotBreakRestsBesideOneThatMay) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0, 0, 0}, 6, 6, 6, h) + cubes(2, {0, 0, 11 * h}, 6, 6, 6, h));
  Parts parts;
  parts.mesh_type = "Text File";
  parts.mesh_file = "points.txt";
  parts.damage = section("brittle", key("Damage Model", "Critical Stretch") + key("Critical Stretch", "0.01"));
  const std::string common = key("Material", "copper") + key("Horizon", "4.01e-3");  // lattices are faster then
  parts.blocks = section("rests", key("Block Names", "block_1") + common + key("Separate Body", "true")) +
                 section("swells", key("Block Names", "block_2") + common + key("Damage Model", "brittle"));
  parts.conditions = along("swelling", "Initial Velocity", "block_2", "z", "5e3*z");
  parts.times = key("Final Time", "2e-6");
  Simulation run(folder, parts);
  run.go([](const Ledger&) {});
  Body& body = run.body();
  EXPECT_GE(body.domain.communicator.max(body.blocks[0].lattice), 0);
  double moved = 0;
  for (const int i : body.blocks[0].points) moved = std::max(moved, body.displacement(i).norm());
  EXPECT_EQ(moved, 0);
  EXPECT_GT(run.solver.ledger().elastic, 0);
}

// A motion that begins later: at rest until then.
TEST(Undisturbed, AMotionBeginsWhenItBegins) {
  const RunFolder folder;
  Parts parts;
  parts.conditions =
      along("pull", "Prescribed Velocity", "top", "z", "if (t &gt; 2e-6) { value = 1; } else { value = 0; }");
  Simulation run(folder, parts);
  double rest = 0;
  run.go([&](const Ledger& now) {
    if (run.body().blocks[0].in_rigid_motion) rest = now.time;
  });
  EXPECT_NEAR(rest, 2e-6, 2 * run.solver.dt());
  EXPECT_GT(run.solver.ledger().elastic, 0);
}

}  // namespace
}  // namespace strut::regression
