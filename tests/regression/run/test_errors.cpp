// The likeliest mistakes of a deck, and a run that fails: every rank throws the same text, and the text tells the user
// where the mistake is, what stands there, what was expected and which name was meant.
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <optional>

#include "deck/problems.hpp"
#include "regression/bodies.hpp"
#include "regression/stretched.hpp"
#include "run/report.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

namespace fs = std::filesystem;

// A deck without mistakes; results go into the folder of the test, whose path stands for "@".
Parts right_parts() {
  Parts parts;
  parts.materials = copper(key("Yield Stress", "400e6"));
  parts.blocks =
      section("metal", key("Block Names", "bar plate") + key("Material", "copper") + key("Horizon", "2.01e-3"));
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-20") +
                     along("wall", "Prescribed Displacement", "foot", "z", "0");
  parts.times = key("Initial Time", "0") + key("Final Time", "5e-6");
  parts.output = key("Output Filename", "@/result.e") + key("Output Frequency", "5") +
                 section("Output Variables", key("Displacement", "true") + key("Von_Mises_Stress", "true"));
  parts.history =
      key("Filename", "@/history.csv") + key("Frequency", "1") + section("Variables", key("Max_Displacement", "true"));
  return parts;
}

class Mistake : public testing::Test {
 protected:
  const RunFolder folder{[] {
    Lattice lattice;
    lattice.plate_layers = 2;
    return lattice;
  }()};
  const Communicator& world = folder.world;

  fs::path write_deck(std::string text) const {
    const std::string here = folder.operator/("").parent_path().string();
    for (std::size_t at; (at = text.find('@')) != std::string::npos;) text.replace(at, 1, here);
    return folder.write("deck.xml", text);
  }

  // The error that this rank throws, if any.
  std::optional<std::string> outcome(const std::string& text, Start start = Start::anew) const {
    const fs::path deck = write_deck(text);
    testing::internal::CaptureStdout();
    std::optional<std::string> error;
    try {
      run(deck, world, start);
    } catch (const Error& thrown) {
      error = thrown.what();
    }
    testing::internal::GetCapturedStdout();
    return error;
  }

  // The text of the Error that every rank throws, without the folder's path.
  std::string error(const std::string& text) const {
    const std::optional<std::string> mine = outcome(text);
    std::string first = mine.value_or("");
    world.broadcast(first);
    // Sums, so that rank 0, which speaks, fails for the others, too.
    EXPECT_EQ(world.sum(mine ? 0.0 : 1.0), 0) << "ranks that throw nothing";
    EXPECT_EQ(world.sum(mine.value_or("") == first ? 0.0 : 1.0), 0) << "ranks that throw another text than rank 0";
    const std::string prefix = (folder / "").string();
    for (std::size_t at; (at = first.find(prefix)) != std::string::npos;) first.erase(at, prefix.size());
    return first;
  }

  void expect_error(const std::string& text, const std::vector<std::string>& fragments) const {
    const std::string shown = error(text);
    for (const std::string& fragment : fragments) {
      EXPECT_NE(shown.find(fragment), std::string::npos) << "expected \"" << fragment << "\" in:\n" << shown;
    }
  }
};

// Without this none of the others would prove that it is the mistake that is refused.
TEST_F(Mistake, NoneRuns) {
  EXPECT_EQ(outcome(right_parts().text()).value_or("no error"), "no error");
  if (world.rank() != 0) return;
  EXPECT_GE(io::read_result(folder / "result.e").times.size(), 3u);
  EXPECT_DOUBLE_EQ(read_history(folder / "history.csv").at("Time").back(), 5e-6);
}

TEST_F(Mistake, MisspeltKey) {
  const std::string deck = right_parts().text();
  expect_error(changed(deck, "\"Horizon\"", "\"Horizn\""),
               {"deck.xml", "Blocks > metal > Horizn: unknown key (did you mean 'Horizon'?)",
                "Blocks > metal > Horizon: missing", "in m"});
  expect_error(changed(deck, "\"Boundary Conditions\"", "\"Boundary Condition\""),
               {"Boundary Condition: unknown section (did you mean 'Boundary Conditions'?)"});
  expect_error(changed(deck, "\"Output Frequency\"", "\"Output Frequenzy\""),
               {"Output > Output Frequenzy: unknown key (did you mean 'Output Frequency'?)"});
}

TEST_F(Mistake, HorizonInAnotherUnit) {
  const std::string deck = right_parts().text();
  const std::vector<std::string> both = {"Blocks > metal > Horizon", "mean spacing is 0.001 m", "between 1 and 20"};
  for (const auto& [written, shown] :
       {std::pair("2.01e-6", "2.01e-06 m"), {"2.01", "2.01 m"}, {"0.9e-3", "0.0009 m"}}) {
    const std::string wrong = changed(deck, "2.01e-3", written);
    expect_error(wrong, both);
    expect_error(wrong, {shown, "block bar", "block plate"});
  }
}

TEST_F(Mistake, BlocksOfDeckAndMeshDiffer) {
  const std::string deck = right_parts().text();
  expect_error(changed(deck, "bar plate", "bar plat"),
               {"Blocks > metal > Block Names", "no block 'plat' (did you mean 'plate'?)", "bar, plate",
                "block 'plate' of the mesh has no material"});
  expect_error(changed(deck, "bar plate", "plate"), {"Blocks: block 'bar' of the mesh has no material", "Block Names"});
}

TEST_F(Mistake, NodeSetThatIsNotThere) {
  Parts parts = right_parts();
  parts.conditions += along("pull", "Body Force", "tob", "x", "1");
  expect_error(changed(parts.text(), "\"foot\"", "\"fooot\""),
               {"Boundary Conditions > wall > Node Set", "'fooot' (did you mean 'foot'?)", "all, foot, top, bar, plate",
                "Boundary Conditions > pull > Node Set", "'tob' (did you mean 'top'?)"});
}

// One name, two meanings: whichever were taken, it might be the other that is meant.
TEST_F(Mistake, NamesThatMeanTwoThings) {
  Parts parts = right_parts();
  parts.node_sets = key("foot", "z &lt; 3e-3") + key("plate", "z &lt; 1e-3");
  expect_error(parts.text(), {"Node Sets > foot: the mesh has a node set 'foot' already; expected another name",
                              "Node Sets > plate: the mesh has a block 'plate' already; expected another name"});
  parts = right_parts();
  parts.node_sets = key("Node Set 1", "z &lt; 1e-3");
  parts.conditions += key("Node Set 1", "1 2 3");
  expect_error(parts.text(), {"Boundary Conditions > Node Set 1: the deck has a node set 'Node Set 1' already"});
  parts = right_parts();
  parts.history = key("Filename", "@/history.csv") + section("Profiles", section("bar", key("Layers", "2"))) +
                  section("Variables", key("Mean_Velocity_Z(bar)", "true"));
  expect_error(parts.text(),
               {"History > Variables > Mean_Velocity_Z(bar): 'bar' is a section of History > Profiles and"});
}

TEST_F(Mistake, NamesOfTheMeshThatMeanTwoThings) {
  const auto with = [&](const std::string& name, std::vector<int> nodes) {
    Lattice lattice;
    lattice.plate_layers = 2;
    io::Mesh mesh = lattice.mesh();
    if (nodes.empty())
      nodes = mesh.blocks[0].nodes, nodes.insert(nodes.end(), mesh.blocks[1].nodes.begin(), mesh.blocks[1].nodes.end());
    mesh.node_sets.push_back({name, nodes});
    run_on_root(world, [&] { io::write_mesh(folder / "two.g", mesh); });
    return changed(right_parts().text(), "bar.g", "two.g");
  };
  EXPECT_EQ(outcome(with("plate", {0, 1, 2})).value_or("no error"), "no error") << "nobody asks for it";
  expect_error(
      changed(with("plate", {0, 1, 2}), "\"foot\"", "\"plate\""),
      {"Boundary Conditions > wall > Node Set: 'plate' is a node set and a block; expected a name that is one"});
  expect_error(changed(with("plate", {0, 1, 2}), "Max_Displacement", "Max_Displacement(plate)"),
               {"History > Variables > Max_Displacement(plate): 'plate' is a node set and a block"});
  expect_error(
      with("all", {0, 1, 2}),
      {"Discretization > Input Mesh File: its node set 'all' holds 3 of 96 points, and in a deck 'all' means all"});
  EXPECT_EQ(outcome(with("all", {})).value_or("no error"), "no error") << "it is all";
}

// Mass, momentum and stiffness would be twice what they are there.
TEST_F(Mistake, PointsGivenTwice) {
  for (const double shift : {0.0, 1e-9}) {
    Lattice lattice;
    io::Mesh mesh = lattice.mesh();
    const auto twice = static_cast<int>(mesh.nodes.size());
    io::Mesh::Block again{
        "plate", "HEX8", {mesh.blocks[0].nodes.begin(), mesh.blocks[0].nodes.begin() + 8 * 16}, {}, {}};
    for (int& node : again.nodes) node += twice;
    for (int n = 0; n < twice; ++n)
      mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(n)] + Vector::Constant(shift));
    mesh.blocks.push_back(again);
    run_on_root(world, [&] { io::write_mesh(folder / "twice.g", mesh); });
    const std::string deck = changed(right_parts().text(), "bar.g", "twice.g");
    expect_error(deck,
                 {"Discretization > Input Mesh File: element 97 of block 'plate' is where element 1 of block 'bar' is",
                  shift > 0 ? "16 points are where others are; expected each once, or elements that are less flat"
                            : "16 points are where others are; expected each once"});
    const std::string file = key("Input Mesh File", "twice.g");
    expect_error(changed(deck, file, file + key("Points", "Nodes")),
                 {"twice.g: element 97 of block 'plate' is where element 1 of block 'bar' is"});
  }
}

// Neighbors by quadratic correspondence whose faces have other corners: squares halved along crossed diagonals (four
// triangles at each of the 224 squares inside), or not halved on one side, or beside four small ones.
TEST_F(Mistake, FacesOfNeighborsThatDoNotMatch) {
  const Lattice lattice;  // 4 × 4 × 6 cubes
  const io::Mesh cubes = lattice.mesh();
  io::Mesh mixed = cubes;  // the lower half of it in tetrahedra that match each other
  io::Mesh::Block& lower = mixed.blocks[0];
  const std::vector<int> upper(lower.nodes.begin() + 8 * 48, lower.nodes.end());
  lower.nodes.resize(8 * 48);
  mixed = in_tetrahedra(mixed);
  mixed.blocks.push_back({"plate", "HEX8", upper, {}, {}});
  io::Mesh hanging = cubes;  // under cubes half as large
  io::Mesh::Block small{"plate", "HEX8", Lattice{.nx = 8, .ny = 8, .nz = 4}.mesh().blocks[0].nodes, {}, {}};
  const auto level = static_cast<int>(cubes.nodes.size()) - 25, above = static_cast<int>(cubes.nodes.size());
  for (int n = 0; n < 9 * 9 * 5; ++n) hanging.nodes.emplace_back(5e-4 * Vector(n % 9, n / 9 % 9, 12 + n / 81));
  for (int& node : small.nodes) {
    const int x = node % 9, y = node / 9;
    node = y < 9 && x % 2 == 0 && y % 2 == 0 ? level + y / 2 * 5 + x / 2 : above + node;
  }
  hanging.blocks.push_back(small);
  run_on_root(world, [&] {
    io::write_mesh(folder / "five.g", in_tetrahedra(cubes, at_corners));
    io::write_mesh(folder / "six.g", in_tetrahedra(cubes));
    io::write_mesh(folder / "mixed.g", mixed);
    io::write_mesh(folder / "hanging.g", hanging);
  });
  Parts parts = right_parts();
  parts.times = key("Final Time", "1e-7");
  const auto of = [&](const std::string& mesh, const std::string& name) {
    parts.blocks = section("metal", key("Block Names", name) + key("Material", "copper") + key("Horizon", "2.01e-3"));
    return changed(parts.text(), "bar.g", mesh);
  };
  EXPECT_EQ(outcome(of("five.g", "bar")).value_or("no error"), "no error");  // the mean gradient knows no faces
  parts.materials = copper(key("Yield Stress", "400e6") + key("Formulation", "Quadratic Correspondence"));
  EXPECT_EQ(outcome(of("six.g", "bar")).value_or("no error"), "no error");
  expect_error(of("five.g", "bar"),
               {"Discretization > Input Mesh File: 896 faces of elements of block 'bar', the first of element 2, meet "
                "faces with other corners of block 'bar'",
                "1 problem"});
  expect_error(of("mixed.g", "bar plate"),
               {"32 faces of elements of block 'bar'", "16 faces of elements of block 'plate'",
                "other corners of block 'bar'", "expected a mesh in which neighbors have a face in common"});
  expect_error(of("hanging.g", "bar plate"),
               {"16 faces of elements of block 'bar', the first of element 81, meet faces with other corners of block "
                "'plate'",
                "1 problem"});
}

// Coincident nodes of one body, between which bonds would be, are found; the faces of two bodies may touch.
TEST_F(Mistake, BodiesThatTouchMayHaveNodesAtOnePlace) {
  Lattice lattice;
  io::Mesh mesh = lattice.mesh();
  const auto all = static_cast<int>(mesh.nodes.size());
  io::Mesh::Block above{"plate", "HEX8", mesh.blocks[0].nodes, {}, {}};
  for (int& node : above.nodes) node += all;
  for (int n = 0; n < all; ++n) mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(n)] + Vector(0, 0, 6e-3));
  mesh.blocks.push_back(above);
  run_on_root(world, [&] { io::write_mesh(folder / "bar.g", mesh); });
  Parts parts = right_parts();
  parts.points = "Nodes";
  expect_error(parts.text(),
               {"Discretization > Input Mesh File: node 176 of block 'plate' is where node 151 of block 'bar' is",
                "25 points are where others are"});
  parts.blocks.clear();
  for (const std::string name : {"bar", "plate"})
    parts.blocks += section(name, key("Block Names", name) + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                      key("Separate Body", "true"));
  EXPECT_EQ(outcome(parts.text()).value_or("no error"), "no error");
}

TEST_F(Mistake, PlacesAndVolumesThatNumbersDoNotTellApart) {
  Parts parts = right_parts();
  parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
  parts.blocks = changed(parts.blocks, "bar plate", "block_7");
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-20");
  for (const char* line : {"1e300 0 0 7 1e-9", "1e14 0 0 7 1e-9", "0 0 1 7 1e-300", "0 0 0 7 1e-320"}) {
    folder.write("points.txt", cubes(7, Vector::Zero(), 3, 3, 3, 1e-3) + line + "\n");
    expect_error(parts.text(),
                 {"Discretization > Input Mesh File: element 28 of block 'block_7' at (", "that numbers tell apart"});
  }
}

// Names and numbers that the files cannot hold are found before the results of an earlier run are replaced.
TEST_F(Mistake, NamesAndNumbersThatFilesDoNotHold) {
  Parts parts = right_parts();
  EXPECT_EQ(outcome(parts.text()).value_or("no error"), "no error");
  parts.node_sets = key("left, right", "x &lt; 2e-3");
  parts.history = changed(parts.history, "Max_Displacement", "Max_Displacement(left, right)");
  expect_error(parts.text(),
               {"History > Variables: 'Max_Displacement(left, right)' cannot be the name of a history column"});
  parts = right_parts();
  parts.node_sets = key(std::string(128, 'n'), "x &lt; 2e-3");
  expect_error(parts.text(), {"Output: a result holds names of up to 127 bytes, but 'nnn", "has 128"});
  if (world.rank() == 0) {
    EXPECT_GE(io::read_result(folder / "result.e").times.size(), 3u);
  }
  PointCloud cloud;
  cloud.element_ids = {1, std::int64_t{1} << 31};
  EXPECT_NE(io::result_problem(cloud, world).find("up to 2147483647, but the mesh has 2147483648"), std::string::npos);
  cloud.element_ids = {1, (std::int64_t{1} << 31) - 1};
  EXPECT_EQ(io::result_problem(cloud, world), "");
}

// --check finds the errors that would end a run.
TEST_F(Mistake, CheckFindsWhatARunWouldFind) {
  folder.write("foreign.restart", "my thesis");
  Parts parts = right_parts();
  parts.node_sets = key("a,b", "x &lt; 2e-3");
  parts.history = changed(parts.history, "Max_Displacement", "Max_Displacement(a,b)");
  const std::string deck =
      changed(parts.text(), "<ParameterList name=\"Solver\">",
              section("Restart", key("Filename", "@/foreign.restart")) + "<ParameterList name=\"Solver\">");
  std::string told;
  try {
    check(write_deck(deck), world);
  } catch (const Error& thrown) {
    told = thrown.what();
  }
  for (const char* part : {"2 problems", "cannot be the name of a history column", "is no checkpoint of strut"})
    EXPECT_NE(told.find(part), std::string::npos) << part << " in:\n" << told;
  expect_error(deck, {"2 problems", "cannot be the name of a history column", "is no checkpoint of strut"});
}

// Files beside the checkpoint have longer names than the key gives, and so has a result.
TEST_F(Mistake, NamesThatAreTooLong) {
  const std::string solver = "<ParameterList name=\"Solver\">";
  Parts parts = right_parts();
  EXPECT_EQ(outcome(parts.text()).value_or("no error"), "no error");
  parts.output = changed(parts.output, "result.e", std::string(255, 'o'));
  parts.history = changed(parts.history, "history.csv", std::string(260, 'h'));
  for (const std::size_t length : {251, 253, 300}) {
    const std::string file = "@/" + std::string(length, 'r');
    const std::string deck = changed(parts.text(), solver, section("Restart", key("Filename", file)) + solver);
    std::string told;
    try {
      check(write_deck(deck), world);
    } catch (const Error& thrown) {
      told = thrown.what();
    }
    for (const char* part : {"Output > Output Filename: '", "its name has 257 bytes", "History > Filename: '",
                             "its name has 260 bytes; expected up to", "Restart > Filename: '"})
      EXPECT_NE(told.find(part), std::string::npos) << length << ": " << part << " in:\n" << told;
    expect_error(deck, {"3 problems", "Restart > Filename: '"});
  }
}

// Peridigm's second part of a run. The first part has the same key, and no checkpoint before it.
TEST_F(Mistake, ADeckThatGoesOnFromACheckpointThatIsNotThere) {
  const auto with = [](const std::string& initial_time) {
    Parts parts = right_parts();
    parts.times = key("Initial Time", initial_time) + key("Final Time", "1.5e-2");
    parts.verlet = key("Fixed dt", "1e-8");
    return changed(parts.text(), "<ParameterList name=\"Solver\">",
                   section("Restart", key("Filename", "@/none.restart") + key("Restart", "true")) +
                       "<ParameterList name=\"Solver\">");
  };
  expect_error(with("1e-2"),
               {"Restart > Restart: 'true' asks to go on from a checkpoint at t = 0.01 s (Solver > Initial "
                "Time), but there is none",
                "Start From > Checkpoint", "'strut --continue'"});
  EXPECT_EQ(outcome(changed(with("0"), "1.5e-2", "1e-7")).value_or("no error"), "no error");
  const std::string solver = "<ParameterList name=\"Solver\">";
  std::string second = changed(with("1e-7"), "1.5e-2", "2e-7");
  for (const std::string file : {"none.restart", "result.e", "history.csv"})
    second = changed(second, "@/" + file, "@/second-" + file);
  expect_error(second, {"there is none"});
  const std::string from = section("Start From", key("Checkpoint", "@/none.restart"));
  EXPECT_EQ(outcome(changed(second, solver, from + solver)).value_or("no error"), "no error");
}

// Places and volumes are those of the checkpoint; what conditions hold is not.
TEST_F(Mistake, AMeshWithOtherNodeSetsIsNotThatOfTheCheckpoint) {
  const std::string deck =
      changed(right_parts().text(), "<ParameterList name=\"Solver\">",
              section("Restart", key("Filename", "@/kept.restart")) + "<ParameterList name=\"Solver\">");
  const std::string longer = changed(deck, "\"5e-6\"", "\"6e-6\"");
  EXPECT_EQ(outcome(deck).value_or("no error"), "no error");
  const auto with_foot_at = [&](const std::string& set) {
    Lattice lattice;
    lattice.plate_layers = 2;
    io::Mesh mesh = lattice.mesh();
    if (set == "top") mesh.node_sets[0].nodes = mesh.node_sets[1].nodes;
    run_on_root(world, [&] { io::write_mesh(folder / "bar.g", mesh); });
  };
  with_foot_at("top");
  EXPECT_NE(outcome(longer, Start::continued).value_or("no error").find("points are in other node sets"),
            std::string::npos);
  with_foot_at("foot");
  EXPECT_EQ(outcome(longer, Start::continued).value_or("no error"), "no error");
}

// Conditions and materials go by names: with others of the same points a run would go on with another model.
TEST_F(Mistake, AMeshWithOtherNamesIsNotThatOfTheCheckpoint) {
  const std::string solver = "<ParameterList name=\"Solver\">";
  Parts parts = right_parts();
  parts.materials = copper();  // without state variables, which would have told
  const std::string deck =
      changed(parts.text(), solver, section("Restart", key("Filename", "@/kept.restart")) + solver);
  const std::string longer = changed(deck, "\"5e-6\"", "\"6e-6\"");
  std::string second =
      changed(changed(parts.text(), "\"5e-6\"", "\"6e-6\""), key("Initial Time", "0"), key("Initial Time", "5e-6"));
  second = changed(second, solver, section("Start From", key("Checkpoint", "@/kept.restart")) + solver);
  for (const std::string file : {"result.e", "history.csv"}) second = changed(second, "@/" + file, "@/second-" + file);
  const auto write = [&](const std::function<void(io::Mesh&)>& change) {
    Lattice lattice;
    lattice.plate_layers = 3;
    io::Mesh mesh = lattice.mesh();
    change(mesh);
    run_on_root(world, [&] { io::write_mesh(folder / "bar.g", mesh); });
  };
  const auto error = [&](const std::string& text, Start start) { return outcome(text, start).value_or("no error"); };
  write([](io::Mesh&) {});
  EXPECT_EQ(error(deck, Start::anew), "no error");
  write([](io::Mesh& mesh) { std::swap(mesh.node_sets[0].name, mesh.node_sets[1].name); });
  EXPECT_NE(error(longer, Start::continued).find("points are in other node sets;"), std::string::npos);
  write([](io::Mesh& mesh) { std::swap(mesh.blocks[0].name, mesh.blocks[1].name); });
  EXPECT_NE(error(longer, Start::continued).find("'block 0 (bar)' where the deck's mesh has 'block 0 (plate)'"),
            std::string::npos);
  EXPECT_NE(error(second, Start::anew).find("points are in blocks of other names;"), std::string::npos);
  write([](io::Mesh& mesh) { std::swap(mesh.node_sets[0], mesh.node_sets[1]); });  // the order is free
  EXPECT_EQ(error(second, Start::anew), "no error");
  EXPECT_EQ(error(longer, Start::continued), "no error");
}

// A slip in a section does not hide those that only the mesh shows.
TEST_F(Mistake, ProblemsOfDeckMeshAndOutputAreToldAtOnce) {
  Parts parts = right_parts();
  parts.node_sets = key("low", "z &lt;&lt; 1");
  parts.conditions += along("push", "Body Force", "low", "x", "1");
  std::string deck = parts.text();
  for (const auto& [old, replacement] : {std::pair("\"8930\"", "\"-8930\""),
                                         {"bar plate", "bar plat"},
                                         {"\"foot\"", "\"fooot\""},
                                         {"\"Displacement\"", "\"Displacment\""},
                                         {"Max_Displacement", "Max_Displacement(tob)"}}) {
    deck = changed(deck, old, replacement);
  }
  expect_error(deck, {"7 problems", "Materials > copper > Density", "Node Sets > low: ", "no block 'plat'",
                      "block 'plate' of the mesh has no material", "'fooot' (did you mean 'foot'?)",
                      "Output Variables > Displacment", "Max_Displacement(tob)"});
}

TEST_F(Mistake, NodeSetWithoutPoints) {
  Parts parts = right_parts();
  parts.node_sets = key("below", "z &lt; -1") + key("low", "z &lt; 1e-3");
  parts.conditions += along("pull", "Body Force", "below", "x", "1") + along("push", "Body Force", "low", "x", "1");
  const std::string shown = error(parts.text());
  EXPECT_EQ(shown, "deck.xml: 1 problem\n  Boundary Conditions > pull > Node Set: 'below' holds no point");
}

TEST_F(Mistake, MeshAndDeckDisagreeInManyWays) {
  Parts parts = right_parts();
  parts.blocks = section("metal", key("Block Names", "bar") + key("Material", "copper") + key("Horizon", "2.01"));
  expect_error(changed(parts.text(), "\"foot\"", "\"fooot\""),
               {"deck.xml: 3 problems", "Blocks: block 'plate' of the mesh has no material", "Blocks > metal > Horizon",
                "Boundary Conditions > wall > Node Set", "'fooot'"});
}

TEST_F(Mistake, ResultThatReplacesAnInput) {
  const std::string deck = right_parts().text();
  expect_error(changed(deck, "@/result.e", "@/bar.g"), {"Output > Output Filename", "bar.g' is the input mesh"});
  expect_error(changed(deck, "@/result.e", "@/nowhere/../deck.xml"),
               {"Output > Output Filename", "deck.xml' is this deck"});
  expect_error(changed(deck, "@/history.csv", "@/./bar.g"), {"History > Filename", "bar.g' is the input mesh"});
  expect_error(changed(deck, "@/history.csv", "@/result.e"), {"History > Filename", "result.e' is Output's file, too"});
  EXPECT_EQ(outcome(deck).value_or("no error"), "no error");  // mesh and deck are as they were
}

TEST_F(Mistake, UnknownMaterial) {
  const std::string deck = right_parts().text();
  expect_error(
      changed(deck, "\"Material\" type=\"string\" value=\"copper\"", "\"Material\" type=\"string\" value=\"coper\""),
      {"Blocks > metal > Material: 'coper'", "did you mean 'copper'", "Materials: copper"});
  expect_error(changed(deck, "Elastic Plastic Corr", "Elastic Plastik Corr"),
               {"Materials > copper > Material Model: 'Elastic Plastik Correspondence'",
                "did you mean 'Elastic Plastic Correspondence'", "expected one of"});
}

TEST_F(Mistake, ValuesOutsideTheirRange) {
  const std::string deck = right_parts().text();
  expect_error(changed(deck, "\"8930\"", "\"-8930\""), {"Materials > copper > Density: '-8930'", "> 0", "kg/m³"});
  expect_error(changed(deck, "\"5e-6\"", "\"-5e-6\""),
               {"Solver > Final Time: '-5e-06'", "expected > Initial Time (0), in s"});
  expect_error(
      changed(changed(deck, "\"5e-6\"", "\"1000000000.00001\""), key("Initial Time", "0"), key("Initial Time", "1e9")),
      {"Solver > Initial Time: at t = 1e+09 s numbers are 1.2e-07 s apart", "expected a time nearer to 0"});
}

TEST_F(Mistake, MeshThatIsNoMesh) {
  const std::string deck = right_parts().text();
  expect_error(changed(deck, "bar.g", "baar.g"), {"Discretization > Input Mesh File", "'baar.g' does not exist"});
  expect_error(changed(deck, "bar.g", "."), {"Discretization > Input Mesh File", "not a file"});
  folder.write("text.g", "0 0 0 1 1e-9\n");
  expect_error(changed(deck, "bar.g", "text.g"), {"text.g", "not an Exodus"});
  run_on_root(world, [&] {
    fs::copy_file(folder / "bar.g", folder / "cut.g");
    fs::resize_file(folder / "cut.g", fs::file_size(folder / "bar.g") / 2);
  });
  expect_error(changed(deck, "bar.g", "cut.g"), {"cut.g", "truncated"});
}

TEST_F(Mistake, NoPoints) {
  Parts parts = right_parts();
  parts.mesh_type = "Text File";
  parts.mesh_file = "points.txt";
  folder.write("points.txt", "# x y z block volume\n");
  expect_error(parts.text(), {"points.txt", "no points"});
  run_on_root(world, [&] {
    io::Mesh mesh = Lattice().mesh();
    mesh.blocks[0].nodes.clear();
    io::write_mesh(folder / "empty.g", mesh);
  });
  expect_error(changed(right_parts().text(), "bar.g", "empty.g"), {"empty.g", "no elements"});
}

TEST_F(Mistake, OutputThatCannotBeWritten) {
  const std::string deck = right_parts().text();
  expect_error(changed(deck, "@/result.e", "@/nowhere/result.e"), {"nowhere/result.e", "cannot create"});
  expect_error(changed(deck, "@/history.csv", "@/nowhere/history.csv"), {"nowhere/history.csv", "cannot create"});
  run_on_root(world, [&] {
    fs::create_directory(folder / "taken.e");
    fs::create_directory(folder / "taken.csv");
  });
  expect_error(changed(deck, "@/result.e", "@/taken.e"), {"taken.e", "is a folder, a pipe or a device"});
  expect_error(changed(deck, "@/history.csv", "@/taken.csv"), {"taken.csv", "is a folder, a pipe or a device"});
}

TEST_F(Mistake, BothHorizonsOrNone) {
  const std::string deck = right_parts().text(), horizon = key("Horizon", "2.01e-3");
  expect_error(changed(deck, horizon, horizon + key("Horizon Factor", "2")),
               {"1 problem\n", "Blocks > metal: 'Horizon' and 'Horizon Factor' are both given"});
  expect_error(changed(deck, horizon, ""), {"1 problem\n", "Blocks > metal > Horizon: missing", "'Horizon Factor'"});
}

TEST_F(Mistake, NodesOfSpheresOrOfAText) {
  const std::string mesh = key("Input Mesh File", "bar.g"), deck = right_parts().text();
  EXPECT_EQ(outcome(changed(deck, mesh, mesh + key("Points", "Nodes"))).value_or("no error"), "no error");
  run_on_root(world, [&] {
    io::Mesh balls;
    balls.nodes = {Vector(0, 0, 0), Vector(1e-3, 0, 0)};
    balls.blocks.push_back({"bar", "SPHERE", {0, 1}, {1e-9, 1e-9}});
    io::write_mesh(folder / "balls.g", balls);
  });
  expect_error(changed(deck, mesh, key("Input Mesh File", "balls.g") + key("Points", "Nodes")),
               {"balls.g: block 'bar' has spheres", "HEX8", "TET4", "points at elements"});
  const std::string text = changed(deck, key("Type", "Exodus"), key("Type", "Text File"));
  expect_error(changed(text, mesh, mesh + key("Points", "Nodes")),
               {"1 problem\n", "Discretization > Points: 'Nodes'", "expected 'Elements'"});
}

TEST_F(Mistake, FewNeighborsAtANodeAreTheNodes) {
  const std::string mesh = key("Input Mesh File", "bar.g");
  const std::string deck = changed(right_parts().text(), key("Horizon", "2.01e-3"), key("Horizon Factor", "1.1"));
  // A corner has three neighbors at one spacing; the first one is node 1.
  expect_error(changed(deck, mesh, mesh + key("Points", "Nodes")),
               {"points have too few neighbors", "node 1 of block bar at (0, 0, 0) m has 3 neighbors"});
}

TEST_F(Mistake, UnknownVariables) {
  const std::string deck = right_parts().text();
  expect_error(changed(deck, "\"Displacement\"", "\"Failed\""),  // which metal foams have
               {"Output > Output Variables > Failed: no material of this deck has a law with this state variable"});
  expect_error(changed(deck, "\"Displacement\"", "\"Displacment\""),
               {"Output > Output Variables > Displacment", "did you mean 'Displacement'", "Velocity", "Cauchy_Stress",
                "Equivalent_Plastic_Strain"});
  expect_error(changed(deck, "\"Max_Displacement\"", "\"Max_Displacment\""),
               {"History > Variables > Max_Displacment", "did you mean 'Max_Displacement'"});
  expect_error(changed(deck, "\"Max_Displacement\"", "\"Displacement\""),
               {"History > Variables > Displacement", "expected Max_, Min_, Mean_ or Sum_"});
  expect_error(
      changed(deck, "\"Max_Displacement\"", "\"Max_Displacement(fot)\""),
      {"History > Variables > Max_Displacement(fot): there is no node set or block 'fot' (did you mean 'foot'?)",
       "there are all, foot, top, bar, plate"});
  const std::string nowhere = "    <ParameterList name=\"Node Sets\">" + key("nowhere", "x > 1") + "</ParameterList>";
  expect_error(changed(changed(deck, "\"Max_Displacement\"", "\"Max_Displacement(nowhere)\""),
                       "<ParameterList name=\"Materials\">", nowhere + "<ParameterList name=\"Materials\">"),
               {"History > Variables > Max_Displacement(nowhere)", "holds no point"});
  const std::string both = changed(deck, "\"Displacement\"", "\"Displacment\"");
  expect_error(changed(both, "\"Max_Displacement\"", "\"Max_Displacment\""),
               {"Output > Output Variables > Displacment", "History > Variables > Max_Displacment"});
}

TEST_F(Mistake, TwoWrongNamesAreTwoProblemsAndEqualOnesAreOne) {
  const std::string deck = right_parts().text();
  const std::string two =
      changed(deck, key("Displacement", "true"), key("Displacment", "true") + key("Velocty", "true"));
  expect_error(two, {"deck.xml: 2 problems\n  Output > Output Variables > Displacment: ",
                     "\n  Output > Output Variables > Velocty: "});
  deck::Problems problems;
  for (const char* what : {"missing", "missing", "unknown"}) problems.add("Blocks", what);
  EXPECT_EQ(problems.text("deck.xml"), "deck.xml: 2 problems\n  Blocks: missing\n  Blocks: unknown");
}

TEST_F(Mistake, MeshesOfOtherPrograms) {
  folder.write("foam.msh", "$MeshFormat");
  for (const char* name : {"foam.msh", "nothere.vtk"}) {
    const std::string shown = error(changed(right_parts().text(), "bar.g", name));
    EXPECT_EQ(shown.find("tools/tetrahedra") != std::string::npos, std::string(name) == "foam.msh") << shown;
  }
}

TEST_F(Mistake, UnknownReactions) {
  Parts parts = right_parts();
  parts.conditions += plane("floor", "Rigid Plane", "all", "0 0 -1", "0 0 1");
  const std::string deck = parts.text();
  const auto with = [&](const std::string& name) { return changed(deck, "Max_Displacement", name); };
  EXPECT_EQ(outcome(with("Reaction_Z(wall)")).value_or("no error"), "no error");
  expect_error(with("Reaction_Z(wal)"), {"History > Variables > Reaction_Z(wal): 'wal' is no section",
                                         "(did you mean 'wall'?); there are wall, floor"});
  expect_error(with("Reaction_Z(flight)"),
               {"'flight' is no section of Boundary Conditions that has a reaction force", "there are wall, floor"});
  EXPECT_EQ(outcome(with("Instant_Reaction_Z(wall)")).value_or("no error"), "no error");
  for (const std::string name :
       {"Instant_Reaction_W(wall)", "Reaction_W(wall)", "Reacton_Z(wall)", "Reaction_Z", "Reaction(wall)"}) {
    expect_error(with(name), {"History > Variables > " + name + ": expected one of Reaction_X, Reaction_Y, Reaction_Z",
                              "in brackets the name of a section of Boundary Conditions"});
  }
}

TEST_F(Mistake, CracksOfTheHistory) {
  const auto with = [](const std::string& name, const std::string& keys) {
    Parts parts = right_parts();
    parts.history = key("Filename", "@/history.csv") + section("Cracks", section("notch", keys)) +
                    section("Variables", key(name, "true"));
    return parts.text();
  };
  expect_error(with("Crack_Tip(nick)", ""), {"History > Variables > Crack_Tip(nick): 'nick' is no section of History > "
                                             "Cracks; there are notch"});
  expect_error(with("Crack_Tip(notch)", ""), {"History > Cracks > notch: no bonds can break here"});
  expect_error(with("Crack_Sped(notch)", ""), {"expected one of Crack_Tip, Crack_Speed (did you mean 'Crack_Speed'?)"});
  expect_error(with("Crack_Tip(notch)", key("Direction", "0 0 0")),
               {"History > Cracks > notch > Direction: is zero; expected a direction"});
  expect_error(with("Crack_Tip(notch)", key("Rows", "1")), {"History > Cracks > notch > Rows: '1'; expected"});
}

TEST_F(Mistake, MeansAndContactForcesOfTheHistory) {
  const auto with = [](const std::string& name, const std::string& layers = "3") {
    Parts parts = right_parts();
    parts.history = key("Filename", "@/history.csv") + section("Profiles", section("slices", key("Layers", layers))) +
                    section("Variables", key(name, "true"));
    return parts.text();
  };
  expect_error(with("Mean_Velocity_W"),
               {"expected Mean_ or Sum_ and the name of a variable (did you mean 'Mean_Velocity"});
  expect_error(with("Mean_Velocity_Z(slces)"), {"there is no node set or block 'slces'"});
  expect_error(with("Mean_Velocity_Z(slices)", "1000"),
               {"History > Profiles > slices: layer 1 of 1000 holds no point"});
  expect_error(with("Mean_Velocity_Z(slices)", "0"), {"History > Profiles > slices > Layers: '0'; expected"});
  expect_error(with("Contact_Force_Z(bar)"), {"in brackets two blocks, e.g. Contact_Force_Z(foam:plate)"});
  expect_error(with("Contact_Force_Z(bar:plat)"), {"there is no block 'plat' (did you mean 'plate'?)"});
  expect_error(with("Contact_Force_Z(bar:bar)"), {"the forces of a block on itself add up to nothing"});
  expect_error(with("Contact_Forc_Z(bar:plate)"), {"(did you mean 'Contact_Force_Z'?)"});
  Parts twice = right_parts();
  twice.node_sets = key("slices 1", "z &gt; 0");
  twice.history =
      key("Filename", "@/history.csv") + section("Profiles", section("slices", key("Layers", "3"))) +
      section("Variables", key("Mean_Velocity_Z(slices)", "true") + key("Mean_Velocity_Z(slices 1)", "true"));
  expect_error(twice.text(), {"two columns are called 'Mean_Velocity_Z(slices 1)'"});
}

// Results of a run are replaced only by a run that begins.
TEST_F(Mistake, LeavesEarlierResultsAlone) {
  const std::string deck = right_parts().text();
  EXPECT_FALSE(outcome(deck).has_value());
  for (const auto& [old, replacement] :
       {std::pair("\"Displacement\"", "\"Displacment\""), {"\"Max_Displacement\"", "\"Max_Displacment\""}}) {
    EXPECT_TRUE(outcome(changed(deck, old, replacement)).has_value());
    if (world.rank() != 0) continue;
    EXPECT_GE(io::read_result(folder / "result.e").times.size(), 3u) << "gone after the mistake " << replacement;
    EXPECT_GE(read_history(folder / "history.csv").at("Time").size(), 3u) << "gone after the mistake " << replacement;
  }
}

// A block and, far away, three points that have only each other.
std::string points_with_stragglers() {
  std::ostringstream text;
  for (int n = 0; n < 4 * 4 * 6; ++n) text << n % 4 << "e-3 " << n / 4 % 4 << "e-3 " << n / 16 << "e-3 7 1e-9\n";
  for (int n = 0; n < 3; ++n) text << "0.5 0.25 " << n << "e-3 7 1e-9\n";
  return text.str();
}

Parts straggling_parts(const std::string& degenerate) {
  Parts parts = right_parts();
  parts.mesh_type = "Text File";
  parts.mesh_file = "points.txt";
  parts.degenerate = degenerate;
  parts.blocks = changed(parts.blocks, "bar plate", "block_7");
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-20");
  return parts;
}

TEST_F(Mistake, PointsWithTooFewNeighbors) {
  folder.write("points.txt", points_with_stragglers());
  expect_error(straggling_parts("Error").text(),
               {"Discretization > Degenerate Points", "3 points have too few neighbors", "of block block_7",
                "(0.5, 0.25, ", "has 2 neighbors: fewer than four", "\"Drop\""});
  const std::string shown = error(straggling_parts("Error").text());
  EXPECT_TRUE(shown.find("element 97 ") != std::string::npos || shown.find("element 98 ") != std::string::npos ||
              shown.find("element 99 ") != std::string::npos)
      << shown;
}

// As in a file that ends within the exponent of its last volume.
TEST_F(Mistake, APointThatOutweighsItsNeighborsIsNamed) {
  folder.write("points.txt", cubes(7, {0, 0, 0}, 4, 4, 6, 1e-3) + "0.5e-3 0.5e-3 6.5e-3 7 1.000000e-0\n");
  Parts parts = straggling_parts("Error");
  parts.blocks = changed(parts.blocks, key("Horizon", "2.01e-3"), key("Horizon Factor", "1.75"));
  expect_error(parts.text(),
               {"points have too few neighbors", "that at (0.0005, 0.0005, 0.0065) m has a volume of 1 m³",
                "the point itself 1e-09 m³. Mend the mesh"});
}

TEST_F(Mistake, PointsWithTooFewNeighborsAreDroppedOnRequest) {
  folder.write("points.txt", points_with_stragglers());
  const fs::path deck = write_deck(straggling_parts("Drop Any").text());
  testing::internal::CaptureStdout();
  EXPECT_TRUE(run(deck, world));
  const std::string shown = testing::internal::GetCapturedStdout();
  if (world.rank() != 0) return;
  EXPECT_NE(shown.find("dropped 3 points"), std::string::npos) << shown;
  EXPECT_NE(shown.find("1 connected piece;"), std::string::npos) << shown;
  EXPECT_EQ(io::read_result(folder / "result.e").element[0][0].size(), 96u);
}

TEST_F(Mistake, MorePointsDroppedThanOneInAHundred) {
  folder.write("points.txt", points_with_stragglers());
  expect_error(straggling_parts("Drop").text(),
               {"Discretization > Degenerate Points", "leave out 3 points with too few neighbors: 3.03 % of 99 points",
                "expected 1 % at most", "\"Drop Any\""});
}

// Two blocks, and between them three points in a row, each near enough to the next alone: 0.7 % of the points.
TEST_F(Mistake, ABodyThatFallsApartWithoutWhatIsDropped) {
  std::string points = cubes(7, Vector(0, 0, 0), 6, 6, 6, 1e-3) + cubes(7, Vector(10.6e-3, 0, 0), 6, 6, 6, 1e-3);
  for (const char* x : {"6.9e-3", "8.3e-3", "9.7e-3"}) points += std::string(x) + " 2.5e-3 2.5e-3 7 1e-9\n";
  folder.write("points.txt", points);
  Parts parts = straggling_parts("Drop");
  parts.blocks = changed(parts.blocks, "2.01e-3", "1.5e-3");
  expect_error(parts.text(), {"Discretization > Degenerate Points", "leave out 3 points", "expected 1 % at most",
                              "without them 216 more, in 1 piece, are cut off: 50.3 % of 435 points"});
  parts.degenerate = "Drop Any";
  EXPECT_EQ(outcome(parts.text()).value_or("no error"), "no error");
}

TEST_F(Mistake, AllPointsDropped) {
  folder.write("points.txt", "0 0 0 7 1e-9\n1e-3 0 0 7 1e-9\n2e-3 0 0 7 1e-9\n3e-3 0 0 7 1e-9\n");
  expect_error(straggling_parts("Drop").text(), {"Discretization > Degenerate Points", "no point is left"});
}

TEST_F(Mistake, SeveralAreReportedAtOnce) {
  std::string deck = right_parts().text();
  for (const auto& [old, replacement] : {std::pair("\"Horizon\"", "\"Horizn\""),
                                         {"\"8930\"", "\"-8930\""},
                                         {"bar.g", "baar.g"},
                                         {"\"5e-6\"", "\"-5e-6\""},
                                         {"Prescribed Displ", "Prescribd Displ"}}) {
    deck = changed(deck, old, replacement);
  }
  expect_error(deck, {"deck.xml", "6 problems", "Blocks > metal > Horizn", "Blocks > metal > Horizon: missing",
                      "Materials > copper > Density: '-8930'", "'baar.g' does not exist", "Solver > Final Time",
                      "Boundary Conditions > wall > Type: 'Prescribd Displacement'"});
}

TEST(FixedStep, AboveTheLimitIsWarnedOfAndBelowItNot) {
  const double limit = 2e-7;
  EXPECT_EQ(step_warning({0.99 * limit, 0}, limit, 0), "");
  EXPECT_NE(step_warning({1.05 * limit, 0}, limit, 0).find("WARNING"), std::string::npos);
  EXPECT_EQ(step_warning({0, 0.8}, limit, 0), "");  // its own step
}

// The step is some ten times the stable one: the bar blows up within a few steps.
TEST_F(Mistake, StepFarAboveTheStableOne) {
  Parts parts = right_parts();
  parts.verlet = key("Fixed dt", "2e-6");
  parts.times = key("Final Time", "1e-3");
  parts.output = changed(parts.output, "\"5\"", "\"1\"");
  expect_error(parts.text(), {"at t = ", " s, step ", " of 2e-06 s: element ", " of block ", "reference position (",
                              "now at (", "Likely causes: ", "step above the stable one"});
  if (world.rank() != 0) return;
  const io::ExodusResult result = io::read_result(folder / "result.e");
  ASSERT_GE(result.times.size(), 2u);
  EXPECT_EQ(result.times[0], 0);
  EXPECT_EQ(result.nodal[0].size(), result.times.size());
  std::vector<double> lines = read_history(folder / "history.csv").at("Time");
  lines.push_back(result.times.back());
  EXPECT_EQ(lines, result.times) << "both were written at every step, and a frame where it failed";
}

}  // namespace
}  // namespace strut::regression
