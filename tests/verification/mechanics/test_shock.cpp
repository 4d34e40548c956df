// A plane shock beside the Hugoniot, p = ρ₀ U_s u, v = 1 − u/U_s, U_s = c₀ + s u, with 50 points across a plate.
#include <gtest/gtest.h>

#include <numeric>

#include "integrators/explicit/central_difference.hpp"
#include "verification/probes.hpp"

namespace strut {
namespace {

constexpr double density = 8930, sound = 3940, slope = 1.49, thick = 10e-3;  // copper; m
constexpr int layers = 50;
constexpr double spacing = thick / layers;

materials::ShockJ2 fluid() {
  const materials::SoftenedFlow flow{{1e6, materials::NoHardening{}, materials::NoRate{}}, materials::NoSoftening{}};
  return {{.bulk = density * sound * sound, .shear = 47.7e9, .flow = flow, .heating = {density * 383, 0.9, 295}},
          materials::MieGruneisen{density, sound, slope, 1.96}};
}

// A column through the plate, nine points a layer, that cannot widen; its first layer stands still.
// The stabilization keeps the points of a layer abreast, which a fluid does not.
struct Plate {
  Communicator world;
  LatticeSpec spec{
      {3, 3, layers}, spacing,
      1.75,           0,
      Influence::one, {density, fluid(), MeanGradientStabilization{1}, Formulation::correspondence, {0.5, 1.5}}};
  Body body = lattice_body(spec, world);
  Conditions conditions;

  explicit Plate(double speed) {
    std::vector<int> all(body.owned()), wall;
    std::iota(all.begin(), all.end(), 0);
    for (const int i : all) {
      const bool stands = body.domain.reference(i)[2] < spacing;
      if (stands) wall.push_back(i);
      body.velocity[i] = stands ? Vector::Zero() : Vector(0, 0, -speed);
    }
    conditions.add(SymmetryPlane{all, Vector::UnitX(), 0});
    conditions.add(SymmetryPlane{all, Vector::UnitY(), 1});
    conditions.add(SymmetryPlane{wall, Vector::UnitZ(), 2});
  }

  materials::ShockJ2::State state(int i) const { return body.blocks[0].state_of<materials::ShockJ2>(i); }
  double pressure(int i) const { return -trace(body.points[i].stress) / 3; }

  // Collective; over the layers between two parts of the thickness, as the body was.
  template <class Value>
  double mean(double from, double to, Value&& value) const {
    double sums[2] = {0, 0};
    for (int i = 0; i < body.owned(); ++i) {
      const double z = body.domain.reference(i)[2] / thick;
      if (z > from && z < to) sums[0] += value(i), sums[1] += 1;
    }
    world.sum(sums);
    return sums[0] / sums[1];
  }

  // The reference place up to which the pressure is at least half of the shock's, from the mean of each layer.
  double front(double shock) const {
    double last = shock;
    for (int layer = 0; layer < layers; ++layer) {
      const double p = mean(layer / double{layers}, (layer + 1) / double{layers}, [&](int i) { return pressure(i); });
      const double place = (layer + 0.5) * spacing;
      if (layer > 3 && p < 0.5 * shock) return place - spacing * (0.5 * shock - p) / (last - p);
      last = p;
    }
    return thick;
  }
};

// One per cent: what 50 points across leave of the shock's thickness, five points.
TEST(Shock, IsTheHugoniot) {
  for (const double u : {100.0, 500.0}) {
    const double speed = sound + slope * u, shock = density * speed * u;
    Plate plate(u);
    CentralDifference solver(plate.body, plate.conditions, {}, {0, 0.3}, 0);
    run_until(solver, 0.4 * thick / speed);
    const double early = plate.front(shock), start = solver.time();
    run_until(solver, 0.75 * thick / speed);
    EXPECT_NEAR((plate.front(shock) - early) / (solver.time() - start), speed, 0.01 * speed) << u;
    const double p = plate.mean(0.25, 0.5, [&](int i) { return plate.pressure(i); });
    const double v = plate.mean(0.25, 0.5, [&](int i) { return plate.state(i).volume; });
    const double e = plate.mean(0.4, 0.6, [&](int i) { return plate.state(i).energy; });
    EXPECT_NEAR(p, shock, 0.01 * shock) << u;
    EXPECT_NEAR(1 - v, u / speed, 0.01 * u / speed) << u;
    // Heat of the shock's start stays at the wall (Noh 1987): 20 % in the first layers, 8 % and 4 % here.
    EXPECT_NEAR(e, 0.5 * density * u * u, 0.1 * 0.5 * density * u * u) << u;
    solver.advance_velocity(1);
    solver.advance_position(true);
    solver.advance_velocity(1);
    EXPECT_LT(solver.ledger().balance_error, 1e-3) << u;
  }
}

}  // namespace
}  // namespace strut
