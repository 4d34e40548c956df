// Search and forces of contact on random clouds, against all pairs of all points, on any number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "contact/contact.hpp"
#include "contact/search/search.hpp"
#include "topology/partition.hpp"

namespace strut::contact {
namespace {

constexpr int count = 900;
using Id = std::int64_t;
constexpr double horizon = 0.08, skin = 0x1p-7;  // a number that a float holds
const PenaltyLaw law{.radius = 0.1, .penalty = 1e3};
const Model model{law, 0.3};

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

constexpr int side = 11;
constexpr double h = horizon / 3.1;

// A block on a lattice whose points stand at place_of(X).
template <class PlaceOf>
Scatter block_on_lattice(const PlaceOf& place_of) {
  Scatter all;
  all.cloud.block_names = {"a", "b", "c"};
  for (int i = 0; i < side * side * side; ++i) {
    const Vector X = h * Vector(i % side, i / side % side, i / (side * side));
    all.cloud.ids.push_back(i);
    all.cloud.element_ids.push_back(i + 1);
    all.cloud.positions.push_back(X);
    all.cloud.volumes.push_back(h * h * h);
    all.cloud.spacings.push_back(h);
    all.cloud.blocks.push_back(0);
    all.cloud.sets.push_back(0);
    all.places.push_back(place_of(X));
    all.velocities.push_back(Vector::Zero());
  }
  return all;
}

const std::vector<BlockBonds> bonds{{horizon, 0}, {horizon, 0}, {1.1 * horizon, 1}};

// The moved part of the body that this rank owns.
struct Part {
  Domain domain;
  std::vector<Vector> velocities;
  std::vector<double> densities;

  Kinematics kinematics() const { return {domain, velocities, densities}; }
  BlockPair blocks(int a, int b) const {
    BlockPair result{a, b, bonds[a].body == bonds[b].body, {}};
    for (int i = 0; i < domain.owned; ++i) {
      if (domain.cloud.blocks[i] == a || domain.cloud.blocks[i] == b) result.points.push_back(i);
    }
    return result;
  }
  std::vector<Vector> places(const BlockPair& blocks) const {
    std::vector<Vector> result;
    for (const int i : blocks.points) result.push_back(domain.sites[i].current.head<3>().matrix());
    return result;
  }
  Pairs pairs(int a, int b, double both_skins = skin) const {
    const BlockPair found = blocks(a, b);
    SkinDistances skins{std::vector<float>(found.points.size(), static_cast<float>(both_skins / 2)), both_skins / 2};
    return find_pairs(kinematics(), found, law.radius, skins);
  }
};

Part part_of(const Scatter& all, const Communicator& world) {
  std::vector<int> mine;
  for (int i = 0; i < static_cast<int>(all.places.size()); ++i) {
    if (i % world.size() == world.rank()) mine.push_back(i);
  }
  Part part{make_domain(partitioned(reordered(all.cloud, mine), world), bonds, world), {}, {}};
  for (int i = 0; i < part.domain.owned; ++i) {
    const auto id = static_cast<std::size_t>(part.domain.cloud.ids[i]);
    part.domain.sites[i].current.head<3>() = all.places[id].array();
    part.velocities.push_back(all.velocities[id]);
    part.densities.push_back(1000.0 + all.cloud.blocks[id]);
  }
  return part;
}

double distance(const Scatter& all, int i, int j) { return (all.places[i] - all.places[j]).norm(); }

double touching(const Scatter& all, int i, int j) {
  const bool one_body = bonds[all.cloud.blocks[i]].body == bonds[all.cloud.blocks[j]].body;
  return largest_touching_distance(law.radius, (all.cloud.positions[i] - all.cloud.positions[j]).norm(), one_body);
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

// The partners of each owned point in the lists, by id.
std::map<Id, std::vector<Id>> partners_in(const Pairs& pairs) {
  std::map<Id, std::vector<Id>> found;
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    for (std::size_t p = pairs.start[k]; p < pairs.start[k + 1]; ++p) {
      found[pairs.ids[k]].push_back(pairs.ids[pairs.partners[p]]);
    }
  }
  return found;
}

// The same of all pairs that are no farther apart than the distance at which they touch, and `more`.
std::map<Id, std::vector<Id>> partners_of(const Scatter& all, const Part& part, int a, int b, double more) {
  std::map<Id, std::vector<Id>> expected;
  for (const Id id : part.domain.cloud.ids) {
    const int i = static_cast<int>(id);
    for (int j = 0; j < static_cast<int>(all.places.size()); ++j) {
      const bool near = distance(all, i, j) <= touching(all, i, j) + more;
      if (j != i && near && belong(all, i, j, a, b) && !joined(all, i, j)) expected[id].push_back(j);
    }
  }
  return expected;
}

TEST_P(ContactOfBlocks, SearchFindsExactlyThePairsOfBruteForce) {
  const auto [a, b] = GetParam();
  const auto expected = partners_of(all, part, a, b, skin);
  EXPECT_EQ(partners_in(part.pairs(a, b)), expected);
  EXPECT_GT(world.sum(static_cast<std::int64_t>(expected.size())), 50) << "the case is too empty to mean anything";
}

// Beside brute force, how many points have a partner.
std::int64_t compare_search(const Scatter& all) {
  const Communicator world;
  const Part part = part_of(all, world);
  const auto expected = partners_of(all, part, 0, 0, skin / 4);
  EXPECT_EQ(partners_in(part.pairs(0, 0, skin / 4)), expected);
  return world.sum(static_cast<std::int64_t>(expected.size()));
}

// Bounding volumes exclude no pair: far and bonded ones in a block that is folded until its halves meet …
TEST(Contact, SearchFindsExactlyThePairsOfAFoldedBlock) {
  const Tensor turn = Eigen::AngleAxisd(0.7, Vector(1, 2, -1).normalized()).toRotationMatrix();
  const Tensor fold = Eigen::AngleAxisd(-2.6, Vector::UnitY()).toRotationMatrix();
  const Vector hinge(5.5 * h, 0, 11 * h);
  const std::int64_t with_partners = compare_search(block_on_lattice(
      [&](const Vector& X) -> Vector { return turn * (X[0] > hinge[0] ? Vector(hinge + fold * (X - hinge)) : X); }));
  EXPECT_GT(with_partners, 50);
  EXPECT_LT(with_partners, 1000) << "many points have none";
}

// … and undeformed ones in a block that is turned, and pressed at one end by as much as a touch takes, or less, or
// more.
TEST(Contact, SearchFindsExactlyThePairsOfAPressedBlock) {
  const Tensor turn = Eigen::AngleAxisd(2, Vector(1, 2, -1).normalized()).toRotationMatrix();
  const auto pressed_by = [&](double strain) {
    return compare_search(block_on_lattice([&](const Vector& X) -> Vector {
      const double length = (side - 1) * h;
      return turn * (X - strain * length / M_PI * std::sin(M_PI * X[2] / length) * Vector::UnitZ());
    }));
  };
  EXPECT_EQ(pressed_by(0.05), 0);
  EXPECT_GT(pressed_by(0.11), 10);
  EXPECT_GT(pressed_by(0.15), pressed_by(0.11));
  EXPECT_LT(pressed_by(0.15), 900) << "most clusters are undeformed";
}

// Points fly on, some much faster than the others, until one has used up its skin distance: whatever touches is in the
// lists.
TEST_P(ContactOfBlocks, NoPairIsMissedBeforeASkinIsUsedUp) {
  const auto [a, b] = GetParam();
  Scatter now = all;
  for (int i = 0; i < 3; ++i) now.velocities[i] *= 8;  // one of each block
  Part moved = part_of(now, world);
  const BlockPair blocks = moved.blocks(a, b);
  const Frame frame = frame_of(moved.kinematics(), blocks, {});
  const Vector mean = mean_velocity(moved.kinematics(), blocks, frame);
  SkinDistances skins = skin_distances_by_speed(moved.kinematics(), blocks, mean, 2 * skin, 1);
  EXPECT_GT(skins.largest, 1.1 * 2 * skin) << "none is faster";
  EXPECT_LT(std::ranges::min(skins.of), 0.9 * 2 * skin) << "none is slower";
  const auto found = partners_in(find_pairs(moved.kinematics(), blocks, law.radius, skins));
  const double t = 0.99 / world.max(largest_use(moved.kinematics(), blocks, mean, skins));
  for (int i = 0; i < count; ++i) now.places[i] += t * now.velocities[i];
  const std::vector<Vector> before = moved.places(blocks);
  moved = part_of(now, world);
  EXPECT_NEAR(part_used(moved.kinematics(), blocks, frame, before, skins), 0.99, 1e-9);
  std::int64_t gained = 0;
  for (const auto& [id, partners] : partners_of(now, moved, a, b, 0)) {
    for (const Id partner : partners) {
      const bool is_listed = found.contains(id) && std::ranges::count(found.at(id), partner) == 1;
      EXPECT_TRUE(is_listed) << id << " and " << partner;
      gained += distance(all, static_cast<int>(id), static_cast<int>(partner)) >
                touching(all, static_cast<int>(id), static_cast<int>(partner));
    }
  }
  EXPECT_GT(world.sum(gained), 4) << "nothing new has come to touch";
}

// Points with partners that move together use up no skin distance, whatever the others do.
TEST_P(ContactOfBlocks, TheFrameIsThatOfPointsWithPartners) {
  const auto [a, b] = GetParam();
  const BlockPair blocks = part.blocks(a, b);
  const Pairs found = part.pairs(a, b);
  const Vector together(3, -1, 2);
  std::vector<Vector> velocities(part.velocities.size(), Vector(-5, 5, 5));
  for (const int i : found.owned) velocities[i] = together;
  const Kinematics moving{part.domain, velocities, part.densities};
  EXPECT_TRUE(mean_velocity(moving, blocks, frame_of(moving, blocks, found)).isApprox(together));
  const Vector of_all = mean_velocity(part.kinematics(), blocks, frame_of(part.kinematics(), blocks, {}));
  EXPECT_LT(of_all.norm(), 0.2) << "speeds are up to a half, and any";
}

TEST_P(ContactOfBlocks, ForcesAreThoseOfBruteForceAndAddUpToNothing) {
  const auto [a, b] = GetParam();
  Pairs pairs = part.pairs(a, b);
  std::vector<Vector> density(part.domain.owned, Vector::Zero()), friction;
  std::vector<Load> loads;
  const ForceResult result = add_normal_forces(part.kinematics(), 0, law, pairs, density, loads);
  double energy = 0, scale = 0;
  std::vector<double> sums(11, 0);
  for (int i = 0; i < part.domain.owned; ++i) {
    const int id = static_cast<int>(part.domain.cloud.ids[i]);
    Vector expected = Vector::Zero();
    for (int j = 0; j < count; ++j) {
      const double d = distance(all, id, j), r = touching(all, id, j);
      if (j == id || d >= r || !belong(all, id, j, a, b) || joined(all, id, j)) continue;
      const auto of = [&](int n) {
        return 18 * law.penalty / (M_PI * std::pow(bonds[all.cloud.blocks[n]].horizon, 5));
      };
      const double k = 0.5 * (of(id) + of(j)) * all.cloud.volumes[id] * all.cloud.volumes[j];
      expected += k * (r - d) * (all.places[id] - all.places[j]) / d;
      energy += 0.25 * k * (r - d) * (r - d);
    }
    const Vector force = density[i] * part.domain.volume(i);
    scale = std::max(scale, expected.norm());
    EXPECT_NEAR((force - expected).norm(), 0, 1e-12 * expected.norm()) << "point " << id;
    for (int c = 0; c < 3; ++c) sums[c] += force[c];
  }
  EXPECT_NEAR(result.energy, energy, 1e-12 * energy);
  Couples couples;
  couples.take(part.domain, pairs.owned);
  std::vector<Vector> rubbed(part.domain.owned, Vector::Zero());
  add_friction(part.kinematics(), law, model.friction, 1e-3, pairs, loads, couples, rubbed, friction);
  for (const Vector& f : friction) sums[6] += f.norm();
  for (int i = 0; i < part.domain.owned; ++i) {
    const Vector f = part.domain.volume(i) * rubbed[i], torque = part.domain.current(i).cross(f);
    for (int c = 0; c < 3; ++c) sums[3 + c] += f[c], sums[7 + c] += torque[c];
    sums[10] += f.dot(part.velocities[i]);
  }
  const auto counted = [&](int i, const Vector& f) { sums[10] -= f.dot(part.velocities[i]); };
  for (std::size_t k = 0; k < friction.size(); ++k) counted(pairs.owned[k], friction[k]);
  couples.for_each_force(counted);
  scale = world.max(scale);
  world.sum(sums);
  EXPECT_GT(sums[6], 0.01 * scale) << "no friction to speak of";
  // Round-off of a sum over all points: of forces, of torques in a cube of 1 m, of work that is counted.
  for (const int c : {0, 1, 2, 3, 4, 5, 7, 8, 9, 10}) EXPECT_NEAR(sums[c], 0, count * 1e-15 * scale) << c;
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
  std::vector<Load> loads;
  const double bound = world.max(add_normal_forces(part.kinematics(), 0, law, pairs, density, loads).stiffness);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(count, count);  // block 0 has every third point
  for (int i = 0; i < count; i += 3) {
    for (int j = 0; j < count; j += 3) {
      if (i == j || !belong(all, i, j, 0, 0) || joined(all, i, j)) continue;
      if (distance(all, i, j) >= touching(all, i, j)) continue;
      const Vector n = (all.places[j] - all.places[i]).normalized();
      const double k = penalty_stiffness(law.penalty, horizon) * all.cloud.volumes[i] * all.cloud.volumes[j];
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
