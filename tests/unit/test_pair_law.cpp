// The pair law of contact against its formulas.
#include <gtest/gtest.h>

#include "contact/laws/penalty.hpp"

namespace strut::contact {
namespace {

constexpr double round_off = 1e-15;  // a handful of products, relative

// Postek et al. (2021), eq. 22, with the numbers of their foam: K_p = 1e12 Pa, δ = 50 µm, r_c = 55 µm. By hand:
// K_c = 18·1e12/(π·(5e-5)⁵) = 1.8334649444186343e34 Pa/m⁵.
TEST(PairLaw, NormalForceIsThePublishedOne) {
  const double K_c = penalty_stiffness(1e12, 5e-5);
  EXPECT_NEAR(K_c, 1.8334649444186343e34, 4 * round_off * K_c);
  const double V1 = 3e-16, V2 = 4e-16;
  const double force = normal_force(K_c * V1 * V2, 5.5e-5, 5.4e-5);
  EXPECT_NEAR(force, 1.8334649444186343e34 * (5.5e-5 - 5.4e-5) * V1 * V2, 1e-13 * force);  // 1 µm of 55: cancellation
}

TEST(PairLaw, NothingActsBeyondTheRadius) {
  EXPECT_EQ(normal_force(2, 1, 1), 0);
  EXPECT_EQ(normal_force(2, 1, 1.5), 0);
  EXPECT_EQ(stored_energy(2, 1, 1.5), 0);
}

// The stored energy is the integral of the force: exactly so for a linear one, whatever the difference quotient's step.
TEST(PairLaw, ForceIsTheSlopeOfTheEnergy) {
  const double k = 3, r = 1, d = 0.7, h = 0.05;
  EXPECT_NEAR((stored_energy(k, r, d - h) - stored_energy(k, r, d + h)) / (2 * h), normal_force(k, r, d), 1e-14);
}

TEST(PairLaw, PointsThatStartCloseTouchAtNineTenthsOfTheirDistance) {
  EXPECT_EQ(touching_distance(1, 10, true), 1);
  EXPECT_DOUBLE_EQ(touching_distance(1, 1, true), 0.9);
  EXPECT_DOUBLE_EQ(touching_distance(1, 0.5, true), 0.45);
  EXPECT_EQ(touching_distance(1, 10, false), 1);
  EXPECT_EQ(touching_distance(1, 0.5, false), 0.5);
}

TEST(PairLaw, FrictionIsCoulombsAndDragsAlongTheSliding) {
  const Vector velocity(3, 4, 12);  // 12 along the normal, 5 across
  const Vector force = friction_force(0.5, 10, velocity, Vector::UnitZ(), 1, 1e-3);
  EXPECT_NEAR((force - Vector(3, 4, 0)).norm(), 0, 1e-14);  // 0.5 · 10 along (3, 4)/5
}

// Two free points of masses 2 and 3: the impulse of friction over dt may stop their sliding, and not turn it.
TEST(PairLaw, FrictionStopsAndDoesNotReverse) {
  const double dt = 0.01, m1 = 2, m2 = 3;
  const Vector velocity(0.5, 0, 0);
  const Vector impulse = dt * friction_force(0.5, 1e6, velocity, Vector::UnitZ(), 1 / m1 + 1 / m2, dt);
  const Vector left = velocity - impulse / m2 - impulse / m1;
  EXPECT_NEAR(left.norm(), 0, 1e-15);
  EXPECT_EQ(friction_force(0.5, 1, Vector::Zero(), Vector::UnitZ(), 1, dt).norm(), 0);
}

}  // namespace
}  // namespace strut::contact
