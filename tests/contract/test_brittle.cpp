// A solid that cracks: closed forms of its fall, and what it dissipates.
#include <gtest/gtest.h>

#include <random>

#include "materials/brittle.hpp"
#include "materials/step_work.hpp"

namespace strut::testing {
namespace {

using namespace materials;

// Glass: E 72 GPa, ν 0.2. A crack takes 4 J/m² over 2 mm, four times what is stored at the strength in tension.
constexpr double bulk = 40e9, shear = 30e9, strength = 8e6, energy = 4, width = 2e-3;  // Pa, J/m², m

Brittle glass() { return {{bulk, shear}, energy, strength, width}; }

// A point whose strain grows at J = 1 for its law, with the sum of its work, J/m³.
struct Point {
  Brittle law = glass();
  Brittle::State state{};
  Symmetric stress = Symmetric::Zero();
  double work = 0;

  void strain(const Symmetric& increment) {
    const PointStep step{increment / 1e-6, 1e-6, 1, spherical(1)};
    const Symmetric before = stress;
    const auto [next, converged] = law.step(step, stress, state);
    ASSERT_TRUE(converged);
    stress = next;
    work += step_work(step, old_determinant(step), before, stress);
  }
};

const Symmetric along = (Symmetric() << 1, 0, 0, 0, 0, 0).finished();

// σ = σ_c (ε_f − ε)/(ε_f − σ_c/M), ε_f = 2 G_c/(ℓ σ_c). An explicit step of 1e-3 ε_f is off by as much.
TEST(Brittle, FallsLinearlyWithTheStrain) {
  Point point;
  const double first = strength / point.law.moduli().longitudinal(), last = 2 * energy / (width * strength);
  double strain = 0;
  for (int n = 0; n < 990; ++n) {
    point.strain(1e-3 * last * along), strain += 1e-3 * last;
    const double expected = strain < first ? strength * strain / first : strength * (last - strain) / (last - first);
    ASSERT_NEAR(point.stress[0], expected, 5e-3 * strength) << strain / last;
  }
}

// However it is strained; the thousandth that stays holds and dissipates less than a percent.
TEST(Brittle, DissipatesTheFractureEnergy) {
  const Symmetric skew = (Symmetric() << 0.7, -0.2, 0.1, 0.4, 0.2, -0.3).finished();
  const Symmetric sheared = (Symmetric() << 0, 0, 0, 1, 0, 0).finished();
  for (const Symmetric& direction : {along, spherical(1), sheared, skew}) {
    Point point;
    for (int n = 0; n < 20000; ++n) point.strain(1e-7 * direction);
    EXPECT_DOUBLE_EQ(point.state.damage, 0.999);
    EXPECT_NEAR(point.state.dissipated, energy / width, 0.01 * energy / width);
  }
}

TEST(Brittle, IsElasticBelowItsStrengthAndInCompression) {
  Point point;
  for (int n = 0; n < 1000; ++n) point.strain(-1e-5 * spherical(1));
  EXPECT_EQ(point.state.damage, 0);
  EXPECT_NEAR(point.stress[0], -3e-2 * bulk, 1e-9 * bulk);
}

// A closed crack bears pressure as the whole solid does, an open one takes up tension as it is.
TEST(Brittle, ClosesInCompression) {
  Point point;
  while (point.state.damage < 0.5) point.strain(1e-6 * along);
  const double x = 1 - point.state.damage;
  double strain = -trace(point.stress) / 3 / (x * bulk);  // to a stress without mean
  point.strain(spherical(strain / 3));
  EXPECT_NEAR(trace(point.stress), 0, 1e-6 * strength);
  point.strain(spherical(-1e-5));
  EXPECT_NEAR(trace(point.stress) / 3, -3e-5 * bulk, 1e-6 * strength);
  point.strain(spherical(2e-5));
  EXPECT_NEAR(trace(point.stress) / 3, x * 3e-5 * bulk, 1e-6 * strength);
}

// Steps of a hundredth of the last strain: second order of that.
TEST(Brittle, WorkIsStoredOrDissipated) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int path = 0; path < 20; ++path) {
    Point point;
    Symmetric direction;
    for (int n = 0; n < 4000; ++n) {
      if (n % 500 == 0) {
        for (int c = 0; c < 6; ++c) direction[c] = number(random);
      }
      point.strain(1e-6 * direction);
    }
    EXPECT_GT(point.state.damage, 0);
    const double counted = point.law.elastic_energy(point.stress, point.state) + point.state.dissipated;
    EXPECT_NEAR(point.work, counted, 2e-3 * counted);
  }
}

}  // namespace
}  // namespace strut::testing
