// Decks in Peridigm's dialect run to their ends, and give to the last bit what the same problems give in our own
// spelling.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

std::string typed(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
}

std::string whole(const std::string& sections) { return "<ParameterList>\n" + sections + "</ParameterList>\n"; }

std::string wanted(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += typed(name, "bool", "true");
  return section("Output Variables", text);
}

// An output as Peridigm's decks have it.
std::string peer_output(const std::string& name, const std::filesystem::path& file, const std::string& frequency,
                        const std::vector<std::string>& variables) {
  return section(name, typed("Output File Type", "string", "ExodusII") + typed("Output Format", "string", "BINARY") +
                           typed("Output Filename", "string", file.string()) +
                           typed("Output Frequency", "int", frequency) + typed("Parallel Write", "bool", "true") +
                           wanted(variables));
}

std::string own_output(const std::filesystem::path& file, const std::string& frequency,
                       const std::vector<std::string>& variables) {
  return section("Output",
                 key("Output Filename", file.string()) + key("Output Frequency", frequency) + wanted(variables));
}

// Runs both decks; their results hold the same variables with the same values, and something happens.
void expect_the_same(const RunFolder& folder, const std::string& theirs, const std::string& ours) {
  ASSERT_TRUE(run(folder.write("theirs.xml", whole(theirs)), folder.world));
  ASSERT_TRUE(run(folder.write("ours.xml", whole(ours)), folder.world));
  if (folder.world.rank() != 0) return;
  const io::ExodusResult a = io::read_result(folder / "theirs.e"), b = io::read_result(folder / "ours.e");
  EXPECT_EQ(a.times, b.times);
  EXPECT_EQ(a.nodal_names, b.nodal_names);
  EXPECT_EQ(a.element_names, b.element_names);
  EXPECT_TRUE(a.nodal == b.nodal && a.element == b.element) << "a value differs";
  EXPECT_NE(a.nodal[0].front(), a.nodal[0].back());
}

const std::string steps = typed("Verbose", "bool", "false") + typed("Initial Time", "double", "0.0");

// A bar whose one end flies away; the ordinary elastic solid.
TEST(DialectOfPeridigm, WaveInABar) {
  const RunFolder folder(Lattice{.nx = 2, .ny = 2, .nz = 12});
  const std::string constants = key("Density", "2300") + key("Bulk Modulus", "12e9") + key("Shear Modulus", "9e9");
  const std::string mesh = key("Type", "Exodus") + key("Input Mesh File", "bar.g");
  const std::string theirs =
      typed("Verbose", "bool", "false") + section("Discretization", mesh + typed("Horizon", "double", "0.003015")) +
      section("Materials", section("stone", key("Material Model", "Elastic") + constants +
                                                typed("Apply Shear Correction Factor", "bool", "false"))) +
      section("Blocks", section("bar", key("Block Names", "default") + key("Material", "stone"))) +
      section("Boundary Conditions",
              key("End Node Set", "1 2 3 4") + along("fly", "Initial Velocity", "End Node Set", "Z", "-30.0")) +
      section("Solver",
              steps + typed("Final Time", "double", "4e-6") + section("Verlet", typed("Fixed dt", "double", "1e-7"))) +
      peer_output("Output", folder / "theirs", "10",
                  {"Displacement", "Velocity", "Force_Density", "ID", "Dilatation", "Weighted_Volume", "Damage"});
  const std::string ours =
      section("Discretization", mesh) +
      section("Materials", section("stone", key("Material Model", "Elastic") + constants)) +
      section("Blocks",
              section("bar", key("Block Names", "all") + key("Material", "stone") + key("Horizon", "0.003015"))) +
      section("Boundary Conditions", along("fly", "Initial Velocity", "foot", "z", "-30")) +
      section("Solver", key("Final Time", "4e-6") + section("Verlet", key("Fixed dt", "1e-7"))) +
      own_output(
          folder / "ours.e", "10",
          {"Displacement", "Velocity", "Force_Density", "Element_Id", "Dilatation", "Weighted_Volume", "Damage"});
  expect_the_same(folder, theirs, ours);
}

// Two cubes by correspondence that are bodies of their own and meet.
TEST(DialectOfPeridigm, CubesInContact) {
  const RunFolder folder;
  folder.write("cubes.txt", cubes(1, Vector(0, 0, 0), 3, 3, 3, 1e-3) + cubes(2, Vector(3.5e-3, 0, 0), 3, 3, 3, 1e-3));
  const std::string mesh = key("Type", "Text File") + key("Input Mesh File", "cubes.txt");
  const std::string constants = key("Material Model", "Elastic Correspondence") + key("Density", "1200") +
                                key("Young's Modulus", "3e9") + key("Poisson's Ratio", "0.3");
  const std::string model =
      section("soft", key("Contact Model", "Short Range Force") + typed("Contact Radius", "double", "1e-3") +
                          typed("Spring Constant", "double", "3e10"));
  const std::string trajectory = along("left", "Initial Velocity", "block_1", "x", "20") +
                                 along("right", "Initial Velocity", "block_2", "x", "-20");
  const std::string compute =
      section("stress", key("Compute Class", "Block_Data") + key("Calculation Type", "Maximum") +
                            key("Block", "block_1") + key("Variable", "Von_Mises_Stress") + key("Output Label", "Top"));
  const std::string theirs =
      section("Discretization", mesh + key("Omit Bonds Between Blocks", "All")) +
      section("Materials", section("plastic", constants + typed("Hourglass Coefficient", "double", "0.02"))) +
      section("Blocks", section("both", key("Block Names", "block_1 block_2") + key("Material", "plastic") +
                                            typed("Horizon", "double", "0.00201"))) +
      section("Contact", typed("Search Radius", "double", "0.01") + typed("Search Frequency", "int", "10") +
                             section("Models", model) +
                             section("Interactions", section("General Contact", key("Contact Model", "soft")))) +
      section("Boundary Conditions", trajectory) +
      section("Solver", steps + typed("Final Time", "double", "4e-5") +
                            section("Verlet", typed("Safety Factor", "double", "0.7"))) +
      section("Compute Class Parameters", compute) +
      peer_output("Output Data", folder / "theirs", "20",
                  {"Displacement", "Velocity", "Cauchy_StressXX", "Cauchy_StressYY", "Contact_Force_Density"}) +
      peer_output("Output History", folder / "theirs", "5", {"Global_Kinetic_Energy", "Top"});
  const auto body = [](const std::string& name) {
    return section(name, key("Block Names", name) + key("Material", "plastic") + key("Horizon", "0.00201") +
                             typed("Separate Body", "bool", "true"));
  };
  const std::string pair =
      key("First Block", "block_1") + key("Second Block", "block_2") + key("Contact Model", "soft");
  const std::string ours =
      section("Discretization", mesh) +
      section("Materials", section("plastic", constants + key("Stabilization", "Silling") +
                                                  key("Stabilization Coefficient", "0.005"))) +
      section("Blocks", body("block_1") + body("block_2")) +
      section("Contact", section("Models", model) + section("Interactions", section("pair", pair))) +
      section("Boundary Conditions", trajectory) +
      section("Solver", key("Final Time", "4e-5") + section("Verlet", key("Safety Factor", "0.7"))) +
      own_output(folder / "ours.e", "20", {"Displacement", "Velocity", "Cauchy_Stress"}) +
      section("History", key("Filename", (folder / "ours.csv").string()) + key("Frequency", "5") +
                             section("Variables", typed("Max_Von_Mises_Stress(block_1)", "bool", "true")));
  expect_the_same(folder, theirs, ours);
  if (folder.world.rank() != 0) return;
  const Table a = read_history(folder / "theirs.csv"), b = read_history(folder / "ours.csv");
  EXPECT_EQ(a, b);
  EXPECT_GT(a.at("Max_Von_Mises_Stress(block_1)").back(), 1e5) << "they have met";
}

// A block between two faces, slowly: Peridigm's grid and a set of points in a file, beside a text mesh and expressions.
TEST(DialectOfPeridigm, SlowCompressionOfAGrid) {
  const RunFolder folder;
  std::string left = "# x = 0\n", right, generator = key("Type", "PdQuickGrid");
  for (int n = 1; n <= 36; n += 4) {
    left += std::to_string(n) + "\n";
    right += std::to_string(n + 3) + " ";
  }
  folder.write("left.txt", left);
  folder.write("block.txt", cubes(1, Vector::Zero(), 4, 3, 3, 0.5));
  for (const std::string axis : {"X", "Y", "Z"}) {
    generator += typed(axis + " Origin", "double", "0.0") +
                 typed(axis + " Length", "double", axis == "X" ? "2" : "1.5") +
                 typed("Number Points " + axis, "int", axis == "X" ? "4" : "3");
  }
  const auto conditions = [](const std::string& fixed, const std::string& pushed) {
    const std::string type = "Prescribed Displacement";
    return along("fix", type, fixed, "x", "0.0") + along("push", type, pushed, "x", "-0.02*t") +
           along("side y", type, fixed, "y", "0.0") + along("side z", type, fixed, "z", "0.0");
  };
  const std::string materials =
      section("Materials", section("steel", key("Material Model", "Elastic") + key("Density", "7800") +
                                                key("Bulk Modulus", "150e9") + key("Shear Modulus", "70e9")));
  const std::string blocks =
      section("Blocks",
              section("all of it", key("Block Names", "block_1") + key("Material", "steel") + key("Horizon", "1.01")));
  const std::vector<std::string> variables = {"Displacement", "Force_Density", "Dilatation"};
  const std::string theirs =
      section("Discretization", key("Type", "PdQuickGrid") + key("NeighborhoodType", "Spherical") +
                                    section("TensorProduct3DMeshGenerator", generator)) +
      materials + blocks +
      section("Boundary Conditions", key("Left Node Set", "left.txt") + key("Right Node Set", right) +
                                         conditions("Left Node Set", "Right Node Set")) +
      section("Solver", steps + typed("Final Time", "double", "1.0") +
                            section("QuasiStatic", typed("Number of Load Steps", "int", "3") +
                                                       typed("Absolute Tolerance", "double", "1.0") +
                                                       typed("Maximum Solver Iterations", "int", "10"))) +
      peer_output("Output", folder / "theirs", "1", variables);
  const std::string ours =
      section("Discretization", key("Type", "Text File") + key("Input Mesh File", "block.txt")) +
      section("Node Sets", key("low", "x &lt; 0.5") + key("high", "x > 1.5")) + materials + blocks +
      section("Boundary Conditions", conditions("low", "high")) +
      section("Solver", key("Final Time", "1") + section("QuasiStatic", key("Number of Load Steps", "3") +
                                                                            key("Maximum Solver Iterations", "10"))) +
      own_output(folder / "ours.e", "1", variables);
  expect_the_same(folder, theirs, ours);
}

// A number that no point has.
TEST(DialectOfPeridigm, SetsAreOfPointsThatExist) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = key("End Node Set", "1 97 98") + along("fly", "Initial Velocity", "End Node Set", "z", "1");
  try {
    run(folder.write("deck.xml", parts.text()), folder.world);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what())
                  .find("Boundary Conditions > End Node Set: names 3 points, up to number 98, of "
                        "which the mesh has 1; it has 96 points"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace strut::regression
