// The cells of points.
#include <gtest/gtest.h>

#include "topology/neighbors/cell_grid.hpp"

namespace strut {
namespace {

// A point that has flown off, as in a run that blows up, makes a long thin box, whose cells would fill all memory.
TEST(CellGrid, HasCellsInProportionToItsPoints) {
  std::vector<Vector> points;
  for (int i = 0; i < 100; ++i) points.push_back(1e-3 * Vector(i % 5, i / 5 % 5, i / 25));
  const int before = CellGrid(points, 1e-3).cells();
  points.push_back(Vector(1e12, 0, 0));
  EXPECT_LE(CellGrid(points, 1e-3).cells(), 8 * (8 * 101 + 64));  // as the grid says of itself: 64 a point
  EXPECT_GT(before, 100);
}

}  // namespace
}  // namespace strut
