// Volumes that a file states for points without elements (text, spheres), or those of nodes, beside the lattice that
// the points stand on: nothing else ties the two, and mass and stiffness follow the volumes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "advice/checks.hpp"
#include "setup/found_points.hpp"

namespace strut {

namespace {

constexpr double alike = 0.01;  // relative difference of volumes and distances in a file of few digits

bool are_alike(double a, double b) { return std::abs(a - b) <= alike * std::max(a, b); }

// A text mesh has no shared nodes, and a sphere has none. Nodes have more than their lattice if elements overlap.
bool is_bare(const PointCloud& cloud, int i) {
  return cloud.at == PointsAt::nodes || cloud.shared_nodes.empty() || cloud.shared_nodes[i].empty();
}

// The axis along which a bond runs; -1: none.
int axis_of(const Vector& xi) {
  constexpr double straight = 1e-3;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(xi[axis]) > (1 - straight * straight) * xi.norm()) return axis;
  }
  return -1;
}

struct LatticeCell {
  double volume = 0;     // m³, the product of the spacings; 0 if they are unknown
  bool is_full = false;  // between two neighbors along each axis, all with its own volume
};

// The spacings are those to the nearest points along the axes. They are unknown in a single layer, where they change,
// where the only neighbor along an axis has another volume (the last cell of a graded mesh), at nodes where any
// neighbor has one (tetrahedra, halves at surfaces), and on lattices of other kinds, which have points between those.
LatticeCell cell_around(const Domain& domain, int i) {
  constexpr double none = std::numeric_limits<double>::infinity();
  Eigen::Array<double, 3, 2> nearest = Eigen::Array<double, 3, 2>::Constant(none), volumes = nearest;
  domain.families.for_each(i, [&](int j) {
    const Vector xi = domain.reference(j) - domain.reference(i);
    const int axis = axis_of(xi), side = axis >= 0 && xi[axis] > 0 ? 1 : 0;
    if (axis < 0 || !(xi.norm() < nearest(axis, side))) return;
    nearest(axis, side) = xi.norm(), volumes(axis, side) = domain.volume(j);
  });
  const Eigen::Array3d spacing = nearest.rowwise().minCoeff();
  const bool at_nodes = domain.cloud.at == PointsAt::nodes;
  bool is_regular = (spacing < none).all(), is_full = (nearest < none).all();
  for (int k = 0; k < 6; ++k) {
    const int axis = k / 2, side = k % 2;
    if (nearest(axis, side) == none) continue;
    const bool has_other = !are_alike(volumes(axis, side), domain.volume(i));
    is_full = is_full && !has_other;
    is_regular = is_regular && are_alike(nearest(axis, side), spacing[axis]) &&
                 !(has_other && (at_nodes || nearest(axis, 1 - side) == none));
  }
  if (!is_regular) return {};
  domain.families.for_each(i, [&](int j) {
    const Eigen::Array3d xi = domain.reference(j) - domain.reference(i);
    if ((xi.abs() < (1 - alike) * spacing).all()) is_regular = false;
  });
  if (!is_regular) return {};
  return {spacing.prod(), is_full};
}

// Points at a surface or beside partly filled cells may have less: a half for each face, if they stand for nodes.
bool is_off(const LatticeCell& cell, double volume, PointsAt at) {
  constexpr double worth_saying = 0.1, least_at_surfaces = 0.1;
  if (!(cell.volume > 0)) return false;
  const double least = at == PointsAt::nodes ? 0 : cell.is_full ? 1 - worth_saying : least_at_surfaces;
  return volume > (1 + worth_saying) * cell.volume || volume < least * cell.volume;
}

}  // namespace

std::string volumes_off_lattices(const Situation& situation) {
  const Body& body = situation.scene.body;
  const Domain& domain = body.domain;
  if (situation.deck.discretization.type == deck::MeshType::grid) return "";
  std::vector<int> points;
  double most = 0, volume = 0, expected = 0;  // of the point that is farthest off
  for (int i = 0; i < body.owned(); ++i) {
    if (!is_bare(domain.cloud, i) || body.has_lost_bonds(i)) continue;
    const LatticeCell cell = cell_around(domain, i);
    if (!is_off(cell, domain.volume(i), domain.cloud.at)) continue;
    points.push_back(i);
    const double ratio = std::max(domain.volume(i) / cell.volume, cell.volume / domain.volume(i));
    if (ratio > most) most = ratio, volume = domain.volume(i), expected = cell.volume;
  }
  const FoundPoints found = found_points(body, {points})[0];
  if (found.count == 0) return "";
  const Communicator& ranks = domain.communicator;
  const bool is_here = ranks.first_rank(most == ranks.max(most)) == ranks.rank();
  volume = ranks.max(is_here ? volume : 0), expected = ranks.max(is_here ? expected : 0);
  std::ostringstream text;
  text << "WARNING: the volumes of " << found.count << " points, one of them at " << place_text(found.one)
       << ", do not fit the lattice that the points are on: the farthest off has " << volume
       << " m³, and its spacings make " << expected << " m³. Mass and stiffness follow the volumes; expected "
       << (domain.cloud.at == PointsAt::nodes ? "each element once" : "the product of the spacings") << "\n";
  return text.str();
}

}  // namespace strut
