// Elastic waves against closed forms: the dispersion of the discrete operator, and a pulse along a bar.
#include <gtest/gtest.h>

#include "integrators/explicit/central_difference.hpp"
#include "verification/probes.hpp"

namespace strut {
namespace {

// ---- The discrete operator on a plane wave u = e cos(k·X): exact sums over one family ------------------------------
// With g = Σ ω V sin(k·ξ) ξ and s = Σ ω V (1 − cos k·ξ):
//   ρ ω² e = (C : e ⊗ q) q  +  C₀ (2 s − g·q) e  +  C̄ Σ ω V (2 sin(k·ξ/2) − q·ξ cos(k·ξ/2))² e,   q = K⁻¹g
// (C₀, C̄: the stabilizations, Silling's and by the mean gradient)

struct Lattice {
  LatticeSpec spec{
      {19, 19, 19}, 1.0, 2.515, 0, Influence::linear_decay, {1000, elastic(1e9, 0.2), SillingStabilization{0.05}}};
  Vector direction{1, 0.4, -0.2}, wave{0.5, 0.8, 0.3};
};

Vector closed_form(const Lattice& l, const Body& body, int i) {
  Vector g = Vector::Zero();
  double s = 0;
  Tensor K = Tensor::Zero();
  const auto for_each_bond = [&](auto visit) {
    body.domain.families.for_each(i, [&](int j) {
      const Vector xi = body.domain.reference(j) - body.domain.reference(i);
      visit(xi, (1 - xi.norm() / l.spec.horizon) * body.domain.volume(j));
    });
  };
  for_each_bond([&](const Vector& xi, double weight) {
    g += weight * std::sin(l.wave.dot(xi)) * xi;
    s += weight * (1 - std::cos(l.wave.dot(xi)));
    K += weight * xi * xi.transpose();
  });
  const auto& law = std::get<materials::Elastic>(l.spec.material.law);
  const Vector q = K.inverse() * g;
  const Tensor strain = 0.5 * (l.direction * q.transpose() + q * l.direction.transpose());
  const Tensor stress = 2 * law.shear * strain + (law.bulk - 2 * law.shear / 3) * strain.trace() * Tensor::Identity();
  double squares = 0;
  for_each_bond([&](const Vector& xi, double weight) {
    const double phase = l.wave.dot(xi) / 2;
    squares += weight * std::pow(2 * std::sin(phase) - q.dot(xi) * std::cos(phase), 2);
  });
  const double unit = law.moduli().longitudinal() / (K.trace() / 3);
  const Stabilization& stabilization = l.spec.material.stabilization;
  const bool by_mean = residual_of(stabilization) == ResidualKind::both_gradients;
  const double held = coefficient_of(stabilization) * (by_mean ? squares : 2 * s - g.dot(q));
  return (stress * q + unit * held * l.direction) / l.spec.material.density;
}

TEST(Waves, DispersionOfTheOperator) {
  const Communicator world;
  Lattice l;
  for (const bool by_mean : {false, true}) {
    if (by_mean) l.spec.material.stabilization = MeanGradientStabilization{0.1};
    Body body = lattice_body(l.spec, world);
    expect_dispersion(body, l.spec, l.direction, l.wave, [&](int i) { return closed_form(l, body, i); });
  }
}

// ---- A pulse along a bar with ν = 0: d'Alembert, c = √(E/ρ) --------------------------------------------------------

// The root mean square error of the displacement over the pulse's own, after it has split and traveled half a bar.
double pulse_error(int cells, const Communicator& world) {
  const double young = 1e9, density = 1000, speed = std::sqrt(young / density), length = 1, width = 0.2;
  LatticeSpec spec{{cells, 3, 3},  length / cells,
                   2.015,          0,
                   Influence::one, {density, elastic(young, 0.0), SillingStabilization{0.02}}};
  Body body = lattice_body(spec, world);
  const double amplitude = 1e-6, center = 0.5 * length;
  const auto start = [&](double x) { return amplitude * pulse((x - center) / width); };
  deform(body, [&](const Vector& X) -> Vector { return X + Vector(start(X[0]), 0, 0); });
  advance_stress_and_force(body, 1e-9, false);  // a hypoelastic law must be told the way to the initial state
  CentralDifference solver(body, {}, {}, {0, 0.5}, 0);
  const double way = 0.25 * length;
  run_until(solver, way / speed);
  const auto exact = [&](double x) { return 0.5 * (start(x - way) + start(x + way)); };
  return displacement_error(body, exact, [](int) { return true; });
}

TEST(Waves, PulseAlongABarConvergesInSecondOrder) {
  const Communicator world;
  const double coarse = pulse_error(50, world), fine = pulse_error(100, world);
  EXPECT_LT(fine, 0.06);  // ten points over the half-width of the pulse, m = 2
  EXPECT_GT(std::log2(coarse / fine), 1.7) << coarse << " " << fine;  // order 2 less what the coarse one still lacks
}

}  // namespace
}  // namespace strut
