// Elastomers against closed forms: incompressible ones, which a bulk modulus of 10⁵ shear moduli is to 1e-5, and
// relaxation at a held stretch.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "materials/hyperelastic.hpp"
#include "materials/tangent.hpp"
#include "point_driver.hpp"

namespace strut::testing {
namespace {

using namespace materials;

constexpr double shear = 1e6, bulk = 1e5 * shear;  // Pa

Hyperelastic neo_hookean() { return {.bulk = bulk, .terms = {{{shear, 2}}}}; }
// C₁₀ = 0.35 MPa, C₀₁ = 0.15 MPa: W = C₁₀ (I₁ − 3) + C₀₁ (I₂ − 3).
Hyperelastic mooney_rivlin() { return {.bulk = bulk, .terms = {{{0.7e6, 2}, {-0.3e6, -2}}}}; }
// Ogden (1972) for Treloar's rubber: μ 0.63, 0.0012, −0.01 MPa, α 1.3, 5, −2.
Hyperelastic ogden() { return {.bulk = bulk, .terms = {{{0.63e6, 1.3}, {0.0012e6, 5}, {-0.01e6, -2}}}}; }

// σ₁ − σ₃ of an incompressible material: Σ μ_p (λ₁^α_p − λ₃^α_p).
double difference(const Hyperelastic& law, double first, double third) {
  double sum = 0;
  for (const auto& [modulus, exponent] : law.terms) {
    sum += modulus * (std::pow(first, exponent) - std::pow(third, exponent));
  }
  return sum;
}

// The stress at a stretch that keeps the volume, but for the pressure.
Symmetric stress_at(const Hyperelastic& law, const Symmetric& stretch, double dt = 1) {
  Hyperelastic::State state;
  const PointStress found =
      law.step(PointStep{Symmetric::Zero(), dt, to_tensor(stretch).determinant(), stretch}, Symmetric::Zero(), state);
  EXPECT_TRUE(found.converged);
  return found.stress;
}

Tensor askew(double angle) { return Eigen::AngleAxisd(angle, Vector(1, 2, -2) / 3).toRotationMatrix(); }

constexpr double tolerance = 1e-3;  // of the issue of elastomers: a tenth of a percent

TEST(Hyperelastic, IsClosedFormInUniaxialTension) {
  for (const Hyperelastic& law : {neo_hookean(), mooney_rivlin(), ogden()}) {
    for (const double s : {0.4, 2.5, 5.0}) {
      double low = 0.9 / std::sqrt(s), high = 1.1 / std::sqrt(s);  // the lateral stretch without lateral stress
      for (int n = 0; n < 60; ++n) {
        const double middle = 0.5 * (low + high);
        (stress_at(law, Symmetric{s, middle, middle, 0, 0, 0})[1] < 0 ? low : high) = middle;
      }
      const double expected = difference(law, s, 1 / std::sqrt(s));
      EXPECT_NEAR(stress_at(law, Symmetric{s, low, low, 0, 0, 0})[0], expected, tolerance * std::abs(expected)) << s;
    }
  }
}

TEST(Hyperelastic, IsClosedFormInEquibiaxialTensionAndPureShear) {
  for (const Hyperelastic& law : {neo_hookean(), mooney_rivlin(), ogden()}) {
    for (const double s : {0.7, 1.5, 3.0}) {
      const Symmetric both = stress_at(law, Symmetric{s, s, 1 / (s * s), 0, 0, 0});
      EXPECT_NEAR(both[0] - both[2], difference(law, s, 1 / (s * s)), 1e-9 * std::abs(both[0] - both[2]));
      const Symmetric pure = stress_at(law, Symmetric{s, 1, 1 / s, 0, 0, 0});
      EXPECT_NEAR(pure[0] - pure[2], difference(law, s, 1 / s), 1e-9 * std::abs(pure[0] - pure[2]));
    }
  }
}

// Simple shear F = 1 + γ e₁ ⊗ e₂ of Mooney & Rivlin: σ₁₂ = 2 (C₁₀ + C₀₁) γ in the frame at rest, to which R turns the
// stress of U.
TEST(Hyperelastic, IsClosedFormInSimpleShear) {
  for (const double amount : {0.1, 1.0, 3.0}) {
    Tensor F = Tensor::Identity();
    F(0, 1) = amount;
    const Eigen::SelfAdjointEigenSolver<Tensor> right(F.transpose() * F);
    const Tensor U = right.operatorSqrt(), R = F * U.inverse();
    const Tensor stress = R * to_tensor(stress_at(mooney_rivlin(), symmetric_part(U))) * R.transpose();
    EXPECT_NEAR(stress(0, 1), 1e6 * amount, 1e-8 * bulk * 1e-5) << amount;
    EXPECT_NEAR(stress(0, 0) - stress(1, 1), 1e6 * amount * amount, 1e-3 * 1e6 * amount) << amount;
  }
}

// Stretched within a step and held: the deviator falls as γ_∞ + Σ γ_k e^(−t/t_k), exactly, as nothing changes the
// branches but their decay.
TEST(Hyperelastic, RelaxesByItsSeries) {
  Hyperelastic law = ogden();
  law.times = {{{0.3, 0.1}, {0.2, 1.0}}};
  const Symmetric stretch{2, 1 / std::sqrt(2.0), 1 / std::sqrt(2.0), 0, 0, 0};
  const double fast = difference(law, 2, 1 / std::sqrt(2.0));
  Hyperelastic::State state;
  const auto step = [&](double dt, const Symmetric& stress) {
    return law.step(PointStep{Symmetric::Zero(), dt, 1, stretch}, stress, state).stress;
  };
  Symmetric stress = step(1e-9, Symmetric::Zero());
  EXPECT_NEAR(stress[0] - stress[2], fast, 1e-7 * fast);
  double time = 0;
  for (int n = 0; n < 300; ++n) {
    stress = step(0.01, stress);
    time += 0.01;
    const double left = 0.5 + 0.3 * std::exp(-time / 0.1) + 0.2 * std::exp(-time / 1.0);
    ASSERT_NEAR(stress[0] - stress[2], left * fast, 1e-6 * fast) << time;
  }
}

// While the axes of the stretch turn by two radians: the integrals h_k = ∫ e^(−(t−s)/t_k) dS̃₀, summed here over forty
// times as many steps. The law takes S̃₀ to change at a constant rate within a step.
TEST(Hyperelastic, RelaxesWhileItsAxesTurn) {
  Hyperelastic law = ogden();
  law.bulk = 3e6, law.times = {{{0.3, 0.1}, {0.2, 0.4}, {0.1, 3.0}}};
  const auto stretch_at = [](double t) {
    const Tensor Q = askew(2 * t);
    return Tensor(Q * Vector(1 + t, 1 - 0.4 * t, 1 - 0.2 * t * t).asDiagonal() * Q.transpose());
  };
  const auto deviator_of = [](const Tensor& one) { return Tensor(one - one.trace() / 3 * Tensor::Identity()); };
  const auto fast_at = [&](const Tensor& U) {  // dev τ₀
    Hyperelastic alone = law;
    alone.times = {};
    return Tensor(U.determinant() * deviator_of(to_tensor(stress_at(alone, symmetric_part(U)))));
  };
  const auto pulled_back = [&](const Tensor& U) {
    return Tensor(std::pow(U.determinant(), 2.0 / 3) * U.inverse() * fast_at(U) * U.inverse());
  };
  const int steps = 100, finer = 40;
  std::array<Tensor, 3> branches{Tensor::Zero(), Tensor::Zero(), Tensor::Zero()};
  Tensor before = Tensor::Zero();
  Hyperelastic::State state;
  Symmetric stress = Symmetric::Zero();
  double worst = 0, largest = 0;
  for (int n = 1; n <= steps * finer; ++n) {
    const double fine = 1.0 / (steps * finer);
    const Tensor U = stretch_at(n * fine), now = pulled_back(U);
    for (int k = 0; k < 3; ++k) {
      const double decay = std::exp(-0.5 * fine / law.times[k].time);
      branches[k] = decay * decay * branches[k] + decay * (now - before);
    }
    before = now;
    if (n % finer != 0) continue;
    const double J = U.determinant();
    stress = law.step(PointStep{Symmetric::Zero(), 1.0 / steps, J, symmetric_part(U)}, stress, state).stress;
    Tensor expected = 0.4 * fast_at(U);
    for (int k = 0; k < 3; ++k)
      expected += law.times[k].fraction * deviator_of(std::pow(J, -2.0 / 3) * U * branches[k] * U);
    worst = std::max(worst, (J * deviator_of(to_tensor(stress)) - expected).norm());
    largest = std::max(largest, expected.norm());
  }
  EXPECT_LT(worst, 1e-3 * largest);
  EXPECT_GT(worst, 0);
}

// Sheared at a constant rate ε̇ for 1 s, in one step and in more, with times of relaxation from a thousandth of a step
// to a thousand steps: per branch s = 2G ε̇ t_k (1 − e^(−t/t_k)), energy s²/(2G), dissipation 4G ε̇² t_k ∫ (1 −
// e^(−t/t_k))². They are of first order in the strain, 1e-5. The energies follow the trapezoidal rule, as the work of a
// run does: of ∫ t² it is off by 1/(4 n²) in n steps, and they are asked of steps of a tenth of t_k at most.
TEST(Hyperelastic, RampsAreTheClosedFormInStepsOfAnyLength) {
  constexpr double rate = 1e-5, fraction = 0.95;
  for (const double time : {1e-3, 0.02, 0.1, 1.0, 1e3}) {
    for (const int steps : {1, 3, 10, 100}) {
      const Hyperelastic law{.bulk = bulk, .terms = {{{shear, 2}}}, .times = {{{fraction, time}}}};
      Hyperelastic::State state;
      Symmetric stress = Symmetric::Zero(), before{1, 1, 1, 0, 0, 0};
      for (int n = 1; n <= steps; ++n) {
        const Symmetric now{1, 1, 1, rate * n / steps, 0, 0};
        stress = law.step(step_between(before, now, 1.0 / steps), stress, state).stress;
        before = now;
      }
      const double reached = -time * std::expm1(-1 / time), branch = 2 * shear * rate * reached;
      const double squares = 1 - 2 * reached - 0.5 * time * std::expm1(-2 / time);  // ∫ (1 − e^(−t/t_k))²
      const double expected = (1 - fraction) * 2 * shear * rate + fraction * branch;
      EXPECT_NEAR(stress[3], expected, 1e-4 * expected) << time << " s, " << steps << " steps";
      if (steps * time < 10) continue;
      const double off = 2e-3 + 0.3 / (steps * steps);
      const double lost = fraction * 4 * shear * rate * rate * time * squares;
      EXPECT_NEAR(state.dissipated, lost, off * lost) << time << " s, " << steps << " steps";
      const double held = (1 - fraction) * 2 * shear * rate * rate + fraction * branch * branch / (2 * shear);
      EXPECT_NEAR(state.stored, held, off * held) << time << " s, " << steps << " steps";
    }
  }
}

// The energy after one step to twice the length is that of the stretch, ½ G (λ² + 2/λ − 3), not the work of the forces
// of the step, 6 % more: a balance shows how coarse the step was. Then held until all has relaxed that can.
TEST(Hyperelastic, EnergyIsThatOfTheStretchHoweverCoarseTheStep) {
  const Hyperelastic law{.bulk = 10e6, .terms = {{{shear, 2}}}, .times = {{{0.3, 1e3}}}};
  const double narrow = 1 / std::sqrt(2.0), energy = 0.5 * shear * (4 + 2 / 2.0 - 3);
  const Symmetric rest{1, 1, 1, 0, 0, 0}, stretch{2, narrow, narrow, 0, 0, 0};
  Hyperelastic::State state;
  Symmetric stress = law.step(step_between(rest, stretch, 1e-3), Symmetric::Zero(), state).stress;
  EXPECT_NEAR(state.stored, energy, 1e-5 * energy);
  const Hyperelastic::State begin = state;
  for (const int steps : {1000, 10, 1}) {
    state = begin;
    for (int n = 0; n < steps; ++n)
      stress = law.step(step_between(stretch, stretch, 2e4 / steps), stress, state).stress;
    EXPECT_NEAR(state.stored, 0.7 * energy, 1e-3 * energy) << steps << " steps";
    EXPECT_NEAR(state.dissipated, 0.3 * energy, 1e-3 * energy) << steps << " steps";
  }
}

// A closed cycle takes what it dissipates and what its branches still hold, and nothing without relaxation.
TEST(Hyperelastic, ClosedPathsTakeWhatTheyDissipate) {
  for (const bool relaxes : {false, true}) {
    Hyperelastic law{.bulk = 10e6, .terms = {{{shear, 2}}}};
    if (relaxes) law.times = {{{0.5, 0.05}}};
    point::Driver<Hyperelastic> point(law);
    double work = 0, most = 0;
    const int steps = 2000;
    for (int n = 0; n < steps; ++n) {
      const double rate = 0.5 * (n < steps / 2 ? 1 : -1) / steps;
      const Symmetric increment{rate, -0.3 * rate, -0.3 * rate, 0.4 * rate, 0, 0}, before = point.stress;
      const double J = std::exp(trace(point.strain));
      ASSERT_TRUE(point.advance_strain(increment, 1e-3));
      work += 0.5 *
              (J * double_dot(before, increment) + std::exp(trace(point.strain)) * double_dot(point.stress, increment));
      most = std::max(most, work);
    }
    EXPECT_NEAR(work, point.state.stored + point.state.dissipated, 1e-4 * most) << relaxes;
    EXPECT_EQ(point.state.dissipated > 0.05 * most, relaxes);
    EXPECT_LT(point.state.stored, relaxes ? 0.01 * most : 1e-6 * most);
  }
}

// With a change of volume, along axes that lie askew, also with exponents below 0 alone:
// σ_i = (τ̄_i − τ̄_m)/J + K (J − 1), τ̄_i = Σ μ_p λ̄_i^α_p. Round-off of powers up to 4.
Vector principal_stresses(const Hyperelastic& law, const Vector& stretches) {
  const double J = stretches.prod();
  Vector kirchhoff = Vector::Zero();
  for (const auto& [modulus, exponent] : law.terms) {
    for (int i = 0; i < 3; ++i) kirchhoff[i] += modulus * std::pow(stretches[i] / std::cbrt(J), exponent);
  }
  return ((kirchhoff.array() - kirchhoff.mean()) / J + law.bulk * (J - 1)).matrix();
}

TEST(Hyperelastic, IsClosedFormWithAChangeOfVolumeAlongAnyAxes) {
  const Hyperelastic falling{.terms = {{{-0.4e6, -1}, {-0.3e6, -2.5}, {-0.05e6, -4}}}};
  for (Hyperelastic law : {neo_hookean(), mooney_rivlin(), ogden(), falling}) {
    law.bulk = 3e6;
    for (const Vector& stretches :
         {Vector(1.6, 1.6, 0.7), Vector(0.5, 0.5, 1.2), Vector(2.5, 0.8, 0.45), Vector(0.7, 0.7, 0.7)}) {
      const Tensor Q = askew(0.7);
      const Tensor U = Q * stretches.asDiagonal() * Q.transpose();
      const Vector expected = principal_stresses(law, stretches);
      const Tensor stress = Q.transpose() * to_tensor(stress_at(law, symmetric_part(U))) * Q;
      EXPECT_LT((stress - Tensor(expected.asDiagonal())).norm(), 1e-12 * (law.bulk + expected.norm())) << stretches;
    }
  }
}

// Equibiaxial tension of a compressible sheet: no stress across it, so that its thickness is a root of the closed form.
TEST(Hyperelastic, SheetIsAsThickAsTheClosedForm) {
  for (Hyperelastic law : {neo_hookean(), mooney_rivlin(), ogden()}) {
    law.bulk = 2e6;
    for (const double s : {0.8, 1.5, 2.5}) {
      const auto root = [&](const auto& across) {
        double low = 0.05, high = 2;
        for (int n = 0; n < 80; ++n) (across(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
        return low;
      };
      const double thickness = root([&](double t) { return principal_stresses(law, Vector(s, s, t))[2]; });
      const double found = root([&](double t) { return stress_at(law, Symmetric{s, s, t, 0, 0, 0})[2]; });
      EXPECT_NEAR(found, thickness, 1e-12) << s;
      EXPECT_GT(std::abs(thickness * s * s - 1), 0.02) << s;  // else the volume would have been kept
    }
  }
}

// ∂σ/∂U by central differences of the law against that of the closed form along the axes, 4/3 G + K at rest.
TEST(Hyperelastic, TangentAtRestIsThatOfItsModuli) {
  const Hyperelastic law{.bulk = 5e6, .terms = {{{0.7e6, 2}, {-0.3e6, -2}}}};
  Symmetric unit = Symmetric::Zero();
  unit.head<3>().setOnes();
  const StretchTangent tangent =
      tangent_of(law, PointStep{Symmetric::Zero(), 1, 1, unit}, Symmetric::Zero(), Hyperelastic::State(), unit);
  EXPECT_NEAR(tangent(0, 0), law.moduli().longitudinal(), 1e-6 * law.bulk);
  EXPECT_NEAR(tangent(0, 1), law.bulk - 2 * law.shear() / 3, 1e-6 * law.bulk);
  EXPECT_NEAR(tangent(3, 3), 2 * law.shear(), 1e-6 * law.bulk);
}

// Far from rest, in the axes of the stretch, of a first step after which the deviator has f = γ_∞ + Σ γ_k (1 −
// e^(−x))/x, x = Δt/t_k, of itself left: σ_i = (f/J) (τ̄_i − τ̄_m) + K (J − 1), τ̄_i = Σ μ_p λ̄_i^α_p, τ̄_m their mean. With
// shears the axes turn: ∂σ_ij/∂U_ij = (σ_i − σ_j)/(λ_i − λ_j).
TEST(Hyperelastic, TangentAtLargeStretchIsThatOfTheClosedForm) {
  constexpr double dt = 0.1;
  for (Hyperelastic law : {neo_hookean(), mooney_rivlin(), ogden()}) {
    for (const bool relaxes : {false, true}) {
      law.bulk = 5e6;
      if (relaxes) law.times = {{{0.3, 0.1}, {0.2, 1.0}}};
      const double f = relaxes ? 0.5 + 0.3 * (1 - std::exp(-1)) + 2 * (1 - std::exp(-0.1)) : 1;
      const Vector stretches{2.5, 0.8, 0.45};
      const double J = stretches.prod();
      Vector kirchhoff = Vector::Zero();
      Tensor slope = Tensor::Zero();  // ∂τ̄_i/∂λ_j
      for (const auto& [modulus, exponent] : law.terms) {
        for (int i = 0; i < 3; ++i) {
          const double part = modulus * std::pow(stretches[i] / std::cbrt(J), exponent);
          kirchhoff[i] += part;
          for (int j = 0; j < 3; ++j) slope(i, j) += part * exponent * ((i == j) - 1.0 / 3) / stretches[j];
        }
      }
      const Vector sides = f / J * (kirchhoff.array() - kirchhoff.mean()).matrix();  // deviator of σ
      StretchTangent expected = StretchTangent::Zero();
      for (int j = 0; j < 3; ++j) {
        const double mean = slope.col(j).mean();
        for (int i = 0; i < 3; ++i) {
          expected(i, j) = f / J * (slope(i, j) - mean) - sides[i] / stretches[j] + law.bulk * J / stretches[j];
        }
        const int next = (j + 1) % 3;  // xy yz zx
        expected(3 + j, 3 + j) = (sides[j] - sides[next]) / (stretches[j] - stretches[next]);
      }
      Symmetric stretch = Symmetric::Zero(), unit = stretch;
      stretch.head<3>() = stretches, unit.head<3>().setOnes();
      const StretchTangent found =
          tangent_of(law, PointStep{Symmetric::Zero(), dt, J, stretch}, Symmetric::Zero(), Hyperelastic::State(), unit);
      EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-6 * expected.cwiseAbs().maxCoeff()) << relaxes;
    }
  }
}

}  // namespace
}  // namespace strut::testing
