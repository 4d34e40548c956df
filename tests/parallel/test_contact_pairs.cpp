// Search and forces of contact on random clouds, against all pairs of all points, on any number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "contact/contact.hpp"
#include "points/partition.hpp"

namespace strut::contact {
namespace {

constexpr int count = 900;
constexpr double horizon = 0.08, skin = 0.01;
const Model model{.radius = 0.1, .penalty = 1e3, .friction = 0.3};

// Points of three blocks in a unit cube, in two bodies, moved at random so that many come near. All points on all
// ranks.
struct Scatter {
  PointCloud cloud;
  std::vector<Vector> places, velocities;
};

Scatter scatter() {
  Scatter all;
  all.cloud.block_names = {"a", "b", "c"};
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> in(0, 1);
  const auto vector = [&] { return Vector(in(engine), in(engine), in(engine)); };
  for (int i = 0; i < count; ++i) {
    all.cloud.ids.push_back(i);
    all.cloud.element_ids.push_back(i + 1);
    all.cloud.positions.push_back(vector());
    all.cloud.volumes.push_back(1e-4 * (1 + in(engine)));
    all.cloud.spacings.push_back(std::cbrt(all.cloud.volumes.back()));
    all.cloud.blocks.push_back(i % 3);
    all.cloud.sets.push_back(0);
    all.places.push_back(all.cloud.positions.back() + 0.05 * vector());
    all.velocities.push_back(vector() - Vector::Constant(0.5));
  }
  return all;
}

const std::vector<BlockBonds> bonds{{horizon, 0}, {horizon, 0}, {1.1 * horizon, 1}};

// What this rank owns of it, moved.
struct Part {
  Domain domain;
  std::vector<Site> sites;
  std::vector<Vector> velocities;
  std::vector<double> densities;

  Crowd crowd() const { return {domain, sites, velocities, densities}; }
  Parties parties(int a, int b) const {
    Parties result{a, b, bonds[a].body == bonds[b].body, {}};
    for (int i = 0; i < domain.owned; ++i) {
      if (domain.cloud.blocks[i] == a || domain.cloud.blocks[i] == b) result.points.push_back(i);
    }
    return result;
  }
  Pairs pairs(int a, int b) const {
    const Parties found = parties(a, b);
    Skins skins{std::vector<float>(found.points.size(), skin / 2), skin / 2};
    return find_pairs(crowd(), found, model, skins);
  }
};

Part part_of(const Scatter& all, const Communicator& world) {
  std::vector<int> mine;
  for (int i = 0; i < count; ++i) {
    if (i % world.size() == world.rank()) mine.push_back(i);
  }
  Part part{make_domain(partitioned(reordered(all.cloud, mine), world), bonds, world), {}, {}, {}};
  for (int i = 0; i < part.domain.owned; ++i) {
    const auto id = static_cast<std::size_t>(part.domain.cloud.ids[i]);
    Site site;
    site.reference << all.cloud.positions[id].array(), all.cloud.volumes[id];
    site.current << all.places[id].array(), bonds[all.cloud.blocks[id]].horizon;
    part.sites.push_back(site);
    part.velocities.push_back(all.velocities[id]);
    part.densities.push_back(1000.0 + all.cloud.blocks[id]);
  }
  return part;
}

double distance(const Scatter& all, int i, int j) { return (all.places[i] - all.places[j]).norm(); }

double touching(const Scatter& all, int i, int j) {
  const bool one_body = bonds[all.cloud.blocks[i]].body == bonds[all.cloud.blocks[j]].body;
  return touching_distance(model.radius, (all.cloud.positions[i] - all.cloud.positions[j]).norm(), one_body);
}

bool joined(const Scatter& all, int i, int j) {
  const BlockBonds &a = bonds[all.cloud.blocks[i]], &b = bonds[all.cloud.blocks[j]];
  return a.body == b.body && (all.cloud.positions[i] - all.cloud.positions[j]).norm() <= 0.5 * (a.horizon + b.horizon);
}

bool belong(const Scatter& all, int i, int j, int a, int b) {
  return std::minmax(all.cloud.blocks[i], all.cloud.blocks[j]) == std::minmax(a, b);
}

class ContactOfBlocks : public ::testing::TestWithParam<std::pair<int, int>> {
 protected:
  const Communicator world;
  const Scatter all = scatter();
  const Part part = part_of(all, world);
};

TEST_P(ContactOfBlocks, SearchFindsExactlyThePairsOfBruteForce) {
  const auto [a, b] = GetParam();
  Pairs pairs = part.pairs(a, b);
  std::map<int, std::vector<int>> found;
  std::vector<double> ids(pairs.sites.size());  // of the pairs' sites, by a search for their places
  for (std::size_t s = 0; s < pairs.sites.size(); ++s) {
    const Vector place = pairs.sites[s].current.head<3>().matrix();
    ids[s] = std::find(all.places.begin(), all.places.end(), place) - all.places.begin();
  }
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    for (std::size_t p = pairs.start[k]; p < pairs.start[k + 1]; ++p) {
      found[static_cast<int>(ids[k])].push_back(static_cast<int>(ids[pairs.partners[p]]));
    }
  }
  std::int64_t total = 0;
  for (int i = 0; i < part.domain.owned; ++i) {
    const int id = static_cast<int>(part.domain.cloud.ids[i]);
    std::vector<int> expected;
    for (int j = 0; j < count; ++j) {
      const bool near = distance(all, id, j) <= touching(all, id, j) + skin;
      if (j != id && near && belong(all, id, j, a, b) && !joined(all, id, j)) expected.push_back(j);
    }
    total += static_cast<std::int64_t>(expected.size());
    EXPECT_EQ(found[id], expected) << "point " << id;
  }
  EXPECT_GT(world.sum(total), 50) << "the case is too empty to mean anything";
}

TEST_P(ContactOfBlocks, ForcesAreThoseOfBruteForceAndAddUpToNothing) {
  const auto [a, b] = GetParam();
  Pairs pairs = part.pairs(a, b);
  std::vector<Vector> density(part.domain.owned, Vector::Zero()), friction;
  const Tally tally = add_normal_forces(part.crowd(), model, pairs, density);
  double energy = 0, scale = 0;
  std::vector<double> sums(7, 0);
  for (int i = 0; i < part.domain.owned; ++i) {
    const int id = static_cast<int>(part.domain.cloud.ids[i]);
    Vector expected = Vector::Zero();
    for (int j = 0; j < count; ++j) {
      const double d = distance(all, id, j), r = touching(all, id, j);
      if (j == id || d >= r || !belong(all, id, j, a, b) || joined(all, id, j)) continue;
      const double delta = 0.5 * (bonds[all.cloud.blocks[id]].horizon + bonds[all.cloud.blocks[j]].horizon);
      const double k = 18 * model.penalty / (M_PI * std::pow(delta, 5)) * all.cloud.volumes[id] * all.cloud.volumes[j];
      expected += k * (r - d) * (all.places[id] - all.places[j]) / d;
      energy += 0.25 * k * (r - d) * (r - d);
    }
    const Vector force = density[i] * part.domain.volumes[i];
    scale = std::max(scale, expected.norm());
    EXPECT_NEAR((force - expected).norm(), 0, 1e-12 * expected.norm()) << "point " << id;
    for (int c = 0; c < 3; ++c) sums[c] += force[c];
  }
  EXPECT_NEAR(tally.energy, energy, 1e-12 * energy);
  add_friction(part.crowd(), model, 1e-3, pairs, density, friction);
  for (const Vector& f : friction) {
    for (int c = 0; c < 3; ++c) sums[3 + c] += f[c];
    sums[6] += f.norm();
  }
  scale = world.max(scale);
  world.sum(sums);
  EXPECT_GT(sums[6], 0.01 * scale) << "no friction to speak of";
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(sums[c], 0, count * 1e-15 * scale);  // round-off of a sum over all points
}

INSTANTIATE_TEST_SUITE_P(Blocks, ContactOfBlocks,
                         ::testing::Values(std::pair(0, 0), std::pair(0, 1), std::pair(2, 1), std::pair(2, 2)));

// The bound of ω² holds: it is not less than the largest eigenvalue of M⁻¹K of the touching pairs, which are springs
// along their directions.
TEST(Contact, BoundOfTheStiffnessHolds) {
  const Communicator world;
  const Scatter all = scatter();
  const Part part = part_of(all, world);
  Pairs pairs = part.pairs(0, 0);
  std::vector<Vector> density(part.domain.owned, Vector::Zero());
  const double bound = world.max(add_normal_forces(part.crowd(), model, pairs, density).stiffness);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(count, count);  // block 0 has every third point
  for (int i = 0; i < count; i += 3) {
    for (int j = 0; j < count; j += 3) {
      if (i == j || !belong(all, i, j, 0, 0) || joined(all, i, j)) continue;
      if (distance(all, i, j) >= touching(all, i, j)) continue;
      const Vector n = (all.places[j] - all.places[i]).normalized();
      const double k = penalty_stiffness(model.penalty, horizon) * all.cloud.volumes[i] * all.cloud.volumes[j];
      const Tensor spring = k * n * n.transpose();
      const double mi = 1000 * all.cloud.volumes[i], mj = 1000 * all.cloud.volumes[j];
      K.block<3, 3>(i, i) += spring / mi;
      K.block<3, 3>(i, j) -= spring / std::sqrt(mi * mj);
    }
  }
  const double largest =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  EXPECT_GE(bound, largest);
  EXPECT_LT(bound, 2 * largest);  // and it is worth something
}

}  // namespace
}  // namespace strut::contact
