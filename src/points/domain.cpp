#include "points/domain.hpp"

#include <Tpetra_Distributor.hpp>
#include <algorithm>
#include <numeric>

#include "points/cell_grid.hpp"
#include "points/partition.hpp"

namespace strut {

namespace {

// A point that another rank may need, as it travels.
struct Candidate {
  double position[3];
  double volume, horizon;
  std::int64_t id;
};
constexpr int candidate_width = sizeof(Candidate) / sizeof(double);

Eigen::AlignedBox3d bounding_box(const PointCloud& cloud) {
  Eigen::AlignedBox3d box;
  for (const Vector& X : cloud.positions) box.extend(X);
  return box;
}

std::vector<Eigen::AlignedBox3d> boxes_of_all(const PointCloud& cloud, const Communicator& communicator) {
  const Eigen::AlignedBox3d mine = bounding_box(cloud);
  std::vector<double> corners(6 * communicator.size(), 0);
  // An empty box, turned inside out, must stay finite to be added up.
  const Vector low = mine.isEmpty() ? Vector::Constant(1) : mine.min();
  const Vector high = mine.isEmpty() ? Vector::Constant(-1) : mine.max();
  double* own = &corners[6 * communicator.rank()];
  std::copy_n(low.data(), 3, own);
  std::copy_n(high.data(), 3, own + 3);
  communicator.sum(corners);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (int r = 0; r < communicator.size(); ++r) {
    const double* c = &corners[6 * r];
    boxes.emplace_back(Vector(c[0], c[1], c[2]), Vector(c[3], c[4], c[5]));
  }
  return boxes;
}

// Points of other ranks that lie within `reach` of the box of this rank's points.
std::vector<Candidate> candidates(const PointCloud& cloud, const std::vector<double>& horizons, double reach,
                                  const Communicator& communicator) {
  if (communicator.size() == 1) return {};
  const auto boxes = boxes_of_all(cloud, communicator);
  std::vector<Candidate> outgoing;
  std::vector<int> targets;
  for (int r = 0; r < communicator.size(); ++r) {
    if (r == communicator.rank() || boxes[r].isEmpty()) continue;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vector& X = cloud.positions[i];
      if (boxes[r].squaredExteriorDistance(X) > reach * reach) continue;
      outgoing.push_back({{X[0], X[1], X[2]}, cloud.volumes[i], horizons[i], cloud.ids[i]});
      targets.push_back(r);
    }
  }
  Tpetra::Distributor distributor(communicator.teuchos());
  const std::size_t arriving = distributor.createFromSends(Teuchos::ArrayView<const int>(targets));
  std::vector<Candidate> incoming(arriving);
  const auto as_doubles = [](std::vector<Candidate>& list) {
    return Kokkos::View<double*, Kokkos::HostSpace>(reinterpret_cast<double*>(list.data()),
                                                    list.size() * candidate_width);
  };
  distributor.doPostsAndWaits(Kokkos::View<const double*, Kokkos::HostSpace>(as_doubles(outgoing)), candidate_width,
                              as_doubles(incoming));
  return incoming;
}

// Owned points first, then candidates.
struct Pool {
  std::vector<Vector> positions;
  std::vector<double> volumes, horizons;
  std::vector<std::int64_t> ids;
};

Pool pool_of(const PointCloud& cloud, const std::vector<double>& horizons, const std::vector<Candidate>& others) {
  Pool pool{cloud.positions, cloud.volumes, horizons, cloud.ids};
  for (const Candidate& c : others) {
    pool.positions.emplace_back(c.position[0], c.position[1], c.position[2]);
    pool.volumes.push_back(c.volume);
    pool.horizons.push_back(c.horizon);
    pool.ids.push_back(c.id);
  }
  return pool;
}

Families families_of(const Pool& pool, int owned, double reach) {
  const CellGrid grid(pool.positions, reach);
  Families families;
  families.start.reserve(owned + 1);
  constexpr double tolerance = 1 + 1e-9;  // a neighbour at exactly the horizon stays in despite round-off
  for (int i = 0; i < owned; ++i) {
    const std::size_t begin = families.neighbours.size();
    grid.visit_near(pool.positions[i], [&](int j) {
      const double horizon = 0.5 * (pool.horizons[i] + pool.horizons[j]) * tolerance;
      if (j != i && (pool.positions[j] - pool.positions[i]).squaredNorm() <= horizon * horizon) {
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

Domain make_domain(PointCloud cloud, const std::vector<double>& horizon, const Communicator& communicator) {
  std::vector<double> horizons;
  for (const int block : cloud.blocks) horizons.push_back(horizon[block]);
  const double reach = *std::max_element(horizon.begin(), horizon.end()) * (1 + 1e-9);
  const int owned = static_cast<int>(cloud.size());
  const Pool pool = pool_of(cloud, horizons, candidates(cloud, horizons, reach, communicator));
  const Families found = families_of(pool, owned, reach);

  int interior = 0;
  std::vector<int> order = interior_first(found, owned, interior);
  PointCloud mine = reordered(cloud, order);
  const std::vector<int> points = order;
  const std::vector<int> ghosts = used_ghosts(found, pool, owned);
  order.insert(order.end(), ghosts.begin(), ghosts.end());

  std::vector<int> local(pool.ids.size(), -1);
  std::vector<Vector> positions;
  std::vector<double> volumes, all_horizons;
  std::vector<std::int64_t> ghost_ids;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int p = order[k];
    local[p] = static_cast<int>(k);
    positions.push_back(pool.positions[p]);
    volumes.push_back(pool.volumes[p]);
    all_horizons.push_back(pool.horizons[p]);
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
          std::move(all_horizons),
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
