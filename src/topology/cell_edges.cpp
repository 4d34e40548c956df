#include "topology/cell_edges.hpp"

#include <algorithm>
#include <cmath>

namespace strut {

bool has_whole_cell(const Domain& domain, int i) {
  constexpr double alike = 1e-3;  // the relative difference of volumes
  const double whole = std::pow(domain.cloud.spacings[i], 3);
  return std::abs(domain.volume(i) - whole) < alike * whole;
}

bool has_known_edges(const Domain& domain, int i) {
  constexpr std::size_t corners_of_tetrahedron = 4;
  const PointCloud& cloud = domain.cloud;
  if (cloud.shapes.empty()) return false;
  const double whole = std::pow(cloud.spacings[i], 3);
  // A node has an eighth of each hexahedron around it, but a quarter of each tetrahedron, six of which make a cube.
  if (cloud.at == PointsAt::nodes)
    return domain.volume(i) > static_cast<double>(cloud.shared_nodes[i].size()) * whole / 16;
  return cloud.shared_nodes[i].size() > corners_of_tetrahedron && has_whole_cell(domain, i);
}

double edge_of_cell(const Domain& domain, int i, const Vector& direction) {
  if (!has_known_edges(domain, i)) return domain.cloud.spacings[i];
  const CellShape& shape = domain.cloud.shapes[i];
  return 2 * std::max(extent_of(shape, direction), extent_of(shape, -direction));
}

CellEdges edges_of_cell(const Domain& domain, int i) {
  if (!has_known_edges(domain, i)) return {domain.cloud.spacings[i], domain.cloud.spacings[i]};
  // A node at a face may have a cube, half of a longer cell: its moments have no axes, and the offset of its centroid
  // adds the axis across the face. Moments of parts of cells do not rank like the edges of the cells.
  const CellShape& shape = domain.cloud.shapes[i];
  const Tensor moments = to_tensor(shape.moments) + 1e-6 * shape.offset * shape.offset.transpose();
  const Tensor axes = Eigen::SelfAdjointEigenSolver<Tensor>(moments).eigenvectors();
  Vector edges;
  for (int c = 0; c < 3; ++c) edges[c] = edge_of_cell(domain, i, axes.col(c));
  return {edges.minCoeff(), edges.maxCoeff()};
}

}  // namespace strut
