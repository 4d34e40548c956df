// The polymeric foam against closed forms: the tests that its parameters come from, flow, density, objectivity, energy.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/step_work.hpp"
#include "materials/tangent.hpp"
#include "point_driver.hpp"
#include "polyurethane.hpp"

namespace strut::testing {
namespace {

using namespace materials;

// Newton solves for the yield function to some 1e-15 of its parts, the driver for the free sides to 1e-10 of the
// stress.
constexpr double by_driver = 1e-9;
constexpr double to_round_off = 1e-12;  // some hundred operations, amplified by stiffness over yield stress, 100

PolymerFoam foam(double poisson = 0) { return Polyurethane::hardening(poisson); }
PolymerFoam perfect(double poisson = 0) { return Polyurethane::perfect(poisson); }

// A point that is led from stretch to stretch.
struct FoamPoint {
  PolymerFoam law;
  PolymerFoam::State state = law.virgin_state();
  Symmetric stress = Symmetric::Zero();  // Cauchy
  Symmetric stretch = spherical(1);

  double J() const { return to_tensor(stretch).determinant(); }
  Symmetric kirchhoff() const { return J() * stress; }
  PointStep step_to(const Symmetric& next) const { return step_between(stretch, next, 1e-6); }
  bool advance(const Symmetric& next) {
    const auto [reached, converged] = law.step(step_to(next), stress, state);
    stress = reached, stretch = next;
    return converged;
  }
  bool advance_strain(const Symmetric& strain) { return advance(exponential(strain)); }
};

Symmetric stretch_of(const Tensor& F) {
  const Principal C = principal(symmetric_part(F.transpose() * F));
  return from_principal(C.values.array().sqrt(), C.axes);
}

double value_at(const TableHardening& table, double strain) { return strain > 0 ? table(0, strain).value : 0; }

// The yield function as the reference prints it, over its right side.
double printed_yield(const PolymerFoam& law, const PolymerFoam::State& state, const Symmetric& kirchhoff) {
  const double ev = state.compaction, ea = ev / (1 - 2 * law.plastic_poisson);
  const double tau = law.uniaxial_yield + value_at(law.uniaxial_hardening, ea);
  const double p_c = law.hydrostatic_yield + value_at(law.hydrostatic_hardening, ev), p_t = law.tension_ratio * p_c;
  const double alpha = tau / std::sqrt(p_t * p_c - tau * (p_t - p_c) / 3 - tau * tau / 9);
  const double p = -trace(kirchhoff) / 3, q = von_mises(kirchhoff), center = (p_c - p_t) / 2;
  return std::sqrt(q * q + alpha * alpha * (p - center) * (p - center)) / (alpha * (p_c + p_t) / 2) - 1;
}

// A path that stretches, shears and turns its axes while it is crushed to a third, and comes back; t from 0 to 1.
Symmetric mixed_strain(double t) {
  constexpr double pi = 3.14159265358979323846;
  const double crush = 0.6 * (1 - std::cos(1.5 * pi * t)), swing = std::sin(2 * pi * t);
  return {-crush, 0.1 * swing, -0.3 * crush, 0.2 * swing, 0.1 * crush, -0.15 * swing};
}

// ---- Yield ----------------------------------------------------------------------------------------------------------

// To the last step before yield E ε = τ, and from then on J σ = τ_y0.
// Where bonds break, those that are left see another stretch: the stress stays, of a foam that has flowed, too.
TEST(PolymerFoam, AJumpOfTheStretchLeavesTheStress) {
  FoamPoint point{foam()};
  Symmetric strain = spherical(-0.05);
  strain[0] = -0.3, strain[3] = 0.1;
  ASSERT_TRUE(point.advance_strain(strain));
  const Symmetric before = point.stress;
  Tensor sheared = Tensor::Identity();
  sheared(0, 0) = 1.1, sheared(1, 1) = 1 / 1.1, sheared(1, 2) = 0.2;  // the volume, on which its moduli depend, stays
  const Symmetric next = stretch_of(to_tensor(point.stretch) * sheared);
  point.law.move_stress(to_tensor(point.stretch), to_tensor(next), point.state);
  ASSERT_TRUE(point.advance(next));
  EXPECT_LT((point.stress - before).norm(), to_round_off * before.norm());
}

TEST(PolymerFoam, YieldsInUniaxialCompression) {
  for (const double poisson : {0.0, 0.1, 0.3}) {
    point::Driver<PolymerFoam> point(perfect(poisson));
    for (int i = 0; i < 100; ++i) {
      ASSERT_TRUE(point.advance_uniaxial_stress(-0.002, 1e-6)) << poisson << " " << i;
      const double J = std::exp(trace(point.strain));
      const double E = Polyurethane::young * std::pow(Polyurethane::density / J, Polyurethane::exponent);
      const double expected = std::min(-E * point.strain[0], Polyurethane::uniaxial);
      EXPECT_NEAR(-J * point.stress[0], expected, by_driver * Polyurethane::uniaxial) << poisson << " " << i;
    }
    EXPECT_GT(point.state.compaction, 0.05);
  }
}

TEST(PolymerFoam, YieldsUnderPressureAndTension) {
  for (const double sign : {-1.0, 1.0}) {
    FoamPoint point{perfect()};
    for (int i = 1; i <= 40; ++i) ASSERT_TRUE(point.advance_strain(spherical(sign * 0.005 * i)));
    const double limit = (sign > 0 ? Polyurethane::tension_ratio : 1) * Polyurethane::hydrostatic;
    EXPECT_NEAR(trace(point.kirchhoff()) / 3, sign * limit, to_round_off * limit);
    EXPECT_LT(sign * point.state.compaction, -0.1);
  }
}

// τ = τ_y0 + H_a(ε_a), where ε_a is what the bar has shortened by beyond its elastic strain.
TEST(PolymerFoam, UniaxialCompressionFollowsItsTable) {
  for (const double poisson : {0.0, 0.2}) {
    point::Driver<PolymerFoam> point(foam(poisson));
    for (int i = 0; i < 300; ++i) {
      ASSERT_TRUE(point.advance_uniaxial_stress(-0.007, 1e-6)) << poisson << " " << i;
      const double J = std::exp(trace(point.strain)), tau = -J * point.stress[0];
      if (point.state.compaction == 0) continue;
      const double E = Polyurethane::young * std::pow(Polyurethane::density / J, Polyurethane::exponent);
      const double axial = -point.strain[0] - tau / E;
      const double expected = Polyurethane::uniaxial + value_at(point.law().uniaxial_hardening, axial);
      EXPECT_NEAR(tau, expected, by_driver * expected) << poisson << " " << i;
      EXPECT_NEAR(point.state.compaction, (1 - 2 * poisson) * axial, by_driver);
      EXPECT_NEAR(point.state.equivalent_plastic_strain, axial, by_driver);
    }
    EXPECT_LT(point.strain[0], -2);
  }
}

TEST(PolymerFoam, PressureFollowsItsTable) {
  FoamPoint point{foam()};
  for (int i = 1; i <= 250; ++i) {
    ASSERT_TRUE(point.advance_strain(spherical(-0.0035 * i)));
    if (point.state.compaction == 0) continue;
    const double p = -trace(point.kirchhoff()) / 3;
    const double K = point.law.moduli(point.state).bulk * point.J();
    const double compaction = -std::log(point.J()) - p / K;
    const double expected = Polyurethane::hydrostatic + value_at(point.law.hydrostatic_hardening, compaction);
    EXPECT_NEAR(p, expected, to_round_off * expected) << i;
    EXPECT_NEAR(point.state.compaction, compaction, to_round_off);
  }
}

TEST(PolymerFoam, TheYieldFunctionHoldsOnAMixedPath) {
  for (const double poisson : {0.0, 0.2}) {
    FoamPoint point{foam(poisson)};
    int flowed = 0;
    for (int i = 1; i <= 400; ++i) {
      const double before = point.state.equivalent_plastic_strain;
      ASSERT_TRUE(point.advance_strain(mixed_strain(i / 400.0)));
      const double over = printed_yield(point.law, point.state, point.kirchhoff());
      EXPECT_LE(over, to_round_off);
      if (point.state.equivalent_plastic_strain == before) continue;
      EXPECT_GE(over, -to_round_off);
      ++flowed;
    }
    EXPECT_GT(flowed, 200);
  }
}

// ---- Flow -----------------------------------------------------------------------------------------------------------

// The plastic strain of a bar: of its sides −ν_p of the axial one; C_p⁻¹ has its stretches.
TEST(PolymerFoam, PlasticPoissonsRatio) {
  for (const double poisson : {0.0, 0.1, 0.3}) {
    point::Driver<PolymerFoam> point(foam(poisson));
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(point.advance_uniaxial_stress(-0.01, 1e-6));
    const auto logarithm = [&](int c) { return -0.5 * std::log(1 - 2 * point.state.plastic_strain[c]); };
    const double axial = logarithm(0);
    EXPECT_LT(axial, -0.8);
    // The driver leaves 1e-10 of the stress at the sides, which flow by as much.
    EXPECT_NEAR(logarithm(1), -poisson * axial, 1e-10) << poisson;
    EXPECT_NEAR(logarithm(2), -poisson * axial, 1e-10) << poisson;
  }
}

// In one step under a stretch that leaves the sides free to round-off: the potential's flow has no lateral part.
TEST(PolymerFoam, WithoutPlasticPoissonsRatioTheSidesDoNotFlow) {
  const PolymerFoam law = perfect();
  const double J = std::exp(-0.5);
  const double E = Polyurethane::young * std::pow(Polyurethane::density / J, Polyurethane::exponent);
  const double lateral = Polyurethane::poisson * Polyurethane::uniaxial / E;  // elastic, under τ_y0
  FoamPoint point{law};
  ASSERT_TRUE(point.advance_strain({-0.5 - 2 * lateral, lateral, lateral, 0, 0, 0}));
  EXPECT_NEAR(point.state.plastic_strain[1], 0, 1e-14);
  EXPECT_NEAR(point.kirchhoff()[0], -Polyurethane::uniaxial, to_round_off * Polyurethane::uniaxial);
  EXPECT_NEAR(point.kirchhoff()[1], 0, to_round_off * Polyurethane::uniaxial);
}

// det F_p = exp(−ε_v), and ρ* = ρ₀*/det F: each step adds its round-off.
TEST(PolymerFoam, VolumesBelongTogether) {
  FoamPoint point{foam(0.1)};
  for (int i = 1; i <= 400; ++i) {
    ASSERT_TRUE(point.advance_strain(mixed_strain(i / 400.0)));
    EXPECT_NEAR(point.state.relative_density, Polyurethane::density / point.J(), 1e-15);
    const Tensor inverse = Tensor::Identity() - 2 * to_tensor(Symmetric(point.state.plastic_strain.data()));
    EXPECT_NEAR(inverse.determinant(), std::exp(2 * point.state.compaction),
                1e-12 * std::exp(2 * point.state.compaction));
  }
}

// Below zero compaction the tables count as at zero.
TEST(PolymerFoam, PulledItKeepsItsFirstStrength) {
  FoamPoint point{foam()};
  for (int i = 1; i <= 100; ++i) ASSERT_TRUE(point.advance_strain(spherical(0.005 * i)));
  EXPECT_LT(point.state.compaction, -1);
  const double limit = Polyurethane::tension_ratio * Polyurethane::hydrostatic;
  EXPECT_NEAR(trace(point.kirchhoff()) / 3, limit, to_round_off * limit);
}

// ---- The frame ------------------------------------------------------------------------------------------------------

// Simple shear up to a shear of 1 after crushing, seen from a turned frame: F' = F Qᵀ has the stretch Q U Qᵀ.
TEST(PolymerFoam, IsTheSameInATurnedFrame) {
  const Tensor Q = Eigen::AngleAxisd(1.1, Vector(1, 2, -1).normalized()).toRotationMatrix();
  FoamPoint here{foam(0.1)}, there{foam(0.1)};
  for (int i = 1; i <= 150; ++i) {
    Tensor F = Tensor::Identity();
    F(0, 0) = 1 - 0.6 * std::min(1.0, i / 50.0);
    F(0, 1) = std::max(0.0, (i - 50) / 100.0);
    ASSERT_TRUE(here.advance(stretch_of(F)));
    ASSERT_TRUE(there.advance(stretch_of(F * Q.transpose())));
    const Symmetric turned = symmetric_part(Q * to_tensor(here.stress) * Q.transpose());
    EXPECT_LE((turned - there.stress).norm(), 1e-11 * Polyurethane::uniaxial) << i;  // 150 steps of to_round_off/10
  }
  EXPECT_GT(std::abs(here.stress[3]), 0.1 * Polyurethane::uniaxial);
}

// ---- Steps ----------------------------------------------------------------------------------------------------------

TEST(PolymerFoam, StepsOfAnySizeConverge) {
  const std::vector<Symmetric> directions{{-1, 0, 0, 0, 0, 0},         {1, 0, 0, 0, 0, 0},
                                          {-0.6, -0.6, -0.6, 0, 0, 0}, {0.6, 0.6, 0.6, 0, 0, 0},
                                          {0, 0, 0, 0.7, 0, 0},        {0.3, -0.5, 0.1, 0.3, -0.2, 0.4}};
  for (const double poisson : {0.0, 0.2, 0.49}) {
    for (double size = 1e-5; size <= 0.5; size *= 2.9) {
      for (const Symmetric& direction : directions) {
        FoamPoint point{foam(poisson)};
        const int steps = static_cast<int>(std::min(1.0 / size, 200.0)) + 1;
        for (int i = 1; i <= steps; ++i) {
          ASSERT_TRUE(point.advance_strain(size * i * direction)) << poisson << " " << size << " " << i;
          EXPECT_LE(printed_yield(point.law, point.state, point.kirchhoff()), 1e-11) << poisson << " " << size;
        }
      }
    }
  }
}

TEST(PolymerFoam, WhatHasNoYieldSurfaceIsNotConverged) {
  PolymerFoam law = perfect();
  law.uniaxial_yield = 3.001 * law.hydrostatic_yield;
  EXPECT_FALSE(FoamPoint{law}.advance_strain({-1e-4, 0, 0, 0, 0, 0}));
  law = perfect();
  law.uniaxial_hardening = {{0, 1}, {0, 60e3}};  // 3 p_c is passed at 0.656
  FoamPoint point{law};
  bool converged = true;
  double reached = 0;
  for (int i = 1; i <= 100 && converged; ++i) {
    reached = point.state.compaction;
    converged = point.advance_strain({-0.01 * i, 0, 0, 0, 0, 0});
  }
  EXPECT_FALSE(converged);
  EXPECT_NEAR(reached, (3 * law.hydrostatic_yield - law.uniaxial_yield) / 60e3, 0.02);
}

// ---- Energy ---------------------------------------------------------------------------------------------------------

struct Ledger {
  double work = 0, stored = 0, lost = 0;
};

Ledger mixed_ledger(int steps) {
  FoamPoint point{foam()};
  Ledger sum;
  for (int i = 1; i <= steps; ++i) {
    const Symmetric before = point.stress;
    const double old_J = point.J();
    const PointStep step = point.step_to(exponential(mixed_strain(static_cast<double>(i) / steps)));
    EXPECT_TRUE(point.advance(step.stretch));
    sum.work += step_work(step, old_J, before, point.stress);
  }
  sum.stored = point.J() * point.law.elastic_energy(point.stress, point.state);
  sum.lost = point.law.dissipation(point.state);
  return sum;
}

// A step that flows closes to round-off. In elastic steps E(ρ*) gives or takes energy: at most γ ε_e, 1.5 %, of that
// stored at first yield, 400 J/m³ of a work of 2.3e5. The dissipation is of the first order in the step where the flow
// turns.
TEST(PolymerFoam, TheLedgerCloses) {
  const Ledger coarse = mixed_ledger(400), fine = mixed_ledger(4000);
  for (const Ledger& sum : {coarse, fine}) EXPECT_NEAR(sum.stored + sum.lost, sum.work, 3e-5 * sum.work);
  EXPECT_NEAR(coarse.lost, fine.lost, 1e-3 * fine.lost);
}

// Uniaxial compression without lateral flow: ∫ τ_y dε_a, the table's own integral. The step in which it yields counts
// from its beginning, and elastic energy that grows and shrinks with E takes a part: 1 %.
TEST(PolymerFoam, DissipatesWhatTheTableSays) {
  point::Driver<PolymerFoam> point(foam());
  double expected = 0;
  for (int i = 0; i < 2000; ++i) {
    const double old = point.state.compaction;
    ASSERT_TRUE(point.advance_uniaxial_stress(-0.001, 1e-6));
    const double middle = (old + point.state.compaction) / 2;
    expected +=
        (Polyurethane::uniaxial + value_at(point.law().uniaxial_hardening, middle)) * (point.state.compaction - old);
  }
  EXPECT_NEAR(point.state.plastic_work, expected, 0.01 * expected);
}

// ---- The tangent ----------------------------------------------------------------------------------------------------

// Against differences, which are good for some 1e-8 (difference_step), with ten for the elastic stiffness over the
// plastic one; not at a kink of the tables.
void expect_tangent(const FoamPoint& point, const Symmetric& next, const char* where) {
  const PointStep step = point.step_to(next);
  const StretchTangent own = point.law.tangent(step, point.stress, point.state);
  const StretchTangent other = difference_tangent(point.law, step, point.stress, point.state, point.stretch);
  EXPECT_LE((own - other).norm(), 1e-7 * own.norm()) << where << "\n" << own << "\n\n" << other;
}

TEST(PolymerFoam, TheTangentIsThatOfTheStress) {
  const std::vector<Symmetric> directions{{-1, 0, 0, 0, 0, 0},
                                          {-0.6, -0.6, -0.6, 0, 0, 0},
                                          {-0.6, -0.6, -0.6 - 1e-7, 0, 0, 0},
                                          {-1, 0.2, 0.2 + 1e-9, 0, 0, 0},
                                          {0.3, -0.5, 0.1, 0.3, -0.2, 0.4},
                                          {-0.2, 0, 0, 0.7, 0, 0},
                                          {0.7, 0, 0, 0, 0, 0}};
  for (const double poisson : {0.0, 0.2}) {
    for (const Symmetric& direction : directions) {
      FoamPoint point{foam(poisson)};
      expect_tangent(point, exponential(2e-3 * direction), "elastic");
      EXPECT_EQ(point.state.equivalent_plastic_strain, 0);
      expect_tangent(point, exponential(0.063 * direction), "first flow");
      for (int i = 1; i <= 4; ++i) ASSERT_TRUE(point.advance_strain(0.133 * i * direction));
      expect_tangent(point, exponential(0.57 * direction), "flow");
      expect_tangent(point, exponential(0.531 * direction), "unloading");
      expect_tangent(point, exponential(0.57 * direction + Symmetric{0.01, 0, 0.02, -0.03, 0.01, 0}), "a turn");
    }
  }
}

TEST(PolymerFoam, TheTangentTurnsWithTheFrame) {
  const Tensor Q = Eigen::AngleAxisd(0.8, Vector(-1, 0.5, 2).normalized()).toRotationMatrix();
  const auto turned = [&](const Symmetric& s) { return symmetric_part(Q * to_tensor(s) * Q.transpose()); };
  FoamPoint point{foam(0.1)};
  const Symmetric direction{-1, 0.1, 0.1, 0, 0, 0};
  for (int i = 1; i <= 4; ++i) ASSERT_TRUE(point.advance(turned(exponential(0.133 * i * direction))));
  expect_tangent(point, turned(exponential(0.57 * direction)), "turned");
}

TEST(PolymerFoam, ATangentThatDoesNotExistIsNotANumber) {
  PolymerFoam law = perfect();
  law.uniaxial_yield = 3.001 * law.hydrostatic_yield;
  const FoamPoint point{law};
  EXPECT_TRUE(law.tangent(point.step_to(spherical(0.9)), point.stress, point.state).hasNaN());
}

// σ = σ_old + C : d dt with d dt = sym(ΔU U_mid⁻¹), so ∂(d dt) = sym(∂U U_mid⁻¹ − ½ ΔU U_mid⁻¹ ∂U U_mid⁻¹).
TEST(Tangent, ByDifferencesIsTheClosedFormOfElastic) {
  const Elastic law{90e9, 42e9};
  const Symmetric old{1.01, 0.97, 1.02, 0.01, -0.02, 0.015}, next{1.03, 0.95, 1.0, 0.03, 0.01, -0.01};
  const Symmetric stress{1e8, -2e8, 5e7, 3e7, 0, -1e8};
  const PointStep step = step_between(old, next, 1e-7);
  const StretchTangent found = tangent_of(law, step, stress, Elastic::State{}, old);
  const Tensor inverse = (0.5 * (to_tensor(old) + to_tensor(next))).inverse();
  for (int d = 0; d < 6; ++d) {
    Symmetric unit = Symmetric::Zero();
    unit[d] = 1;
    const Tensor change = to_tensor(unit) * inverse;
    const Symmetric strain = symmetric_part(change - 0.5 * to_tensor(next - old) * inverse * change);
    const Symmetric exact = spherical(law.bulk * trace(strain)) + 2 * law.shear * deviator(strain);
    EXPECT_LE((found.col(d) - exact).norm(), 1e-8 * exact.norm()) << d;  // 3e-9: see difference_step
  }
}

}  // namespace
}  // namespace strut::testing
