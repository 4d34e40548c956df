// The tip of a crack in the history: of a damage that is known, and its speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "output/crack_tip.hpp"
#include "verification/breaking.hpp"

namespace strut {
namespace {

constexpr double spacing = 1e-3, horizon = 3.015e-3;
const LatticeSpec plate{{16, 8, 6},        spacing,
                        horizon / spacing, 0,
                        Influence::one,    {2440, elastic(72e9, 0.2), NoStabilization(), Formulation::ordinary}};

// The half above the plane z = 3 mm, up to x, which is torn off the rest.
bool is_torn(const Vector& X, double x) { return X[2] > 3e-3 && X[0] < x; }

Body torn_plate(double x, const Communicator& world) {
  LatticeSpec spec = plate;
  spec.material.damage = DamageModel{Function(1.0)};
  Body body = lattice_body(spec, world);
  Fracture fracture(body);
  advance_stress(body, 0, false, 0, &fracture);
  deform(body, fracture, [&](const Vector& X) -> Vector { return X + Vector(0, 0, is_torn(X, x) ? 0.1 : 0); });
  advance_stress(body, 1e-9, false, 1e-9, &fracture);
  return body;
}

// By counting: of all points whose share of neighbors across the tear is above `damage` the farthest along a direction.
double farthest(double x, double damage, const Vector& direction, const Vector& start) {
  std::vector<Vector> places;
  for (int n = 0; n < plate.cells.prod(); ++n) {
    const int i = n % plate.cells[0], j = n / plate.cells[0] % plate.cells[1], k = n / plate.cells[0] / plate.cells[1];
    places.push_back(spacing * Vector(i + 0.5, j + 0.5, k + 0.5));
  }
  double most = 0;
  for (const Vector& X : places) {
    int all = 0, across = 0;
    for (const Vector& Y : places) {
      if (Y == X || (Y - X).norm() > horizon) continue;
      ++all;
      across += is_torn(X, x) != is_torn(Y, x);
    }
    if (across > damage * all) most = std::max(most, direction.dot(X - start));
  }
  return most;
}

TEST(CrackTip, IsTheFarthestDamagedPoint) {
  const Communicator world;
  const Vector oblique = Vector(3, 0, -4) / 5, start(2e-3, 1e-3, 4e-3);
  for (const double x : {0.0, 4e-3, 9e-3}) {
    const Body body = torn_plate(x, world);
    for (const double damage : {0.2137, 0.3541, 0.6173}) {  // no share of a few neighbors
      for (const Vector& direction : {Vector(Vector::UnitX()), oblique, Vector(-Vector::UnitX())}) {
        const CrackTip tip({"tear", direction, start, damage, "block", 2}, body);
        // The same places, rounded the same or once more.
        EXPECT_NEAR(world.max(tip.local(body)), farthest(x, damage, direction, start), 1e-17) << x << " " << damage;
      }
    }
  }
  EXPECT_GT(farthest(9e-3, 0.35, Vector::UnitX(), start), 5e-3);
}

// A tear that grows by a spacing in each microsecond: also its tip does, whatever the damage that it is told by.
TEST(CrackTip, SpeedIsThatOfTheTear) {
  const Communicator world;
  CrackTip tip({"tear", Vector::UnitX(), Vector::Zero(), 0.35, "all", 4}, torn_plate(0, world));
  for (int n = 4; n <= 11; ++n) {
    const Body body = torn_plate(n * spacing, world);
    tip.take(n * 1e-6, world.max(tip.local(body)));
  }
  EXPECT_NEAR(tip.speed() / 1000, 1, 1e-12);  // round-off of places over that of four steps
}

TEST(CrackTip, SpeedIsTheSlopeOfTheLastRows) {
  const Communicator world;
  const Body body = torn_plate(0, world);
  const deck::WatchedCrack watched{"tear", Vector::UnitX(), Vector::Zero(), 0.35, "all", 7};
  CrackTip tip(watched, body);
  EXPECT_EQ(tip.speed(), 0);
  tip.take(-100, 50);  // not among the last seven
  EXPECT_EQ(tip.speed(), 0);
  for (int n = 0; n <= 6; ++n) tip.take(n, n / 3);
  EXPECT_EQ(tip.tip(), 2);
  EXPECT_NEAR(tip.speed(), 9.0 / 28, 1e-15);  // Σ (t − 3) x / Σ (t − 3)², of x = 0, 0, 0, 1, 1, 1, 2

  Snapshot snapshot;
  Archive saving = Archive::saving_to(snapshot);
  tip.serialize(saving);
  CrackTip other(watched, body);
  Archive loading = Archive::loading_from(snapshot);
  other.serialize(loading);
  for (CrackTip* one : {&tip, &other}) one->take(10, 4);
  EXPECT_EQ(other.speed(), tip.speed());
  EXPECT_EQ(other.tip(), 4);
}

TEST(CrackTip, IsRefusedWhereThereCanBeNone) {
  const Communicator world;
  const auto refused = [&](const Body& body, const std::string& node_set, const std::string& problem) {
    try {
      const CrackTip tip({"tear", Vector::UnitX(), Vector::Zero(), 0.35, node_set, 7}, body);
      ADD_FAILURE() << "no error: " << problem;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(problem), std::string::npos) << error.what();
    }
  };
  refused(lattice_body(plate, world), "all", "History > Cracks > tear: no bonds can break here; expected a block with");
  refused(torn_plate(0, world), "blok",
          "History > Cracks > tear > Node Set: there is no node set or block 'blok' (did you mean 'block'?)");
}

}  // namespace
}  // namespace strut
