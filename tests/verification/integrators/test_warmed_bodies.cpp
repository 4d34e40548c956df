// Points whose temperature is prescribed: closed forms of free and of clamped bodies in equilibrium, and the balance of
// energy while they move, in each formulation.
#include <gtest/gtest.h>

#include <cmath>

#include "conditions/prototype.hpp"
#include "integrators/explicit/central_difference.hpp"
#include "verification/each_formulation.hpp"
#include "verification/larger.hpp"
#include "verification/loading.hpp"

namespace strut {
namespace {

constexpr double alpha = 2e-5, bulk = young / (3 * (1 - 2 * poisson));  // 1/K, Pa

class Warmed : public ::testing::TestWithParam<Case> {
 protected:
  LatticeSpec spec(materials::AnyLaw law = elastic(young, poisson)) const {
    LatticeSpec spec = lattice_of({4, 5, 6}, std::move(law));
    spec.material.formulation = GetParam().formulation;
    spec.material.stabilization = GetParam().stabilization;
    spec.material.thermal_expansion = alpha;
    spec.families = GetParam().families;
    return spec;
  }
  bool adds_up() const { return GetParam().formulation == Formulation::ordinary; }
};

std::vector<int> all_points(const Body& body) {
  return points_where(body, [](const Vector&) { return true; });
}

void warm(Body& body, const std::string& temperature) {
  PrescribedTemperature{Function::parse(temperature)}.set_initial_state(all_points(body), 0, body);
  set_reference_temperatures(body, 0);
}

// Held at three layers of points along their normals: each point moves by ε from there, and there is no stress.
TEST_P(Warmed, FreeBodyGrowsWithoutStress) {
  Loaded loaded(spec());
  loaded.guide();
  loaded.hold(layer(loaded.body, loaded.spec, 2, false), Vector::UnitZ());
  warm(loaded.body, "293 + 500*t");
  QuasiStatic solver = loaded.solver({.load_steps = 4});
  const Ledger end = load(solver);
  const double strain = 0.01;
  const Body& body = loaded.body;
  EXPECT_LT(largest_over(body, [&](int i) { return std::abs(body.expansion[i].now - strain); }), 1e-15);
  // Equilibria are found to 1e-6 of the forces that a held body would have, and each of the four load steps, and the
  // softest motions of a body, add to that.
  EXPECT_LT(largest_over(body,
                         [&](int i) {
                           const Vector X = body.domain.reference(i) - Vector::Constant(0.5 * spacing);
                           return (body.displacement(i) - strain * X).norm();
                         }),
            1e-5 * strain * 6 * spacing);
  const double whole = 4.5 * bulk * strain * strain * 120 * std::pow(spacing, 3);  // if nothing gave way
  EXPECT_LT(std::abs(end.elastic), 1e-9 * whole);
  EXPECT_LT(std::abs(end.external), 1e-7 * whole);  // forces that are left, times the growth
}

// Where every point is held the elastic stretch is 1/(1 + ε): the pressure is 3K ln(1 + ε), 3K ε of the ordinary solid,
// and what the body stores is what its expansion gave.
TEST_P(Warmed, ClampedBodyIsUnderPressure) {
  Loaded loaded(spec());
  for (int c = 0; c < 3; ++c) loaded.move(all_points(loaded.body), c, "0");
  warm(loaded.body, "293 + 500*t");
  QuasiStatic solver = loaded.solver({.load_steps = 20});
  const Ledger end = load(solver);
  const double whole = adds_up() ? 0.01 : std::log1p(0.01), energy = 4.5 * bulk * whole * whole * 120e-9;
  // By rates twenty mid-points of the logarithm err by (Δε)²/12 of it, 2e-8, and its work likewise.
  const double of_steps = adds_up() ? 1e-12 : 1e-6;
  EXPECT_NEAR(end.elastic, energy, of_steps * energy);
  EXPECT_NEAR(end.external, energy,
              (adds_up() ? 1e-12 : 1.3e-5) * energy);  // the trapezoid of the pull, see test_expansion
  const Body& body = loaded.body;
  EXPECT_LT(largest_over(body,
                         [&](int i) {
                           const Symmetric& stress = body.points[i].stress;
                           double error = stress.tail<3>().norm();
                           for (int c = 0; c < 3; ++c) error = larger(error, std::abs(stress[c] + 3 * bulk * whole));
                           return adds_up() || GetParam().formulation == Formulation::quadratic ? 0.0 : error;
                         }),
            of_steps * 3 * bulk * whole);
}

// Fast, unevenly, and with one end held: what the expansion gives is what the body stores and carries.
TEST_P(Warmed, FastExpansionKeepsTheBalance) {
  Loaded loaded(spec());
  for (int c = 0; c < 3; ++c) loaded.move(layer(loaded.body, loaded.spec, 2, false), c, "0");
  warm(loaded.body, "293 + 200*sin(1e5*t)*(1 + 100*x)");
  CentralDifference solver(loaded.body, loaded.conditions, std::move(loaded.contact), {.safety_factor = 0.4}, 0);
  double largest = 0;
  Ledger now;
  for (;;) {
    solver.advance_velocity(6e-5);
    now = solver.ledger();
    largest = larger(largest, std::abs(now.gained) / now.largest);
    if (solver.time() >= 6e-5) break;
    solver.advance_position(true);
  }
  EXPECT_GT(now.kinetic, 0.01 * now.external);
  EXPECT_GT(now.elastic, 0.01 * now.external);
  // The error falls with the square of the step; a period of the temperature has about a hundred steps.
  EXPECT_LT(largest, 2e-2);
}

INSTANTIATE_TEST_SUITE_P(By, Warmed, each_formulation, [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace strut
