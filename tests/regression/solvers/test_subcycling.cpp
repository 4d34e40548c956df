// When points take smaller steps of their own: where that saves time, by what points cost.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"

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

}  // namespace
}  // namespace strut::regression
