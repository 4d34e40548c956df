// Families and ghosts with periodic sides: those of the infinite body, on any number of ranks.
#include <gtest/gtest.h>

#include <random>

#include "base/parallel/communicator.hpp"
#include "topology/domain.hpp"
#include "topology/partition.hpp"
#include "verification/add_point.hpp"

namespace strut {
namespace {

const Vector size(2, 1, 0.5);  // m, of the box; it repeats along x and y

PointCloud random_cloud(int count, const Communicator& world) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 1);
  PointCloud cloud;
  cloud.block_names = {"block"};
  for (int id = 0; id < count; ++id) {
    const double x = place(random), y = place(random), z = place(random);
    if (world.rank() > 0) continue;
    add_point(cloud, id, size.cwiseProduct(Vector(x, y, z)), 1, 0.1);
  }
  return cloud;
}

std::vector<Period> periods() { return {{0, size[0], 0, Function(1)}, {1, size[1], 1, Function(1)}}; }

// All places of the neighbors of each point, by a search over all points of 25 periods.
TEST(Periods, FamiliesAreThoseOfTheInfiniteBody) {
  const Communicator world;
  constexpr int count = 300;
  constexpr double horizon = 0.27;
  std::vector<Vector> all(count, Vector::Zero());
  const Domain domain =
      make_domain(partitioned(random_cloud(count, world), world), {BlockBonds(horizon)}, world, {}, {}, periods());
  for (int i = 0; i < domain.owned; ++i) all[domain.id(i)] = domain.reference(i);
  world.sum(std::span(all[0].data(), 3 * all.size()));
  std::int64_t bonds = 0, across = 0;
  for (int i = 0; i < domain.owned; ++i) {
    std::vector<Vector> expected, found;
    for (int j = 0; j < count; ++j) {
      for (int n = 0; n < 25; ++n) {
        const Vector X = all[j] + size.cwiseProduct(Vector(n % 5 - 2, n / 5 - 2, 0));
        const double distance = (X - domain.reference(i)).norm();
        if (distance > 0 && distance <= (1 + 1e-4) * horizon) expected.push_back(X);
      }
    }
    domain.families.for_each(i, [&](int j) {
      found.push_back(domain.reference(j));
      EXPECT_LT((domain.reference(j) - all[Images::original(domain.id(j))]).array().abs().matrix()[2], 1e-15);
      across += Images::image(domain.id(j)) > 0 ? 1 : 0;
    });
    const auto before = [](const Vector& a, const Vector& b) {
      return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    };
    std::sort(expected.begin(), expected.end(), before), std::sort(found.begin(), found.end(), before);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_LT((found[k] - expected[k]).norm(), 1e-14);
    bonds += static_cast<std::int64_t>(found.size());
  }
  EXPECT_GT(world.sum(across), 500);
  EXPECT_EQ(world.sum(bonds) % 2, 0);  // both ends have a bond
}

// Images follow the originals, and the sides when these move.
TEST(Periods, ImagesAreWhereTheStretchedSidesPutThem) {
  const Communicator world;
  Domain domain =
      make_domain(partitioned(random_cloud(200, world), world), {BlockBonds(0.3)}, world, {}, {}, periods());
  const Vector stretch(1.1, 0.8, 1);
  const auto moved = [](const Vector& X) { return Vector(X + 0.01 * Vector(X[1], X[2], X[0] * X[0])); };
  std::vector<Vector> all(200, Vector::Zero());
  for (int i = 0; i < domain.owned; ++i) {
    domain.sites[i].current.head<3>() = moved(domain.reference(i)).array();
    all[domain.id(i)] = domain.reference(i);
  }
  world.sum(std::span(all[0].data(), 3 * all.size()));
  domain.halo.set_stretch(stretch);
  domain.halo.exchange_positions(domain.sites);
  for (int g = domain.owned; g < domain.owned + domain.ghosts; ++g) {
    const Vector original = all[Images::original(domain.id(g))];
    const Vector shift = domain.reference(g) - original;  // whole periods
    EXPECT_LT((domain.current(g) - moved(original) - stretch.cwiseProduct(shift)).norm(), 1e-14);
  }
}

// Two layers with one cell between them: bonds run through the side where material does, though a
// joint is another node there.
TEST(Periods, BondsRunThroughTheMaterialAtTheSides) {
  const Communicator world;
  PointCloud cloud;
  cloud.block_names = {"block"};
  cloud.has_shared_nodes = true;
  const std::vector<Mirror> sides{{.on = Vector::Zero(), .normal = Vector::UnitX(), .bit = 0, .period = 4},
                                  {.on = 4 * Vector::UnitX(), .normal = -Vector::UnitX(), .bit = 0, .period = 4}};
  const auto solid = [](int x, int z) {
    return z != 1 || x == 0;
  };  // three layers; in the middle one cell of four, at the lower side
  for (int n = 0; n < 12; ++n) {
    const int x = n % 4, z = n / 4;
    if (world.rank() > 0 || !solid(x, z)) continue;
    add_point(cloud, n, {x + 0.5, 0.5, z + 0.5}, 1, 1);
    cloud.shapes.emplace_back();
    std::vector<std::int64_t>& nodes = cloud.shared_nodes.emplace_back();
    for (int corner = 0; corner < 8; ++corner) {
      const Vector X(x + corner % 2, corner / 2 % 2, z + corner / 4);
      nodes.push_back(shared_node_at(X, std::lround(X[0] + 10 * X[1] + 100 * X[2]), sides, 1));
    }
    std::sort(nodes.begin(), nodes.end());
  }
  BlockBonds bonds(2.1);
  bonds.visible_only = true;
  bonds.families = FamilyKind::lists;
  const Domain domain =
      make_domain(partitioned(std::move(cloud), world), {bonds}, world, {}, {}, {{0, 4, 0, Function(1)}});
  for (int i = 0; i < domain.owned; ++i) {
    // In a layer 2 on either side. From layer to layer (distances 1, √2 and 2) only by the cell between, which touches
    // those beside it, x = 3 through the side: it and the one on its other side.
    const int x = static_cast<int>(domain.id(i)) % 4, z = static_cast<int>(domain.id(i)) / 4;
    const std::size_t expected = z == 1 ? 6 : x == 2 ? 4 : 6;
    EXPECT_EQ(domain.families.size(i), expected) << domain.id(i);
  }
}

// Nine periods around one point: it is its own neighbor, 8 times along two axes.
TEST(Periods, APointMayBeItsOwnNeighbor) {
  const Communicator world;
  PointCloud cloud;
  cloud.block_names = {"block"};
  for (int z = 0; world.rank() == 0 && z < 3; ++z) {
    add_point(cloud, z, {0.5, 0.5, z + 0.5}, 1, 1);
  }
  const std::vector<Period> periods{{0, 1, 0, Function(1)}, {1, 1, 1, Function(1)}};
  const Domain domain = make_domain(partitioned(std::move(cloud), world), {BlockBonds(1.5)}, world, {}, {}, periods);
  for (int i = 0; i < domain.owned; ++i) {
    EXPECT_EQ(domain.families.size(i), domain.id(i) == 1 ? 8u + 2 * 5 : 8u + 5);  // |ξ| ≤ 1.5: 4 corners are at 1.73
  }
}

}  // namespace
}  // namespace strut
