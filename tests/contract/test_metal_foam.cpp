// Deshpande and Fleck's foam against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/laws.hpp"
#include "point_driver.hpp"

namespace strut::testing {
namespace {

using namespace materials;

// The aluminium foam of the block under a bullet: E 54 MPa, ν 0, σ_p 3 MPa, γ 3.15 MPa, α₂ 45 MPa, β 4, ε_D 2.2.
DeshpandeFleck foam(double alpha = 2.1) {
  DeshpandeFleck law{.initial = {18e6, 27e6}, .compacted = {18e6, 27e6}};
  law.alpha = alpha, law.plateau = 3e6, law.linear = 3.15e6, law.locking = 45e6, law.exponent = 4;
  law.densification = 2.2;
  return law;
}

// A step of 1e-6 s. The law depends on the rate and J.
PointStep step_of(const Symmetric& rate, double J) { return {rate, 1e-6, J, spherical(std::cbrt(J))}; }

DeshpandeFleck without_hardening(DeshpandeFleck law) {
  law.linear = law.locking = 0;
  return law;
}

// Y as the reference prints it.
double printed(const DeshpandeFleck& law, double strain) {
  const double e = strain / law.densification;
  return law.plateau + law.linear * e + law.locking * std::log(1 / (1 - std::pow(e, law.exponent)));
}

constexpr double tolerance = 1e-9;  // 1e-13 of the trial in each of some hundred steps, and the sides' 1e-10

TEST(MetalFoam, UniaxialStressIsTheFlowStress) {
  for (const double alpha : {0.5, 1.5, 2.1}) {
    const DeshpandeFleck law = foam(alpha);
    point::Driver<DeshpandeFleck> point(law);
    for (int i = 0; i < 300; ++i) ASSERT_TRUE(point.advance_uniaxial_stress(-0.004, 1e-6)) << alpha << " " << i;
    const double strain = point.state.equivalent_plastic_strain;
    EXPECT_GT(strain, 0.5);
    EXPECT_NEAR(-point.stress[0], printed(law, strain), tolerance * printed(law, strain));
  }
}

// ν_p = (½ − (α/3)²)/(1 + (α/3)²): the sides' plastic strain over the axial one, and of it the volume's.
TEST(MetalFoam, PlasticPoissonsRatio) {
  for (const double alpha : {0.0, 0.7, 1.5, 2.1}) {
    point::Driver<DeshpandeFleck> point(without_hardening(foam(alpha)));
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(point.advance_uniaxial_stress(-0.004, 1e-6));
    const double elastic = point.stress[0] / 54e6;  // ν = 0
    const double axial = point.strain[0] - elastic, lateral = point.strain[1];
    const double square = alpha * alpha / 9, expected = (0.5 - square) / (1 + square);
    EXPECT_NEAR(-lateral / axial, expected, tolerance);
    EXPECT_NEAR(point.state.volumetric_plastic_strain, (1 - 2 * expected) * axial, tolerance);
  }
}

TEST(MetalFoam, HydrostaticYield) {
  for (const double alpha : {0.5, 2.1}) {
    const DeshpandeFleck law = without_hardening(foam(alpha));
    DeshpandeFleck::State state;
    const Symmetric rate = spherical(-3e3);  // ε̂ = 1.1, far from locking
    Symmetric stress = Symmetric::Zero();
    for (int i = 0; i < 100; ++i) {
      const PointStress next = law.step(step_of(rate, 1), stress, state);
      ASSERT_TRUE(next.converged);
      stress = next.stress;
    }
    const double expected = law.plateau * std::sqrt(1 + alpha * alpha / 9) / alpha;
    EXPECT_NEAR(-trace(stress) / 3, expected, tolerance * expected);
  }
}

// α = 0 is J2 with the same flow stress; linear, so that both solve it to round-off.
TEST(MetalFoam, AlphaZeroIsJ2) {
  DeshpandeFleck law = foam(0);
  law.locking = 0;
  const double slope = law.linear / law.densification;
  point::Driver<DeshpandeFleck> one(law);
  point::Driver<J2> other(J2{18e6, 27e6, {law.plateau, LinearHardening{slope}, NoRate{}}});
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(one.advance_uniaxial_strain(-0.01, 1e-6));
    ASSERT_TRUE(other.advance_uniaxial_strain(-0.01, 1e-6));
  }
  EXPECT_NEAR(one.stress[0], other.stress[0], 1e-10 * std::abs(other.stress[0]));
  EXPECT_NEAR(one.state.equivalent_plastic_strain, other.state.equivalent_plastic_strain, 1e-10);
}

// σ̂ ε̂̇ = σ : ε̇_p: the dissipation is ∫ J Y dε̂, of which ∫ Y dε̂ is known in closed form without the locking term,
// and the work that a volume under stress loses as it shrinks, −∫ W dJ (3 % of it). The error is of the second order in
// the step, as all are trapezoids, but for the step in which it yields.
TEST(MetalFoam, DissipatesWhatTheFlowStressDoes) {
  DeshpandeFleck law = foam();
  law.locking = 0;
  const auto integral = [&](double strain) {
    return law.plateau * strain + law.linear * strain * strain / (2 * law.densification);
  };
  double error[2];
  for (const int fine : {0, 1}) {
    const int steps = fine ? 4000 : 400;
    DeshpandeFleck::State state;
    Symmetric stress = Symmetric::Zero();
    const Symmetric rate = Symmetric{-0.8 / steps, 0, 0, 0.3 / steps, 0, 0} / 1e-6;
    double exact = 0;
    for (int i = 0; i < steps; ++i) {
      const double before = integral(state.equivalent_plastic_strain);
      const double J = std::exp(-0.8 * (i + 1) / steps);
      const PointStress next = law.step(step_of(rate, J), stress, state);
      ASSERT_TRUE(next.converged);
      const double mean_J = std::exp(-0.8 * (i + 0.5) / steps);
      exact += mean_J * (integral(state.equivalent_plastic_strain) - before);
      if (state.equivalent_plastic_strain > 0) {
        exact += 0.4 / steps * mean_J * (law.elastic_energy(stress, state) + law.elastic_energy(next.stress, state));
      }
      stress = next.stress;
    }
    error[fine] = std::abs(state.plastic_work / exact - 1);
  }
  EXPECT_LT(error[0], 1e-4);
  EXPECT_LT(error[1], error[0] / 5);
}

// In uniaxial strain P = σ: the trapezoid of its work is what is stored and what is dissipated, in steps of any size.
TEST(MetalFoam, WorkIsStoredOrDissipated) {
  DeshpandeFleck law = foam();
  law.compacted = {75e9, 26e9};
  DeshpandeFleck::State state;
  Symmetric stress = Symmetric::Zero();
  double F = 1;
  for (int i = 0; i < 60; ++i) {
    const double old_F = F, old_stress = stress[0], old_stored = old_F * law.elastic_energy(stress, state);
    const double old_plastic = state.equivalent_plastic_strain, old_dissipated = law.dissipation(state);
    F *= 0.96;
    const Symmetric rate{(F - old_F) / (0.5 * (F + old_F)) / 1e-6, 0, 0, 0, 0, 0};
    const PointStress next = law.step(step_of(rate, F), stress, state);
    ASSERT_TRUE(next.converged);
    stress = next.stress;
    if (state.equivalent_plastic_strain == old_plastic) continue;  // elastic: dissipates nothing
    const double work = 0.5 * (stress[0] + old_stress) * (F - old_F);
    const double kept = F * law.elastic_energy(stress, state) - old_stored + law.dissipation(state) - old_dissipated;
    EXPECT_NEAR(kept, work, 1e-12 * (work + old_stored)) << i;
  }
  EXPECT_GT(state.equivalent_plastic_strain, 1.5);
}

// However hard it is pressed, ε̂ stays below ε_D, and the stress goes on to grow.
TEST(MetalFoam, LocksWithoutOverstepping) {
  const DeshpandeFleck law = foam();
  for (const double step : {1e-4, 1e-3, 6.1e-4, 0.1, 3.0, 1e3}) {
    DeshpandeFleck::State state;
    Symmetric stress = Symmetric::Zero();
    double pressed = 0;
    const int steps = 400 + static_cast<int>(3 / step);
    for (int i = 0; i < steps; ++i) {
      const PointStress next = law.step(step_of(Symmetric{-step, 0, 0, 0, 0, 0} / 1e-6, 1), stress, state);
      ASSERT_TRUE(next.converged) << step << " " << i;
      EXPECT_LE(state.equivalent_plastic_strain, law.densification);
      EXPECT_LT(next.stress[0], pressed);
      stress = next.stress, pressed = stress[0];
    }
  }
}

// Compacted all the way, to ln(ρ_f/ρ_s) = −3 α² ε_D/(9 + α²), a point has the moduli of the solid, and half way the
// mean of both.
TEST(MetalFoam, ModuliGrowWithTheCompaction) {
  DeshpandeFleck law = foam();
  law.compacted = {75e9, 26e9};
  DeshpandeFleck::State state;
  EXPECT_EQ(law.moduli(state).bulk, 18e6);
  const double full = 3 * 2.1 * 2.1 * 2.2 / (9 + 2.1 * 2.1);
  state.volumetric_plastic_strain = -0.5 * full;
  EXPECT_NEAR(law.moduli(state).bulk, 0.5 * (18e6 + 75e9), 1e-6 * 75e9);
  state.volumetric_plastic_strain = -1.5 * full;
  EXPECT_DOUBLE_EQ(law.moduli(state).shear, 26e9);
}

TEST(MetalFoam, FailsWhereItsVolumeHasGrown) {
  DeshpandeFleck law = foam();
  law.failure_strain = 0.095;
  DeshpandeFleck::State state;
  Symmetric stress = Symmetric::Zero();
  double J = 1, work = 0;
  for (int i = 0; i < 12; ++i) {
    const double old_J = J;
    J *= std::exp(0.01);
    const Symmetric rate{1e4, 0, 0, 0, 0, 0};
    const PointStress next = law.step(step_of(rate, J), stress, state);
    ASSERT_TRUE(next.converged);
    work += 0.5 * 1e-6 * double_dot(old_J * stress + J * next.stress, rate);
    stress = next.stress;
    EXPECT_EQ(state.failed > 0, i >= 9) << i;  // ln J = 0.10
    if (state.failed > 0) {
      EXPECT_EQ(stress.norm(), 0);
      EXPECT_EQ(law.moduli(state).bulk, 0);
      EXPECT_EQ(law.elastic_energy(stress, state), 0);
    }
  }
  // All that was done is gone, but for what a change of J makes of the stored part (1 % a step).
  EXPECT_NEAR(law.dissipation(state), work, 0.02 * work);
}

}  // namespace
}  // namespace strut::testing
