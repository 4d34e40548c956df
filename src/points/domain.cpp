#include "points/domain.hpp"

#include <algorithm>
#include <numeric>

#include "points/cell_grid.hpp"
#include "points/near_ranks.hpp"
#include "points/partition.hpp"

namespace strut {

namespace {

// A point that another rank may need, as it travels.
struct Candidate {
  double position[3];
  double volume;
  std::int64_t id, block;
};

// Points of other ranks that lie within `reach` of the box of this rank's points.
std::vector<Candidate> candidates(const PointCloud& cloud, double reach, const Communicator& communicator) {
  std::vector<Candidate> mine;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector& X = cloud.positions[i];
    mine.push_back({{X[0], X[1], X[2]}, cloud.volumes[i], cloud.ids[i], cloud.blocks[i]});
  }
  return from_near_ranks<Candidate>(cloud.positions, mine, reach, communicator);
}

// Owned points first, then candidates.
struct Pool {
  std::vector<Vector> positions;
  std::vector<double> volumes;
  std::vector<std::int64_t> ids;
  std::vector<BlockBonds> bonds;
};

Pool pool_of(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const std::vector<Candidate>& others) {
  Pool pool{cloud.positions, cloud.volumes, cloud.ids, {}};
  for (const int block : cloud.blocks) pool.bonds.push_back(bonds[block]);
  for (const Candidate& c : others) {
    pool.positions.emplace_back(c.position[0], c.position[1], c.position[2]);
    pool.volumes.push_back(c.volume);
    pool.ids.push_back(c.id);
    pool.bonds.push_back(bonds[c.block]);
  }
  return pool;
}

Families families_of(const Pool& pool, int owned, double reach) {
  const CellGrid grid(pool.positions, reach);
  Families families;
  families.start.reserve(owned + 1);
  for (int i = 0; i < owned; ++i) {
    const std::size_t begin = families.neighbours.size();
    grid.visit_near(pool.positions[i], [&](int j) {
      if (j != i && bonded(pool.bonds[i], pool.bonds[j], pool.positions[j] - pool.positions[i])) {
        families.neighbours.push_back(j);
      }
    });
    std::sort(families.neighbours.begin() + begin, families.neighbours.end(),
              [&](int a, int b) { return pool.ids[a] < pool.ids[b]; });
    families.start.push_back(families.neighbours.size());
  }
  return families;
}

// The candidates that are in some family, ordered by id (ranks that own them send runs of ids).
std::vector<int> used_ghosts(const Families& families, const Pool& pool, int owned) {
  std::vector<char> used(pool.ids.size(), 0);
  for (const int j : families.neighbours) used[j] = 1;
  std::vector<int> ghosts;
  for (std::size_t j = owned; j < pool.ids.size(); ++j) {
    if (used[j]) ghosts.push_back(static_cast<int>(j));
  }
  std::sort(ghosts.begin(), ghosts.end(), [&](int a, int b) { return pool.ids[a] < pool.ids[b]; });
  return ghosts;
}

// Owned points without ghosts in their family first; both parts keep their order along the curve.
std::vector<int> interior_first(const Families& families, int owned, int& interior) {
  std::vector<int> order(owned);
  std::iota(order.begin(), order.end(), 0);
  const auto boundary = std::stable_partition(order.begin(), order.end(), [&](int i) {
    return std::all_of(families.neighbours.begin() + families.start[i],
                       families.neighbours.begin() + families.start[i + 1], [&](int j) { return j < owned; });
  });
  interior = static_cast<int>(boundary - order.begin());
  return order;
}

// Families of the points order[0], order[1], …, with neighbours renumbered by local[].
Families renumbered(const Families& old, const std::vector<int>& order, const std::vector<int>& local) {
  Families families;
  families.start.reserve(old.start.size());
  families.neighbours.reserve(old.bonds());
  for (const int i : order) {
    for (std::size_t b = old.start[i]; b < old.start[i + 1]; ++b) {
      families.neighbours.push_back(local[old.neighbours[b]]);
    }
    families.start.push_back(families.neighbours.size());
  }
  return families;
}

}  // namespace

bool bonded(const BlockBonds& one, const BlockBonds& other, const Vector& xi) {
  constexpr double tolerance = 1 + 1e-9;  // a neighbour at exactly the horizon stays in despite round-off
  const double horizon = 0.5 * (one.horizon + other.horizon) * tolerance;
  return one.body == other.body && xi.squaredNorm() <= horizon * horizon;
}

Domain make_domain(PointCloud cloud, const std::vector<BlockBonds>& bonds, const Communicator& communicator) {
  double reach = 0;
  for (const BlockBonds& block : bonds) reach = std::max(reach, block.horizon * (1 + 1e-9));
  const int owned = static_cast<int>(cloud.size());
  const Pool pool = pool_of(cloud, bonds, candidates(cloud, reach, communicator));
  const Families found = families_of(pool, owned, reach);

  int interior = 0;
  std::vector<int> order = interior_first(found, owned, interior);
  PointCloud mine = reordered(cloud, order);
  const std::vector<int> points = order;
  const std::vector<int> ghosts = used_ghosts(found, pool, owned);
  order.insert(order.end(), ghosts.begin(), ghosts.end());

  std::vector<int> local(pool.ids.size(), -1);
  std::vector<Vector> positions;
  std::vector<double> volumes, horizons;
  std::vector<std::int64_t> ghost_ids;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int p = order[k];
    local[p] = static_cast<int>(k);
    positions.push_back(pool.positions[p]);
    volumes.push_back(pool.volumes[p]);
    horizons.push_back(pool.bonds[p].horizon);
    if (p >= owned) ghost_ids.push_back(pool.ids[p]);
  }
  Halo halo(communicator, mine.ids, ghost_ids);
  return {communicator,
          std::move(mine),
          interior,
          owned,
          static_cast<int>(ghosts.size()),
          std::move(positions),
          std::move(volumes),
          std::move(horizons),
          bonds,
          renumbered(found, points, local),
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
