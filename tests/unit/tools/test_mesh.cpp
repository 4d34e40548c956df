// strut-mesh: points, volumes and node sets of what it makes, and what it says about wrong recipes.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "base/parallel/communicator.hpp"
#include "io/exodus/exodus.hpp"
#include "tool.hpp"

namespace strut {
namespace {

constexpr double pi = std::numbers::pi;

class MeshTool : public testing::ToolTest {
 protected:
  testing::Outcome make(const std::string& recipe) const {
    return run(std::string(STRUT_MESH) + " " + write("mesh.recipe", recipe) + " " + path("mesh.g"));
  }
  testing::Outcome make_input(const std::string& name) const {
    return run(std::string(STRUT_MESH) + " " + STRUT_SOURCE_DIR + "/inputs/taylor/" + name + " " + path("mesh.g"));
  }
  PointCloud points() const { return io::read_exodus(path("mesh.g"), Communicator()); }

  PointCloud made(const std::string& recipe) const {
    const testing::Outcome outcome = make(recipe);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    return points();
  }
};

double volume(const PointCloud& cloud) { return std::accumulate(cloud.volumes.begin(), cloud.volumes.end(), 0.0); }

// How many points are in each set.
std::map<std::string, int> set_sizes(const PointCloud& cloud) {
  std::map<std::string, int> sizes;
  for (std::size_t k = 0; k < cloud.set_names.size(); ++k) {
    for (const std::uint64_t bits : cloud.sets) sizes[cloud.set_names[k]] += bits >> k & 1;
  }
  return sizes;
}

Vector center_of_mass(const PointCloud& cloud) {
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < cloud.size(); ++i) sum += cloud.volumes[i] * cloud.positions[i];
  return sum / volume(cloud);
}

// Σ V x² and Σ V y² of a section of 4-fold symmetry are the same, Σ V x y vanishes.
void expect_fourfold(const PointCloud& cloud) {
  Tensor moment = Tensor::Zero();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    moment += cloud.volumes[i] * cloud.positions[i] * cloud.positions[i].transpose();
  }
  EXPECT_NEAR(moment(0, 0), moment(1, 1), 1e-12 * moment(0, 0));
  EXPECT_NEAR(moment(0, 1), 0, 1e-12 * moment(0, 0));
}

TEST_F(MeshTool, LatticeCylinderOfThePublishedBar) {
  ASSERT_EQ(make_input("bar.recipe").status, 0);
  const PointCloud cloud = points();
  EXPECT_EQ(cloud.size(), 20720);
  const double spacing = 0.324 / 140;
  for (const double v : cloud.volumes) ASSERT_NEAR(v, std::pow(spacing, 3), 1e-9 * v);
  const std::map<std::string, int> expected = {{"bar_zmin", 148}, {"bar_zmax", 148}, {"foot", 148}, {"top", 148}};
  EXPECT_EQ(set_sizes(cloud), expected);
  expect_fourfold(cloud);
}

TEST_F(MeshTool, LatticeCylinderOf227MetresPerSecond) {
  ASSERT_EQ(make_input("bar-227.recipe").status, 0);
  EXPECT_EQ(points().size(), 8060);
}

TEST_F(MeshTool, FittedCylindersHaveTheVolumeOfTheirPolygon) {
  for (const auto& [name, radius, length] :
       {std::tuple("bar-fitted.recipe", 0.016, 0.324), std::tuple("bar-227-fitted.recipe", 0.0032, 0.0324)}) {
    ASSERT_EQ(make_input(name).status, 0);
    const PointCloud cloud = points();
    const double sides = 48;  // 12 cells across
    const double polygon = sides / 2 * radius * radius * std::sin(2 * pi / sides);
    EXPECT_NEAR(volume(cloud), polygon * length, 1e-9 * polygon * length);
    EXPECT_NEAR(volume(cloud), pi * radius * radius * length, 0.003 * pi * radius * radius * length);
    const auto [smallest, largest] = std::minmax_element(cloud.volumes.begin(), cloud.volumes.end());
    EXPECT_GT(*smallest / *largest, 0.85);
    expect_fourfold(cloud);
  }
}

// A frustum of a regular polygon, up or down, layers alike or graded; volume and center of mass are exact.
TEST_F(MeshTool, ConesAreFrustumsOfTheirPolygon) {
  for (const auto& [low, high] : {std::pair(0.5, 1.0), std::pair(1.0, 0.25)}) {
    for (const std::string more : {"", "grading = 1.2\n", "elements = sphere\n"}) {
      const PointCloud cloud = made("shape = cone\nlength = 3\nradius = " + std::to_string(low) +
                                    "\ntop_radius = " + std::to_string(high) + "\nspacing = 0.11\n" + more);
      const double sides = 4 * std::round((low + high) / 2 * std::sqrt(pi) / 0.11 / 2) * 2;
      const double squares = low * low + low * high + high * high;
      const double exact = sides / 2 * std::sin(2 * pi / sides) * 3 * squares / 3;
      EXPECT_NEAR(volume(cloud), exact, 1e-9 * exact);
      const double height = 3 * (low * low + 2 * low * high + 3 * high * high) / (4 * squares);
      EXPECT_NEAR((center_of_mass(cloud) - Vector(0, 0, height)).norm(), 0, 1e-9);
      expect_fourfold(cloud);
    }
  }
}

TEST_F(MeshTool, AxisThroughAPoint) {
  // Squares whose centers lie within 1.5 spacings of one: it and its eight neighbors.
  const PointCloud cloud = made("shape = cylinder\ncentred = point\nlength = 3\nradius = 1.5\nspacing = 1\n");
  EXPECT_EQ(cloud.size(), 27);
  EXPECT_NEAR((center_of_mass(cloud) - Vector(0, 0, 1.5)).norm(), 0, 1e-12);
  EXPECT_EQ(made("shape = cylinder\nlength = 3\nradius = 1.5\nspacing = 1\n").size(), 12);  // 4 about the corner
}

TEST_F(MeshTool, BoxFillsItsSizeAndHasSixFaces) {
  const PointCloud cloud =
      made("shape = box\nname = plate\nsize = 1 2 3.1\nspacing = 0.5\norigin = -1 10 0 # corner\n");
  EXPECT_EQ(cloud.size(), 2 * 4 * 6);
  EXPECT_NEAR(volume(cloud), 6.2, 1e-12);
  EXPECT_NEAR((center_of_mass(cloud) - Vector(-0.5, 11, 1.55)).norm(), 0, 1e-12);
  const std::map<std::string, int> expected = {{"plate_xmin", 24}, {"plate_xmax", 24}, {"plate_ymin", 12},
                                               {"plate_ymax", 12}, {"plate_zmin", 8},  {"plate_zmax", 8},
                                               {"foot", 8},        {"top", 8}};
  EXPECT_EQ(set_sizes(cloud), expected);
}

TEST_F(MeshTool, BoxesOfAllNumbersOfLayersHaveSixFaces) {
  for (const char* size : {"6e-3 4e-3 4e-3", "4e-3 6e-3 4e-3", "4e-3 4e-3 6e-3"}) {  // 0.006 * 6 / 6 > 0.006
    const PointCloud cloud = made(std::string("shape = box\nspacing = 1e-3\nsize = ") + size);
    EXPECT_EQ(cloud.size(), 96);
    for (const auto& [name, count] : set_sizes(cloud)) EXPECT_TRUE(count == 16 || count == 24) << size << " " << name;
  }
  const PointCloud flat = made("shape = box\nspacing = 1e-3\nsize = 97e-3 53e-3 1e-3");
  EXPECT_EQ(set_sizes(flat)["body_xmax"], 53);
  EXPECT_EQ(set_sizes(flat)["body_ymax"], 97);
}

TEST_F(MeshTool, ARecipeMayBeginWithAByteOrderMark) {
  EXPECT_EQ(made("\xef\xbb\xbfshape = box\nsize = 1 2 3\nspacing = 1\n").size(), 6);
}

TEST_F(MeshTool, SpheresAreTheSamePointsAsHexahedra) {
  for (const std::string shape : {"shape = cylinder\nmethod = fitted\nlength = 2\nradius = 1\nspacing = 0.3\n",
                                  "shape = cone\nlength = 2\nradius = 1\ntop_radius = 0.6\nspacing = 0.3\n",
                                  "shape = box\nsize = 1 2 3\nspacing = 0.4\norigin = 5 6 7\n"}) {
    const PointCloud hexahedra = made(shape);
    const PointCloud spheres = made(shape + "elements = sphere\n");
    ASSERT_EQ(hexahedra.size(), spheres.size());
    EXPECT_EQ(hexahedra.set_names, spheres.set_names);
    EXPECT_EQ(hexahedra.sets, spheres.sets);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      EXPECT_NEAR((hexahedra.positions[i] - spheres.positions[i]).norm(), 0, 1e-12);
      EXPECT_NEAR(hexahedra.volumes[i], spheres.volumes[i], 1e-12);
    }
  }
}

TEST_F(MeshTool, SeveralBodiesShareTheKeysBeforeThem) {
  const PointCloud cloud = made(
      "spacing = 1\nshape = box\n[body]\nname = plate\nsize = 4 4 1\nspacing = 0.5\n"
      "[body]\nname = block\nsize = 2 2 2\norigin = 1 1 1\nelements = sphere\n");
  EXPECT_EQ(cloud.block_names, (std::vector<std::string>{"plate", "block"}));
  EXPECT_EQ(cloud.size(), 8 * 8 * 2 + 8);
  EXPECT_NEAR(volume(cloud), 16 + 8, 1e-12);
  const std::map<std::string, int> sizes = set_sizes(cloud);
  EXPECT_EQ(sizes.size(), 12);
  EXPECT_EQ(sizes.count("foot"), 0);
  EXPECT_EQ(sizes.at("block_zmin"), 4);
}

// The faces of the layers, from the nodes.
std::vector<double> levels(const std::string& file) {
  std::vector<double> all;
  for (const Vector& node : io::read_mesh(file).nodes) all.push_back(node.z());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

TEST_F(MeshTool, GradedLayersGrowUpToTheCoarsestAndFillTheLength) {
  const std::string cylinder =
      "shape = cylinder\nmethod = fitted\nlength = 0.0324\nradius = 0.0032\nspacing = 0.35e-3\n";
  ASSERT_EQ(make(cylinder + "grading = 1.08\nuniform = 4e-3\ncoarsest = 0.5e-3\n").status, 0);
  const std::vector<double> z = levels(path("mesh.g"));
  EXPECT_EQ(z.front(), 0);
  EXPECT_EQ(z.back(), 0.0324);
  const auto layer = [&](std::size_t k) { return z[k + 1] - z[k]; };
  const double first = layer(0);
  EXPECT_NEAR(first, 0.35e-3, 0.01 * 0.35e-3);  // half a layer more or less of 69
  // 12 layers make 4.2 mm; then thicknesses grow by 1.08 until four steps have made 0.476 mm and a fifth would be more
  // than 0.5 mm.
  const double expected[] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1.08, 1.1664, 1.259712, 1.36048896, 0.5 / 0.35};
  for (std::size_t k = 0; k < std::size(expected); ++k) EXPECT_NEAR(layer(k) / first, expected[k], 1e-9) << k;
  for (std::size_t k = 16; k + 1 < z.size(); ++k) EXPECT_NEAR(layer(k) / first, 0.5 / 0.35, 1e-9) << k;
  // The section is that of the spacing: 16 cells across.
  EXPECT_EQ(points().size(), 16 * 16 * (z.size() - 1));
  EXPECT_NEAR(volume(points()), 0.0324 * 32 * 0.0032 * 0.0032 * std::sin(pi / 32), 1e-15);
}

// Three spacings along z are 3.015 roots of the volume of a cell 0.75 % too long.
TEST_F(MeshTool, CellsThatLoseNeighborsAtWholeSpacingsAreNoted) {
  const auto is_noted = [&](const std::string& size) {
    return make("shape = box\nsize = 4 4 " + size + "\nspacing = 1\n").text.find("loses neighbors") !=
           std::string::npos;
  };
  EXPECT_TRUE(is_noted("3.6"));
  EXPECT_TRUE(is_noted("4.035"));
  EXPECT_FALSE(is_noted("4.025"));
  EXPECT_FALSE(is_noted("4"));
}

TEST_F(MeshTool, GradedBoxHasTheSamePointsAsSpheres) {
  const std::string box = "shape = box\nsize = 2 2 9\nspacing = 1\ngrading = 1.5\n";
  const PointCloud hexahedra = made(box);
  EXPECT_EQ(levels(path("mesh.g")).size(), 5);  // 1, 1.5, 2.25, 3.375: 8.125 is nearer to 9 than 13.2
  const PointCloud spheres = made(box + "elements = sphere\n");
  ASSERT_EQ(hexahedra.size(), spheres.size());
  EXPECT_EQ(hexahedra.sets, spheres.sets);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    EXPECT_NEAR((hexahedra.positions[i] - spheres.positions[i]).norm(), 0, 1e-14);
    EXPECT_NEAR(hexahedra.volumes[i], spheres.volumes[i], 1e-14);
  }
}

// Volume and second moment of a cylinder about its axis come with the finer voxels, not with the cells.
TEST_F(MeshTool, CellsOfACylinderHaveItsSection) {
  for (const char* centred : {"corner", "point"}) {
    const std::string recipe = "shape = cylinder\nlength = 2\nradius = 1\nspacing = 0.25\norigin = 3 4 5\ncentred = ";
    ASSERT_EQ(make(recipe + centred + "\ncells = 12\n").status, 0);
    const io::Mesh mesh = io::read_mesh(path("mesh.g"));
    double volume = 0;
    Tensor second = Tensor::Zero();
    for (const io::PartialCell& cell : mesh.blocks[0].cells) {
      const Vector x = cell.centroid - Vector(3, 4, 6);
      volume += cell.volume;
      second += cell.volume * (to_tensor(cell.moments) + x * x.transpose());
    }
    // 48 voxels to a radius: lattice points in a disc miss its area by about a row of surface voxels of random sign.
    EXPECT_NEAR(volume, 2 * pi, 0.003 * 2 * pi);
    EXPECT_NEAR(second(0, 0), pi / 2, 0.006 * pi / 2);
    EXPECT_NEAR(second(0, 0), second(1, 1), 1e-12);
    EXPECT_NEAR(second(2, 2), volume / 3, 1e-12);
  }
}

TEST_F(MeshTool, CellsOfABoxAreItsHexahedra) {
  const std::string box = "shape = box\nsize = 1 2 3\nspacing = 0.5\norigin = 5 6 7\n";
  const PointCloud hexahedra = made(box);
  const PointCloud cells = made(box + "cells = 3\n");
  ASSERT_EQ(cells.size(), hexahedra.size());
  EXPECT_EQ(cells.set_names, hexahedra.set_names);
  EXPECT_EQ(cells.sets, hexahedra.sets);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_NEAR((cells.positions[i] - hexahedra.positions[i]).norm(), 0, 1e-13);
  }
}

TEST_F(MeshTool, GradingThatCannotBeIsRefused) {
  const std::string box = "shape = box\nsize = 1 1 1\nspacing = 0.1\n";
  const std::string lattice = "shape = cylinder\nlength = 1\nradius = 1\nspacing = 0.2\n";
  for (const auto& [recipe, expected] :
       {std::pair(box + "grading = 0.9\n", "line 4: grading is '0.9', expected a number from 1 to 2"),
        {box + "grading = 1.1\ncoarsest = 0.05\n", "line 5: coarsest is less than the spacing"},
        {box + "grading = 1.1\nuniform = 0\n", "line 5: uniform is '0', expected a length > 0"},
        {box + "uniform = 0.5\n", "line 4: a body without the key 'grading' has no key 'uniform'"},
        {lattice + "grading = 1.1\n", "line 5: a lattice cylinder has no key 'grading'"},
        {lattice + "method = fitted\ncells = 2\n", "line 6: a fitted cylinder has no key 'cells'"}}) {
    const testing::Outcome outcome = make(recipe);
    EXPECT_EQ(outcome.status, 1) << recipe;
    EXPECT_NE(outcome.text.find(expected), std::string::npos) << outcome.text;
  }
}

TEST_F(MeshTool, WrongRecipesAreRefusedWithTheirLines) {
  const testing::Outcome outcome =
      make("shape = cylindre\nspaceing = 1\nlength = -2\nspacing = 1\nsize = 1 2 3\nname = a b\n");
  EXPECT_EQ(outcome.status, 1);
  for (const char* expected :
       {"line 1: shape is 'cylindre', expected cylinder or cone or box or foam or lattice or file (did you mean "
        "'cylinder'?)",
        "line 2: unknown key 'spaceing' (did you mean 'spacing'?)", "line 3: length is '-2', expected a length > 0",
        "line 5: a lattice cylinder has no key 'size'", "line 6: name is 'a b', expected one word",
        "lacks the key 'radius'"}) {
    EXPECT_NE(outcome.text.find(expected), std::string::npos) << outcome.text;
  }
  EXPECT_FALSE(std::filesystem::exists(path("mesh.g")));
}

TEST_F(MeshTool, LengthsWhoseProductsAreNoNumbersAreRefused) {
  const testing::Outcome outcome = make("shape = box\nsize = 1e300 1e300 1e300\nspacing = 1e299\n");
  EXPECT_EQ(outcome.status, 1);
  for (const char* expected : {"line 2: size is '1e300 1e300 1e300', expected three lengths > 0 in m (1e-30 to 1e30)",
                               "line 3: spacing is '1e299', expected a length > 0 in m (1e-30 to 1e30)"}) {
    EXPECT_NE(outcome.text.find(expected), std::string::npos) << outcome.text;
  }
}

TEST_F(MeshTool, AFileOfAnotherKindIsRefusedInOneSentence) {
  std::string facets = "solid part\n";
  for (int n = 0; n < 1000; ++n) {
    facets += "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  }
  const std::string deck =
      "<ParameterList>\n  <ParameterList name=\"Solver\">\n    <Parameter name=\"Final Time\" value=\"1\"/>\n"
      "  </ParameterList>\n</ParameterList>\n";
  for (const std::string& text : {facets, deck, std::string("part\0\1\2\n", 8) + std::string(2000, '\0')}) {
    const testing::Outcome outcome = make(text);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text.substr(0, 1000);
    EXPECT_NE(outcome.text.find("mesh.recipe: it is no recipe"), std::string::npos) << outcome.text.substr(0, 1000);
  }
  std::string wrong = "shape = box\n";
  for (int n = 0; n < 100; ++n) wrong += "spacings = 1\n";
  const testing::Outcome outcome = make(wrong);
  EXPECT_NE(outcome.text.find("line 2: unknown key 'spacings' (did you mean 'spacing'?)"), std::string::npos);
  EXPECT_NE(outcome.text.find("others\n"), std::string::npos) << outcome.text;
  EXPECT_LT(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 40);
}

TEST_F(MeshTool, WrongConesAreRefused) {
  const std::string cone = "shape = cone\nlength = 1\nspacing = 0.1\nradius = 1\n";
  for (const auto& [recipe, expected] :
       {std::pair(cone, "lacks the key 'top_radius'"), std::pair(cone + "top_radius = 0\n", "expected a length > 0"),
        std::pair(cone + "top_radius = 1\nmethod = lattice\n", "line 6: a cone has only the method fitted"),
        std::pair(cone + "top_radius = 1\ncentred = point\n", "line 6: a cone has no key 'centred'"),
        std::pair("shape = cylinder\ntop_radius = 1\n" + cone.substr(cone.find("length")),
                  "line 2: a lattice cylinder has no key 'top_radius'")}) {
    const testing::Outcome outcome = make(recipe);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.text.find(expected), std::string::npos) << outcome.text;
  }
}

// The earlier mesh stays where the new one does not fit, and nothing of the new one does.
TEST_F(MeshTool, AMeshThatCannotBeWrittenCostsNoOther) {
  const auto make = [this](const std::string& before, int cells) {
    const std::string recipe = "shape = box\nspacing = 1\nsize = 9 9 " + std::to_string(cells) + "\n";
    return run(before + std::string(STRUT_MESH) + " " + write("mesh.recipe", recipe) + " " + path("mesh.g"));
  };
  const auto bytes = [this] {
    std::ifstream file(path("mesh.g"), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  ASSERT_EQ(make("", 1).status, 0);
  const std::string kept = bytes();
  EXPECT_EQ(make("ulimit -f 40; ", 60).status, 1);
  EXPECT_EQ(bytes(), kept);
  for (const auto& entry : std::filesystem::directory_iterator(path(""))) EXPECT_NE(entry.path().extension(), ".part");
  EXPECT_EQ(make("", 2).status, 0);
  EXPECT_NE(bytes(), kept);
}

// Each writes its own part: the mesh is that of the one which ends last.
TEST_F(MeshTool, TwoProgramsThatWriteOneMeshAtOnceDoNotMeet) {
  const std::string recipe = write("mesh.recipe", "shape = box\nspacing = 1\nsize = 9 9 500\n");
  const std::string one = std::string(STRUT_MESH) + " " + recipe + " " + path("mesh.g");
  const testing::Outcome both = run("(" + one + " & first=$!; " + one + " && wait $first)");
  EXPECT_EQ(both.status, 0) << both.text;
  EXPECT_TRUE(std::filesystem::exists(path("mesh.g")));
}

// A link stays one, and the mesh is where it leads, as for a mesh that is there.
TEST_F(MeshTool, ALinkToAMeshThatIsNotThereYetStays) {
  std::filesystem::create_symlink("there.g", path("mesh.g"));
  ASSERT_EQ(make("shape = box\nspacing = 1\nsize = 1 1 1\n").status, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(path("mesh.g")));
  EXPECT_TRUE(std::filesystem::is_regular_file(path("there.g")));
}

TEST_F(MeshTool, OtherErrorsEndWithStatusOne) {
  const std::string box = "shape = box\nsize = 1 1 1\nspacing = 0.5\n";
  for (const std::string& recipe :
       {box + "name = a\nname = b\n", box + "a line\n", box + "origin = 1 2\n", box + "name =\n", box + "radius = 1\n",
        std::string("[body]\n") + box + "[body]\n" + box, std::string("shape = box\nsize = 1 1 1\nspacing = 1e-4\n"),
        std::string("shape = cylinder\nlength = 1\nradius = 0.1\nspacing = 1\n"),
        std::string("shape = cylinder\nlength = 1e-9\nradius = 1\nspacing = 1e-2\n")}) {
    const testing::Outcome outcome = make(recipe);
    EXPECT_EQ(outcome.status, 1) << recipe;
    EXPECT_TRUE(outcome.text.starts_with("strut-mesh: ")) << outcome.text;
  }
  EXPECT_EQ(run(std::string(STRUT_MESH) + " /nowhere.recipe " + path("mesh.g")).status, 1);
  EXPECT_EQ(run(std::string(STRUT_MESH) + " " + write("box.recipe", box) + " /nowhere/mesh.g").status, 1);
  EXPECT_EQ(run(STRUT_MESH).status, 1);
}

}  // namespace
}  // namespace strut
