// The rules by which points are bonded to each other.
#pragma once

#include "base/math/tensors.hpp"

namespace strut {

// The representation of the families of a body. `fastest`: a stencil if its points are on a lattice and sums are faster
// by it, else lists. `lists`: for code that reads them; a body whose blocks want different kinds gets lists.
enum class FamilyKind { fastest, stencil, lists };

// The bonds of a block's points: their horizon δ, and the body that they belong to. Different bodies are not bonded to
// each other.
struct BlockBonds {
  BlockBonds(double horizon, int body = 0) : horizon(horizon), body(body) {}
  static BlockBonds per_spacing(double factor, int body = 0) {
    BlockBonds bonds(factor, body);
    bonds.in_spacings = true;
    return bonds;
  }

  double horizon;  // of all points, m; or in local spacings of each point
  bool in_spacings = false;
  int body;
  FamilyKind families = FamilyKind::fastest;
  // Bonds may break, or are left out because of a crack: lists are then kept beside a stencil. One block of a body with
  // this flag is enough.
  bool may_lose_bonds = false;
  // Visibility: a bond is left out unless a chain of touching points (PointCloud::shared_nodes), all within the horizon
  // of both ends, joins its ends. Needs shared nodes and lists. For two blocks, one with this flag is enough.
  bool visible_only = false;
  // A family consists of the points that touch, whatever their distance: the centroid or node of a cell does not show
  // its extent. Needs shared nodes and lists. For two blocks, one with this flag is enough.
  bool touching = false;

  // δ of a point with this local spacing, m.
  double horizon_at(double spacing) const { return in_spacings ? horizon * spacing : horizon; }
  // Touching points are searched for within this many horizons: the centers of cells that share a corner, or have
  // absorbed parts of a neighbor, are up to 2.8 spacings apart.
  double search_factor() const { return touching ? 1.6 : 1; }
};

// A neighbor at exactly the horizon stays in, despite coordinates in single precision, or of six digits.
constexpr double with_round_off = 1 + 1e-4;

// True if two points of one body, with these horizons (m) and the bond ξ, are in each other's families: |ξ| ≤ (δ_i +
// δ_j)/2, which is symmetric.
inline bool bonded(double one_horizon, double other_horizon, const Vector& xi) {
  const double horizon = 0.5 * (one_horizon + other_horizon) * with_round_off;
  return xi.squaredNorm() <= horizon * horizon;
}

}  // namespace strut
