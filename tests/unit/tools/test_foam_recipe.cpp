// strut-mesh, shape = foam: density, one piece, seeds, node sets, symmetry, and what is refused.
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <set>

#include "base/parallel/communicator.hpp"
#include "io/exodus/exodus.hpp"
#include "tool.hpp"

namespace strut {
namespace {

using Cell = std::array<int, 3>;

constexpr int cells = 40;  // along each side
constexpr double spacing = 0.025;
const std::string cube = "shape = foam\nname = foam\nsize = 1 1 1\nspacing = 0.025\ncell = 0.45\n";

class FoamRecipe : public testing::ToolTest {
 protected:
  testing::Outcome make(const std::string& recipe) const {
    return run(std::string(STRUT_MESH) + " " + write("mesh.recipe", recipe) + " " + path("mesh.g"));
  }
  PointCloud made(const std::string& recipe) const {
    const testing::Outcome outcome = make(recipe);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    return io::read_exodus(path("mesh.g"), Communicator());
  }
};

Cell cell_of(const Vector& x) {
  Cell cell;
  for (int k = 0; k < 3; ++k) cell[k] = static_cast<int>(std::floor(x[k] / spacing));
  return cell;
}

std::set<Cell> cells_of(const PointCloud& cloud) {
  std::set<Cell> all;
  for (const Vector& x : cloud.positions) all.insert(cell_of(x));
  EXPECT_EQ(all.size(), cloud.size());
  return all;
}

std::size_t piece_of(const std::set<Cell>& all, const Cell& start) {
  std::set<Cell> found = {start};
  for (std::deque<Cell> open = {start}; !open.empty(); open.pop_front()) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Cell next = open.front();
        next[axis] += step;
        if (all.count(next) && found.insert(next).second) open.push_back(next);
      }
    }
  }
  return found.size();
}

TEST_F(FoamRecipe, HasTheDensityAndIsOnePiece) {
  for (const std::string irregularity : {"0.3", "1"}) {
    for (const double density : {0.08, 0.15, 0.3}) {
      const PointCloud cloud =
          made(cube + "irregularity = " + irregularity + "\nrelative_density = " + std::to_string(density) + "\n");
      const double wanted = density * std::pow(cells, 3);
      // Voxels join the piece one by one; only where a smaller piece gets connected come some at once. One layer of
      // voxels on all struts would be 2 h / r, about 60 %.
      EXPECT_GE(static_cast<double>(cloud.size()), std::floor(wanted));
      EXPECT_LE(static_cast<double>(cloud.size()), 1.005 * wanted);
      for (const double volume : cloud.volumes) ASSERT_NEAR(volume, std::pow(spacing, 3), 1e-12 * volume + 1e-17);
      const std::set<Cell> all = cells_of(cloud);
      EXPECT_EQ(piece_of(all, *all.begin()), all.size());
    }
  }
}

TEST_F(FoamRecipe, TheSeedDecides) {
  const std::string recipe = cube + "relative_density = 0.1\nseed = ";
  const PointCloud first = made(recipe + "5\n"), again = made(recipe + "5\n"), other = made(recipe + "6\n");
  EXPECT_EQ(first.positions, again.positions);
  EXPECT_NE(first.positions, other.positions);
  EXPECT_EQ(made(cube + "relative_density = 0.1\n").positions, made(recipe + "1\n").positions);
  // On every machine the same: this number is from x86-64 with fused multiply-add.
  std::uint64_t hash = 14695981039346656037u;
  for (const Vector& x : first.positions) {
    for (const int i : cell_of(x)) hash = (hash ^ static_cast<std::uint64_t>(i)) * 1099511628211u;
  }
  EXPECT_EQ(hash, 6821109294108882855u);
}

TEST_F(FoamRecipe, NodeSetsAreTheFacesOfTheBox) {
  const PointCloud cloud = made(cube + "relative_density = 0.12\n");
  std::map<std::string, std::set<Cell>> expected, found;
  for (const Cell& cell : cells_of(cloud)) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name = std::string("foam_") + "xyz"[axis];
      if (cell[axis] == 0) expected[name + "min"].insert(cell);
      if (cell[axis] == cells - 1) expected[name + "max"].insert(cell);
    }
  }
  expected["foot"] = expected.at("foam_zmin");
  expected["top"] = expected.at("foam_zmax");
  for (std::size_t k = 0; k < cloud.set_names.size(); ++k) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.sets[i] >> k & 1) found[cloud.set_names[k]].insert(cell_of(cloud.positions[i]));
    }
  }
  EXPECT_EQ(expected.size(), 8u);
  EXPECT_EQ(found, expected);
}

TEST_F(FoamRecipe, KelvinFoamHasCubicSymmetry) {
  const std::set<Cell> all = cells_of(made(cube + "irregularity = 0\nrelative_density = 0.1\n"));
  std::set<Cell> swapped, turned, mirrored;
  for (const auto& [i, j, k] : all) {
    swapped.insert({j, i, k});
    turned.insert({j, k, i});
    mirrored.insert({cells - 1 - i, j, k});
  }
  EXPECT_EQ(swapped, all);
  EXPECT_EQ(turned, all);
  EXPECT_EQ(mirrored, all);
  // Voxels at the same distance come together; more than 5 % too many would be refused.
  EXPECT_GE(all.size(), 6400u);
  EXPECT_LE(all.size(), 6720u);
  EXPECT_NE(cells_of(made(cube + "irregularity = 0.05\nrelative_density = 0.1\n")), all);
}

TEST_F(FoamRecipe, SpheresAreTheSamePointsAsHexahedra) {
  const std::string recipe =
      "shape = foam\nsize = 1 1.3 0.8\nspacing = 0.027\ncell = 0.4\nrelative_density = 0.15\n"
      "origin = 5 6 7\nelements = ";
  const PointCloud hexahedra = made(recipe + "hex\n"), spheres = made(recipe + "sphere\n");
  ASSERT_EQ(hexahedra.size(), spheres.size());
  EXPECT_EQ(hexahedra.set_names, spheres.set_names);
  EXPECT_EQ(hexahedra.sets, spheres.sets);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    EXPECT_NEAR((hexahedra.positions[i] - spheres.positions[i]).norm(), 0, 1e-14 * 10);  // rounding of the origin
    EXPECT_NEAR(hexahedra.volumes[i], spheres.volumes[i], 1e-11 * spheres.volumes[i]);   // of it over the spacing
    EXPECT_GT((spheres.positions[i] - Vector(5, 6, 7)).minCoeff(), 0);
    EXPECT_GT((Vector(6, 7.3, 7.8) - spheres.positions[i]).minCoeff(), 0);
  }
}

TEST_F(FoamRecipe, SaysWhatWasMade) {
  const std::string text = make(cube + "relative_density = 0.1\nirregularity = 0\n").text;
  for (const char* part : {"open-cell foam, irregularity 0", "of 40 x 40 x 40 voxels", "(asked for 0.1)", "cells",
                           "edges", "spacings = ", "other pieces", "stairs of whole voxels"}) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

// The foam of cells is the same body as that of voxels, and the same file again.
TEST_F(FoamRecipe, CellsHoldTheFinerVoxels) {
  const std::string recipe = "relative_density = 0.1\norigin = 2 3 4\n";
  const std::string fine = "shape = foam\nsize = 1 1 1\nspacing = 0.0125\ncell = 0.45\n";
  const PointCloud voxels = made(fine + recipe);
  const testing::Outcome outcome = make(cube + recipe + "cells = 2\n");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  for (const char* part : {"51200 voxels", "40 x 40 x 40 places", "merged into neighbors", "0 kept",
                           "dropped (0 % of the volume)", " cells thick: by quadratic correspondence expect up to ±"}) {
    EXPECT_NE(outcome.text.find(part), std::string::npos) << outcome.text;
  }
  EXPECT_EQ(outcome.text.find("stairs"), std::string::npos);
  const io::Mesh mesh = io::read_mesh(path("mesh.g"));
  ASSERT_EQ(mesh.blocks[0].cells.size(), mesh.blocks[0].elements());
  std::size_t small = 0;
  double volume = 0, expected = 0;
  Vector first = Vector::Zero(), expected_first = Vector::Zero();
  for (const io::PartialCell& cell : mesh.blocks[0].cells) {
    volume += cell.volume;
    first += cell.volume * cell.centroid;
    small += cell.volume < 0.3 * std::pow(spacing, 3) * (1 - 1e-12) ? 1 : 0;
  }
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    expected += voxels.volumes[i];
    expected_first += voxels.volumes[i] * voxels.positions[i];
  }
  EXPECT_LT(small, mesh.blocks[0].cells.size() / 200);  // halves of cells that were cut: 0.1 % were measured
  EXPECT_NEAR(volume, expected, 1e-9 * expected);       // 50,000 voxels by a Gauss sum of coordinates about 4
  EXPECT_LT((first - expected_first).norm(), 1e-9 * expected_first.norm());
  ASSERT_EQ(make(cube + recipe + "cells = 2\n").status, 0);
  const io::Mesh again = io::read_mesh(path("mesh.g"));
  EXPECT_EQ(again.nodes, mesh.nodes);
  EXPECT_EQ(again.blocks[0].nodes, mesh.blocks[0].nodes);
  for (std::size_t n = 0; n < again.blocks[0].cells.size(); ++n) {
    EXPECT_EQ(again.blocks[0].cells[n].moments, mesh.blocks[0].cells[n].moments);
  }
}

// A cell at a face of the box has its nodes there, in the sets that a hexahedron would be in.
TEST_F(FoamRecipe, CellsAtTheFacesAreInTheNodeSets) {
  ASSERT_EQ(make(cube + "relative_density = 0.12\ncells = 3\n").status, 0);
  const io::Mesh mesh = io::read_mesh(path("mesh.g"));
  for (const io::Mesh::NodeSet& set : mesh.node_sets) {
    if (!set.name.starts_with("foam_")) continue;
    const int axis = set.name[5] - 'x';
    const double face = set.name.ends_with("max") ? 1 : 0;
    std::set<int> expected;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      if (std::abs(mesh.nodes[n][axis] - face) < 1e-12) expected.insert(static_cast<int>(n));
    }
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(std::set<int>(set.nodes.begin(), set.nodes.end()), expected) << set.name;
  }
}

// By density to 0.1 %, with partly filled voxels; by the thickness what it says.
TEST_F(FoamRecipe, LatticesAreMadeByName) {
  for (const std::string name : {"octet", "kelvin", "gyroid", "diamond-sheet"}) {
    const std::string recipe = "shape = lattice\nname = body\ncount = 2 1 1\ncell = 0.5\nspacing = 0.025\ncells = 2\n";
    const testing::Outcome outcome = make(recipe + "relative_density = 0.2\nlattice = " + name + "\n");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    double volume = 0;
    for (const io::PartialCell& cell : io::read_mesh(path("mesh.g")).blocks[0].cells) volume += cell.volume;
    EXPECT_NEAR(volume / (0.2 * 0.25), 1, 1e-3) << outcome.text;
  }
  const testing::Outcome thick = make(
      "shape = lattice\nlattice = bcc\nsize = 1 1 1\ncell = 0.5\nspacing = 0.025\nthickness = 0.1\nperiodic = x y z\n");
  EXPECT_NE(thick.text.find("4 voxels = 0.1 m thick"), std::string::npos) << thick.text;
  EXPECT_NE(thick.text.find("8 struts a cell"), std::string::npos);
}

TEST_F(FoamRecipe, WrongRecipesAreRefused) {
  const std::string density = "relative_density = 0.1\n";
  const std::string lattice = "shape = lattice\ncount = 1\ncell = 1\nspacing = 0.05\nlattice = ";
  const std::pair<std::string, const char*> wrong[] = {
      {cube, "lacks the key 'relative_density'"},
      {cube + "relative_density = 10 %\n", "line 6: relative_density is '10 %', expected a number between 0 and 1"},
      {cube + "relative_density = 1\n", "expected a number between 0 and 1"},
      {cube + density + "irregularity = 1.5\n", "line 7: irregularity is '1.5', expected a number from 0 to 1"},
      {cube + density + "seed = -1\n", "line 7: '-1' is not a whole number"},
      {cube + density + "radius = 1\n", "line 7: a foam has no key 'radius'"},
      {cube + density + "method = fitted\n", "a foam has only the method lattice"},
      {cube + density + "cells = 1\n", "line 7: cells is '1', expected a whole number from 2 to 16"},
      {cube + density + "cells = 2.5\n", "line 7: cells is '2.5', expected a whole number from 2 to 16"},
      {cube + density + "cells = 17\n", "line 7: cells is '17'"},
      {cube + density + "smallest_cell = 0.2\n", "line 7: a body without the key 'cells' has no key 'smallest_cell'"},
      {cube + density + "cells = 2\nsmallest_cell = 1\n",
       "line 8: smallest_cell is '1', expected a number from 0 to 0.9"},
      {cube + density + "cells = 2\nelements = sphere\n", "line 7: a body of spheres has no key 'cells'"},
      {"shape = box\nsize = 1 1 1\nspacing = 0.1\ngrading = 1.1\ncells = 2\n",
       "line 4: cells that gather voxels are all alike"},
      {cube + density + "cel = 1\n", "did you mean 'cell'?"},
      {"shape = box\nsize = 1 1 1\nspacing = 0.1\ncell = 1\n", "line 4: a box has no key 'cell'"},
      {"shape = foam\nsize = 1 1 1\nspacing = 0.1\ncell = 0.3\n" + density, "fewer than 4 spacings"},
      {"shape = foam\nsize = 1 1 0.3\nspacing = 0.01\ncell = 0.4\n" + density, "the box is smaller than a cell"},
      {"shape = foam\nsize = 1 1 1\nspacing = 0.05\ncell = 0.4\nrelative_density = 0.01\n", "take a smaller spacing"},
      {"shape = foam\nsize = 1 1 1\nspacing = 1e-4\ncell = 0.4\n" + density, "more than 10⁸ cells"},
      {"shape = foam\nsize = 1 1 1\nspacing = 2e-3\ncells = 3\ncell = 0.4\n" + density, "more than 10⁹ voxels"},
      {cube + density + "sizes = 2\n", "line 7: sizes is '2', expected a number from 0 to 0.6"},
      {cube + density + "relax = 1.5\n", "expected a whole number from 0 to 1000"},
      {cube + density + "stretch = 1 1 9\n", "expected three numbers from 0.2 to 5"},
      {cube + density + "section = square\n", "section is 'square', expected round or three-cornered"},
      {cube + density + "thickness = 0.1\n", "a foam has no key 'thickness'"},
      {cube + density + "periodic = xy\n", "expected axes: x, y, z, with blanks between"},
      {lattice + "octett\n" + density, "lattice is 'octett', expected octet or bcc"},
      {lattice + "octet\n", "lacks the key 'relative_density'"},
      {lattice + "octet\nthickness = 0.1\n" + density, "thickness and relative_density exclude each other"},
      {lattice + "gyroid\nthickness = 0.1\n", "has no thickness"},
      {lattice + "bcc\nsize = 1 1 1\n" + density, "count and size exclude each other"},
      {lattice + "bcc\nseed = 2\n" + density, "a lattice has no key 'seed'"},
      {"shape = lattice\nlattice = bcc\nsize = 1.7 1 1\ncell = 1\nspacing = 0.05\nperiodic = x\n" + density,
       "periodic along x, but 1.7 cells of 1 m"},
      {"shape = lattice\nlattice = octet\nsize = 1 1 1\ncell = 1\nspacing = 0.1\nrelative_density = 0.3\n",
       "many voxels are equally far from the edges and come together"},
      {"shape = lattice\nlattice = diamond\ncount = 2\ncell = 1\nspacing = 0.05\nrelative_density = 0.2\n",
       "come together; in one piece they have 1.11 times the density"}};
  for (const auto& [recipe, part] : wrong) {
    const testing::Outcome outcome = make(recipe);
    EXPECT_EQ(outcome.status, 1) << recipe;
    EXPECT_NE(outcome.text.find(part), std::string::npos) << "expected '" << part << "' in " << outcome.text;
    EXPECT_FALSE(std::filesystem::exists(path("mesh.g")));
  }
}

}  // namespace
}  // namespace strut
