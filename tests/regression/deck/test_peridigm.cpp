// Decks in Peridigm's dialect run to their ends, and give to the last bit what the same problems give in our own
// spelling.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"
#include "verification/larger.hpp"

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

// ---- Keys of Peridigm's decks alone --------------------------------------------------------------------------------

std::string grid_of(const std::vector<int>& points, const std::vector<double>& lengths) {
  const char* axes[] = {"X", "Y", "Z"};
  std::string generator = key("Type", "PdQuickGrid");
  for (int c = 0; c < 3; ++c) {
    generator += typed(std::string(axes[c]) + " Origin", "double", "0.0") +
                 typed(std::string(axes[c]) + " Length", "double", std::to_string(lengths[c])) +
                 typed(std::string("Number Points ") + axes[c], "int", std::to_string(points[c]));
  }
  return key("Type", "PdQuickGrid") + section("TensorProduct3DMeshGenerator", generator);
}

constexpr double density = 7800, bulk = 130e9, shear = 78e9;  // of the solid below

std::string solid(const std::string& horizon, const std::string& block = "block_1") {
  return section("Materials", section("solid", key("Material Model", "Elastic") + key("Density", "7800") +
                                                   key("Bulk Modulus", "130e9") + key("Shear Modulus", "78e9"))) +
         section("Blocks", section("all of it", key("Block Names", block) + key("Material", "solid") +
                                                    typed("Horizon", "double", horizon)));
}

std::string explicit_steps(const std::string& end, const std::string& dt) {
  return section("Solver", typed("Final Time", "double", end) + section("Verlet", typed("Fixed dt", "double", dt)));
}

const std::vector<double>& last_of(const io::ExodusResult& result, const std::string& name) {
  for (std::size_t k = 0; k < result.element_names.size(); ++k) {
    if (result.element_names[k] == name) return result.element[k].back();
  }
  for (std::size_t k = 0; k < result.nodal_names.size(); ++k) {
    if (result.nodal_names[k] == name) return result.nodal[k].back();
  }
  throw Error("no variable " + name);
}

// Without a NeighborhoodType a family is a box of cells: with a horizon of 1.6 cells two to each side (it is rounded),
// in a thin direction no more than there are: 5 · 5 · 2 − 1 neighbors inside, 3 · 3 · 2 − 1 at a corner.
TEST(DialectOfPeridigm, FamiliesOfAGridAreBoxes) {
  const RunFolder folder;
  const std::string deck = section("Discretization", grid_of({7, 6, 2}, {7, 6, 2})) + solid("1.6") +
                           explicit_steps("1e-6", "1e-6") +
                           peer_output("Output", folder / "boxes", "1", {"Number_Of_Neighbors"});
  ASSERT_TRUE(run(folder.write("boxes.xml", whole(deck)), folder.world));
  if (folder.world.rank() != 0) return;
  const std::vector<double> counts = last_of(io::read_result(folder / "boxes.e"), "Number_Of_Neighbors");
  ASSERT_EQ(counts.size(), 84u);
  EXPECT_EQ(std::ranges::max(counts), 5 * 5 * 2 - 1);
  EXPECT_EQ(std::ranges::min(counts), 3 * 3 * 2 - 1);
  EXPECT_EQ(std::ranges::count(counts, 5 * 5 * 2 - 1), 3 * 2 * 2);
}

// Boxes of cells have no images: planes and sides behind which a body goes on are refused. And they hold more than the
// horizon does, which is no overlap.
TEST(DialectOfPeridigm, BoxesEndWithTheGrid) {
  const RunFolder folder;
  const auto with = [&](const std::string& condition) {
    return deck::read(
        folder.write("boxes.xml",
                     whole(section("Discretization", key("NeighborhoodType", "Box") + grid_of({8, 8, 8}, {8, 8, 8})) +
                           solid("2.1") + section("Node Sets", key("foot", "z &lt; 1")) +
                           section("Boundary Conditions", condition) + explicit_steps("1e-6", "1e-6"))),
        folder.world);
  };
  EXPECT_EQ(told_at_the_start(with(along("flight", "Initial Velocity", "all", "z", "1")), folder.world)
                .warnings.find("as much material"),
            std::string::npos);
  const std::string sides =
      section("sides", key("Type", "Periodic Sides") + key("Coordinate", "x") + key("Lower", "0") + key("Upper", "8"));
  for (const std::string& condition : {sides, plane("half", "Symmetry Plane", "foot", "0 0 0", "0 0 1")}) {
    try {
      set_up(with(condition), folder.world);
      FAIL() << condition;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("expected Discretization > NeighborhoodType \"Spherical\""),
                std::string::npos);
    }
  }
}

// Two points of a chain, pulled apart by 2 e₀ at the start: each bond force of the ordinary solid is 18 K V e/ξ² a
// volume, so that the stretch swings as cos ω t with ω² = 36 K/(ρ ξ²). Half a swing later it is −2 e₀, to the order of
// central differences, (ω dt)²/24 of the phase.
TEST(DialectOfPeridigm, BodiesBeginDisplaced) {
  const RunFolder folder;
  const double omega = std::sqrt(36 * bulk / density) / 2, end = std::numbers::pi / omega;
  const std::string conditions =
      section("Boundary Conditions", key("Low Node Set", "1") + key("High Node Set", "2") +
                                         along("low", "Initial Displacement", "Low Node Set", "x", "-1e-6") +
                                         along("high", "Initial Displacement", "High Node Set", "x", "1e-6"));
  const std::string deck = section("Discretization", grid_of({2, 1, 1}, {4, 1, 1})) + solid("2.0") + conditions +
                           explicit_steps(std::to_string(end * 1e6) + "e-6", std::to_string(end * 1e4) + "e-6") +
                           peer_output("Output", folder / "swing", "1", {"Displacement"});
  ASSERT_TRUE(run(folder.write("swing.xml", whole(deck)), folder.world));
  if (folder.world.rank() != 0) return;
  const std::vector<double> x = last_of(io::read_result(folder / "swing.e"), "DisplacementX");
  EXPECT_NEAR(x[0], 1e-6, 1e-9);
  EXPECT_NEAR(x[1], -1e-6, 1e-9);
}

// A held foot begins where it is held, whichever condition is the first: nothing throws it back, which would be work.
TEST(DialectOfPeridigm, HeldPointsBeginWhereTheyAreHeld) {
  const std::string all = along("strain", "Initial Displacement", "all", "z", "1e-6");
  const std::string foot = along("foot", "Prescribed Displacement", "foot", "z", "0");
  for (const std::string& conditions : {all + foot, foot + all}) {
    const RunFolder folder(Lattice{.nx = 3, .ny = 3, .nz = 8});
    Parts parts;
    parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
    parts.conditions = conditions;
    Simulation run(folder, parts);
    for (int i = 0; i < run.body().owned(); ++i) {
      EXPECT_NEAR(run.body().current(i)[2] - run.reference(i)[2], run.in_set(i, "foot") ? 0 : 1e-6, 1e-17);
    }
    EXPECT_EQ(run.go().external, 0);
  }
}

// Points may be held where their body begins, and a plane keeps its points.
TEST(DialectOfPeridigm, DisplacedBodiesAreHeldWhereTheyBegin) {
  const std::string all = along("strain", "Initial Displacement", "all", "x", "1e-6");
  for (const auto& [held, of_foot] : {std::pair(along("foot", "Prescribed Displacement", "foot", "x", "1e-6"), 1e-6),
                                      {plane("half", "Symmetry Plane", "foot", "0 0 0", "1 0 0"), 0.0}}) {
    const RunFolder folder(Lattice{.nx = 3, .ny = 3, .nz = 8});
    Parts parts;
    parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
    parts.conditions = all + held;
    Simulation run(folder, parts);
    for (int i = 0; i < run.body().owned(); ++i) {
      EXPECT_NEAR(run.body().current(i)[0] - run.reference(i)[0], run.in_set(i, "foot") ? of_foot : 1e-6, 1e-17);
    }
  }
}

// A strained bar that is let go, in steps near the critical one: what the scheme conserves starts with half a step, and
// the balance says so. Where strains are small forces are linear, and it is closed to round-off.
TEST(DialectOfPeridigm, AStrainedBodyKeepsItsEnergy) {
  const RunFolder folder(Lattice{.nx = 3, .ny = 3, .nz = 8});
  Parts parts;
  parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
  parts.conditions = along("strain", "Initial Displacement", "all", "z", "1e-8*z");
  Simulation run(folder, parts);
  double first = 0, most = 0;
  const Ledger last = run.go([&](const Ledger& now) {
    if (first == 0)
      first = now.elastic;
    else
      most = larger(most, now.balance_error);
  });
  EXPECT_GT(first, 0);
  EXPECT_LT(last.elastic, 0.9 * first);
  EXPECT_LT(most, 1e-6);  // of second order in a strain of 1e-8, and round-off of places, 1e-16 over it
}

// A load that holds one of these points in equilibrium, e = b ξ²/(18 K), and is then taken off: with the other one held
// it swings to −e in half a period of ω² = 18 K/(ρ ξ²).
TEST(DialectOfPeridigm, StepsGoOnFromEquilibria) {
  const RunFolder folder;
  const double load = 1e9, stretch = load * 4 / (18 * bulk),
               half = std::numbers::pi / (std::sqrt(18 * bulk / density) / 2);
  const std::string held = "Prescribed Displacement";
  const std::string conditions = section(
      "Boundary Conditions",
      key("Low Node Set", "1") + key("High Node Set", "2") + along("low", held, "Low Node Set", "xyz", "0.0") +
          along("aside y", held, "High Node Set", "y", "0.0") + along("aside z", held, "High Node Set", "z", "0.0") +
          along("pull", "Body Force", "High Node Set", "x",
                "if (t &lt; 1.0000001) { value = 1e9; } else { value = 0; }"));
  const auto solver = [](const std::string& name, const std::string& begin, double end, const std::string& steps) {
    std::ostringstream text;
    text.precision(17);
    text << end;
    return section(name, typed("Initial Time", "double", begin) + typed("Final Time", "double", text.str()) + steps);
  };
  const std::string deck =
      section("Discretization", grid_of({2, 1, 1}, {4, 1, 1})) + solid("2.0") + conditions +
      solver("Solver1", "0.0", 1, section("QuasiStatic", typed("Number of Load Steps", "int", "2"))) +
      solver("Solver 2", "1.0", 1 + half, section("Verlet", typed("Fixed dt", "double", "2e-6"))) +
      peer_output("Output1", folder / "then", "1", {"Displacement"});
  ASSERT_TRUE(run(folder.write("then.xml", whole(deck)), folder.world));
  if (folder.world.rank() != 0) return;
  const io::ExodusResult result = io::read_result(folder / "then.e");
  ASSERT_GT(result.times.size(), 4u);
  EXPECT_EQ(result.times[2], 1);
  for (std::size_t k = 0; k < result.nodal_names.size(); ++k) {
    if (result.nodal_names[k] != "DisplacementX") continue;
    EXPECT_NEAR(result.nodal[k][2][1], stretch, 1e-5 * stretch);
    EXPECT_NEAR(result.nodal[k].back()[1], -stretch, 0.02 * stretch);
  }
}

// Points without neighbors fly on, as 'Elastic' has no force on them.
TEST(DialectOfPeridigm, LonePointsFlyOn) {
  const RunFolder folder;
  const std::string deck =
      section("Discretization", key("NeighborhoodType", "Spherical") + grid_of({2, 1, 1}, {4, 1, 1})) + solid("1.0") +
      section("Boundary Conditions",
              key("Low Node Set", "1") + along("low", "Initial Velocity", "Low Node Set", "x", "3")) +
      explicit_steps("1e-5", "1e-6") + peer_output("Output", folder / "alone", "10", {"Displacement"});
  ASSERT_TRUE(run(folder.write("alone.xml", whole(deck)), folder.world));
  if (folder.world.rank() != 0) return;
  const std::vector<double> x = last_of(io::read_result(folder / "alone.e"), "DisplacementX");
  EXPECT_NEAR(x[0], 3e-5, 1e-15);
  EXPECT_EQ(x[1], 0);
}

// The last one of several loads on a point along an axis counts, also with node sets of the mesh; in our decks they add
// up.
TEST(DialectOfPeridigm, TheLastLoadCounts) {
  const RunFolder folder(Lattice{.nx = 2, .ny = 2, .nz = 2});
  const auto displacement = [&](const std::string& name, bool theirs) {
    const std::string deck =
        section("Discretization", key("Type", "Exodus") + key("Input Mesh File", "bar.g")) + solid("2.1e-3", "bar") +
        section("Boundary Conditions",
                along("one", "Body Force", "foot", "x", "1e6") + along("two", "Body Force", "foot", "x", "2e6")) +
        explicit_steps("1e-9", "1e-9") +
        (theirs ? peer_output("Output", folder / name, "1", {"Force_Density"})
                : own_output(folder / (name + ".e"), "1", {"Force_Density"}));
    EXPECT_TRUE(run(folder.write(name + ".xml", whole(deck)), folder.world));
    return folder.world.rank() == 0 ? std::ranges::max(io::read_result(folder / (name + ".e")).nodal[0].front()) : 0;
  };
  const double theirs = displacement("theirs", true), ours = displacement("ours", false);
  if (folder.world.rank() != 0) return;
  EXPECT_EQ(theirs, 2e6);
  EXPECT_EQ(ours, 3e6);
}

// Sums over a block, and the point nearest to a place: of volumes 8 and 1, of the coordinate that of the cell there.
TEST(DialectOfPeridigm, SumsAndNearestPoints) {
  const RunFolder folder;
  const std::string classes =
      section("Compute Class Parameters",
              section("sum", key("Compute Class", "Block_Data") + key("Calculation Type", "Sum") +
                                 key("Block", "block_1") + key("Variable", "Volume") + key("Output Label", "Whole")) +
                  section("gauge", key("Compute Class", "Nearest_Point_Data") + typed("X", "double", "1.6") +
                                       typed("Y", "double", "0.4") + typed("Z", "double", "0.4") +
                                       key("Variable", "Displacement") + key("Output Label", "Gauge")));
  const std::string deck =
      section("Discretization", grid_of({2, 2, 2}, {2, 2, 2})) + solid("1.0") + classes +
      section("Boundary Conditions", along("x", "Prescribed Displacement", "block_1", "x", "x*t")) +
      explicit_steps("1e-6", "1e-6") + peer_output("Output", folder / "gauge", "1", {"Displacement", "Whole", "Gauge"});
  ASSERT_TRUE(run(folder.write("gauge.xml", whole(deck)), folder.world));
  if (folder.world.rank() != 0) return;
  const Table table = read_history(folder / "gauge.csv");
  EXPECT_EQ(table.at("Sum_Volume(block_1)").back(), 8);
  EXPECT_NEAR(table.at("Mean_Displacement_X(Gauge Node Set)").back(), 1.5e-6, 1e-15);
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
