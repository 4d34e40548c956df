#include "advice/lattice_axes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "topology/cell_edges.hpp"

namespace strut {

namespace {

// The direction to the nearest neighbor more than 30 degrees off a line or plane, of which `off` is the sine; zero
// without any.
template <class Off>
Vector nearest_neighbor(const Domain& domain, int i, const Off& off) {
  Vector nearest = Vector::Zero();
  double least = std::numeric_limits<double>::infinity();
  domain.families.for_each(i, [&](int j) {
    const Vector xi = domain.reference(j) - domain.reference(i);
    const double length = xi.norm();
    if (length < least && off(Vector(xi / length)) > 0.5) least = length, nearest = xi;
  });
  return nearest;
}

// The vectors to the nearest neighbors of lattice_axes(); zero for those that there are not.
Tensor nearest_neighbors(const Domain& domain, int i) {
  Tensor to_neighbors = Tensor::Zero();
  to_neighbors.col(0) = nearest_neighbor(domain, i, [](const Vector&) { return 1; });
  const Vector first = to_neighbors.col(0).stableNormalized();
  to_neighbors.col(1) = nearest_neighbor(domain, i, [&](const Vector& u) { return u.cross(first).norm(); });
  if (to_neighbors.col(1).isZero(0)) return to_neighbors;
  const Vector normal = to_neighbors.col(0).cross(to_neighbors.col(1)).stableNormalized();
  to_neighbors.col(2) = nearest_neighbor(domain, i, [&](const Vector& u) { return std::abs(u.dot(normal)); });
  return to_neighbors;
}

// The longest of three vectors over the least distance of the planes of two of them; 0 where one is missing.
double unevenness(const Tensor& to_neighbors) {
  double longest = 0, largest = 0;
  for (int c = 0; c < 3; ++c) {
    longest = std::max(longest, to_neighbors.col(c).norm());
    largest = std::max(largest, to_neighbors.col(c).cross(to_neighbors.col((c + 1) % 3)).norm());
  }
  const double volume = std::abs(to_neighbors.determinant());
  return volume > 0 ? longest * largest / volume : 0;
}

}  // namespace

Tensor lattice_axes(const Domain& domain, int i) {
  Tensor axes = nearest_neighbors(domain, i);
  if (axes.col(1).isZero(0)) return Tensor::Zero();
  if (axes.col(2).isZero(0)) axes.col(2) = axes.col(0).cross(axes.col(1));
  for (int c = 0; c < 3; ++c) axes.col(c).stableNormalize();
  return axes;
}

std::vector<double> unevenness_of_lattices(const Body& body) {
  const Domain& domain = body.domain;
  const std::size_t blocks = body.blocks.size();
  constexpr std::size_t enough = 2000;      // points of a block and rank
  std::vector<double> sums(2 * blocks, 0);  // and counts
  for (std::size_t b = 0; b < blocks; ++b) {
    if (!body.blocks[b].is_ordinary()) continue;
    const auto& points = body.blocks[b].points;
    for (std::size_t k = 0; k < points.size(); k += 1 + points.size() / enough) {
      const int i = points[k];
      const bool is_known = domain.cloud.at == PointsAt::nodes || has_whole_cell(domain, i);
      const double found = is_known && !body.has_lost_bonds(i) ? unevenness(nearest_neighbors(domain, i)) : 0;
      if (found > 0) sums[b] += found, sums[blocks + b] += 1;
    }
  }
  domain.communicator.sum(sums);
  std::vector<double> means;
  for (std::size_t b = 0; b < blocks; ++b) means.push_back(sums[b] / std::max(1.0, sums[blocks + b]));
  return means;
}

}  // namespace strut
