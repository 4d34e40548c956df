// Mass scaling: a step as long as the deck wants it, by mass that is told.
#include <gtest/gtest.h>

#include "regression/stiff_ended_bar.hpp"

namespace strut::regression {
namespace {

const std::vector<std::string> formulations = {"", "Quadratic Correspondence", "ordinary"};

// A free bar, the upper tenth of which is sixteen times as stiff: four times as fast.
Parts bar(const std::string& formulation, const std::string& verlet) {
  std::string stiff = copper();
  if (formulation == "ordinary") {
    stiff = changed(stiff, "Elastic Correspondence", "Elastic");
  } else if (!formulation.empty()) {
    stiff = changed(stiff, key("Density", "8930"), key("Density", "8930") + key("Formulation", formulation));
  }
  Parts parts = stiff_ended_bar(stiff, "7.3e9");
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "30 * sin(z / 0.02)");
  parts.verlet = key("Safety Factor", "0.8") + key("Subcycling", "false") + verlet;
  return parts;
}

const Lattice lattice{.nx = 4, .ny = 4, .nz = 40, .plate_layers = 4};

std::string wanted(double dt, const std::string& most) {
  return key("Mass Scaling dt", std::to_string(dt * 1e9) + "e-9") + key("Most Added Mass", most);
}

double usual_step(const RunFolder& folder, const std::string& formulation) {
  return 0.8 * Simulation(folder, bar(formulation, "")).solver.critical_time_step();
}

double added_mass(const Simulation& run) {
  const Body& body = run.scene.body;
  double added = 0;
  for (int i = 0; i < body.owned(); ++i)
    added += body.mass(i) - body.block_of(i).material.density * body.domain.volume(i);
  return body.domain.communicator.sum(added);
}

// Twice the step: of the stiff tenth only, which then has at least four times its mass and not much more, as bounds of
// single points are not equally far from what they bound. The bar moves and rings on, its energy balanced.
TEST(MassScaling, MakesTheStepAsLongAsWanted) {
  for (const std::string& formulation : formulations) {
    const RunFolder folder(lattice);
    const double usual = usual_step(folder, formulation);
    Simulation run(folder, bar(formulation, wanted(2 * usual, "1")));
    const double volume = run.volume(), fraction = added_mass(run) / (8930 * volume);
    EXPECT_GE(0.8 * run.solver.critical_time_step(), 2 * usual * (1 - 1e-6)) << formulation;  // digits of the deck
    const Ledger end = run.go([](const Ledger&) {});
    EXPECT_GT(fraction, 0.1) << formulation;  // less than (4 − 1)/10: points at its surface are slower
    EXPECT_LT(fraction, 0.5) << formulation;
    EXPECT_LT(end.balance_error, 2e-3) << formulation;  // leap-frog steps: (ω dt)² of the modes that ring
    EXPECT_NE(run.advice.warnings.find("mass scaling for a step of"), std::string::npos);
    EXPECT_EQ(run.advice.warnings.find(" on 0 of "), std::string::npos) << run.advice.warnings;
    EXPECT_NE(run.advice.warnings.find(", more than Most Added Mass, which limits that of all"), std::string::npos);
  }
}

// Force times time is momentum, whatever the mass; and that of the larger one, from velocities that are all the same.
TEST(MassScaling, LeavesForcesAsTheyAre) {
  const RunFolder folder(lattice);
  const double usual = usual_step(folder, "");
  Parts parts = bar("", wanted(2 * usual, "1"));
  parts.conditions =
      along("flight", "Initial Velocity", "all", "z", "3") + along("pull", "Body Force", "all", "z", "1e9");
  Simulation run(folder, parts);
  const double mass = 8930 * run.volume() + added_mass(run), force = 1e9 * run.volume();
  const Ledger end = run.go([](const Ledger&) {});
  // Round-off of a sum over points and steps.
  EXPECT_NEAR(end.momentum[2], 3 * mass + force * 20e-6, 1e-10 * end.momentum[2]);
}

TEST(MassScaling, AddsNothingToAStepThatIsLongEnough) {
  const RunFolder folder(lattice);
  Simulation usual(folder, bar("", "")), scaled(folder, bar("", wanted(1e-9, "1e-6")));
  EXPECT_EQ(scaled.solver.critical_time_step(), usual.solver.critical_time_step());
  for (int i = 0; i < scaled.body().owned(); ++i) EXPECT_EQ(scaled.body().density[i], 8930);
  EXPECT_NE(scaled.advice.warnings.find("mass scaling adds nothing"), std::string::npos);
}

TEST(MassScaling, IsRefusedAboveAShare) {
  const RunFolder folder(lattice);
  const double usual = usual_step(folder, "");
  try {
    Simulation run(folder, bar("", wanted(2 * usual, "0.05")));
    ADD_FAILURE() << "it ran";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("Solver > Verlet > Mass Scaling dt: a step of"), 0u) << error.what();
    EXPECT_NE(std::string(error.what()).find("expected 5 % at most (Most Added Mass)"), std::string::npos);
  }
}

}  // namespace
}  // namespace strut::regression
