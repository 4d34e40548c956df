// Partition, families and halo against a search over all pairs, on any number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <ostream>
#include <random>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "topology/domain.hpp"
#include "topology/neighbors/lattice.hpp"
#include "topology/partition.hpp"

namespace strut {
namespace {

using Id = std::int64_t;
using Pair = std::pair<Id, Id>;

// Points whose places are random but the same on all ranks.
struct Case {
  int count;
  std::vector<double> horizons;  // of the blocks, m; or in local spacings of the points
  int seed;
  bool in_spacings = false;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.count << " points, " << c.horizons.size() << " horizons";
}

PointCloud whole_cloud(const Case& c) {
  std::mt19937 random(c.seed);
  std::uniform_real_distribution<double> place(0, 1);
  PointCloud cloud;
  cloud.at = PointsAt::nodes;  // not the default, so that its loss shows
  cloud.set_names = {"left"};
  for (std::size_t b = 0; b < c.horizons.size(); ++b) cloud.block_names.push_back("block_" + std::to_string(b));
  for (int id = 0; id < c.count; ++id) {
    const double x = place(random), y = place(random), z = place(random);
    cloud.ids.push_back(id);
    cloud.element_ids.push_back(10 * id + 3);
    cloud.positions.emplace_back(2 * x, y, 0.5 * z);
    cloud.volumes.push_back(1e-3 + id);
    cloud.spacings.push_back(0.05 + 0.1 * z);
    cloud.blocks.push_back(static_cast<int>(x * static_cast<double>(c.horizons.size())));  // they touch at a plane
    cloud.sets.push_back(x < 0.3 ? 1 : 0);
  }
  return cloud;
}

constexpr double round_off_of_files = 1e-4;  // neighbors are as far as a horizon, and by this part of it farther

// The slice of a rank, as a reader delivers it.
PointCloud slice(const PointCloud& whole, const Communicator& world) {
  std::vector<int> mine;
  const auto n = static_cast<int>(whole.size());
  for (int i = n * world.rank() / world.size(); i < n * (world.rank() + 1) / world.size(); ++i) mine.push_back(i);
  return reordered(whole, mine);
}

Domain domain_of(const Case& c, const Communicator& world) {
  std::vector<BlockBonds> bonds;
  for (const double h : c.horizons) bonds.push_back(c.in_spacings ? BlockBonds::per_spacing(h) : BlockBonds(h));
  return make_domain(partitioned(slice(whole_cloud(c), world), world), bonds, world);
}

double horizon_of(const Case& c, const PointCloud& whole, Id id) {
  return c.horizons[whole.blocks[id]] * (c.in_spacings ? whole.spacings[id] : 1);
}

// The ids of owned points and ghosts, by local index: what the halo brings says who a ghost is.
std::vector<Id> ids_of(Domain& domain) {
  std::vector<Id> values = domain.cloud.ids;
  values.resize(domain.owned + domain.ghosts, -1);
  domain.halo.exchange(values);
  return values;
}

std::set<Pair> brute_force(const Case& c) {
  const PointCloud cloud = whole_cloud(c);
  std::set<Pair> pairs;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (std::size_t j = 0; j < cloud.size(); ++j) {
      const double horizon = 0.5 * (horizon_of(c, cloud, i) + horizon_of(c, cloud, j));
      if (i != j && (cloud.positions[i] - cloud.positions[j]).norm() <= (1 + round_off_of_files) * horizon)
        pairs.emplace(i, j);
    }
  }
  return pairs;
}

// The bonds of all ranks, on every rank, each as often as it was found.
std::vector<Pair> all_bonds(const Domain& domain, const std::vector<Id>& ids, const Communicator& world) {
  std::vector<Id> mine;
  for (int i = 0; i < domain.owned; ++i) {
    domain.families.for_each(i, [&](int j) { mine.insert(mine.end(), {ids[i], ids[j]}); });
  }
  std::vector<Id> all = gather(world, std::span<const Id>(mine));
  world.broadcast(all);
  std::vector<Pair> bonds;
  for (std::size_t k = 0; k < all.size(); k += 2) bonds.emplace_back(all[k], all[k + 1]);
  return bonds;
}

const Case dense = {600, {0.25, 0.12}, 1};

class DomainOf : public testing::TestWithParam<Case> {
 protected:
  const Communicator world;
  const PointCloud whole = whole_cloud(GetParam());
  Domain domain = domain_of(GetParam(), world);
  const std::vector<Id> ids = ids_of(domain);
};

TEST_P(DomainOf, EveryPointHasOneOwnerAndKeepsWhatItIs) {
  std::vector<Id> all = gather(world, std::span<const Id>(domain.cloud.ids));
  if (world.rank() == 0) {
    std::sort(all.begin(), all.end());
    EXPECT_EQ(all, whole.ids);
  }
  ASSERT_EQ(domain.owned, static_cast<int>(domain.cloud.size()));
  for (int i = 0; i < domain.owned; ++i) {
    const Id id = domain.cloud.ids[i];
    EXPECT_EQ(domain.cloud.element_ids[i], whole.element_ids[id]);
    EXPECT_EQ(domain.reference(i), whole.positions[id]);
    EXPECT_EQ(domain.volume(i), whole.volumes[id]);
    EXPECT_EQ(domain.cloud.spacings[i], whole.spacings[id]);
    EXPECT_EQ(domain.cloud.blocks[i], whole.blocks[id]);
    EXPECT_EQ(domain.cloud.sets[i], whole.sets[id]);
  }
  EXPECT_EQ(domain.cloud.at, whole.at);
  EXPECT_EQ(domain.cloud.block_names, whole.block_names);
  EXPECT_EQ(domain.cloud.set_names, whole.set_names);
}

TEST_P(DomainOf, FamiliesAreThoseOfASearchOverAllPairs) {
  const std::vector<Pair> bonds = all_bonds(domain, ids, world);
  const std::set<Pair> distinct(bonds.begin(), bonds.end());
  EXPECT_EQ(distinct.size(), bonds.size());  // none twice
  EXPECT_EQ(distinct, brute_force(GetParam()));
}

TEST_P(DomainOf, FamiliesAreSymmetric) {
  const std::vector<Pair> bonds = all_bonds(domain, ids, world);
  const std::set<Pair> distinct(bonds.begin(), bonds.end());
  for (const auto& [i, j] : distinct) EXPECT_TRUE(distinct.contains({j, i})) << i << " " << j;
}

// Sums over a family must not depend on who owns its members.
TEST_P(DomainOf, FamiliesAreInTheOrderOfIds) {
  for (int i = 0; i < domain.owned; ++i) {
    Id last = -1;
    domain.families.for_each(i, [&](int j) {
      EXPECT_LT(last, ids[j]);
      last = ids[j];
    });
  }
}

TEST_P(DomainOf, GhostsAreWhatTheirOwnersSay) {
  const std::set<Id> own(domain.cloud.ids.begin(), domain.cloud.ids.end());
  std::set<Id> seen;
  ASSERT_EQ(domain.sites.size(), ids.size());
  for (std::size_t g = domain.owned; g < ids.size(); ++g) {
    ASSERT_GE(ids[g], 0) << "the halo brings nothing";
    EXPECT_FALSE(own.contains(ids[g]));
    EXPECT_TRUE(seen.insert(ids[g]).second) << "twice";
    EXPECT_EQ(domain.reference(g), whole.positions[ids[g]]);
    EXPECT_EQ(domain.volume(g), whole.volumes[ids[g]]);
    EXPECT_EQ(domain.horizon(g), horizon_of(GetParam(), whole, ids[g]));
  }
  if (world.size() == 1) {
    EXPECT_EQ(domain.ghosts, 0);
  }
}

TEST_P(DomainOf, InteriorPointsNeedNoGhostAndTheOthersDo) {
  std::vector<char> used(domain.ghosts, 0);
  for (int i = 0; i < domain.owned; ++i) {
    bool has_ghost = false;
    domain.families.for_each(i, [&](int j) {
      ASSERT_GE(j, 0);
      ASSERT_LT(j, domain.owned + domain.ghosts);
      if (j < domain.owned) return;
      has_ghost = true;
      used[j - domain.owned] = 1;
    });
    EXPECT_EQ(has_ghost, i >= domain.interior) << i;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0) << "ghosts that nobody needs";
}

TEST_P(DomainOf, SmallestAndLargestHorizonOfABlockAreThoseOfAllRanks) {
  for (std::size_t b = 0; b < whole.block_names.size(); ++b) {
    double smallest = 0, largest = 0;
    for (std::size_t id = 0; id < whole.size(); ++id) {
      if (whole.blocks[id] != static_cast<int>(b)) continue;
      const double horizon = horizon_of(GetParam(), whole, static_cast<Id>(id));
      smallest = largest == 0 ? horizon : std::min(smallest, horizon);
      largest = std::max(largest, horizon);
    }
    EXPECT_EQ(domain.blocks[b].smallest, smallest);
    EXPECT_EQ(domain.blocks[b].largest, largest);
  }
}

// The halo exchanges only the positions of sites; their other numbers stay.
TEST_P(DomainOf, HaloMovesThePlacesAndNoOthers) {
  const auto place = [](Id id, int round) { return Vector(static_cast<double>(id), 0.5 * round, -1); };
  for (Site& site : domain.sites) site.current[3] = -7;
  for (int i = 0; i < domain.owned; ++i) domain.sites[i].current[3] = 7;
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < domain.owned; ++i) domain.sites[i].current.head<3>() = place(ids[i], round).array();
    domain.halo.exchange_positions(domain.sites);
    for (int i = 0; i < domain.owned + domain.ghosts; ++i) {
      EXPECT_EQ(domain.current(i), place(ids[i], round));
      EXPECT_EQ(domain.sites[i].horizon(), i < domain.owned ? 7 : -7);
    }
  }
}

// Values that are no whole number of doubles arrive whole.
TEST_P(DomainOf, HaloMovesValuesOfAnySize) {
  struct Mark {
    Id id;
    char letter;
  };
  std::vector<std::array<char, 3>> letters(domain.owned + domain.ghosts);
  std::vector<Mark> marks(domain.owned + domain.ghosts);
  const auto letter = [](Id id) { return static_cast<char>('a' + id % 26); };
  for (int i = 0; i < domain.owned; ++i) {
    letters[i] = {letter(ids[i]), letter(ids[i] + 1), letter(ids[i] + 2)};
    marks[i] = {ids[i], letter(ids[i])};
  }
  domain.halo.exchange<unchanged>(letters);
  domain.halo.exchange<unchanged>(marks);
  for (int i = domain.owned; i < domain.owned + domain.ghosts; ++i) {
    EXPECT_EQ(letters[i], (std::array{letter(ids[i]), letter(ids[i] + 1), letter(ids[i] + 2)}));
    EXPECT_EQ(marks[i].id, ids[i]);
    EXPECT_EQ(marks[i].letter, letter(ids[i]));
  }
}

TEST_P(DomainOf, SpreadIsThatOfAllPairs) {
  const std::set<Pair> pairs = brute_force(GetParam());
  for (int i = 0; i < domain.owned; ++i) {
    Tensor spread = Tensor::Zero();
    for (auto pair = pairs.lower_bound({ids[i], -1}); pair != pairs.end() && pair->first == ids[i]; ++pair) {
      const Vector xi = whole.positions[pair->second] - whole.positions[pair->first];
      spread += whole.volumes[pair->second] * xi * xi.transpose();
    }
    // Both sum in the order of ids, but the compiler may contract one and not the other: some roundings.
    EXPECT_LE((family_spread(domain, i) - spread).norm(), 1e-14 * spread.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Points, DomainOf,
                         testing::Values(dense, Case{600, {1.5, 2.5}, 7, true}, Case{600, {0.12, 0.25}, 2},
                                         Case{500, {0.2}, 3}, Case{40, {0.3, 0.3}, 4},  // some without a neighbor
                                         Case{3, {1.0}, 5},                             // fewer points than ranks
                                         Case{1, {1.0}, 6}),
                         [](const auto& info) { return "Case" + std::to_string(info.index); });

// Sums by stencils and by lists round differently: all numbers of ranks must find the same lattices. Layers along y lie
// 2, 3 and 2 spacings apart, and of four ranks none has two of them.
TEST(Lattice, IsFoundThoughNoRankSeesItsSpacing) {
  const Communicator world;
  const std::array<double, 4> layers{0, 2, 5, 7};
  PointCloud cloud;
  cloud.block_names = {"block_1"};
  for (std::size_t y = world.rank(); y < layers.size(); y += world.size()) {
    for (int n = 0; n < 9; ++n) cloud.positions.emplace_back(n % 3, 0.25 * layers[y], n / 3);
  }
  cloud.ids.resize(cloud.positions.size());
  cloud.blocks.assign(cloud.positions.size(), 0);
  const std::vector<double> horizons(cloud.positions.size(), 1.5);
  const std::vector<LatticeFrame> frames = lattice_frames(cloud, horizons, {BlockBonds(1.5)}, world);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].spacing, Vector(1, 0.25, 1));
}

// Points exactly at the horizon are neighbors on any number of ranks, in spite of the round-off of their places, in
// single precision too.
TEST(Lattice, NeighborsAtExactlyTheHorizonAreIn) {
  const Communicator world;
  for (const bool single : {false, true}) {
    PointCloud cloud;
    cloud.block_names = {"block_1"};
    for (int n = 0; n < 6 * 6 * 6; ++n) {
      cloud.ids.push_back(n);
      const Vector X(0.1 * (n % 6), 0.1 * (n / 6 % 6), 0.1 * (n / 36));
      cloud.positions.push_back(single ? Vector((X + Vector(13.7, -21.1, 100.3)).cast<float>().cast<double>()) : X);
    }
    cloud.element_ids = cloud.ids;
    cloud.volumes.assign(cloud.ids.size(), 1e-3);
    cloud.spacings.assign(cloud.ids.size(), 0.1);
    cloud.blocks.assign(cloud.ids.size(), 0);
    cloud.sets.assign(cloud.ids.size(), 0);
    const Domain domain = make_domain(partitioned(slice(cloud, world), world), {0.1}, world);
    const auto bonds = world.sum(static_cast<std::int64_t>(domain.families.bonds()));
    EXPECT_EQ(bonds, 2 * 3 * 5 * 6 * 6);
  }
}

// ---- Bonds through material, shapes and shared nodes
// ----------------------------------------------------------------------

// Cells of a porous block, or of two blocks one above the other, with their corners for shared nodes; shapes by their
// ids.
struct Porous {
  double filled;   // the part of the cells that is there
  double horizon;  // spacings; of the upper block 0.8 of it
  bool lower_asks, upper_asks;
  int separate = 0;    // body of the upper block
  double stretch = 1;  // of the cells along y
};

std::ostream& operator<<(std::ostream& out, const Porous& c) {
  return out << c.filled << " filled, horizon " << c.horizon << ", asked " << c.lower_asks << c.upper_asks;
}

std::vector<std::int64_t> corners_of(int i, int j, int k) {
  std::vector<std::int64_t> corners;
  for (int n = 0; n < 8; ++n) corners.push_back((i + n % 2) + 100 * (j + n / 2 % 2) + 10000 * (k + n / 4));
  return corners;
}

CellShape shape_of_id(Id id) {
  const auto x = static_cast<double>(id);
  return {Vector(x, x + 1, x + 2), Symmetric::LinSpaced(x, x + 7), Vector(-x, x / 3, 1)};
}

PointCloud whole_cloud(const Porous& c) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> any(0, 1);
  PointCloud cloud;
  cloud.block_names = {"lower", "upper"};
  for (int k = 0; k < 8; ++k) {
    for (int j = 0; j < 7; ++j) {
      for (int i = 0; i < 9; ++i) {
        const Vector shift = 0.2 * Vector(any(random), any(random), any(random));
        const double spacing = 0.9 + 0.2 * any(random);
        if (any(random) > c.filled) continue;
        cloud.ids.push_back(static_cast<Id>(cloud.ids.size()));
        cloud.positions.push_back(Vector(i, c.stretch * j, k) + shift);
        cloud.spacings.push_back(spacing);
        cloud.blocks.push_back(k < 4 ? 0 : 1);
        cloud.shared_nodes.push_back(corners_of(i, j, k));
        cloud.shapes.push_back(shape_of_id(cloud.ids.back()));
      }
    }
  }
  cloud.element_ids = cloud.ids;
  cloud.volumes.assign(cloud.ids.size(), 1);
  cloud.sets.assign(cloud.ids.size(), 0);
  return cloud;
}

std::vector<BlockBonds> bonds_of(const Porous& c) {
  std::vector<BlockBonds> bonds = {BlockBonds::per_spacing(c.horizon),
                                   BlockBonds::per_spacing(0.8 * c.horizon, c.separate)};
  bonds[0].visible_only = c.lower_asks, bonds[1].visible_only = c.upper_asks;
  for (BlockBonds& block : bonds) block.families = FamilyKind::lists;
  return bonds;
}

// By the words of the definition, over all pairs: the points that are bonded to both ends fall into parts that hang
// together, and both ends must be in one.
std::set<Pair> visible_only(const Porous& c) {
  const PointCloud cloud = whole_cloud(c);
  const std::vector<BlockBonds> bonds = bonds_of(c);
  const auto n = static_cast<int>(cloud.size());
  const auto block = [&](int i) { return bonds[cloud.blocks[i]]; };
  const auto in_reach = [&](int i, int j) {
    const double horizon = 0.5 * (block(i).horizon_at(cloud.spacings[i]) + block(j).horizon_at(cloud.spacings[j]));
    return block(i).body == block(j).body &&
           (cloud.positions[i] - cloud.positions[j]).norm() <= (1 + round_off_of_files) * horizon;
  };
  const auto touch = [&](int i, int j) {
    std::vector<std::int64_t> common;
    std::set_intersection(cloud.shared_nodes[i].begin(), cloud.shared_nodes[i].end(), cloud.shared_nodes[j].begin(),
                          cloud.shared_nodes[j].end(), std::back_inserter(common));
    return !common.empty();
  };
  std::vector<std::vector<int>> touching(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (j != i && touch(i, j)) touching[i].push_back(j);
    }
  }
  const auto joined = [&](int i, int j) {
    std::set<int> reached{i};
    std::vector<int> front{i};
    while (!front.empty() && !reached.contains(j)) {
      const int at = front.back();
      front.pop_back();
      for (const int k : touching[at]) {
        if ((k == j || (in_reach(i, k) && in_reach(j, k))) && reached.insert(k).second) front.push_back(k);
      }
    }
    return reached.contains(j);
  };
  std::set<Pair> pairs;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (i == j || !in_reach(i, j)) continue;
      const bool asked = block(i).visible_only || block(j).visible_only;
      if (!asked || joined(i, j)) pairs.emplace(i, j);
    }
  }
  return pairs;
}

class PorousDomain : public testing::TestWithParam<Porous> {
 protected:
  const Communicator world;
  Domain domain = make_domain(partitioned(slice(whole_cloud(GetParam()), world), world), bonds_of(GetParam()), world);
  const std::vector<Id> ids = ids_of(domain);
};

TEST_P(PorousDomain, FamiliesAreThoseOfTheDefinitionOverAllPairs) {
  const std::vector<Pair> bonds = all_bonds(domain, ids, world);
  const std::set<Pair> distinct(bonds.begin(), bonds.end());
  EXPECT_EQ(distinct.size(), bonds.size());
  EXPECT_EQ(distinct, visible_only(GetParam()));
  Porous all = GetParam();
  all.lower_asks = all.upper_asks = false;
  if ((GetParam().lower_asks || GetParam().upper_asks) && GetParam().filled > 0.1) {
    EXPECT_LT(distinct.size(), visible_only(all).size()) << "a case without pores";
  }
}

TEST_P(PorousDomain, FamiliesAreInTheOrderOfIdsAndNeedTheirGhosts) {
  std::vector<char> used(domain.ghosts, 0);
  for (int i = 0; i < domain.owned; ++i) {
    Id last = -1;
    bool has_ghost = false;
    domain.families.for_each(i, [&](int j) {
      EXPECT_LT(last, ids[j]);
      last = ids[j];
      if (j < domain.owned) return;
      has_ghost = true;
      used[j - domain.owned] = 1;
    });
    EXPECT_EQ(has_ghost, i >= domain.interior);
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
}

TEST_P(PorousDomain, PointsKeepTheirShapesAndSharedNodes) {
  const PointCloud whole = whole_cloud(GetParam());
  const PointCloud again = strut::whole_cloud(domain);
  ASSERT_EQ(domain.cloud.shapes.size(), domain.cloud.size());
  ASSERT_EQ(again.shared_nodes.size(), again.size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    const Id id = again.ids[i];
    EXPECT_EQ(domain.cloud.ids[i], id);
    EXPECT_EQ(numbers_of(domain.cloud.shapes[i]), numbers_of(shape_of_id(id)));
    EXPECT_EQ(again.shared_nodes[i], whole.shared_nodes[id]);
  }
}

INSTANTIATE_TEST_SUITE_P(Points, PorousDomain,
                         testing::Values(Porous{0.3, 3, true, true}, Porous{0.5, 2.2, true, true},
                                         Porous{0.4, 3, false, true}, Porous{0.3, 2.5, true, false, 1},
                                         Porous{0.3, 3, false, false},
                                         Porous{0.5, 2.2, true, true, 0, 2},  // not all that touch are bonded
                                         Porous{0.004, 4, true, true}),       // fewer points than ranks
                         [](const auto& info) { return "Case" + std::to_string(info.index); });

TEST(Visibility, NeedsListsAndSharedNodes) {
  const Communicator world;
  const Porous c = {0.3, 2.2, true, true};
  std::vector<BlockBonds> bonds = bonds_of(c);
  PointCloud cloud = slice(whole_cloud(c), world);
  bonds[1].families = FamilyKind::fastest;
  EXPECT_THROW(make_domain(cloud, bonds, world), std::logic_error);
  bonds[1].families = FamilyKind::lists;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.blocks[i] == 1) cloud.shared_nodes[i].clear();
  }
  for (const bool all : {false, true}) {
    if (all) cloud.shared_nodes.clear();
    try {
      make_domain(cloud, bonds, world);
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(all ? "block 'lower': its bonds" : "block 'upper': its bonds"),
                std::string::npos)
          << error.what();
    }
  }
}

// Every step waits for the rank with most points.
TEST(Partition, IsEven) {
  const Communicator world;
  const Domain domain = domain_of(dense, world);
  const double mean = static_cast<double>(dense.count) / world.size();
  EXPECT_NEAR(domain.owned, mean, 0.1 * mean);  // Zoltan's own tolerance
}

// Wherever points were before, a rank has them in the same order: sums over them keep their bits.
TEST(Partition, PointsThatAreMovedLieAsIfTheyHadAlwaysBeenThere) {
  const Communicator world;
  const PointCloud once = partitioned(slice(whole_cloud(Case{500, {0.2, 0.3}, 7}), world), world);
  std::vector<int> anywhere, home;
  for (const Id id : once.ids) anywhere.push_back(static_cast<int>(id * 7919 % world.size()));
  const PointCloud scattered = moved(once, anywhere, world);
  for (const Id id : scattered.ids) EXPECT_EQ(id * 7919 % world.size(), world.rank());
  std::vector<double> owners(500, 0);
  for (const Id id : once.ids) owners[id] = world.rank();
  world.sum(owners);
  for (const Id id : scattered.ids) home.push_back(static_cast<int>(owners[id]));
  const PointCloud again = moved(scattered, home, world);
  EXPECT_EQ(again.ids, once.ids);
  EXPECT_EQ(again.element_ids, once.element_ids);
  EXPECT_EQ(again.positions, once.positions);
  EXPECT_EQ(again.volumes, once.volumes);
  EXPECT_EQ(again.sets, once.sets);
}

}  // namespace
}  // namespace strut
