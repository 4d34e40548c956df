// When points take smaller steps of their own: where that saves time, by what points cost.
#include <gtest/gtest.h>

#include "regression/stiff_ended_bar.hpp"
#include "verification/larger.hpp"

namespace strut::regression {
namespace {

// A third of the points are stiff, sixteen times as fast as the others, and a body of their own.
int most_substeps(const std::string& formulation) {
  const RunFolder folder({.nx = 6, .ny = 6, .nz = 12, .plate_layers = 4});
  const std::string soft = changed(changed(copper(), "\"copper\"", "\"soft\""), "117e9", "0.457e9");
  Parts parts;
  parts.materials = changed(copper(), key("Density", "8930"), key("Density", "8930") + formulation) + soft;
  const auto block = [](const std::string& name, const std::string& material) {
    return section(name, key("Block Names", name) + key("Material", material) + key("Horizon Factor", "1.75") +
                             key("Separate Body", "true"));
  };
  parts.blocks = block("bar", "soft") + block("plate", "copper");
  parts.conditions = along("flight", "Initial Velocity", "bar", "z", "20");
  Simulation simulation(folder, parts);
  simulation.solver.advance_velocity(1);
  simulation.solver.advance_position(false);
  return simulation.solver.most_substeps();
}

// With points that cost the same: a third of them takes 16 substeps at 1.5 times the cost, the others one step in 16.
TEST(Subcycling, IsOfStiffPointsThatCostAsMuchAsOthers) { EXPECT_GT(most_substeps(""), 1); }

// With stiff points that cost four times as much as the others, these are two thirds of all costs: to save the steps of
// the rest is not worth half as many steps more of these.
TEST(Subcycling, IsNotOfStiffPointsThatCostMost) {
  EXPECT_EQ(most_substeps(key("Formulation", "Quadratic Correspondence")), 1);
}

// A free bar, the upper part of which is a hundred times as stiff and has substeps.
Parts bar_with_substeps(const std::string& formulation, const std::string& load) {
  std::string stiff = copper();
  if (!formulation.empty()) {
    stiff = changed(stiff, key("Density", "8930"), key("Density", "8930") + key("Formulation", formulation));
  }
  Parts parts = stiff_ended_bar(stiff, "1.17e9");
  parts.conditions = along("pull", "Body Force", "all", "z", load);
  return parts;
}

// Under a load for a part of the run it gains force times time, as one. It stays in rigid motion, where there is
// nothing to do between whole steps.
TEST(Subcycling, LeavesLoadsOnABodyInRigidMotionAsTheyAre) {
  for (const std::string& formulation : std::vector<std::string>{"", "Quadratic Correspondence"}) {
    const RunFolder folder({.nx = 4, .ny = 4, .nz = 40, .plate_layers = 4});
    Simulation run(folder, bar_with_substeps(formulation, "if (t &lt; 5e-6) { value = 1e9; } else { value = 0; }"));
    const Body& body = run.body();
    double apart = 0;
    const Ledger end = run.go([&](const Ledger&) {
      for (int i = 0; i < body.owned(); ++i) apart = larger(apart, (body.velocity[i] - body.velocity[0]).norm());
    });
    EXPECT_GT(run.solver.most_substeps(), 1);
    // A load that ends suddenly does so within a substep or two.
    const double impulse = 1e9 * run.volume() * 5e-6, substep = end.dt / run.solver.most_substeps();
    EXPECT_NEAR(end.momentum[2], impulse, 1e9 * run.volume() * 2 * substep);
    EXPECT_EQ(apart, 0) << "on this rank";
    EXPECT_LT(end.balance_error, 1e-10);  // round-off of a sum over points and steps
  }
}

// The mean of a load over the times of an impulse is exact of a ramp, from its beginning on: ½ F T.
TEST(Subcycling, GivesTheWholeImpulseOfARamp) {
  const RunFolder folder({.nx = 4, .ny = 4, .nz = 40, .plate_layers = 4});
  Simulation run(folder, bar_with_substeps("", "1e9 * t / 20e-6"));
  const Ledger end = run.go([](const Ledger&) {});
  EXPECT_GT(run.solver.most_substeps(), 1);
  EXPECT_NEAR(end.momentum[2] / (0.5 * 1e9 * run.volume() * 20e-6), 1,
              1e-10);  // round-off of a sum over points and steps
}

// The same body at rest, with a stiff end, and another one that flies to it.
Parts struck_bar(const RunFolder& folder, double z = 0, double apart = 0.2e-3) {
  const Vector at(0, 0, z);
  folder.write("points.txt", cubes(1, at, 4, 4, 20, 1e-3) + cubes(2, at + Vector(0, 0, 20e-3), 4, 4, 4, 1e-3) +
                                 cubes(3, at + Vector(0, 0, 24e-3 + apart), 4, 4, 4, 1e-3));
  Parts parts;
  parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
  parts.materials = copper() + changed(changed(copper(), "\"copper\"", "\"soft\""), "117e9", "1.17e9");
  const auto block = [](const std::string& names, const std::string& material, bool apart) {
    return section(names, key("Block Names", names) + key("Material", material) + key("Horizon Factor", "1.75") +
                              (apart ? key("Separate Body", "true") : ""));
  };
  parts.blocks = block("block_1", "soft", false) + block("block_2", "copper", false) + block("block_3", "soft", true);
  parts.conditions = along("flight", "Initial Velocity", "block_3", "z", "-20");
  parts.times = key("Final Time", "30e-6");
  return parts;
}

// Contact pushes both alike.
TEST(Subcycling, LeavesContactForcesOnABodyAtRestAsTheyAre) {
  const RunFolder folder;
  Parts parts = struck_bar(folder);
  parts.contact = contact_of({{"block_2", "block_3"}}, "1e-3", "1e11");
  Simulation run(folder, parts);
  double thrown = 0, drift = 0;
  run.go([&](const Ledger& now) {
    if (now.time == 0) thrown = now.momentum[2];
    drift = larger(drift, std::abs(now.momentum[2] - thrown));
  });
  EXPECT_GT(run.solver.most_substeps(), 1);
  EXPECT_GT(run.body().velocity.size(), 0u);
  EXPECT_LT(drift, 1e-10 * std::abs(thrown));  // forces are pairs but for the round-off of places
}

// One impulse a step, in which the stiff end goes through several periods, would feed its vibrations: what contact, or
// a tool with a mass, pushes takes two substeps at the most. A touch that begins within a step costs some percent.
TEST(Subcycling, OfWhatIsPushedKeepsTheEnergy) {
  const auto worst_balance = [](const std::string& contact, const std::string& tool) {
    const RunFolder folder;
    Parts parts = struck_bar(folder);
    parts.contact = contact;
    parts.conditions += tool;
    Simulation run(folder, parts);
    double worst = 0;
    run.go([&](const Ledger& now) { worst = larger(worst, now.balance_error); });
    EXPECT_GT(run.solver.most_substeps(), 1) << "before they meet";
    return worst;
  };
  EXPECT_LT(worst_balance(contact_of({{"block_2", "block_3"}}, "1e-3", "1e10"), ""), 0.05);
  EXPECT_LT(worst_balance(section("Models", section("m", key("Contact Model", "Surface"))) +
                              section("Interactions", section("any", key("Contact Model", "m"))),
                          ""),
            0.05);
  const std::string mass =
      section("punch", key("Type", "Rigid Plane") + key("Node Set", "block_2") + key("Point", "0 0 24.1e-3") +
                           key("Normal", "0 0 -1") + key("Mass", "1e-4") + key("Speed Z", "-20"));
  EXPECT_LT(worst_balance("", mass), 0.05);
}

// How far the foot of a block slips that is pressed onto a rough plane and pushed by nearly what friction bears, m; the
// plane may come to it after 20 µs. Its upper layer is stiffer.
double slip(const std::string& subcycling, bool lands) {
  const RunFolder folder({.nx = 6, .ny = 6, .nz = 12, .plate_layers = 1});
  const std::string quadratic = key("Density", "8930") + key("Formulation", "Quadratic Correspondence");
  Parts parts = stiff_ended_bar(changed(copper(), key("Density", "8930"), quadratic), "20e9");
  const std::string normal = key("Normal", "0 0 1");
  const std::string travel = lands ? key("Travel Z", "-2e-4 + 2e-4 * min(1, t / 2e-5)") : "";
  const std::string since = lands ? "* min(1, max(0, t - 2e-5) / 1e-4)" : "* min(1, t / 1e-4)";
  parts.conditions = changed(plane("floor", "Rigid Plane", "all", "0 0 0", "0 0 1"), normal,
                             normal + key("Friction Coefficient", "0.5") + travel) +
                     along("weight", "Body Force", "bar", "z", "-4e6" + since) +
                     along("push", "Body Force", "bar", "x", "1.68e6" + since);
  parts.times = key("Final Time", lands ? "2.2e-4" : "2e-4");
  parts.verlet = key("Subcycling", subcycling);
  Simulation run(folder, parts);
  run.go([](const Ledger&) {});
  EXPECT_EQ(run.solver.most_substeps() > 1, subcycling == "true");
  double moved[] = {0, 0};  // sum, m; points
  const Body& body = run.body();
  for (int i = 0; i < body.owned(); ++i) {
    if (body.domain.reference(i)[2] < 1e-3) moved[0] += body.displacement(i)[0], moved[1] += 1;
  }
  body.domain.communicator.sum(moved);
  return moved[0] / moved[1];
}

// Friction that takes the velocity of points between the impulses of their neighbors let them slip 1.7 times as far.
// The vibrations of the two runs differ by their steps: 0.97 where the tool lands later.
TEST(Subcycling, LetsARoughFootSlipAsFar) {
  for (const bool lands : {false, true}) EXPECT_NEAR(slip("true", lands) / slip("false", lands), 1, 0.04) << lands;
}

// A tool with a mass is just where it counts as near to what it may push.
TEST(Subcycling, IsTheSameWhereverABodyIs) {
  const auto first_step = [](double z) {
    const RunFolder folder;
    Parts parts = struck_bar(folder, z, 9e-3);
    std::ostringstream place;
    place.precision(17);
    place << "0 0 " << z + 24.05e-3;  // 0.05 spacings beside the body
    parts.conditions += section("punch", key("Type", "Rigid Plane") + key("Node Set", "block_2") + key("Mass", "1") +
                                             key("Point", place.str()) + key("Normal", "0 0 -1"));
    Simulation run(folder, parts);
    run.solver.advance_velocity(1);
    return run.solver.dt();
  };
  const double here = first_step(0);
  for (int n = 1; n <= 16; ++n) {
    // Lanczos' estimate, of the round-off of places a few of its sizes away.
    EXPECT_NEAR(first_step(n * 1.234567e-3) / here, 1, 1e-6) << n;
  }
}

}  // namespace
}  // namespace strut::regression
