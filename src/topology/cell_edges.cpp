#include "topology/cell_edges.hpp"

#include <algorithm>
#include <cmath>

namespace strut {

bool has_known_edges(const Domain& domain, int i) {
  constexpr double alike = 1e-3;  // the relative difference of volumes
  constexpr std::size_t corners_of_tetrahedron = 4;
  const PointCloud& cloud = domain.cloud;
  if (cloud.shapes.empty()) return false;
  const double whole = std::pow(cloud.spacings[i], 3);
  // A node has an eighth of each hexahedron around it, and of a tetrahedron a quarter, of which six make a cube.
  if (cloud.at == PointsAt::nodes)
    return domain.volume(i) > static_cast<double>(cloud.shared_nodes[i].size()) * whole / 16;
  return cloud.shared_nodes[i].size() > corners_of_tetrahedron && std::abs(domain.volume(i) - whole) < alike * whole;
}

double edge_of_cell(const Domain& domain, int i, const Vector& direction) {
  if (!has_known_edges(domain, i)) return domain.cloud.spacings[i];
  const CellShape& shape = domain.cloud.shapes[i];
  return 2 * std::max(extent_of(shape, direction), extent_of(shape, -direction));
}

CellEdges edges_of_cell(const Domain& domain, int i) {
  if (!has_known_edges(domain, i)) return {domain.cloud.spacings[i], domain.cloud.spacings[i]};
  const Eigen::SelfAdjointEigenSolver<Tensor> moments(to_tensor(domain.cloud.shapes[i].moments));
  const auto edge = [&](int axis) { return edge_of_cell(domain, i, moments.eigenvectors().col(axis)); };
  return {edge(0), edge(2)};
}

}  // namespace strut
