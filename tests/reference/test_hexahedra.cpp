// Explicit hexahedra against closed forms of a metal that flows.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "hexahedra.hpp"

namespace strut::reference {
namespace {

const IdealMetal metal = {70e9, 0.33, 2700, 200e6};
constexpr double edge = 1e-3;

// A row of cubes along x, so many that the last side is not full; all nodes are held.
Impact row(int cubes, const std::function<Vector(const Vector&)>& velocity, double duration) {
  Impact impact{{edge, {}, {}}, {}, {}, duration};
  for (int i = 0; i <= cubes; ++i) {
    for (int c = 0; c < 4; ++c) {
      impact.body.nodes.push_back(edge * Vector(i, c & 1, c >> 1));
      impact.velocities.push_back(velocity(impact.body.nodes.back()));
      impact.held.push_back({4 * i + c, impact.velocities.back()});
    }
  }
  for (int i = 0; i < cubes; ++i) {
    impact.body.voxels.push_back({4 * i, 4 * i + 4, 4 * i + 1, 4 * i + 5, 4 * i + 2, 4 * i + 6, 4 * i + 3, 4 * i + 7});
  }
  return impact;
}

double work_of(const Impact& impact, double hourglass, double& time) {
  Hexahedra hexahedra(impact, metal, hourglass);
  for (time = 0; time < impact.duration;) time += hexahedra.step();
  return hexahedra.work();
}

// Uniaxial strain e = ln(l/l₀): −σ = (λ + 2μ) |e| until 2μ |e| = σ_y, then K |e| + 2 σ_y/3. Bulk viscosity adds what it
// does, 0.06 ρ c h ė, a thousandth here.
TEST(Hexahedra, TakeTheWorkOfUniaxialStrainThatFlows) {
  constexpr int cubes = 11;
  constexpr double rate = -2e2;  // 1/s
  const double mu = metal.young / (2 * (1 + metal.poisson)), bulk = metal.young / (3 * (1 - 2 * metal.poisson));
  for (const double hourglass : {0.0, 0.05}) {
    double time = 0;
    const Impact impact = row(
        cubes, [](const Vector& x) { return Vector(rate * x[0], 0, 0); }, 2e-4);
    const double work = work_of(impact, hourglass, time);
    const double strain = -std::log1p(rate * time), yielding = metal.yield_stress / (2 * mu);
    double expected = 0;
    constexpr int parts = 10000;
    for (int k = 0; k < parts; ++k) {
      const double e = strain * (k + 0.5) / parts;
      const double stress = e < yielding ? (bulk + 4 * mu / 3) * e : bulk * e + 2 * metal.yield_stress / 3;
      expected += stress * std::exp(-e) * strain / parts;
    }
    EXPECT_GT(strain, 5 * yielding);
    EXPECT_NEAR(work, expected * cubes * edge * edge * edge, 2e-3 * work) << hourglass;
  }
}

// A rigid turn about z by unit circles in small steps does no work on a body without stress: what is left is the second
// order of a step, (ω dt)² of the strain, squared in the energy.
TEST(Hexahedra, TurnWithoutStress) {
  for (const double hourglass : {0.0, 0.05}) {
    double time = 0;
    const Impact impact = row(
        3, [](const Vector& x) { return Vector(-x[1], x[0], 0); }, 1e-4);
    const double work = work_of(impact, hourglass, time);
    EXPECT_LT(std::abs(work), 1e-9 * metal.yield_stress * 3 * edge * edge * edge);
  }
}

}  // namespace
}  // namespace strut::reference
