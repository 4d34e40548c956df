#include "points/domain.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "points/cell_grid.hpp"
#include "points/near_ranks.hpp"
#include "points/partition.hpp"

namespace strut {

namespace {

// A point that another rank may need, as it travels.
struct Candidate {
  double position[3];
  double volume, horizon;
  std::int64_t id, block;
};

// Points of other ranks that lie within `reach` of the box of this rank's points.
std::vector<Candidate> candidates(const PointCloud& cloud, const std::vector<double>& horizons, double reach,
                                  const Communicator& communicator) {
  std::vector<Candidate> mine;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector& X = cloud.positions[i];
    mine.push_back({{X[0], X[1], X[2]}, cloud.volumes[i], horizons[i], cloud.ids[i], cloud.blocks[i]});
  }
  return from_near_ranks<Candidate>(cloud.positions, mine, reach, communicator);
}

// Owned points first, then candidates.
struct Pool {
  std::vector<Vector> positions;
  std::vector<double> volumes;
  std::vector<std::int64_t> ids;
  std::vector<double> horizons;
  std::vector<int> bodies;
};

Pool pool_of(const PointCloud& cloud, const std::vector<double>& horizons, const std::vector<BlockBonds>& bonds,
             const std::vector<Candidate>& others) {
  Pool pool{cloud.positions, cloud.volumes, cloud.ids, horizons, {}};
  for (const int block : cloud.blocks) pool.bodies.push_back(bonds[block].body);
  for (const Candidate& c : others) {
    pool.positions.emplace_back(c.position[0], c.position[1], c.position[2]);
    pool.volumes.push_back(c.volume);
    pool.ids.push_back(c.id);
    pool.horizons.push_back(c.horizon);
    pool.bodies.push_back(bonds[c.block].body);
  }
  return pool;
}

std::vector<double> horizons_of(const PointCloud& cloud, const std::vector<BlockBonds>& bonds) {
  std::vector<double> horizons;
  horizons.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    horizons.push_back(bonds[cloud.blocks[i]].horizon_at(cloud.spacings[i]));
  }
  return horizons;
}

// Collective.
std::vector<BlockHorizons> block_horizons(const PointCloud& cloud, const std::vector<double>& horizons,
                                          const std::vector<BlockBonds>& bonds, const Communicator& communicator) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::vector<double> bounds(2 * bonds.size(), none);  // the largest of each block, and the smallest, negated
  for (std::size_t i = 0; i < horizons.size(); ++i) {
    double* of_block = &bounds[2 * cloud.blocks[i]];
    of_block[0] = std::max(of_block[0], horizons[i]);
    of_block[1] = std::max(of_block[1], -horizons[i]);
  }
  communicator.max(bounds);
  std::vector<BlockHorizons> blocks;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const bool empty = bounds[2 * b] == none;
    blocks.push_back({empty ? 0 : -bounds[2 * b + 1], empty ? 0 : bounds[2 * b], bonds[b].body});
  }
  return blocks;
}

// Calls visit(j) for the family of pool member i.
template <class Visit>
void for_each_neighbour(const CellGrid& grid, const Pool& pool, int i, double reach, Visit&& visit) {
  const Vector here = pool.positions[i];
  grid.visit_near(here, [&](int j, const Vector& there) {
    const Vector xi = there - here;
    if (xi.squaredNorm() > reach * reach || j == i || pool.bodies[i] != pool.bodies[j]) return;
    if (bonded(pool.horizons[i], pool.horizons[j], xi)) visit(j);
  });
}

// The order in which points and ghosts stand in memory, as places in the pool: owned points without ghosts in their
// family first, then the others, both along the curve; then the ghosts that are in some family, ordered by id (ranks
// that own them send runs of ids).
struct Order {
  std::vector<int> points, ghosts;
  std::vector<std::size_t> family_sizes;  // of points
  int interior = 0;
};

Order order_of(const CellGrid& grid, const Pool& pool, int owned, double reach) {
  Order order;
  std::vector<std::size_t> sizes(owned, 0);
  std::vector<char> needs_ghost(owned, 0), used(pool.ids.size(), 0);
  for (int i = 0; i < owned; ++i) {
    for_each_neighbour(grid, pool, i, reach, [&](int j) {
      ++sizes[i];
      if (j >= owned) needs_ghost[i] = used[j] = 1;
    });
  }
  order.points.resize(owned);
  std::iota(order.points.begin(), order.points.end(), 0);
  const auto boundary =
      std::stable_partition(order.points.begin(), order.points.end(), [&](int i) { return !needs_ghost[i]; });
  order.interior = static_cast<int>(boundary - order.points.begin());
  for (const int i : order.points) order.family_sizes.push_back(sizes[i]);
  for (int j = owned; j < static_cast<int>(pool.ids.size()); ++j) {
    if (used[j]) order.ghosts.push_back(j);
  }
  std::sort(order.ghosts.begin(), order.ghosts.end(), [&](int a, int b) { return pool.ids[a] < pool.ids[b]; });
  return order;
}

// Families of the points in their order, neighbours by local[]. Filled in a second look at the grid: growing or copying
// the lists, by far the largest of a run, would take twice their memory.
Families families_of(const CellGrid& grid, const Pool& pool, const Order& order, const std::vector<int>& local,
                     double reach) {
  Families families;
  families.start.reserve(order.points.size() + 1);
  for (const std::size_t size : order.family_sizes) families.start.push_back(families.start.back() + size);
  families.neighbours.reserve(families.start.back());
  for (const int i : order.points) {
    const auto begin = static_cast<std::ptrdiff_t>(families.neighbours.size());
    for_each_neighbour(grid, pool, i, reach, [&](int j) { families.neighbours.push_back(j); });
    std::sort(families.neighbours.begin() + begin, families.neighbours.end(),
              [&](int a, int b) { return pool.ids[a] < pool.ids[b]; });
  }
  for (int& j : families.neighbours) j = local[j];
  return families;
}

}  // namespace

bool bonded(double one_horizon, double other_horizon, const Vector& xi) {
  constexpr double tolerance = 1 + 1e-9;  // a neighbour at exactly the horizon stays in despite round-off
  const double horizon = 0.5 * (one_horizon + other_horizon) * tolerance;
  return xi.squaredNorm() <= horizon * horizon;
}

Domain make_domain(PointCloud cloud, const std::vector<BlockBonds>& bonds, const Communicator& communicator) {
  const std::vector<double> own_horizons = horizons_of(cloud, bonds);
  std::vector<BlockHorizons> blocks = block_horizons(cloud, own_horizons, bonds, communicator);
  double reach = std::numeric_limits<double>::min();  // where there is no point
  for (const BlockHorizons& block : blocks) reach = std::max(reach, block.largest * (1 + 1e-9));
  const int owned = static_cast<int>(cloud.size());
  const Pool pool = pool_of(cloud, own_horizons, bonds, candidates(cloud, own_horizons, reach, communicator));
  const CellGrid grid(pool.positions, reach);
  const Order order = order_of(grid, pool, owned, reach);
  PointCloud mine = reordered(cloud, order.points);
  std::vector<int> local(pool.ids.size(), -1);
  std::vector<Vector> positions;
  std::vector<double> volumes, horizons;
  std::vector<std::int64_t> ghost_ids;
  std::vector<int> members = order.points;
  members.insert(members.end(), order.ghosts.begin(), order.ghosts.end());
  for (const int p : members) {
    local[p] = static_cast<int>(positions.size());
    positions.push_back(pool.positions[p]);
    volumes.push_back(pool.volumes[p]);
    horizons.push_back(pool.horizons[p]);
    if (p >= owned) ghost_ids.push_back(pool.ids[p]);
  }
  Halo halo(communicator, mine.ids, ghost_ids);
  return {communicator,
          std::move(mine),
          order.interior,
          owned,
          static_cast<int>(order.ghosts.size()),
          std::move(positions),
          std::move(volumes),
          std::move(horizons),
          std::move(blocks),
          families_of(grid, pool, order, local, reach),
          std::move(halo)};
}

Tensor family_spread(const Domain& domain, int i) {
  Tensor spread = Tensor::Zero();
  for (std::size_t b = domain.families.start[i]; b < domain.families.start[i + 1]; ++b) {
    const int j = domain.families.neighbours[b];
    const Vector xi = domain.positions[j] - domain.positions[i];
    spread += domain.volumes[j] * xi * xi.transpose();
  }
  return spread;
}

const char* degeneracy(std::size_t neighbours, const Tensor& spread) {
  if (neighbours < 4) return "fewer than four neighbours";
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(spread, Eigen::EigenvaluesOnly);
  // A flat family of a lattice has an exact zero; a strut one spacing wide and two long has about 1e-1.
  if (eigen.eigenvalues()[0] <= 1e-6 * eigen.eigenvalues()[2]) return "neighbours in one plane";
  return nullptr;
}

}  // namespace strut
