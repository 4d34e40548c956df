// Points that are at one place are found, however they are spread over the ranks, and no others.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/parallel/communicator.hpp"
#include "topology/coincident.hpp"

namespace strut {
namespace {

// Dealt to the ranks in turn; every second one is of block "b".
struct Spread {
  const Communicator world;
  PointCloud cloud;
  std::int64_t points = 0;

  Spread() { cloud.block_names = {"a", "b"}; }
  void add(const Vector& place, double edge) {
    const std::int64_t id = points++;
    if (id % world.size() != world.rank()) return;
    cloud.ids.push_back(id), cloud.element_ids.push_back(id + 1);
    cloud.positions.push_back(place), cloud.volumes.push_back(edge * edge * edge);
    cloud.blocks.push_back(static_cast<int>(id % 2));
  }
  std::string found(const std::function<bool(int, int)>& allowed = [](int, int) { return false; }) const {
    return coincident_points(cloud, world, allowed);
  }
};

void add_lattice(Spread& spread, int n, double spacing, const Vector& origin = Vector::Zero()) {
  for (int k = 0; k < n * n * n; ++k)
    spread.add(origin + spacing * Vector(k % n, k / n % n, double(k / (n * n))), spacing);
}

TEST(Coincident, ALatticeHasNone) {
  for (const double spacing : {1.0, 1e-3, 1e-9}) {
    for (const Vector& origin : {Vector(0, 0, 0), Vector(-2.5, 7, 1e3)}) {
      Spread spread;
      add_lattice(spread, 8, spacing, spacing * origin);
      EXPECT_EQ(spread.found(), "");
    }
  }
}

// Shifted in any direction, across the faces of the cells of the search as well. The limit is a tenth of the edge.
TEST(Coincident, ATwinIsFoundUpToATenthOfTheEdge) {
  std::mt19937 random(7);
  std::normal_distribution<double> component;
  for (const double part : {0.0, 1e-6, 0.01, 0.099, 0.101, 0.5}) {
    for (int trial = 0; trial < 20; ++trial) {
      Spread spread;
      add_lattice(spread, 4, 1e-3);
      const Vector direction = Vector(component(random), component(random), component(random)).normalized();
      const int twin = static_cast<int>(random() % 64);
      spread.add(1e-3 * (Vector(twin % 4, twin / 4 % 4, double(twin / 16)) + part * direction), 1e-3);
      const std::string text = spread.found();
      const std::string names = "element 65 of block 'a' is where element " + std::to_string(twin + 1) + " of block";
      EXPECT_EQ(text.find(names) == 0, part < 0.1) << part << ": " << text;
    }
  }
}

TEST(Coincident, AWholeBodyGivenTwiceIsCounted) {
  Spread spread;
  add_lattice(spread, 5, 1e-3);
  add_lattice(spread, 5, 1e-3, Vector::Constant(1e-9));
  const std::string text = spread.found();
  EXPECT_NE(text.find("element 126 of block 'b' is where element 1 of block 'a' is"), std::string::npos) << text;
  EXPECT_NE(text.find("125 points are where others are"), std::string::npos) << text;
  EXPECT_EQ(spread.found([](int a, int b) { return a != b; }), "") << "all pairs are of two blocks";
}

// All at one place: found without a look at all pairs, or this takes minutes.
TEST(Coincident, AHundredThousandPointsAtOnePlace) {
  Spread spread;
  for (int k = 0; k < 100'000; ++k) spread.add(Vector(1, 2, 3), 1e-3);
  EXPECT_NE(spread.found().find("99999 points are where others are"), std::string::npos);
}

// A point of a coarse mesh that is where one of a mesh a thousand times as fine is, and a far coarser one elsewhere.
TEST(Coincident, SizesMayDiffer) {
  Spread spread;
  add_lattice(spread, 10, 1e-3);
  spread.add(Vector(100, 100, 100), 50);
  EXPECT_EQ(spread.found(), "");
  spread.add(Vector(4e-3, 4e-3, 4e-3), 1);
  EXPECT_NE(spread.found().find("element 1002 of block 'b' is where element 445 of"), std::string::npos)
      << spread.found();
}

// One point that is as large as a planet, or cells of the mean size would have all others in one of them.
TEST(Coincident, OneHugePointCostsNoTime) {
  Spread spread;
  add_lattice(spread, 40, 1e-3);
  spread.add(Vector(-1, -1, -1), 1e7);
  EXPECT_EQ(spread.found(), "");
}

TEST(Coincident, NoPointsAtAll) { EXPECT_EQ(Spread().found(), ""); }

}  // namespace
}  // namespace strut
