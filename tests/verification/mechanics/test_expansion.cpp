// Stress and energy of points whose temperature is prescribed, in each formulation: a body that grows by 1 + ε has
// none, one that is held is under the pressure of the closed form, and all that it stores came from its expansion.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/energies.hpp"
#include "verification/each_formulation.hpp"
#include "verification/larger.hpp"
#include "verification/lattice.hpp"

namespace strut {
namespace {

constexpr double young = 1e9, poisson = 0.3, bulk = young / (3 * (1 - 2 * poisson));  // Pa, -, Pa
constexpr double alpha = 2e-5, spacing = 1e-3;                                        // 1/K, m

class Expansion : public ::testing::TestWithParam<Case> {
 protected:
  Body body(const std::string& temperature) const {
    LatticeSpec spec{{4, 5, 6}, spacing, 1.75};
    spec.material = {.density = 1000,
                     .law = elastic(young, poisson),
                     .stabilization = GetParam().stabilization,
                     .formulation = GetParam().formulation};
    spec.material.thermal_expansion = alpha;
    spec.families = GetParam().families;
    Body body = lattice_body(spec, world);
    std::vector<int> all(body.owned());
    for (int i = 0; i < body.owned(); ++i) all[i] = i;
    add_heated(body, {all, Function::parse(temperature)});
    set_reference_temperatures(body, 0);
    return body;
  }
  bool adds_up() const { return GetParam().formulation == Formulation::ordinary; }

  Communicator world;
};

// To t = 1 in steps; `place` has the positions at a time.
double go(Body& body, int steps, const std::function<Vector(const Vector&, double)>& place) {
  double forces = 0;
  advance_stress_and_force(body, 0, true);
  for (int n = 1; n <= steps; ++n) {
    const double t = static_cast<double>(n) / steps;
    deform(body, [&](const Vector& X) { return place(X, t); });
    advance_stress(body, 1.0 / steps, true, t);
    sum_forces(body, true);
    forces = larger(forces, largest_over(body, [&](int i) { return body.force_density[i].norm(); }));
  }
  return forces;
}

TEST_P(Expansion, GrowthWithoutStress) {
  Body warmed = body("293 + 500*t*t");
  const double forces = go(warmed, 7, [](const Vector& X, double t) { return Vector((1 + 0.01 * t * t) * X); });
  // Round-off of places, 1e-16 of 6 spacings, makes strains of 1e-15, which cancel in part; the fits of cells take
  // second differences of the places, which have ten times as much.
  const double round_off = GetParam().formulation == Formulation::quadratic ? 1e-11 : 1e-12;
  EXPECT_LT(forces, round_off * young / spacing);
  EXPECT_LT(largest_over(warmed, [&](int i) { return std::abs(warmed.expansion[i].now - 0.01); }), 1e-15);
  const Energies energies = stored_energies(warmed);
  const double held = 4.5 * bulk * 1e-4 * 120 * std::pow(spacing, 3);
  EXPECT_LT(std::abs(energies.elastic), round_off * held);
  EXPECT_LT(std::abs(energies.expansion), round_off * held);
}

// The elastic stretch is 1/(1 + ε); of the ordinary solid extensions add up.
TEST_P(Expansion, PressureOfAHeldBody) {
  Body warmed = body("293 + 500*t");
  go(warmed, 20, [](const Vector& X, double) { return X; });
  const double whole = adds_up() ? 0.01 : std::log1p(0.01), volume = 120 * std::pow(spacing, 3);
  const double energy = 4.5 * bulk * whole * whole * volume;
  const Energies energies = stored_energies(warmed);
  // By rates twenty mid-points of the logarithm err by (Δε)²/12 of it, 2e-8; the trapezoid of the pull
  // 9 K ln(1 + ε)/(1 + ε) by (Δε)²/(2 ε) of the work, 1.25e-5.
  EXPECT_NEAR(energies.elastic, energy, (adds_up() ? 1e-12 : 1e-6) * energy);
  EXPECT_NEAR(energies.expansion, energy, (adds_up() ? 1e-12 : 1.3e-5) * energy);
}

// An arbitrary motion and an uneven temperature: the work of the forces on the points and that of the expansion are
// what the body stores. By the mean of both ends of a step, so that the error falls with its square.
TEST_P(Expansion, GivesWhatIsStored) {
  const auto error = [&](int steps) {
    Body warmed = body("293 + 300*t*(1 + 200*x - 100*z*t)");
    const auto place = [](const Vector& X, double t) {
      return Vector(X + t * Vector(2 * X[1] * X[2], 3 * X[0] * X[0] - 0.002 * X[1], 0.004 * X[2] + X[0] * X[1]));
    };
    advance_stress_and_force(warmed, 0, true);
    double work = 0;
    for (int n = 1; n <= steps; ++n) {
      const double t = static_cast<double>(n) / steps;
      const std::vector<Vector> before = *warmed.force_density;
      std::vector<Vector> way(warmed.owned());
      for (int i = 0; i < warmed.owned(); ++i) way[i] = -warmed.current(i);
      deform(warmed, [&](const Vector& X) { return place(X, t); });
      advance_stress(warmed, 1.0 / steps, true, t);
      sum_forces(warmed, true);
      for (int i = 0; i < warmed.owned(); ++i) {
        way[i] += warmed.current(i);
        work -= 0.5 * warmed.domain.volume(i) * way[i].dot(before[i] + warmed.force_density[i]);
      }
    }
    work = world.sum(work);
    const Energies now = stored_energies(warmed);
    const double stored = now.elastic + now.stabilization;
    EXPECT_GT(std::abs(now.expansion), 0.1 * stored);
    return std::abs(stored - work - now.expansion) / stored;
  };
  // A hypoelastic law stores the energy of its strain only to the first order of the strain, which is 1 %.
  EXPECT_LT(error(40), adds_up() ? 1e-4 : 2e-2);
  if (adds_up()) {
    EXPECT_NEAR(error(10) / error(40), 16, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(By, Expansion, each_formulation,
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace strut
