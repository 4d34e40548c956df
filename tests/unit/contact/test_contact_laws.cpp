// The laws of contact and friction against their formulas.
#include <gtest/gtest.h>

#include "contact/laws/contact_law.hpp"
#include "contact/laws/laws.hpp"

namespace strut::contact {
namespace {

constexpr double round_off = 1e-15;  // a handful of products, relative

// Two points 1 mm apart at first, with a horizon of 50 µm; of two bodies.
PointPair pair_of(double one_volume, double other_volume) {
  return {{one_volume, other_volume}, {5e-5, 5e-5}, 1e-3, false};
}

// Postek et al. (2021), eq. 22, with the numbers of their foam: K_p = 1e12 Pa, δ = 50 µm. By hand:
// K_c = 18·1e12/(π·(5e-5)⁵) = 1.8334649444186343e34 Pa/m⁵.
TEST(PenaltyLaw, ForceIsThePublishedOne) {
  const double K_c = penalty_stiffness(1e12, 5e-5);
  EXPECT_NEAR(K_c, 1.8334649444186343e34, 4 * round_off * K_c);
  const PenaltyLaw law{.radius = 5.5e-5, .penalty = 1e12};
  const double force = law.normal_force(pair_of(3e-16, 4e-16), 1e-6);
  EXPECT_NEAR(force, 1.8334649444186343e34 * 1e-6 * 3e-16 * 4e-16, 10 * round_off * force);
}

// In Peridigm each point of a pair pushes by its own horizon: the mean of both, 33/2 of the softer one at 1 : 2.
TEST(PenaltyLaw, IsTheMeanOfThoseOfBothHorizons) {
  const PenaltyLaw law{.radius = 5.5e-5, .penalty = 1e12};
  PointPair pair = pair_of(3e-16, 4e-16);
  pair.horizons.second = 1e-4;
  const double softer = penalty_stiffness(1e12, 1e-4) * 3e-16 * 4e-16;
  EXPECT_NEAR(law.tangent_stiffness(pair, 1e-6), 16.5 * softer, 1e-14 * 16.5 * softer);
  std::swap(pair.horizons.first, pair.horizons.second);
  EXPECT_NEAR(law.tangent_stiffness(pair, 1e-6), 16.5 * softer, 1e-14 * 16.5 * softer);
}

// By hand: R₁ = 0.5 mm and R₂ = 1.5 mm, so R* = 0.375 mm; E* = 6e10 Pa and an overlap of 15 µm, √(R* o) = 75 µm:
// stiffness 2 E* 75e-6 = 9e6 N/m, force 2/3 of it times o = 90 N, energy 2/5 of that times o = 540 µJ.
TEST(HertzLaw, ForceStiffnessAndEnergyAreThoseOfElasticSpheres) {
  const HertzLaw law{.radius = 1e-3, .effective_modulus = 6e10};
  const PointPair pair = pair_of(1e-9, 27e-9);
  EXPECT_NEAR(HertzLaw::effective_radius(pair), 0.375e-3, 10 * round_off);
  EXPECT_NEAR(law.tangent_stiffness(pair, 15e-6), 9e6, 10 * round_off * 9e6);
  EXPECT_NEAR(law.normal_force(pair, 15e-6), 90, 10 * round_off * 90);
  EXPECT_NEAR(law.stored_energy(pair, 15e-6), 540e-6, 10 * round_off * 540e-6);
  // F = 4/3 E* √R* o^(3/2), as it is usually written.
  EXPECT_NEAR(law.normal_force(pair, 1e-6), 4.0 / 3 * 6e10 * std::sqrt(0.375e-3) * std::pow(1e-6, 1.5), 1e-13);
}

// Two faces of points press each other as much, whatever their spacing.
TEST(HertzLaw, PressureOfAFaceIsThatOfAnySpacing) {
  const HertzLaw law{.radius = 1, .effective_modulus = 6e10};
  for (const double h : {1e-3, 0.3e-3, 20e-6}) {
    const double volume = h * h * h;
    const double pressure = law.normal_force(pair_of(volume, volume), 0.01 * h) / (h * h);
    EXPECT_NEAR(pressure, 2.0 / 3 * 6e10 * 1e-3, 20 * round_off * pressure);
  }
}

// The requirements of the concept, for every law in the variant.
template <class L>
struct EveryLaw : ::testing::Test {};

template <class Variant>
struct TypesOf;
template <class... Laws>
struct TypesOf<std::variant<Laws...>> {
  using Types = ::testing::Types<Laws...>;
};
TYPED_TEST_SUITE(EveryLaw, TypesOf<PairLaw>::Types);

// Some pair and law of each kind, with which force and stiffness are of the order of 1 at an overlap of 1.
template <class L>
L some_law() {
  return L{2, 3};
}
const PointPair some_pair{{1.5, 0.5}, {1.2, 1.3}, 2, false};

TYPED_TEST(EveryLaw, NothingActsWithoutOverlap) {
  const auto law = some_law<TypeParam>();
  EXPECT_EQ(law.normal_force(some_pair, 0), 0);
  EXPECT_EQ(law.stored_energy(some_pair, 0), 0);
  EXPECT_GE(law.tangent_stiffness(some_pair, 0), 0);
}

// By central differences, which are off by h²/6 times a third derivative: less than h² of what they are compared with,
// for powers of an overlap above 0.2.
TYPED_TEST(EveryLaw, StiffnessIsTheSlopeOfTheForceAndForceThatOfTheEnergy) {
  const auto law = some_law<TypeParam>();
  const double h = 1e-4;
  for (const double o : {0.2, 0.5, 1.0}) {
    const double force = law.normal_force(some_pair, o), stiffness = law.tangent_stiffness(some_pair, o);
    const auto slope = [&](const auto& of) { return (of(o + h) - of(o - h)) / (2 * h); };
    EXPECT_NEAR(slope([&](double x) { return law.stored_energy(some_pair, x); }), force, 25 * h * h * force);
    EXPECT_NEAR(slope([&](double x) { return law.normal_force(some_pair, x); }), stiffness, 25 * h * h * stiffness);
  }
}

// forces.cpp bounds the stiffness to come by that of a larger overlap.
TYPED_TEST(EveryLaw, StiffnessDoesNotFallWithTheOverlap) {
  const auto law = some_law<TypeParam>();
  for (double o = 0; o < 1; o += 0.1)
    EXPECT_LE(law.tangent_stiffness(some_pair, o), law.tangent_stiffness(some_pair, o + 0.1));
}

TYPED_TEST(EveryLaw, IsTheSameFromBothPoints) {
  const auto law = some_law<TypeParam>();
  PointPair turned = some_pair;
  std::swap(turned.volumes[0], turned.volumes[1]);
  EXPECT_EQ(law.normal_force(some_pair, 0.3), law.normal_force(turned, 0.3));  // to the last bit
}

// The search looks for no pairs farther apart than that.
TYPED_TEST(EveryLaw, TouchingDistanceIsNoLargerThanTheSearchExpects) {
  const auto law = some_law<TypeParam>();
  EXPECT_EQ(radius_of(law), 2);
  for (const bool one_body : {true, false}) {
    for (const double reference : {0.5, 2.0, 20.0}) {
      PointPair pair = some_pair;
      pair.reference_distance = reference, pair.one_body = one_body;
      EXPECT_LE(law.touching_distance(pair), largest_touching_distance(2, reference, one_body));
    }
  }
}

TEST(TouchingDistance, OfPointsThatStartCloseIsNineTenthsOfTheirDistance) {
  EXPECT_EQ(largest_touching_distance(1, 10, true), 1);
  EXPECT_DOUBLE_EQ(largest_touching_distance(1, 1, true), 0.9);
  EXPECT_DOUBLE_EQ(largest_touching_distance(1, 0.5, true), 0.45);
  EXPECT_EQ(largest_touching_distance(1, 10, false), 1);
  EXPECT_EQ(largest_touching_distance(1, 0.5, false), 0.5);
}

TEST(Friction, IsCoulombsAndDragsAlongTheSliding) {
  const Vector velocity(3, 4, 12);  // 12 along the normal, 5 across
  const Vector force = friction_force(0.5, 10, velocity, Vector::UnitZ(), 1, 1e-3);
  EXPECT_NEAR((force - Vector(3, 4, 0)).norm(), 0, 1e-14);  // 0.5 · 10 along (3, 4)/5
}

// Two free points of masses 2 and 3: the impulse of friction over dt may stop their sliding, and not turn it.
TEST(Friction, StopsAndDoesNotReverse) {
  const double dt = 0.01, m1 = 2, m2 = 3;
  const Vector velocity(0.5, 0, 0);
  const Vector impulse = dt * friction_force(0.5, 1e6, velocity, Vector::UnitZ(), 1 / m1 + 1 / m2, dt);
  const Vector left = velocity - impulse / m2 - impulse / m1;
  EXPECT_NEAR(left.norm(), 0, 1e-15);
  EXPECT_EQ(friction_force(0.5, 1, Vector::Zero(), Vector::UnitZ(), 1, dt).norm(), 0);
}

}  // namespace
}  // namespace strut::contact
