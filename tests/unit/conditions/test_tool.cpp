// Gap, normal and curvature of rigid tools against closed forms and against each other.
#include <gtest/gtest.h>

#include <random>

#include "conditions/crossing.hpp"

namespace strut {
namespace {

constexpr double round_off = 1e-14;  // some ten operations on numbers about 1

void expect_surface(const Shape& shape, const Vector& place, double gap, const Vector& normal,
                    const Tensor& curvature = Tensor::Zero()) {
  const Surface at = surface(shape, place);
  EXPECT_NEAR(at.gap, gap, round_off) << place.transpose();
  EXPECT_LT((at.normal - normal).norm(), round_off) << place.transpose() << ": " << at.normal.transpose();
  EXPECT_LT((at.curvature - curvature).norm(), round_off) << place.transpose() << ":\n" << at.curvature;
}

Tensor diagonal(double x, double y, double z) { return Vector(x, y, z).asDiagonal(); }

TEST(Tool, HalfSpaceHasOneNormalEverywhere) {
  const Vector normal(0.6, 0, 0.8);
  const HalfSpace half{Vector(1, 7, 2), normal};
  expect_surface(half, Vector(1, 2, 2), 0, normal);
  expect_surface(half, Vector(2, 0, 3), 1.4, normal);
  expect_surface(half, Vector(0, 0, 2), -0.6, normal);
}

TEST(Tool, CylinderIsRoundAcrossItsAxis) {
  const Cylinder cylinder{Vector(1, 5, 2), Vector::UnitY(), 0.5};
  expect_surface(cylinder, Vector(1, -3, 2.75), 0.25, Vector::UnitZ(), diagonal(1 / 0.75, 0, 0));
  expect_surface(cylinder, Vector(0.5, 0, 2), 0, -Vector::UnitX(), diagonal(0, 0, 2));
  expect_surface(cylinder, Vector(1.1, 0, 2), -0.4, Vector::UnitX(), diagonal(0, 0, 10));
  const Vector slant = Vector(1, 0, 1).normalized();
  expect_surface(cylinder, Vector(31, 8, 32), 30 * std::sqrt(2) - 0.5, slant,
                 (Tensor::Identity() - slant * slant.transpose() - diagonal(0, 1, 0)) / (30 * std::sqrt(2)));
}

TEST(Tool, CylinderHasANormalOnItsAxis) {
  expect_surface(Cylinder{Vector::Zero(), Vector::UnitX(), 0.5}, Vector(3, 0, 0), -0.5, Vector::UnitY());
  expect_surface(Cylinder{Vector::Zero(), Vector(0.6, 0.8, 0), 0.5}, Vector::Zero(), -0.5, Vector::UnitZ());
}

const Box box{Vector(0, 0, 0), Vector(1, 2, 3)};

TEST(Tool, BoxHasFacesEdgesAndCorners) {
  expect_surface(box, Vector(0.5, 2.5, 1), 0.5, Vector::UnitY());
  expect_surface(box, Vector(0.5, 1.9, -4), 4, -Vector::UnitZ());
  const Vector edge(0.6, 0.8, 0), corner(1. / 3, 2. / 3, 2. / 3);
  expect_surface(box, Vector(1, 2, 1) + 5 * edge, 5, edge,
                 (diagonal(1, 1, 0) - edge * edge.transpose()) / 5);  // turns about the edge
  expect_surface(box, Vector(1, 2, 3) + 3 * corner, 3, corner,
                 (Tensor::Identity() - corner * corner.transpose()) / 3);  // about the corner
  expect_surface(box, -Vector::Constant(1e3), 1e3 * std::sqrt(3), -Vector::Constant(1 / std::sqrt(3)),
                 (Tensor::Identity() - Tensor::Constant(1. / 3)) / (1e3 * std::sqrt(3)));
}

TEST(Tool, BoxSendsWhatIsInsideToItsNearestFace) {
  expect_surface(box, Vector(0.9, 1, 1), -0.1, Vector::UnitX());
  expect_surface(box, Vector(0.5, 0.25, 1), -0.25, -Vector::UnitY());
  expect_surface(box, Vector(0.5, 1, 3), 0, Vector::UnitZ());  // on it
}

TEST(Tool, BoxChoosesTheFirstOfEquallyNearFaces) {
  expect_surface(box, Vector(0.5, 1, 1.5), -0.5, -Vector::UnitX());      // low x before high x
  expect_surface(box, Vector(0.75, 1.75, 1.5), -0.25, Vector::UnitX());  // x before y
  expect_surface(box, Vector(1, 2, 3), 0, Vector::UnitX());              // at a corner
}

// The normal is the gradient of the gap, the curvature that of the normal, by central differences of a step of 1e-5:
// their truncation is 1e-10 times third derivatives, up to 1/(0.05)² for gap and 6/(0.05)³ for normal at the distances
// below, their round-off 1e-16/1e-5.
void expect_derivatives(const Shape& shape, const Vector& place) {
  const double h = 1e-5;
  const Surface at = surface(shape, place);
  for (int c = 0; c < 3; ++c) {
    const Surface ahead = surface(shape, place + h * Vector::Unit(c));
    const Surface behind = surface(shape, place - h * Vector::Unit(c));
    EXPECT_NEAR(at.normal[c], (ahead.gap - behind.gap) / (2 * h), 1e-7) << place.transpose();
    EXPECT_LT((at.curvature.col(c) - (ahead.normal - behind.normal) / (2 * h)).norm(), 1e-5) << place.transpose();
  }
}

// Whether no kink is near: the axis of the cylinder; inside of a box the places of several nearest faces; outside those
// over its edges, where only the curvature jumps.
bool is_smooth(const Shape& shape, const Vector& place) {
  const Surface at = surface(shape, place);
  for (int c = 0; c < 3; ++c) {
    for (const double h : {-1e-3, 1e-3}) {
      const Surface beside = surface(shape, place + h * Vector::Unit(c));
      if ((beside.curvature - at.curvature).norm() > 0.5 || (beside.normal - at.normal).norm() > 0.1) return false;
    }
  }
  return std::abs(at.gap) > 0.05 && at.curvature.norm() < 20;
}

TEST(Tool, NormalAndCurvatureAreDerivatives) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-4, 6);
  const std::vector<Shape> shapes = {HalfSpace{Vector(1, 0, 1), Vector(0.36, 0.48, 0.8)},
                                     Cylinder{Vector(1, 0, 1), Vector(0.36, 0.48, 0.8), 1.5}, box};
  for (const Shape& shape : shapes) {
    int tried = 0;
    for (int k = 0; k < 3000; ++k) {
      const Vector place(number(random), number(random), number(random));
      if (!is_smooth(shape, place)) continue;
      expect_derivatives(shape, place);
      ++tried;
    }
    EXPECT_GT(tried, 1000);
  }
}

// The explicit solver relies on this: the gap after a move is at least that by the tangent plane.
TEST(Tool, TangentPlanesAreNeverTooGenerous) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-2, 4);
  const auto place = [&] { return Vector(number(random), number(random), number(random)); };
  for (const Shape& shape : {Shape(Cylinder{Vector(1, 0, 1), Vector(0.36, 0.48, 0.8), 1.5}), Shape(box)}) {
    for (int k = 0; k < 3000; ++k) {
      const Vector a = place(), b = place();
      const Surface at = surface(shape, a);
      EXPECT_GE(surface(shape, b).gap, at.gap + at.normal.dot(b - a) - round_off);
    }
  }
}

TEST(Tool, TravelsAsItsFunctionsOfTimeSay) {
  RigidTool tool{{}, box, {Function::parse("2*t"), std::nullopt, Function::parse("-0.25")}};
  EXPECT_EQ(tool.offset(3), Vector(6, 0, -0.25));
  EXPECT_EQ((RigidTool{{}, box, {}}).offset(3), Vector::Zero());
}

// Closed forms of what two convex bodies are apart along the line that separates them.
TEST(ToolGap, IsTheDistanceBetweenTwoTools) {
  const auto gap = [](const Shape& one, const Shape& other) {
    const RigidTool a{.shape = one}, b{.shape = other};
    EXPECT_NEAR(gap_between(a, b, 0), gap_between(b, a, 0), 1e-9);
    return gap_between(a, b, 0);
  };
  const HalfSpace floor{Vector(0, 0, 1), Vector::UnitZ()}, lid{Vector(3, 3, 4), -Vector::UnitZ()};
  const Box box{Vector(0, 0, 2), Vector(1, 1, 3)};
  EXPECT_EQ(gap(floor, lid), 3);
  EXPECT_EQ(gap(floor, box), 1);
  EXPECT_EQ(gap(lid, box), 1);
  EXPECT_EQ(gap(box, Box{Vector(1.5, 5, 2), Vector(2, 6, 3)}), 4);
  EXPECT_LT(gap(floor, HalfSpace{Vector(0, 0, 9), Vector::UnitX()}), 0) << "which meet somewhere";
  EXPECT_LT(gap(floor, HalfSpace{Vector::Zero(), Vector::UnitZ()}), 0);
  constexpr double found = 1e-9;  // round-off of places that are thousands of km away
  const Cylinder roll{Vector(7, 0, 6), Vector::UnitX(), 0.5};
  EXPECT_NEAR(gap(roll, floor), 4.5, found);
  EXPECT_NEAR(gap(roll, Cylinder{Vector(1, 8, 9), Vector::UnitY(), 1}), 1.5, found);
  EXPECT_NEAR(gap(roll, box), 2.5, found);
  EXPECT_LT(gap(roll, Box{Vector(-3, -1, 5), Vector(-2, 1, 7)}), 0);
  for (const double along : {-3e4, 12e3, 1e6}) {  // the point that a deck gives for an axis is any of it
    const Cylinder same{Vector(along, 0, 6), Vector::UnitX(), 0.5};
    EXPECT_NEAR(gap(same, floor), 4.5, found);
    EXPECT_NEAR(gap(same, Cylinder{Vector(1, 8, 9), Vector::UnitY(), 1}), 1.5, found);
    EXPECT_NEAR(gap(same, Cylinder{Vector(1, 4, 9), Vector::UnitX(), 1}), 3.5, found);
    EXPECT_NEAR(gap(same, box), 2.5, found);
    EXPECT_LT(gap(same, Box{Vector(-3, -1, 5), Vector(-2, 1, 7)}), 0);
  }
  EXPECT_LT(gap(floor, Cylinder{Vector(0, 0, 6), Vector(0.8, 0, 0.6), 1}), 0) << "which meet somewhere";
}

}  // namespace
}  // namespace strut
