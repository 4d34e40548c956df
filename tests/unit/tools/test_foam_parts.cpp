// The parts of a foam recipe: the skeleton of Kelvin's foam and of a random one, struts around single edges.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "mesh/tessellation.hpp"
#include "mesh/voxels.hpp"

namespace strut::mesh {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Skeleton, KelvinFoamHasTheEdgesOfTruncatedOctahedra) {
  // Two cells in a cube of the lattice constant a, 12 edges of the length a √2 / 4 each (36, shared by three). A box of
  // 3³ cubes about a seed ends in mirror planes: they cut no edge, and hold four in each of their 6 · 9 squares, of
  // which the box would own halves. It is a little smaller, so that these lie outside.
  const double cell = 0.4e-3;
  const double a = cell * std::cbrt(pi / 3);
  const double gap = 1e-6 * a;
  const Vector size = Vector::Constant(3 * a - 2 * gap);
  const Skeleton skeleton = foam_skeleton(size, {cell, 0, 1});
  double length = 0;
  int edges = 0;
  for (const Edge& edge : skeleton.edges) {
    const double part = length_within(edge, size);
    length += part;
    edges += part > 0 ? 1 : 0;
    EXPECT_NEAR((edge.b - edge.a).norm(), a * std::sqrt(2) / 4, part > 0 ? 1e-9 * a : INFINITY);
  }
  const int expected = 24 * 27 - 6 * 9 * 4 / 2;
  EXPECT_EQ(edges, expected);
  // One edge ends at each corner of a square, at 45° to the wall, and lacks what the box is smaller by.
  const double missing = 6 * 9 * 4 * gap * std::sqrt(2);
  EXPECT_NEAR(length + missing, expected * a * std::sqrt(2) / 4, 1e-9 * length);  // voro++: 1e-11 a vertex
  EXPECT_EQ(skeleton.cells, 27u + 8);  // seeds at the corners of cubes lie outside
}

TEST(Skeleton, FourStrutsMeetAtEveryVertex) {
  const Vector size(1, 1.5, 1.2);
  const double cell = 0.3;
  for (const double irregularity : {0.1, 0.5, 1.0}) {
    std::map<std::array<long, 3>, int> contact_pair;
    for (const Edge& edge : foam_skeleton(size, {cell, irregularity, 7}).edges) {
      for (const Vector& x : {edge.a, edge.b}) {
        if ((x.array() < 0).any() || (x.array() > size.array()).any()) continue;
        const Vector place = x / (1e-7 * cell);  // ends of edges from different cells differ by rounding only
        ++contact_pair[{std::lround(place[0]), std::lround(place[1]), std::lround(place[2])}];
      }
    }
    // 12 edges a cell, two ends each, four at a vertex: 6 a cell in Kelvin's foam, more in a random one (6.77).
    const double cells = size.prod() / (pi / 6 * std::pow(cell, 3));
    EXPECT_GT(contact_pair.size(), 5 * cells);
    EXPECT_LT(contact_pair.size(), 8 * cells);
    for (const auto& [place, edges] : contact_pair) EXPECT_EQ(edges, 4) << "irregularity " << irregularity;
  }
}

TEST(Skeleton, TheSizeOfCellsDoesNotDependOnTheIrregularity) {
  const double cell = 0.3;
  const Vector size =
      Vector::Constant(9.5 * cell * std::cbrt(pi / 3));  // lattice constants: 9 or 10 seeds along a side
  const double expected = size.prod() / (pi / 6 * std::pow(cell, 3));
  for (const double irregularity : {0.0, 0.5, 1.0}) {
    // On the lattice there are 9³ + 10³ seeds for 2 · 9.5³ cells. A few of those within half a lattice constant of the
    // walls leave and others enter: the square root of their number, three times.
    const double uncertain = 9 * 9 * 9 + 10 * 10 * 10 - expected + 3 * std::sqrt(6 * expected * 0.5 / 9.5);
    EXPECT_NEAR(static_cast<double>(foam_skeleton(size, {cell, irregularity, 3}).cells), expected, uncertain);
  }
}

TEST(Skeleton, LengthWithinTheBox) {
  const Vector size(1, 2, 3);
  EXPECT_DOUBLE_EQ(length_within({{0.5, 1, -5}, {0.5, 1, 5}}, size), 3);
  EXPECT_DOUBLE_EQ(length_within({{0.2, 0.2, 0.2}, {0.2, 0.2, 1}}, size), 0.8);
  EXPECT_DOUBLE_EQ(length_within({{-1, 0, 1}, {1, 2, 1}}, size), std::sqrt(2.0));
  EXPECT_EQ(length_within({{1.5, 1, 0}, {1.5, 1, 3}}, size), 0);
  EXPECT_EQ(length_within({{-1, 0.5, 1}, {0.5, -1, 1}}, size), 0);
}

// Centers at the surface fall on one side or the other like coins: of S h² surface voxels (S: area), sqrt(S) / 2 is the
// expected error of the number, and that divided by S of the radius, in spacings. Three times that.
double uncertainty(double area) { return 3 * 0.5 / std::sqrt(area); }

TEST(Struts, RadiusOfACylinderThroughTheBox) {
  const VoxelGrid grid{{60, 50, 40}, {60, 50, 40}};
  const Edge edge{{20.3, 15.2, -30}, {41.1, 30.9, 70}};  // leaves through z = 0 and z = 40
  for (const double radius : {3.0, 6.0, 9.0}) {
    const double length =
        length_within(edge, grid.size);  // the oblique ends add on one side what they cut on the other
    const auto wanted = static_cast<std::size_t>(std::lround(pi * radius * radius * length));
    const Struts struts = struts_around({edge}, grid, wanted);
    EXPECT_EQ(struts.voxels.size(), wanted);
    EXPECT_EQ(struts.dropped_pieces, 0u);
    EXPECT_NEAR(struts.radius, radius, uncertainty(2 * pi * radius * length));
  }
}

TEST(Struts, RadiusOfACylinderWithRoundEnds) {
  const VoxelGrid grid{{3, 2.5, 2}, {60, 50, 40}};  // spacing 0.05
  const double h = 0.05;
  const Edge edge{{1.03, 1.21, 0.97}, {1.91, 1.38, 1.06}};
  const double radius = 0.33, length = (edge.b - edge.a).norm();
  const double volume = pi * radius * radius * (length + 4 * radius / 3);
  const Struts struts = struts_around({edge}, grid, static_cast<std::size_t>(volume / (h * h * h)));
  EXPECT_NEAR(struts.radius, radius, h * uncertainty(2 * pi * radius * (length + 2 * radius) / (h * h)));
}

TEST(Struts, VoxelsAreThoseWithinTheRadius) {
  const VoxelGrid grid{{20, 20, 20}, {20, 20, 20}};
  const std::vector<Edge> edges = {{{4, 5, 6}, {15, 16, 7}}, {{15, 16, 7}, {10, 3, 17}}};
  const Struts struts = struts_around(edges, grid, 500);
  std::vector<int> expected;
  for (int n = 0; n < 8000; ++n) {
    const Vector x = grid.cell(n).cast<double>() + 0.5;
    double least = INFINITY;
    for (const Edge& edge : edges) {
      const Vector along = (edge.b - edge.a).normalized();
      const double t = std::clamp((x - edge.a).dot(along), 0.0, (edge.b - edge.a).norm());
      least = std::min(least, (x - edge.a - t * along).norm());
    }
    if (least < struts.radius) expected.push_back(n);
  }
  EXPECT_EQ(struts.voxels, expected);
}

TEST(Struts, OnlyTheLargestPieceIsKept) {
  const VoxelGrid grid{{40, 20, 20}, {40, 20, 20}};
  const Edge large{{5, 5.2, 5.1}, {35, 5.4, 6}}, small{{5, 15.2, 15}, {15, 15.1, 15.6}};
  const Struts both = struts_around({large, small}, grid, 600);
  const Struts alone = struts_around({large}, grid, 600);
  EXPECT_EQ(both.voxels, alone.voxels);
  EXPECT_EQ(both.dropped_pieces, 1u);
  EXPECT_GT(both.dropped_voxels, 150u);  // about a third of the other
  EXPECT_LT(both.dropped_voxels, 300u);
}

TEST(Struts, TiesAreNotBroken) {
  const VoxelGrid grid{{10, 10, 6}, {10, 10, 6}};
  const Struts struts = struts_around({{{5, 5, -1}, {5, 5, 7}}}, grid, 1);
  EXPECT_EQ(struts.voxels.size(), 4 * 6u);  // all at √0.5 from the axis
  EXPECT_NEAR(struts.radius, (std::sqrt(0.5) + std::sqrt(2.5)) / 2, 1e-12);
}

}  // namespace
}  // namespace strut::mesh
