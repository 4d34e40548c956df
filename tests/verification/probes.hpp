// Shared by several tests of a body: whether it stays bounded at a time step, and the linearized operator of a wave.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/errors.hpp"
#include "integrators/explicit/central_difference.hpp"
#include "larger.hpp"
#include "lattice.hpp"

namespace strut {

// Random velocities, the same on any number of ranks.
void throw_apart(Body& body, double speed);

// True if noise stays bounded over a thousand steps of `factor` times the estimated limit.
bool stays_bounded(Body body, double factor);

// Kv/ρ of the linearized operator for the field v(i), owned points.
template <class OfPoint>
std::vector<Vector> operator_on(Body& body, OfPoint&& field) {
  advance_stress_and_force(body, 0, false);
  std::vector<Site> directions = body.domain.sites;
  for (int i = 0; i < body.owned(); ++i) directions[i].current.head<3>() = field(i).array();
  ForceStates scratch = body.force_states;
  std::vector<Vector> result(body.owned());
  apply_tangent(body, body.domain.halo, directions, nullptr, scratch, result);
  for (int i = 0; i < body.owned(); ++i) result[i] /= body.density[i];
  return result;
}

// The operator on direction · cos(wave · X), deep inside the lattice, is closed_form(i) · cos(wave · X).
template <class ClosedForm>
void expect_dispersion(Body& body, const LatticeSpec& spec, const Vector& direction, const Vector& wave,
                       ClosedForm&& closed_form) {
  const Communicator& world = body.domain.communicator;
  const auto phase = [&](int i) { return std::cos(wave.dot(body.domain.reference(i))); };
  const std::vector<Vector> result = operator_on(body, [&](int i) -> Vector { return direction * phase(i); });
  double scale = 0;
  int deep = 0;
  const double error = largest_over(body, [&](int i) {
    if (!is_deep(spec, body.domain.reference(i), 3 * spec.horizon)) return 0.0;
    ++deep;
    const Vector expected = closed_form(i);
    scale = larger(scale, expected.norm());
    return (result[i] - expected * phase(i)).norm();
  });
  EXPECT_GT(world.sum(static_cast<std::int64_t>(deep)), 20);
  EXPECT_LT(error, 1e-11 * world.max(scale));  // sums of 80 terms, twice
}

// A pulse of half-width 1.
double pulse(double x);

void run_until(CentralDifference& solver, double final_time);

// Collective. The root mean square error of the displacement along x over that of the exact one, of the points that
// count.
template <class Exact, class Counts>
double displacement_error(const Body& body, Exact&& exact, Counts&& counts) {
  double sums[2] = {0, 0};
  for (int i = 0; i < body.owned(); ++i) {
    if (!counts(i)) continue;
    const double expected = exact(body.domain.reference(i)[0]);
    sums[0] += std::pow(body.displacement(i)[0] - expected, 2);
    sums[1] += expected * expected;
  }
  body.domain.communicator.sum(sums);
  return std::sqrt(sums[0] / sums[1]);
}

}  // namespace strut
