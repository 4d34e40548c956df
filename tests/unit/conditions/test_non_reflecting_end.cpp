// The part of a cell within ends that meet.
#include <gtest/gtest.h>

#include <cmath>

#include "conditions/non_reflecting_end.hpp"

namespace strut {
namespace {

const Vector x = Vector::UnitX(), y = Vector::UnitY(), z = Vector::UnitZ();

TEST(PartWithinEnds, IsOfABoxAHalfAQuarterAndAnEighth) {
  constexpr double round_off = 1e-15;
  EXPECT_EQ(part_within({}), 1);
  EXPECT_EQ(part_within({x}), 0.5);
  EXPECT_NEAR(part_within({x, -y}), 0.25, round_off);
  EXPECT_NEAR(part_within({x, y, -z}), 0.125, round_off);
}

// A wedge of 60° between faces whose normals are 120° apart; the corner of a regular tetrahedron, whose angle is
// 3 acos(1/3) − π.
TEST(PartWithinEnds, IsTheShareOfTheFullAngle) {
  const double half = std::sqrt(0.75);
  EXPECT_NEAR(part_within({x, Vector(-0.5, half, 0)}), 1.0 / 6, 1e-15);
  const Vector a = Vector(1, 1, 1) / std::sqrt(3), b = Vector(1, -1, -1) / std::sqrt(3),
               c = Vector(-1, 1, -1) / std::sqrt(3);
  EXPECT_NEAR(part_within({a, b, c}), (3 * std::acos(1.0 / 3) - M_PI) / (4 * M_PI), 1e-15);
}

TEST(PartWithinEnds, IsNothingWhereNormalsAreInOnePlaneOrTooMany) {
  EXPECT_EQ(part_within({x, x}), 0);
  EXPECT_EQ(part_within({x, -x}), 0);
  EXPECT_EQ(part_within({x, y, (x + y).normalized()}), 0);
  EXPECT_EQ(part_within({x, y, z, -z}), 0);
}

}  // namespace
}  // namespace strut
