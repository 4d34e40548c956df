// Bodies of an equilibrium that only contact holds are told at the start.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"

namespace strut::regression {
namespace {

constexpr double h = 1e-3;  // m, spacing

// A block on a held one, and a third one on that. `conditions`: of the two upper ones.
Parts pile(const RunFolder& folder, const std::string& conditions) {
  folder.write("points.txt", cubes(1, {0, 0, 0}, 3, 3, 3, h) + cubes(2, {0, 0, 3.1 * h}, 3, 3, 3, h) +
                                 cubes(3, {0, 0, 6.2 * h}, 3, 3, 3, h));
  Parts parts = thrown_block(contact_of({{"block_1", "block_2"}}, "1e-3", "1e12"));
  parts.blocks += section("block_3", key("Block Names", "block_3") + key("Material", "copper") +
                                         key("Horizon", "2.01e-3") + key("Separate Body", "true"));
  parts.node_sets = key("end", "x &lt; 1e-3");
  parts.conditions = along("foot", "Prescribed Displacement", "block_1", "xyz", "0") + conditions;
  parts.times = key("Final Time", "1");
  parts.verlet = key("Number of Load Steps", "2");
  return parts;
}

// The part of the warning about bodies, after "WARNING: " and before the common rest.
std::string told(const RunFolder& folder, const Parts& parts, const std::string& solver = "QuasiStatic") {
  const deck::Deck deck = deck::read(folder.write("deck.xml", changed(parts.text(), "Verlet", solver)), folder.world);
  std::istringstream all(told_at_the_start(deck, folder.world).warnings);
  std::string found;
  for (std::string line; std::getline(all, line);) {
    const std::size_t end = line.find(" in these equilibria");
    if (end != std::string::npos) found += line.substr(9, end - 9) + "\n";
  }
  return found;
}

std::string held(const std::string& set, const std::string& axes) {
  return along("hold " + axes + set, "Prescribed Displacement", set, axes, "0");
}

TEST(UnheldBodies, AreToldOfWithTheWayThatTheyMayGo) {
  const RunFolder folder;
  const std::string only = "block_2: only contact and friction hold it";
  EXPECT_EQ(told(folder, pile(folder, "")), only + "\n") << "nothing touches the third one";
  EXPECT_EQ(told(folder, pile(folder, held("block_2", "xy"))), only + " along z\n");
  EXPECT_EQ(told(folder, pile(folder, held("block_2", "z"))), only + " but along z\n");
  EXPECT_EQ(told(folder, pile(folder, held("block_2", "xyz"))), "");
  Parts flies = pile(folder, "");
  flies.verlet = key("Safety Factor", "0.8");
  EXPECT_EQ(told(folder, flies, "Verlet"), "") << "what flies needs nothing that holds it";
}

// The points at x = 0.5 mm hold against turning about y and z, by any one direction of two points; about x they turn.
TEST(UnheldBodies, MayTurn) {
  const RunFolder folder;
  const std::string line = key("end", "(x &lt; 1e-3) * (y &lt; 1e-3) * (z &gt; 3e-3) * (z &lt; 6e-3)");
  Parts parts = pile(folder, held("end", "xyz"));
  parts.node_sets = line;  // along z
  EXPECT_EQ(told(folder, parts), "block_2: only contact and friction hold it against turning\n");
  parts.conditions += along("side", "Prescribed Displacement", "block_2", "x", "0");
  EXPECT_EQ(told(folder, parts), "");
}

TEST(UnheldBodies, AreHeldByToolsThatTouchThem) {
  const RunFolder folder;
  const std::string sides = held("block_2", "xy");
  const auto plate = [](double gap) {
    return plane("plate", "Rigid Plane", "block_2", "0 0 " + std::to_string((6.1 + gap) * h), "0 0 -1");
  };
  EXPECT_EQ(told(folder, pile(folder, sides + plate(0.1))), "");
  EXPECT_NE(told(folder, pile(folder, sides + plate(2))), "");
}

// A body that goes on behind a symmetry plane neither leaves it nor turns out of it.
TEST(UnheldBodies, AreHeldByTheirMirrorImages) {
  const RunFolder folder;
  const std::string mirror = plane("mirror", "Symmetry Plane", "left", "0 0 0", "1 0 0");
  const auto parts_with = [&](const std::string& more) {
    Parts parts = pile(folder, mirror + more);
    parts.node_sets = key("left", "(x &lt; 1e-3) * (z &gt; 3e-3) * (z &lt; 6e-3)");
    return parts;
  };
  EXPECT_EQ(told(folder, parts_with("")), "block_2: only contact and friction hold it but along x\n");
  EXPECT_EQ(told(folder, parts_with(held("left", "yz"))), "");
}

// Weight that nothing bears has no equilibrium; what conditions or a tool may bear is not told of.
TEST(UnheldBodies, OnWhichLoadsActAreToldOf) {
  const RunFolder folder;
  const auto told_of = [&folder](const std::string& conditions) {
    Parts parts;
    parts.conditions = conditions;
    parts.times = key("Final Time", "1");
    parts.verlet = key("Number of Load Steps", "2");
    return told(folder, parts);
  };
  const std::string weight = along("weight", "Body Force", "all", "z", "-1e4");
  EXPECT_EQ(told_of(weight), "bar: nothing holds it\n");
  EXPECT_EQ(told_of(weight + held("foot", "z")), "");
  EXPECT_EQ(told_of(weight + plane("floor", "Rigid Plane", "all", "0 0 0", "0 0 1")), "");
  EXPECT_EQ(told_of(held("foot", "z")), "");
  Parts parts = pile(folder, along("weight", "Body Force", "block_3", "z", "-1e4") +
                                 plane("floor", "Rigid Plane", "block_2", "0 0 0", "0 0 1"));
  parts.contact = "";
  EXPECT_EQ(told(folder, parts), "block_3: nothing holds it\n");
}

// Loose pieces of one block, which another may push.
TEST(UnheldBodies, MayBePiecesOfABlock) {
  const RunFolder folder;
  Parts parts = pile(folder, held("block_3", "xyz"));
  folder.write("points.txt", cubes(1, {0, 0, 0}, 3, 3, 3, h) + cubes(2, {0, 0, 3.1 * h}, 3, 3, 3, h) +
                                 cubes(2, {9 * h, 0, 3.1 * h}, 3, 3, 3, h) + cubes(3, {0, 0, 6.2 * h}, 3, 3, 3, h));
  parts.node_sets = key("one", "(x &lt; 4e-3) * (z &gt; 3e-3) * (z &lt; 6e-3)");
  parts.conditions += held("one", "xyz");
  EXPECT_EQ(told(folder, parts),
            "a piece of 27 points of block_2 around (0.0105, 0.0015, 0.0046) m: only contact and friction hold it\n");
}

}  // namespace
}  // namespace strut::regression
