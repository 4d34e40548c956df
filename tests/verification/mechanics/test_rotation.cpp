// A rigid rotation must leave no stress and no force, however far it goes.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "base/math/rotation.hpp"
#include "verification/larger.hpp"
#include "verification/lattice.hpp"

namespace strut {
namespace {

Tensor turned(double angle, const Vector& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

Tensor next_rotation(const Tensor& R, const Tensor& F) {
  small::Tensor3<double> old, gradient;
  for (int k = 0; k < 9; ++k) old.c[k / 3][k % 3] = R(k / 3, k % 3), gradient.c[k / 3][k % 3] = F(k / 3, k % 3);
  const auto next = polar_update(old, gradient).rotation;
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(next.c[0]);
}

TEST(Rotation, FullTurnLeavesNoStress) {
  const Communicator world;
  const double young = 110e9;
  LatticeSpec spec{{6, 6, 7}, 1e-3,           2.5,
                   0.1,       Influence::one, {8960, elastic(young, 0.296), SillingStabilization{0.02}}};
  Body body = lattice_body(spec, world);
  const int steps = 72;  // of 5°
  for (int n = 1; n <= steps; ++n) {
    const Tensor Q = turned(2 * M_PI * n / steps, {1, 2, -0.5});
    deform(body, [&](const Vector& X) -> Vector { return Q * X; });
    const StepReport report = advance_stress_and_force(body, 1e-6, n == steps);
    ASSERT_FALSE(report.failure);
    ASSERT_LT(largest_over(body, [&](int i) { return (body.points[i].rotation.tensor() - Q).norm(); }), 1e-12);
  }
  // 72 additions of round-off (1e-14 of strain each) times the modulus.
  EXPECT_LT(largest_over(body, [&](int i) { return body.points[i].stress.norm(); }), 1e-12 * young);
  EXPECT_LT(std::abs(stored_energies(body).stabilization), 1e-12 * young * std::pow(6e-3, 3));
}

TEST(Rotation, StressTurnsWithTheBody) {
  // Stretched first, then turned: the unrotated stress stays, the Cauchy stress turns.
  const Communicator world;
  LatticeSpec spec{{5, 5, 5}, 1.0, 2.015, 0, Influence::one, {1000, elastic(1e9, 0.25)}};
  Body body = lattice_body(spec, world);
  const Tensor stretch = Vector(1.01, 0.995, 1.002).asDiagonal();
  deform(body, [&](const Vector& X) -> Vector { return stretch * X; });
  advance_stress_and_force(body, 1e-6, false);
  const std::vector<MaterialPoint> before = body.points;
  for (int n = 1; n <= 90; ++n) {
    const Tensor Q = turned(M_PI * n / 90, {0.3, -1, 0.8});
    deform(body, [&](const Vector& X) -> Vector { return Q * stretch * X; });
    advance_stress_and_force(body, 1e-6, false);
  }
  // The Newton step for a turn of 2° at stretches that differ by 1 % leaves about (0.03 × 0.01)² of strain in transit;
  // it does not add up over the 90 steps.
  EXPECT_LT(largest_over(body, [&](int i) { return (body.points[i].stress - before[i].stress).norm(); }), 1e-7 * 1e9);
}

// Simple shear F = I + γ e₁⊗e₂: tan θ = −γ/2 about e₃ in closed form.
TEST(Rotation, LongSimpleShearFollowsThePolarDecomposition) {
  Tensor R = Tensor::Identity();
  const int steps = 1000;
  double largest = 0;
  for (int n = 1; n <= steps; ++n) {
    const double gamma = 10.0 * n / steps;
    Tensor F = Tensor::Identity();
    F(0, 1) = gamma;
    R = next_rotation(R, F);
    largest = larger(largest, (R - turned(-std::atan(gamma / 2), {0, 0, 1})).norm());
  }
  // One Newton step from the last rotation: the error is of the order of the square of the turn of a step (5e-3)² and
  // does not add up.
  EXPECT_LT(largest, 2.5e-5);
  EXPECT_LT((R - turned(-std::atan(5.0), {0, 0, 1})).norm(), 1e-9);  // it has caught up where the turning is slow
  EXPECT_LT((R.transpose() * R - Tensor::Identity()).norm(), 1e-12);
}

// ---- The step form against Flanagan & Taylor's rate form, on F = I + t A from 0 to 1 s ----------------------------

Vector axial(const Tensor& a) { return {a(2, 1) - a(1, 2), a(0, 2) - a(2, 0), a(1, 0) - a(0, 1)}; }

// One step of the rate form: ω = w − [V − (tr V) I]⁻¹ z with V at the start of the step, then the Cayley transform.
Tensor rate_form(const Tensor& R, const Tensor& F, const Tensor& next_F, double dt) {
  const Tensor L = (next_F - F) / dt * (0.5 * (F + next_F)).inverse();
  const Tensor V = F * R.transpose(), D = 0.5 * (L + L.transpose());
  const Tensor defect = V.trace() * Tensor::Identity() - V;
  const Vector h = 0.5 * dt * (0.5 * axial(L) + defect.inverse() * axial(D * V));
  return turned(2 * std::atan(h.norm()), h) * R;
}

struct Distances {
  double rate_form, step_form;  // of R from the polar decomposition at the end
};

Distances distances(int steps) {
  Tensor A;
  A << 0.3, 1.2, -0.4, 0.2, -0.5, 0.7, 0.9, -0.3, 0.6;
  Tensor by_rate = Tensor::Identity(), by_step = by_rate, F = by_rate;
  for (int n = 1; n <= steps; ++n) {
    const Tensor next = Tensor::Identity() + A * n / steps;
    by_rate = rate_form(by_rate, F, next, 1.0 / steps);
    by_step = next_rotation(by_step, next);
    F = next;
  }
  const Eigen::JacobiSVD<Tensor> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Tensor polar = svd.matrixU() * svd.matrixV().transpose();
  return {(by_rate - polar).norm(), (by_step - polar).norm()};
}

TEST(Rotation, StepFormIsCloserThanRateForm) {
  for (const int steps : {100, 200, 400}) {
    const Distances d = distances(steps);
    std::printf("%d steps: rate form %.1e, step form %.1e from the polar rotation\n", steps, d.rate_form, d.step_form);
    EXPECT_LT(d.step_form, 1e-4 * d.rate_form);
  }
  // The rate form is of first order: a check that the rival here is the published one and not a broken copy.
  EXPECT_NEAR(distances(200).rate_form / distances(400).rate_form, 2, 0.1);
}

TEST(Rotation, RigidTurnBelow90DegreesIsExactInOneStep) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector axis(uniform(engine), uniform(engine), uniform(engine));
    const Tensor Q = turned(0.49 * M_PI * uniform(engine), axis);
    EXPECT_LT((next_rotation(Tensor::Identity(), Q) - Q).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace strut
