// Means, layers and contact forces of the history: of motions that are known, and beside the momentum that they
// explain.
#include <gtest/gtest.h>

#include "regression/stretched.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

constexpr double h = 1e-3;            // spacing, m
constexpr double cube = 8930 * 1e-9;  // kg, of a point

// The history, of every step, of a run with these variables.
Table history_of(const RunFolder& folder, Parts parts, const std::vector<std::string>& variables,
                 const std::string& profiles = "") {
  std::string names;
  for (const std::string& name : variables) names += key(name, "true");
  parts.history = key("Filename", (folder / "history.csv").string()) + key("Frequency", "1") +
                  section("Variables", names) + (profiles.empty() ? "" : section("Profiles", profiles));
  testing::internal::CaptureStdout();
  run(folder.write("deck.xml", parts.text()), folder.world);
  testing::internal::GetCapturedStdout();
  return read_history(folder / "history.csv");
}

// A bar of 4 x 4 x 6 cubes whose points fly with v = (1, 2, 3 + z/mm) m/s, from the first row on.
TEST(Means, AreThoseOfAMotionThatIsGiven) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = along("x", "Initial Velocity", "all", "x", "1") + along("y", "Initial Velocity", "all", "y", "2") +
                     along("z", "Initial Velocity", "all", "z", "3 + 1000*z");
  parts.times = key("Final Time", "1e-7");
  const std::string profiles =
      section("thirds", key("Layers", "3")) + section("across", key("Layers", "2") + key("Direction", "-1 0 0"));
  const Table table = history_of(
      folder, parts,
      {"Mean_Velocity_Y", "Mean_Velocity_Z(top)", "Mean_Velocity_Z(thirds)", "Mean_Coordinate_Z(thirds)",
       "Mean_Coordinate_X(across)", "Max_Velocity_Z(foot)", "Min_Velocity_Z(foot)", "Mean_Deformation_Gradient_ZZ"},
      profiles);
  const auto first = [&](const std::string& name) { return table.at(name).front(); };
  // Round-off of sums of 96 points.
  EXPECT_NEAR(first("Mean_Velocity_Y"), 2, 1e-13);
  EXPECT_NEAR(first("Mean_Velocity_Z(top)"), 3 + 5.5, 1e-13);
  EXPECT_NEAR(first("Max_Velocity_Z(foot)"), 3 + 0.5, 1e-13);
  EXPECT_NEAR(first("Min_Velocity_Z(foot)"), 3 + 0.5, 1e-13);
  EXPECT_NEAR(first("Mean_Deformation_Gradient_ZZ"), 1, 1e-13);
  for (int layer = 1; layer <= 3; ++layer) {
    const std::string column = "(thirds " + std::to_string(layer) + ")";
    EXPECT_NEAR(first("Mean_Velocity_Z" + column), 3 + 2 * layer - 1, 1e-13) << layer;
    EXPECT_NEAR(first("Mean_Coordinate_Z" + column), (2 * layer - 1) * h, 1e-16) << layer;
  }
  EXPECT_NEAR(first("Mean_Coordinate_X(across 1)"), 3 * h, 1e-16);
  EXPECT_NEAR(first("Mean_Coordinate_X(across 2)"), 1 * h, 1e-16);
}

// Cells of 4 x 4 x 1 mm: six layers are those of the mesh.
TEST(Means, OfLayersOfFlatCells) {
  const Lattice lattice;
  const RunFolder folder(lattice);
  write_stretched(folder, lattice, {4, 4, 1});
  Parts parts;
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "8.1e-3"));
  parts.times = key("Final Time", "1e-8");
  for (const int count : {3, 6}) {
    const Table table = history_of(folder, parts, {"Mean_Coordinate_Z(slices)"},
                                   section("slices", key("Layers", std::to_string(count))));
    for (int layer = 1; layer <= count; ++layer) {
      const std::string column = "Mean_Coordinate_Z(slices " + std::to_string(layer) + ")";
      EXPECT_NEAR(table.at(column).front(), (layer - 0.5) * 6 * h / count, 1e-16) << layer;
    }
  }
}

// Nodes at z = 2, 3, 4 and 5 mm: a tool far away, for which cells are read, is nothing to the layers between them.
TEST(Means, OfLayersOfNodesAreTheSameBesideATool) {
  const RunFolder folder;
  Parts parts;
  parts.points = "Nodes";
  parts.node_sets = key("middle", "abs(z - 3.5e-3) &lt; 1.6e-3");
  parts.times = key("Final Time", "1e-8");
  for (const std::string& tool : {std::string(), plane("far", "Rigid Plane", "all", "0 0 -5e-3", "0 0 1")}) {
    parts.conditions = tool;
    const Table table = history_of(folder, parts, {"Mean_Coordinate_Z(slices)"},
                                   section("slices", key("Layers", "3") + key("Node Set", "middle")));
    for (const auto& [column, place] : {std::pair("1", 2.0), {"2", 3.0}, {"3", 4.5}}) {
      const std::string name = std::string("Mean_Coordinate_Z(slices ") + column + ")";
      EXPECT_NEAR(table.at(name).front(), place * h, 1e-16) << tool << column;
    }
  }
}

// Hot metal on an elastic plate, which has no temperature: its zeros are no temperatures.
TEST(Means, LeaveOutPointsThatHaveNoTemperature) {
  const RunFolder folder({.plate_layers = 3});
  Parts parts;
  parts.materials = copper(key("Yield Stress", "50e6") +
                           section("Softening", key("Type", "Johnson-Cook") + key("Reference Temperature", "293") +
                                                    key("Melting Temperature", "1356") + key("Exponent", "1"))) +
                    section("plain", key("Material Model", "Elastic") + key("Density", "8930") +
                                         key("Young's Modulus", "117e9") + key("Poisson's Ratio", "0.35"));
  parts.blocks = section("hot", key("Block Names", "bar") + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                    key("Initial Temperature", "400")) +
                 section("cold", key("Block Names", "plate") + key("Material", "plain") + key("Horizon", "2.01e-3"));
  parts.times = key("Final Time", "1e-7");
  const Table table = history_of(
      folder, parts,
      {"Min_Temperature", "Mean_Temperature", "Sum_Temperature(plate)", "Mean_Equivalent_Plastic_Strain(plate)"});
  EXPECT_EQ(table.at("Min_Temperature").back(), 400);
  EXPECT_NEAR(table.at("Mean_Temperature").back(), 400, 1e-10);  // round-off of a sum
  EXPECT_EQ(table.at("Sum_Temperature(plate)").back(), 0);
  EXPECT_EQ(table.at("Mean_Equivalent_Plastic_Strain(plate)").back(), 0);
  for (const std::string name : {"Max_Temperature(plate)", "Mean_Temperature(plate)", "Mean_Temperature(slices)"}) {
    try {
      history_of(folder, parts, {name}, section("slices", key("Layers", "4")));
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      testing::internal::GetCapturedStdout();
      EXPECT_NE(std::string(error.what()).find(name + ": there are points only"), std::string::npos) << error.what();
    }
  }
}

// Two cubes of 64 points meet, not face to face, with friction: what the one feels is what the other does not, and its
// impulse, of means over the times between the rows, the momentum of the block, to the round-off of some hundred steps.
TEST(ContactForce, ExplainsTheMomentumOfBothBlocks) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0, 0, 0}, 4, 4, 4, h) + cubes(2, {0.3 * h, 0.2 * h, 4.1 * h}, 4, 4, 4, h));
  Parts parts;
  parts.mesh_type = "Text File";
  parts.mesh_file = "points.txt";
  parts.blocks.clear();
  for (const std::string name : {"block_1", "block_2"}) {
    parts.blocks += section(name, key("Block Names", name) + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                      key("Separate Body", "true"));
  }
  parts.contact = contact_of({{"block_1", "block_2"}}, "1e-3", "1e11", "0.3");
  parts.conditions = along("fall", "Initial Velocity", "block_2", "z", "-20") +
                     along("slide", "Initial Velocity", "block_2", "x", "7");
  parts.times = key("Final Time", "20e-6");
  parts.verlet = key("Fixed dt", "1e-7");
  std::vector<std::string> names;
  for (const char axis : {'X', 'Y', 'Z'}) {
    for (const std::string pair : {"(block_1:block_2)", "(block_2:block_1)"})
      names.push_back(std::string("Contact_Force_") + axis + pair);
    names.push_back(std::string("Mean_Velocity_") + axis + "(block_2)");
  }
  const Table table = history_of(folder, parts, names);
  const std::vector<double>& time = table.at("Time");
  const double momentum = 64 * cube * 20;
  for (const char axis : {'X', 'Y', 'Z'}) {
    const std::string force = std::string("Contact_Force_") + axis;
    const std::vector<double>&on_1 = table.at(force + "(block_1:block_2)"),
          &on_2 = table.at(force + "(block_2:block_1)"),
          &velocity = table.at(std::string("Mean_Velocity_") + axis + "(block_2)");
    double impulse = 0;
    for (std::size_t n = 1; n < time.size(); ++n) {
      impulse += on_2[n] * (time[n] - time[n - 1]);
      ASSERT_NEAR(64 * cube * (velocity[n] - velocity[0]), impulse, 1e-11 * momentum) << axis << n;
      ASSERT_NEAR(on_1[n] + on_2[n], 0, 1e-9 * momentum / 1e-5) << axis << n;  // of a force that stops it in 10 µs
    }
    if (axis == 'Y') continue;
    EXPECT_GT(std::abs(impulse), 0.05 * momentum) << axis << ": they have met";
  }
}

// A probe is one point, of which mean and sum are the same.
TEST(Means, AndSumsOfAProbe) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = along("z", "Initial Velocity", "all", "z", "3 + 1000*z");
  parts.times = key("Final Time", "1e-7");
  std::string names;
  for (const std::string name : {"Velocity_Z(tip)", "Mean_Velocity_Z(tip)", "Sum_Velocity_Z(tip)"})
    names += key(name, "true");
  parts.history = key("Filename", (folder / "history.csv").string()) + key("Frequency", "1") +
                  section("Variables", names) + section("Probes", section("tip", key("Point", "0 0 6e-3")));
  testing::internal::CaptureStdout();
  run(folder.write("deck.xml", parts.text()), folder.world);
  testing::internal::GetCapturedStdout();
  const Table table = read_history(folder / "history.csv");
  EXPECT_NEAR(table.at("Sum_Velocity_Z(tip)").front(), 3 + 5.5, 1e-13);
  EXPECT_EQ(table.at("Sum_Velocity_Z(tip)"), table.at("Velocity_Z(tip)"));
  EXPECT_EQ(table.at("Sum_Velocity_Z(tip)"), table.at("Mean_Velocity_Z(tip)"));
}

// The work of a crack is a variable of points, and no column of a crack that is watched.
TEST(Means, OfTheWorkOfACrackAtAProbe) {
  const RunFolder folder;
  Parts parts;
  parts.materials = changed(copper(), key("Density", "8930"),
                            key("Density", "8930") + key("Formulation", "Quadratic Correspondence"));
  parts.damage = section("crack", key("Damage Model", "Cohesive Crack") + key("Fracture Energy", "1e3"));
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") +
                                      key("Horizon Factor", "1.75") + key("Damage Model", "crack"));
  parts.conditions = along("pull", "Initial Velocity", "all", "z", "3e3*(z - 3e-3)");
  parts.times = key("Final Time", "1e-6");
  parts.history = key("Filename", (folder / "history.csv").string()) + key("Frequency", "1") +
                  section("Variables", key("Crack_Work(tip)", "true") + key("Mean_Crack_Work(tip)", "true")) +
                  section("Probes", section("tip", key("Point", "2e-3 2e-3 3e-3")));
  testing::internal::CaptureStdout();
  run(folder.write("deck.xml", parts.text()), folder.world);
  testing::internal::GetCapturedStdout();
  const Table table = read_history(folder / "history.csv");
  EXPECT_GT(table.at("Crack_Work(tip)").back(), 0);
  EXPECT_EQ(table.at("Crack_Work(tip)"), table.at("Mean_Crack_Work(tip)"));
}

}  // namespace
}  // namespace strut::regression
