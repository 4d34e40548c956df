// Lattices by name, sections of struts, and skeletons of foams with cells of many sizes, stretched, relaxed, periodic.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "mesh/cells.hpp"
#include "mesh/lattices.hpp"

namespace strut::mesh {
namespace {

constexpr double pi = std::numbers::pi;

// No plane of symmetry of a lattice has a fixed place among these voxels.
const VoxelGrid uneven{{1, 1, 1}, {127, 118, 109}};

VoxelGrid cube(int cells, double edge = 1) { return {Vector::Constant(edge), Eigen::Array3i::Constant(cells)}; }

double part_of(const std::vector<Level>& levels, double most, const VoxelGrid& grid) {
  double count = 0;
  for (const Level& level : levels) count += level.value <= most ? 1 : 0;
  return count / static_cast<double>(grid.count());
}

// Struts a cell and their length in cells: octet 24 of 1/√2, face diagonals 12 of 1/√2, body diagonals 8 of √3/2, two
// truncated octahedra with 36 edges of √2/4, each shared by three.
TEST(Lattices, HaveTheStrutsOfTheirCells) {
  const std::map<std::string, std::pair<int, double>> expected = {{"octet", {24, std::sqrt(0.5)}},
                                                                  {"fcc", {12, std::sqrt(0.5)}},
                                                                  {"bcc", {8, std::sqrt(0.75)}},
                                                                  {"kelvin", {24, std::sqrt(0.125)}}};
  for (const auto& [name, struts] : expected) {
    const std::vector<Edge> cell = lattice_cell(name);
    EXPECT_EQ(static_cast<int>(cell.size()), struts.first) << name;
    for (const Edge& edge : cell) EXPECT_NEAR((edge.b - edge.a).norm(), struts.second, 1e-15) << name;
  }
}

TEST(Lattices, FourStrutsMeetAtEachVertexOfKelvinsFoamAndTwelveAtEachOfTheOctet) {
  for (const auto& [name, meeting] : std::map<std::string, int>{{"kelvin", 4}, {"octet", 12}, {"bcc", 8}}) {
    std::map<std::array<long, 3>, int> ends;
    for (const Edge& edge : lattice_edges(name, Vector::Ones(), 1)) {
      for (const Vector& x : {edge.a, edge.b}) {
        if ((x.array() >= 0).all() && (x.array() < 1).all())
          ++ends[{std::lround(4 * x[0]), std::lround(4 * x[1]), std::lround(4 * x[2])}];
      }
    }
    for (const auto& [place, count] : ends) EXPECT_EQ(count, name == "bcc" && place[0] == 2 ? 8 : meeting) << name;
  }
}

// Slender struts have the density Σ length π r²; what they share at nodes is of the order r/L less (here up to 0.14).
TEST(Lattices, HaveTheDensityOfSlenderStruts) {
  for (const auto& [name, of_all] : std::map<std::string, double>{{"octet", 12 * std::sqrt(2)},
                                                                  {"fcc", 6 * std::sqrt(2)},
                                                                  {"bcc", 4 * std::sqrt(3)},
                                                                  {"kelvin", 6 * std::sqrt(2)}}) {
    double length = 0;
    for (const Edge& edge : lattice_cell(name)) length += (edge.b - edge.a).norm();
    EXPECT_NEAR(length, of_all, 1e-12);
    const double r = 0.025;
    const std::vector<Level> levels = strut_levels(lattice_edges(name, Vector::Ones(), 1), {}, uneven, 2 * r);
    const double slender = part_of(levels, r, uneven) / (length * pi * r * r);
    EXPECT_LT(slender, 1.02) << name;  // sections of 30 voxels: 1 to 2 % were measured
    EXPECT_GT(slender, 0.86) << name;
    EXPECT_LT(part_of(levels, 2 * r, uneven) / (length * pi * 4 * r * r), slender) << name;
  }
}

// A sheet of the thickness t around a minimal surface has the volume S t + 2π χ t³/12 in each cell (Weyl's tube). Areas
// S of the gyroid and of Schwarz' D in cubes that hold two and four primitive cells of genus 3 (χ = −4): Schoen 1970.
TEST(Lattices, SheetsHaveTheVolumeOfTheMinimalSurface) {
  const VoxelGrid& grid = uneven;
  struct Known {
    double area, chi;
  };
  for (const auto& [name, known] :
       std::map<std::string, Known>{{"gyroid-sheet", {3.0915, -8}}, {"diamond-sheet", {3.8378, -16}}}) {
    const double t = 0.03;
    const double expected = known.area * t + 2 * pi * known.chi * t * t * t / 12;
    // Level sets of cosines are nearly minimal (areas 0.2 % larger); f/|∇f| is the distance in first order, off by (2π
    // t)²/12.
    EXPECT_NEAR(part_of(field_levels(surface_field(name, 1), grid), t / 2, grid), expected, 0.01 * expected) << name;
  }
}

// The two sides of these surfaces are alike.
TEST(Lattices, SolidsOnOneSideFillHalfAtZero) {
  const VoxelGrid grid = cube(64);
  for (const std::string name : {"gyroid", "diamond"}) {
    EXPECT_NEAR(part_of(field_levels(surface_field(name, 1), grid), 0, grid), 0.5, 2e-3) << name;  // voxels on it
  }
}

// Voxels at one level come together: filled in part, they give exactly the wanted volume, and the symmetry stays.
TEST(Lattices, CellsHaveExactlyTheWantedDensity) {
  const VoxelGrid grid = cube(48);
  for (const std::string name : {"octet", "kelvin"}) {
    for (const std::size_t wanted : {11000u, 17001u}) {
      const Struts struts = struts_around(lattice_edges(name, Vector::Ones(), 1), grid, wanted);
      double volume = 0;
      for (const double fill : struts.fills) volume += fill;
      if (struts.fills.empty()) volume = static_cast<double>(struts.voxels.size());
      EXPECT_NEAR(volume, static_cast<double>(wanted), 1e-6) << name;
      const Cells cells = gathered(struts.voxels, struts.fills, grid, {3, 0.3});
      EXPECT_NEAR(cells.volume(), volume / static_cast<double>(grid.count()), 1e-9) << name;
    }
  }
}

// ---- Sections ------------------------------------------------------------------------------------------------------

// One edge through the box, three films at 120°: the section of the level r has the area π r², whatever its form.
TEST(StrutShape, ThreeCorneredSectionsHaveTheAreaOfTheirCircle) {
  const VoxelGrid grid{{64, 64, 4}, {256, 256, 4}};
  Edge edge{{32, 32, -100}, {32, 32, 104}};
  for (int n = 0; n < 3; ++n) edge.films[n] = {std::cos(2 * pi * n / 3), std::sin(2 * pi * n / 3), 0};
  const double r = 6;
  const StrutShape shape{.three_cornered = true};
  const std::vector<Level> levels = strut_levels({edge}, shape, grid, r);
  EXPECT_NEAR(part_of(levels, r, grid) * 64 * 64, pi * r * r, 0.02 * pi * r * r);  // 1800 voxels, thin corners
  // Arcs of the radius R with (√3 − π/2) R² = π r²: corners R/√3 into the films, sides (2/√3 − 1) R from the middle.
  const double R = r * std::sqrt(pi / (std::sqrt(3.0) - pi / 2));
  double corner = 0, side = HUGE_VAL;
  std::set<int> solid;
  for (const Level& level : levels) solid.insert(level.voxel);
  for (int i = 0; i < 256; ++i) {
    const double x = 0.25 * (i + 0.5) - 32;
    const bool in = solid.contains(grid.index(i, 128, 0));
    if (in) corner = std::max(corner, x);
    if (!in && x < 0) side = std::min(side, -x);
  }
  EXPECT_NEAR(side, (2 / std::sqrt(3.0) - 1) * R, 0.3);  // a voxel
  // The corner is a cusp of the half width s²/2R at the distance s: it ends for voxels half an edge beside its plane.
  EXPECT_NEAR(corner, R / std::sqrt(3.0) - std::sqrt(2 * R * 0.125), 0.25);
}

// Areas 1 + x² + 96 x⁴ (Gong et al. 2005) have 7.25 at the ends and the mean 2.28.
TEST(StrutShape, GrowsToItsNodesAsMeasured) {
  const StrutShape shape{.node = std::sqrt(7.25)};
  double mean = 0;
  for (int n = 0; n < 1000; ++n) mean += std::pow(shape.width((n + 0.5) / 1000), 2) / 1000;
  EXPECT_DOUBLE_EQ(shape.width(0.5), 1);
  EXPECT_NEAR(shape.width(1), shape.node, 1e-12);
  EXPECT_NEAR(mean, 1 + 1.0 / 12 + 96.0 / 80, 1e-4);  // midpoint rule
  for (const double x : {0.1, 0.3, 0.45}) {
    EXPECT_NEAR(std::pow(shape.width(0.5 + x), 2), 1 + x * x + 96 * x * x * x * x, 1e-9);
  }
}

// ---- Foams ---------------------------------------------------------------------------------------------------------

std::size_t crossings(const std::vector<Edge>& edges, int axis, double place) {
  std::size_t count = 0;
  for (const Edge& edge : edges) {
    const Vector middle = edge.a + (place - edge.a[axis]) / (edge.b[axis] - edge.a[axis]) * (edge.b - edge.a);
    bool within = (edge.a[axis] < place) != (edge.b[axis] < place);
    for (int c = 0; c < 3; ++c) within = within && (c == axis || (middle[c] >= 0 && middle[c] <= 1));
    count += within ? 1 : 0;
  }
  return count;
}

TEST(Foam, SpheresOfManySizesScatterTheVolumesAndLloydEvensThemOut) {
  const Vector size = Vector::Ones();
  FoamSeeds seeds{.cell = 0.14, .irregularity = 1, .periodic = true};
  const double alike = foam_skeleton(size, seeds).scatter;
  seeds.sizes = 0.3;
  const double polydisperse = foam_skeleton(size, seeds).scatter;
  seeds.sizes = 0, seeds.relax = 20;
  const double relaxed = foam_skeleton(size, seeds).scatter;
  EXPECT_GT(polydisperse, 2 * alike);
  EXPECT_LT(relaxed, 0.6 * alike);
  EXPECT_EQ(foam_skeleton(size, {.cell = 0.14, .irregularity = 0, .periodic = true}).scatter < 1e-6, true);
}

// Seven eighths of the cells in a period would have another number: the box holds whole cells, 12 · 36/3/12 edges each.
TEST(Foam, GoesOnBehindASideAsBehindTheOther) {
  const Vector size(1, 1.2, 0.9);
  const Skeleton foam =
      foam_skeleton(size, {.cell = 0.3, .irregularity = 1, .seed = 5, .sizes = 0.2, .relax = 3, .periodic = true});
  const VoxelGrid grid{size, {40, 48, 36}};
  const VoxelGrid shifted{size, {40, 48, 36}};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Edge> moved = foam.edges;
    const Vector by = 0.5 * size[axis] * Vector::Unit(axis);
    for (Edge& edge : moved) edge.a -= by, edge.b -= by;
    std::map<int, double> here, there;
    for (const Level& level : strut_levels(foam.edges, {}, grid, 0.03)) here[level.voxel] = level.value;
    for (const Level& level : strut_levels(moved, {}, shifted, 0.03)) there[level.voxel] = level.value;
    // The lower half of the moved box is the upper one of the other.
    int compared = 0;
    for (const auto& [voxel, value] : there) {
      Eigen::Array3i at = grid.cell(voxel);
      if (2 * at[axis] >= grid.cells[axis]) continue;
      at[axis] += grid.cells[axis] / 2;
      const auto same = here.find(grid.index(at[0], at[1], at[2]));
      ASSERT_NE(same, here.end());
      EXPECT_NEAR(same->second, value, 1e-9);
      ++compared;
    }
    EXPECT_GT(compared, 500);
    // Edges leave through one side where others come in through the opposite one.
    std::multiset<std::pair<long, long>> lower, upper;
    for (const Edge& edge : foam.edges) {
      for (const auto& [place, into] : {std::pair{0.0, &lower}, std::pair{size[axis], &upper}}) {
        if ((edge.a[axis] < place) == (edge.b[axis] < place)) continue;
        const Vector x = edge.a + (place - edge.a[axis]) / (edge.b[axis] - edge.a[axis]) * (edge.b - edge.a);
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        if (x[u] < 0 || x[u] > size[u] || x[v] < 0 || x[v] > size[v]) continue;
        into->insert({std::lround(1e6 * x[u]), std::lround(1e6 * x[v])});
      }
    }
    EXPECT_EQ(lower, upper);
    EXPECT_GT(lower.size(), 10u);
  }
}

// The counts of edges through unit areas across x and z are as the mean intercepts of cells along z and x. About 1000
// edges a plane, five planes each.
TEST(Foam, StretchedCellsHaveLongerIntercepts) {
  const double stretch = 1.5;
  const Skeleton foam =
      foam_skeleton(Vector::Ones(), {.cell = 0.1, .irregularity = 1, .stretch = Vector(1, 1, stretch)});
  double across_x = 0, across_z = 0;
  for (const double place : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    across_x += static_cast<double>(crossings(foam.edges, 0, place));
    across_z += static_cast<double>(crossings(foam.edges, 2, place));
  }
  EXPECT_NEAR(across_z / across_x, stretch, 4 * stretch * std::sqrt(1 / across_x + 1 / across_z));
}

TEST(Foam, APeriodStretchesCellsToAWholeNumber) {
  // Cubes of a lattice of some 1/4: four along each axis; stretched, 3.05 along z, so three, and 4.6, so five, across.
  const double cell = 0.25 * 2 * std::cbrt(3 / std::numbers::pi) / 2;
  const auto stretch_of = [&](double wanted) {
    return foam_skeleton(Vector::Ones(), {.cell = cell, .stretch = Vector(1, 1, wanted), .periodic = true}).stretch;
  };
  EXPECT_LT((stretch_of(1.1) - Vector::Ones()).norm(), 1e-14);
  const Vector stretch = stretch_of(1.5);
  EXPECT_NEAR(stretch[2] / stretch[0], 5.0 / 3, 1e-14);
  EXPECT_NEAR(stretch.prod(), 1, 1e-14);
}

// A strut through the sides of a box that repeats has no surface there.
TEST(Foam, CellsAtPeriodicSidesHaveNoSurfaceThere) {
  VoxelGrid grid{{1, 1, 1}, {24, 24, 24}, {true, true, true}};
  const Struts struts = struts_around({{{0.5, 0.5, -1}, {0.5, 0.5, 2}}}, grid, 24 * 60);
  const Cells cells = gathered(struts.voxels, struts.fills, grid, {4, 0.3});
  Vector surface = Vector::Zero();
  double along = 0;
  for (const io::PartialCell& part : cells.parts) {
    surface += part.surface;
    along += part.surface_moments(2, 2);
  }
  EXPECT_LT(surface.norm(), 1e-12);
  EXPECT_NEAR(along, 0, 1e-12);
  EXPECT_EQ(struts.dropped_pieces, 0u);
  grid.periodic = {};
  double cut = 0;
  for (const io::PartialCell& part : gathered(struts.voxels, struts.fills, grid, {4, 0.3}).parts) {
    cut += part.surface_moments(2, 2);
  }
  EXPECT_GT(cut, 0.01);  // ∫ n z dA relative to the cells' middles: half a cell at either end
}

}  // namespace
}  // namespace strut::mesh
