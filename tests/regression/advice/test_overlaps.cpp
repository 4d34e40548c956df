// Meshes that overlap: mass that counts twice is told of before the run. Seams, where surfaces of blocks end.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"

namespace strut::regression {
namespace {

// Two cubes of 5³ points, the second one so far from the first along each axis, m.
std::string warnings(double apart, bool separate, const std::string& formulation, const std::string& conditions = "") {
  const RunFolder folder;
  folder.write("points.txt",
               cubes(1, Vector::Zero(), 5, 5, 5, 1e-3) + cubes(2, Vector::Constant(apart), 5, 5, 5, 1e-3));
  Parts parts;
  parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
  parts.materials = changed(copper(), key("Density", "8930"), key("Density", "8930") + formulation);
  parts.blocks =
      section("one", key("Block Names", "block_1") + key("Material", "copper") + key("Horizon Factor", "1.75")) +
      section("two", key("Block Names", "block_2") + key("Material", "copper") + key("Horizon Factor", "1.75") +
                         key("Separate Body", separate ? "true" : "false"));
  parts.contact = contact_of({{"block_1", "block_2"}}, "1e-3", "1e11");
  if (!separate) parts.contact.clear();
  parts.conditions = conditions;
  if (!conditions.empty()) parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
  const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
  return told_at_the_start(deck, folder.world).warnings;
}

TEST(Overlaps, OfBondedBlocksAreTold) {
  for (const std::string& formulation : {std::string(), key("Formulation", "Quadratic Correspondence")}) {
    for (const double apart : {0.3e-3, 0.5e-3, 1.3e-3}) {
      EXPECT_NE(warnings(apart, false, formulation).find("times as much material as fits within the horizon"),
                std::string::npos)
          << apart;
    }
    EXPECT_EQ(warnings(5e-3, false, formulation).find("as much material"), std::string::npos);
  }
}

// A body of two blocks and a plate: what touches is at the seam of a surface, not of points or of a body of its own.
TEST(Seams, OfSurfacesAreTold) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0, 0, 0}, 3, 6, 3, 1e-3) + cubes(2, {3e-3, 0, 0}, 3, 6, 3, 1e-3) +
                                 cubes(3, {0, 0, 4e-3}, 6, 6, 3, 1e-3));
  const auto tells = [&folder](const std::string& law, const std::string& apart) {
    Parts parts = thrown_block(section("Models", section("m", law)) +
                               section("Interactions", section("General Contact", key("Contact Model", "m"))));
    const auto block = [](const std::string& name, const std::string& separate) {
      return section(name, key("Block Names", name) + key("Material", "copper") + key("Horizon", "2.01e-3") +
                               key("Separate Body", separate));
    };
    parts.blocks = block("block_1", "false") + block("block_2", apart) + block("block_3", "true");
    const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
    return told_at_the_start(deck, folder.world)
               .warnings.find(
                   "blocks block_1 and block_2 are bonded to each other, but each has a surface of its own") !=
           std::string::npos;
  };
  const std::string surface = key("Contact Model", "Surface");
  const std::string penalty =
      key("Contact Model", "Short Range Force") + key("Spring Constant", "1e12") + key("Contact Radius", "1e-3");
  EXPECT_TRUE(tells(surface, "false"));
  EXPECT_FALSE(tells(surface, "true"));
  EXPECT_FALSE(tells(penalty, "false"));
}

// The warnings of points 1 mm apart, each with this part of a cube's volume, as text or as spheres. `at_faces`: halves
// and quarters there, as points at nodes have.
std::string told_of_volumes(const Vector& layers, double part, bool spheres = false, bool at_faces = false,
                            double every_second = 1) {
  const RunFolder folder;
  const double spacing = 1e-3;  // m
  std::ostringstream lines;
  io::Mesh mesh;
  mesh.blocks.push_back({.name = "block_1", .type = "SPHERE", .nodes = {}, .volumes = {}, .cells = {}});
  for (int n = 0; n < layers.prod(); ++n) {
    const int x = n % int(layers[0]), y = n / int(layers[0]) % int(layers[1]), z = n / int(layers[0] * layers[1]);
    const Vector cell(x, y, z);
    double volume = part * ((x + y + z) % 2 == 0 ? 1 : every_second) * std::pow(spacing, 3);
    for (int axis = 0; axis < 3 && at_faces; ++axis)
      volume *= cell[axis] == 0 || cell[axis] == layers[axis] - 1 ? 0.5 : 1;
    lines << spacing * x << " " << spacing * y << " " << spacing * z << " 1 " << volume << "\n";
    mesh.nodes.push_back(spacing * cell);
    mesh.blocks[0].nodes.push_back(n);
    mesh.blocks[0].volumes.push_back(volume);
  }
  folder.write("points.txt", lines.str());
  run_on_root(folder.world, [&] { io::write_mesh(folder / "bar.g", mesh); });
  const std::string horizon = part > 1 ? key("Horizon Factor", "1.75") : key("Horizon", "1.75e-3");
  Parts parts;
  parts.blocks = section("one", key("Block Names", "block_1") + key("Material", "copper") + horizon);
  parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
  if (!spheres) parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
  return told_at_the_start(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world).warnings;
}

// Nothing but the file ties them to the lattice.
TEST(Volumes, ThatDoNotFitTheLatticeAreTold) {
  const auto has = [](const std::string& text, const std::string& part) { return text.find(part) != text.npos; };
  const std::string fit = "do not fit the lattice";
  for (const bool spheres : {false, true}) {
    for (const double part : {1e-3, 0.5, 2.0, 8.0})
      EXPECT_TRUE(has(told_of_volumes({3, 4, 5}, part, spheres), fit)) << part << spheres;
    EXPECT_FALSE(has(told_of_volumes({3, 4, 5}, 1.05, spheres), fit));
  }
  EXPECT_TRUE(has(told_of_volumes({3, 4, 5}, 2),
                  "the volumes of 60 points, one of them at (0, 0, 0) m, do not fit the lattice that the points are "
                  "on: the farthest off has 2e-09 m³, and its spacings make 1e-09 m³"));
  for (const double part : {1e-3, 2.0}) EXPECT_TRUE(has(told_of_volumes({2, 2, 5}, part), fit)) << part;
  EXPECT_FALSE(has(told_of_volumes({6, 6, 1}, 0.1), fit));  // the thickness of one layer is its volumes'
  EXPECT_TRUE(has(told_of_volumes({4, 4, 5}, 1, false, false, 2), fit));
  EXPECT_FALSE(has(told_of_volumes({4, 4, 5}, 1, false, false, 0.5), fit));  // partly filled cells
  for (const int layers : {2, 3, 5}) {
    EXPECT_FALSE(has(told_of_volumes({5.0, 5.0, double(layers)}, 1, false, true), fit)) << layers;
  }
}

// Small points have larger ones in their families, which lie outside of their own horizon.
TEST(Overlaps, AreNotToldWhereCellsGrow) {
  const RunFolder folder;
  const double small = 1e-3, large = 1.8e-3;  // m; volumes 1 : 5.8
  folder.write("points.txt",
               cubes(1, Vector::Zero(), 9, 9, 4, small) + cubes(1, Vector(0, 0, 4 * small), 5, 5, 3, large));
  Parts parts;
  parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
  for (const char* factor : {"1.75", "3.01"}) {
    parts.blocks =
        section("one", key("Block Names", "block_1") + key("Material", "copper") + key("Horizon Factor", factor));
    const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
    EXPECT_EQ(told_at_the_start(deck, folder.world).warnings.find("as much material"), std::string::npos) << factor;
    EXPECT_EQ(told_at_the_start(deck, folder.world).warnings.find("do not fit"), std::string::npos) << factor;
  }
}

// The small horizon of a small cell holds whole volumes of large ones that reach out of it: 4.09 mm³ where 2.05 fit.
TEST(Overlaps, AreNotToldOfASmallCellAmongLargeOnes) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, Vector::Zero(), 6, 6, 6, 1e-3) + "0.003 0.003 0.0025 1 9e-11\n");
  Parts parts;
  parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
  parts.blocks =
      section("one", key("Block Names", "block_1") + key("Material", "copper") + key("Horizon Factor", "1.75"));
  const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
  EXPECT_EQ(told_at_the_start(deck, folder.world).warnings.find("as much material"), std::string::npos);
}

// The warnings of a bar of cells of 1 mm that is given twice, the second time shifted and with nodes of its own.
std::string told_of_two(const Lattice& bar, const Vector& apart, Parts parts = {}) {
  const RunFolder folder;
  io::Mesh mesh = bar.mesh();
  const std::vector<Vector> once = mesh.nodes;
  std::vector<int>& elements = mesh.blocks[0].nodes;
  const std::vector<int> of_one = elements;
  for (const Vector& X : once) mesh.nodes.push_back(X + apart);
  for (const int node : of_one) elements.push_back(node + static_cast<int>(once.size()));
  run_on_root(folder.world, [&] { io::write_mesh(folder / "bar.g", mesh); });
  return told_at_the_start(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world).warnings;
}

Parts quadratic() {
  Parts parts;
  parts.materials = changed(copper(), key("Density", "8930"),
                            key("Density", "8930") + key("Formulation", "Quadratic Correspondence"));
  return parts;
}

// Hexahedra that share no nodes: bonds run through material, so neither is bonded to the other.
TEST(Overlaps, OfPiecesOfABodyThatAreNotBondedAreTold) {
  const auto told = [](double apart) { return told_of_two({5, 5, 5}, Vector::Constant(apart), quadratic()); };
  for (const double apart : {0.5e-3, 1.3e-3})
    EXPECT_NE(told(apart).find("times as much material as fits"), std::string::npos) << apart;
  for (const double apart : {5e-3, 5.1e-3}) EXPECT_EQ(told(apart).find("as much material"), std::string::npos) << apart;
}

// Nodes of both are one lattice of finer cells.
TEST(Overlaps, OfElementsAreToldAtNodes) {
  Parts parts;
  parts.points = "Nodes";
  EXPECT_NE(told_of_two({4, 4, 6}, {0.5e-3, 0, 0}, parts).find("do not fit the lattice"), std::string::npos);
  EXPECT_NE(told_of_two({8, 8, 8}, Vector::Constant(0.5e-3), parts).find("times as much material"), std::string::npos);
  EXPECT_EQ(told_of_two({4, 4, 6}, {0, 0, 8.1e-3}, parts).find("WARNING"), std::string::npos);
}

// Where no family is full, its volume does not tell.
TEST(Overlaps, OfThinBodiesAreTold) {
  const std::string twice = "share no node: elements that overlap, or are given twice?";
  for (const Lattice& thin : {Lattice{2, 2, 8}, Lattice{4, 4, 2}})
    EXPECT_NE(told_of_two(thin, Vector::Constant(0.2e-3)).find(twice), std::string::npos);
  EXPECT_EQ(told_of_two({2, 2, 8}, {0, 0, 8e-3}).find("share no node"), std::string::npos);
}

// Nodes at one place that are not merged cut a body whose bonds run through material.
TEST(Overlaps, AreNotWherePartsLieBesideEachOther) {
  const std::string cut = "64 points, one of them at", unmerged = "nodes at one place that are not merged?";
  const std::string told = told_of_two({4, 8, 4}, {0, 0, 4e-3}, quadratic());
  EXPECT_NE(told.find(cut), std::string::npos) << told;
  EXPECT_NE(told.find(unmerged), std::string::npos) << told;
  // Faces that overlap in part, as those of cells of two sizes do.
  EXPECT_NE(told_of_two({4, 8, 4}, {0.5e-3, 0.4e-3, 4e-3}, quadratic()).find(unmerged), std::string::npos);
  EXPECT_EQ(told_of_two({4, 8, 4}, {0, 0, 4.2e-3}, quadratic()).find(unmerged), std::string::npos);   // a gap
  EXPECT_EQ(told_of_two({4, 8, 4}, {4e-3, 0, 4e-3}, quadratic()).find(unmerged), std::string::npos);  // at an edge
  EXPECT_EQ(told_of_two({4, 8, 4}, {0, 0, 4e-3}).find(unmerged), std::string::npos);                  // bonded
  Parts at_nodes = quadratic();
  at_nodes.points = "Nodes";
  EXPECT_NE(told_of_two({4, 8, 4}, {0, 0, 4e-3}, at_nodes).find("90 points"), std::string::npos);
  EXPECT_NE(told_of_two({4, 8, 4}, {0, 0, 4e-3}, at_nodes).find(unmerged), std::string::npos);
  EXPECT_EQ(told_of_two({4, 8, 4}, {0, 0, 4.2e-3}, at_nodes).find(unmerged), std::string::npos);
}

// A crack cuts elements that share nodes into parts, too.
TEST(Overlaps, AreNotWhereACrackIs) {
  std::string disk = key("Type", "Disk") + key("Radius", "1") + key("Center_Z", "4e-3") + key("Normal_Z", "1");
  for (const char* zero : {"Normal_X", "Normal_Y", "Center_X", "Center_Y"}) disk += key(zero, "0");
  const std::string crack = section("Bond Filters", section("cut", disk));
  for (const Parts& parts : {Parts{}, quadratic()}) {
    const RunFolder folder(Lattice{4, 4, 8});
    const std::string text = changed(parts.text(), R"(value="bar.g"/>)", R"(value="bar.g"/>)" + crack);
    const deck::Deck deck = deck::read(folder.write("deck.xml", text), folder.world);
    const std::string told = told_at_the_start(deck, folder.world).warnings;
    EXPECT_EQ(told.find("share no node"), std::string::npos) << told;
  }
}

std::string with_anything() {
  return section("Models", section("m", key("Contact Model", "Short Range Force") + key("Spring Constant", "1e11") +
                                            key("Contact Radius", "1e-3"))) +
         section("Interactions", section("any", key("Contact Model", "m")));
}

// Two parts of a block may be bodies that meet; an interaction of all blocks does not say so.
TEST(Overlaps, AreNotWherePartsMeetByDeclaredContact) {
  const auto told = [](const std::string& contact) {
    Parts parts = quadratic();
    parts.contact = contact;
    return told_of_two({4, 8, 4}, {0, 0, 4e-3}, parts).find("share no node") != std::string::npos;
  };
  EXPECT_FALSE(told(contact_of({{"bar", "bar"}}, "1e-3", "1e11")));
  EXPECT_TRUE(told(with_anything()));
}

// Contact never acts between bonded points: of one block, too, and across gaps of less than a quarter of a spacing.
TEST(Contact, OfBondedPartsOfABlockIsTold) {
  const std::string bonded = "parts of block bar that share no node are bonded to each other by ";
  for (const std::string& contact : {contact_of({{"bar", "bar"}}, "1e-3", "1e11"), with_anything()}) {
    Parts parts;
    parts.contact = contact;
    EXPECT_NE(told_of_two({4, 4, 4}, {0, 0, 4.2e-3}, parts).find(bonded), std::string::npos);
    EXPECT_EQ(told_of_two({4, 4, 4}, {0, 0, 4e-3}, parts).find(bonded), std::string::npos);  // no gap
    EXPECT_EQ(told_of_two({4, 4, 4}, {0, 0, 6e-3}, parts).find(bonded), std::string::npos);  // no bond
  }
}

// Nodes on both sides of a gap of a cell are layers of a lattice: elements tell that nothing is between them.
TEST(Contact, OfBondedPartsIsToldAtNodes) {
  const std::string bonded = "that share no node are bonded to each other by ";
  for (const std::string& contact : {std::string(), with_anything()}) {
    Parts parts;
    parts.points = "Nodes", parts.contact = contact;
    for (const double gap : {0.3e-3, 1e-3})
      EXPECT_NE(told_of_two({4, 4, 4}, {0, 0, 4e-3 + gap}, parts).find(bonded), std::string::npos) << gap;
    EXPECT_EQ(told_of_two({4, 4, 4}, {0, 0, 6.1e-3}, parts).find(bonded), std::string::npos);
  }
}

TEST(Contact, OfBondedBlocksIsToldWhereTheGapIsSmall) {
  const auto told = [](double gap, bool merged) {
    const RunFolder folder;
    io::Mesh mesh = Lattice{4, 4, 8}.mesh();
    std::vector<int>& low = mesh.blocks[0].nodes;
    io::Mesh::Block high = mesh.blocks[0];
    high.name = "high";
    high.nodes.assign(low.begin() + 8 * 64, low.end());
    low.resize(8 * 64);
    const auto nodes = static_cast<int>(mesh.nodes.size());
    for (int n = 0; n < nodes && !merged; ++n) mesh.nodes.push_back(mesh.nodes[n] + Vector(0, 0, gap));
    for (int& node : high.nodes) node += merged ? 0 : nodes;
    mesh.blocks.push_back(high);
    run_on_root(folder.world, [&] { io::write_mesh(folder / "bar.g", mesh); });
    Parts parts;
    parts.contact = with_anything();
    return told_at_the_start(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world)
               .warnings.find("are bonded to each other by") != std::string::npos;
  };
  EXPECT_TRUE(told(0.24e-3, false));
  EXPECT_FALSE(told(0, false));
  EXPECT_FALSE(told(0, true));
}

// No contact is declared: blocks of 4 mm with a gap of half a cell would be one body; those that touch are meant to be
// one, and those 2 mm apart are two.
TEST(Contact, OfBlocksThatAreBondedAcrossAGapIsAskedFor) {
  const auto told = [](double apart, const std::string& contact) {
    const RunFolder folder;
    Parts parts;
    parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
    parts.contact = contact;
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3"));
    folder.write("points.txt", cubes(1, {0, 0, 0}, 4, 4, 4, 1e-3) + cubes(2, {0, 0, apart}, 4, 4, 4, 1e-3));
    return told_at_the_start(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world)
        .warnings.find(contact.empty() ? "are bonded to each other across the gap between them"
                                       : "are bonded to each other by");
  };
  EXPECT_NE(told(4.5e-3, ""), std::string::npos);
  EXPECT_NE(told(4.2e-3, with_anything()), std::string::npos);
  for (const std::string& contact : {std::string(), with_anything()}) {
    EXPECT_EQ(told(4e-3, contact), std::string::npos);
    EXPECT_EQ(told(6e-3, contact), std::string::npos);
  }
}

// Two lattices of unequal spacings on each other: ranks that have one of them each find the same parts.
TEST(Contact, OfBondedBlocksOfUnequalSpacingsIsLookedFor) {
  const RunFolder folder;
  io::Mesh mesh = Lattice{4, 4, 8}.mesh();
  const io::Mesh fine = Lattice{8, 8, 2, 0.5e-3}.mesh();
  const auto count = static_cast<int>(mesh.nodes.size());
  for (const Vector& X : fine.nodes) mesh.nodes.push_back(X + Vector(0, 0, 8e-3));
  mesh.blocks.push_back(fine.blocks[0]);
  mesh.blocks[1].name = "fine";
  for (int& node : mesh.blocks[1].nodes) node += count;
  run_on_root(folder.world, [&] { io::write_mesh(folder / "bar.g", mesh); });
  Parts parts;
  parts.contact = with_anything();
  const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
  EXPECT_EQ(told_at_the_start(deck, folder.world).warnings.find("parts of block"), std::string::npos);
}

// Cells that are no cubes, and layers that do not match, leave no gap where they touch. The warnings of two stacks of
// 4 x 4 x 4 cells, of which the upper one has nodes of its own.
std::string told_of_stacks(const Vector& edges, const Vector& apart, const std::string& points, bool merged,
                           bool one_block) {
  const RunFolder folder;
  io::Mesh mesh = Lattice{4, 4, merged ? 8 : 4, 1.0}.mesh();
  for (Vector& X : mesh.nodes) X = X.cwiseProduct(edges);
  const std::vector<Vector> once = mesh.nodes;
  std::vector<int>& low = mesh.blocks[0].nodes;
  io::Mesh::Block high = mesh.blocks[0];
  high.name = "high";
  if (merged) high.nodes.erase(high.nodes.begin(), high.nodes.begin() + 8 * 64), low.resize(8 * 64);
  for (const Vector& X : once)
    if (!merged) mesh.nodes.push_back(X + apart);
  for (int& node : high.nodes) node += merged ? 0 : static_cast<int>(once.size());
  if (one_block) low.insert(low.end(), high.nodes.begin(), high.nodes.end());
  if (!one_block) mesh.blocks.push_back(high);
  mesh.node_sets.clear();
  run_on_root(folder.world, [&] { io::write_mesh(folder / "bar.g", mesh); });
  Parts parts;
  parts.points = points;
  parts.contact = with_anything();
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "4.1e-3"));
  return told_at_the_start(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world).warnings;
}

TEST(Contact, OfCellsThatAreNoCubesIsToldWhereThereIsAGap) {
  const std::string bonded = "are bonded to each other by";
  const Vector tall(1e-3, 1e-3, 2e-3), cube = Vector::Constant(1e-3);
  const auto told = [&](const Vector& edges, const Vector& apart, const std::string& points, bool merged,
                        bool one_block) {
    return told_of_stacks(edges, apart, points, merged, one_block).find(bonded) != std::string::npos;
  };
  EXPECT_FALSE(told(tall, Vector::Zero(), "Nodes", true, false));
  EXPECT_TRUE(told(cube, {0, 0, 5e-3}, "Nodes", false, false));
  for (const bool one_block : {false, true}) {
    EXPECT_FALSE(told(tall, {0, 0, 8e-3}, "Elements", false, one_block));
    EXPECT_TRUE(told(tall, {0, 0, 8.2e-3}, "Elements", false, one_block));
    EXPECT_FALSE(told(cube, {0.5e-3, 0.5e-3, 4e-3}, "Elements", false, one_block));
    EXPECT_FALSE(told(cube, {0.5e-3, 0, 4e-3}, "Elements", false, one_block));
    EXPECT_TRUE(told(cube, {0.5e-3, 0.5e-3, 4.2e-3}, "Elements", false, one_block));
  }
}

TEST(Overlaps, OfSeparateBodiesAreTold) {
  for (const double apart : {0.3e-3, 0.5e-3, 1.3e-3}) {
    EXPECT_NE(warnings(apart, true, "").find("points of the blocks 'block_1' and 'block_2', one of them at"),
              std::string::npos)
        << apart;
  }
  for (const double apart : {4.99e-3, 5e-3}) {
    EXPECT_EQ(warnings(apart, true, "").find("inside of the other one"), std::string::npos) << apart;
  }
}

// Contact by surfaces takes away what bodies overlap by at the start, less than a spacing here.
TEST(Overlaps, OfSurfacesAreTold) {
  const auto told = [](double overlap) {
    const RunFolder folder;
    folder.write("points.txt",
                 cubes(1, Vector::Zero(), 6, 6, 6, 1e-3) + cubes(2, {0, 0, 6e-3 - overlap}, 6, 6, 6, 1e-3));
    Parts parts = thrown_block(section("Models", section("m", key("Contact Model", "Surface"))) +
                               section("Interactions", section("General Contact", key("Contact Model", "m"))));
    parts.blocks.clear();
    for (const std::string block : {"block_1", "block_2"}) {
      parts.blocks += section(block, key("Block Names", block) + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                         key("Separate Body", "true"));
    }
    return told_at_the_start(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world).warnings;
  };
  // Known to a tenth: the density of the other body is no straight line over the distance.
  EXPECT_NE(told(0.3e-3).find("blocks 'block_1' and 'block_2' overlap by up to about 0.3"), std::string::npos)
      << told(0.3e-3);
  EXPECT_NE(told(0.7e-3).find("blocks 'block_1' and 'block_2' overlap by up to about 0."), std::string::npos);
  for (const double overlap : {0.0, -0.3e-3}) EXPECT_EQ(told(overlap).find("overlap by"), std::string::npos);
}

TEST(Overlaps, AreThoseOfTheStart) {
  const auto told = [](double apart, const std::string& by) {
    return warnings(apart, true, "", along("lift", "Initial Displacement", "block_2", "xyz", by))
               .find("are inside of the other one at the start") != std::string::npos;
  };
  EXPECT_FALSE(told(1.3e-3, "4e-3"));
  EXPECT_TRUE(told(1.3e-3, "1e-3"));
  EXPECT_TRUE(told(6e-3, "-3e-3"));
}

}  // namespace
}  // namespace strut::regression
