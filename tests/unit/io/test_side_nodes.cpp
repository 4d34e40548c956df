// Shared nodes on periodic sides, where a mesh may have several at one place: those of the body that goes on.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <random>
#include <set>

#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "base/union_find.hpp"
#include "bricks.hpp"

namespace strut::io {
namespace {

constexpr int period = 3;  // cubes of 1 m, along x, y and z

std::vector<Mirror> sides(const std::vector<int>& axes) {
  std::vector<Mirror> all;
  for (const int axis : axes) {
    const Vector along = Vector::Unit(axis);
    all.push_back({.on = Vector::Zero(), .normal = along, .bit = axis, .period = period});
    all.push_back({.on = period * along, .normal = -along, .bit = axis, .period = period});
  }
  return all;
}

// The shared nodes of all elements, on rank 0.
std::vector<std::set<std::int64_t>> nodes_of(const Mesh& mesh, const std::vector<Mirror>& planes,
                                             const Communicator& world) {
  struct Shared {
    std::int64_t element, node;
  };
  const PointCloud cloud = points_of(mesh, world, PointsAt::elements, true, planes);
  std::vector<Shared> mine;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (const std::int64_t node : cloud.shared_nodes[i])
      mine.push_back({cloud.ids[i], node & ((std::int64_t{1} << first_plane_bit) - 1)});
  }
  std::vector<std::set<std::int64_t>> all(mesh.blocks[0].elements());
  for (const Shared& one : gather(world, std::span<const Shared>(mine))) all[one.element].insert(one.node);
  return all;
}

std::ptrdiff_t common(const std::set<std::int64_t>& some, const std::set<std::int64_t>& others) {
  return std::ranges::count_if(some, [&](std::int64_t node) { return others.contains(node); });
}

// ---- Cracks --------------------------------------------------------------------------------------------------------

using Place = Eigen::Array3i;
using Cut = std::function<bool(const Place& cube, int axis)>;  // of the cube's upper face

// n × n × n cubes. Around an edge or corner those have a node in common that are connected by faces without a cut.
Mesh cubes(int n, const Cut& is_cut) {
  const Place corners[8] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const auto place = [n](int cube) { return Place(cube % n, cube / n % n, cube / n / n); };
  const int stride[] = {1, n, n * n}, count = n * n * n;
  UnionFind joined(8 * static_cast<std::size_t>(count));
  for (int cube = 0; cube < count; ++cube) {
    for (int axis = 0; axis < 3; ++axis) {
      if (place(cube)[axis] == n - 1 || is_cut(place(cube), axis)) continue;
      for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 8; ++b) {
          const Place apart = corners[a] - corners[b];
          if (apart[axis] == 1 && apart.abs().sum() == 1) joined.join(8 * cube + a, 8 * (cube + stride[axis]) + b);
        }
      }
    }
  }
  Mesh mesh;
  Mesh::Block block{"cubes", "HEX8", {}, {}};
  std::vector<int> numbers(8 * static_cast<std::size_t>(count), -1);
  for (int k = 0; k < 8 * count; ++k) {
    int& number = numbers[joined.first(k)];
    if (number < 0) {
      number = static_cast<int>(mesh.nodes.size());
      mesh.nodes.emplace_back((place(k / 8) + corners[k % 8]).cast<double>());
    }
    block.nodes.push_back(number);
  }
  mesh.blocks.push_back(block);
  return mesh;
}

using Division = std::vector<std::array<int, 4>>;
const Division whole, six{{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}},
    five{{0, 1, 3, 4}, {1, 2, 3, 6}, {1, 4, 5, 6}, {3, 4, 6, 7}, {1, 3, 4, 6}};  // other diagonals on opposite faces

Mesh divided(Mesh mesh, const Division& division) {
  if (division.empty()) return mesh;
  std::vector<int> nodes;
  for (std::size_t e = 0; e < mesh.blocks[0].elements(); ++e) {
    for (const auto& corners : division) {
      for (const int corner : corners) nodes.push_back(mesh.blocks[0].nodes[8 * e + corner]);
    }
  }
  mesh.blocks[0] = {"tetrahedra", "TET4", nodes, {}};
  return mesh;
}

// Two elements of a period have as many nodes in common as wherever they are nearest in two periods along each axis.
TEST(SideNodes, AreThoseOfTheBodyThatGoesOnBesideRandomCracks) {
  const Communicator world;
  std::mt19937 random(5);
  for (const Division& division : {whole, whole, six, five}) {
    std::set<std::array<int, 4>> cuts;
    std::bernoulli_distribution is_cut(0.4);
    for (int n = 0; n < 3 * period * period * period; ++n) {
      const std::array<int, 4> face{n % 3, n / 3 % period, n / 3 / period % period, n / 3 / period / period};
      if (face[1 + face[0]] < period - 1 && is_cut(random)) cuts.insert(face);
    }
    const auto cut = [&](const Place& cube, int axis) {
      return cuts.contains({axis, cube[0] % period, cube[1] % period, cube[2] % period});
    };
    const auto found = nodes_of(divided(cubes(period, cut), division), sides({0, 1, 2}), world);
    const auto longer = nodes_of(divided(cubes(2 * period, cut), division), {}, world);
    if (world.rank() > 0) continue;
    const int parts = std::max(1, static_cast<int>(division.size()));
    const auto in_longer = [&](int element, int copy) {
      const int cube = element / parts, n = 2 * period;
      const Place at(cube % period, cube / period % period, cube / period / period);
      const Place there = at + period * Place(copy % 2, copy / 2 % 2, copy / 4);
      return longer[parts * ((there[2] * n + there[1]) * n + there[0]) + element % parts];
    };
    for (int a = 0; a < std::ssize(found); ++a) {
      for (int b = 0; b < a; ++b) {
        std::ptrdiff_t expected = 0;
        for (int copy = 0; copy < 64; ++copy)
          expected = std::max(expected, common(in_longer(a, copy % 8), in_longer(b, copy / 8)));
        EXPECT_EQ(common(found[a], found[b]), expected) << a << " " << b << " of " << found.size();
      }
    }
  }
}

// ---- Parts of cells ------------------------------------------------------------------------------------------------

// A strut in a cube: the middle of its sections along x at half the height, and half its width, in m; its slope along
// z.
struct Strut {
  double middle, half, slope = 0;
};

// A column of 1 × 3 × 3 cubes, with a strut in each, twice; without the second one in the upper layer if `ends`.
// Elements are numbered by struts, layers, and along y. The struts of the upper layer are others.
Mesh struts(const std::array<Strut, 2>& below, const std::array<Strut, 2>& upper, bool ends = false) {
  const std::vector<double> grid{0, 1, 2, 3};
  const Mesh one = bricks({0, 1}, grid, grid);
  Mesh mesh;
  Mesh::Block block{"struts", "HEX8", {}, {}};
  for (const int strut : {0, 1}) {
    for (int e = 0; e < (strut == 1 && ends ? 6 : 9); ++e) {
      const auto& [middle, half, slope] = (e < 6 ? below : upper)[strut];
      for (int n = 0; n < 8; ++n)
        block.nodes.push_back(one.blocks[0].nodes[8 * e + n] + strut * static_cast<int>(one.nodes.size()));
      PartialCell& cell = block.cells.emplace_back();
      cell.volume = 2 * half, cell.centroid = {middle, e % 3 + 0.5, e / 3 + 0.5};
      cell.moments << (4 * half * half + slope * slope) / 12, 1. / 12, 1. / 12, 0, 0, slope / 12;
    }
    mesh.nodes.insert(mesh.nodes.end(), one.nodes.begin(), one.nodes.end());
  }
  mesh.blocks.push_back(block);
  return mesh;
}

TEST(SideNodes, AreOneWhereTheMaterialOfPartlyFilledCellsMeets) {
  const Communicator world;
  struct Case {
    std::array<Strut, 2> below, upper;
  };
  const std::array<Strut, 2> slit{Strut{0.2, 0.2}, {0.75, 0.25}};
  const Case cases[] = {
      {slit, slit},
      {{{{0.2, 0.05}, {0.8, 0.05}}}, {{{0.35, 0.05}, {0.65, 0.05}}}},                            // they miss each other
      {{{{0.48, 0.04, 0.36}, {0.88, 0.04, 0.36}}}, {{{0.12, 0.04, 0.36}, {0.52, 0.04, 0.36}}}},  // at 0.3 and 0.7
  };
  for (const auto& [below, upper] : cases) {
    const auto nodes = nodes_of(struts(below, upper), sides({1, 2}), world);
    if (world.rank() > 0) continue;
    const int lowest = 1, highest = 7, other = 9;  // in the middle along y
    EXPECT_EQ(common(nodes[lowest], nodes[highest]), 4);
    EXPECT_EQ(common(nodes[other + lowest], nodes[other + highest]), 4);
    EXPECT_EQ(common(nodes[lowest], nodes[other + highest]), 0);
    EXPECT_EQ(common(nodes[other + lowest], nodes[highest]), 0);
    EXPECT_EQ(common(nodes[0], nodes[2]), 4) << "the sides along y";
    EXPECT_EQ(common(nodes[0], nodes[8]), 2) << "both";
    EXPECT_EQ(common(nodes[0], nodes[other + 8]), 0);
  }
  const auto nodes = nodes_of(struts(slit, {Strut{0.5, 0.5}}, true), sides({1, 2}), world);
  if (world.rank() > 0) return;
  for (const int lowest : {1, 10}) EXPECT_EQ(common(nodes[lowest], nodes[7]), 4) << "a slit that ends at the side";
  EXPECT_EQ(common(nodes[1], nodes[10]), 4);
  EXPECT_EQ(common(nodes[4], nodes[13]), 0);
}

}  // namespace
}  // namespace strut::io
