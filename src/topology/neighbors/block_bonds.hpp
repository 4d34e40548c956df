// Which points are bonded to each other.
#pragma once

#include "base/math/tensors.hpp"

namespace strut {

// What the families of a body become: a stencil where its points sit on a lattice and that is faster; or what is asked
// for. Lists are for those who read them; a body of blocks that want different ones has lists.
enum class FamilyKind { fastest, stencil, lists };

// How the points of a block are bonded: their horizon δ, and the body they belong to. Bodies are not bonded to each
// other.
struct BlockBonds {
  BlockBonds(double horizon, int body = 0) : horizon(horizon), body(body) {}
  static BlockBonds per_spacing(double factor, int body = 0) {
    BlockBonds bonds(factor, body);
    bonds.in_spacings = true;
    return bonds;
  }

  double horizon;  // of all points, m; or in local spacings of each
  bool in_spacings = false;
  int body;
  FamilyKind families = FamilyKind::fastest;
  // Bonds may break, or are left out for a crack: where families are a stencil, lists are kept beside it. Of the blocks
  // of a body, one that says so is enough.
  bool may_lose_bonds = false;
  // Bonds run through material: a bond whose ends are not joined by points that touch (PointCloud::joints), all of them
  // within the horizon of both ends, is left out. Needs joints, and lists. Of two blocks, one that asks is enough.
  bool through_material = false;
  // Families are of those that touch, whatever their distance: at a centroid or a node a cell does not show how far it
  // reaches. Needs joints, and lists. Of two blocks, one that asks is enough.
  bool touching = false;

  // δ of a point with this local spacing, m.
  double horizon_at(double spacing) const { return in_spacings ? horizon * spacing : horizon; }
  // Those that touch are looked for within so many horizons: the middles of cells that share a corner, or have taken
  // over what is in a neighbor, are up to 2.8 spacings apart.
  double search_factor() const { return touching ? 1.6 : 1; }
};

// Whether two points of one body, with these horizons (m) and the bond ξ, are in each other's families:
// |ξ| ≤ (δ_i + δ_j)/2, which is symmetric.
inline bool bonded(double one_horizon, double other_horizon, const Vector& xi) {
  constexpr double tolerance = 1 + 1e-9;  // a neighbor at exactly the horizon stays in despite round-off
  const double horizon = 0.5 * (one_horizon + other_horizon) * tolerance;
  return xi.squaredNorm() <= horizon * horizon;
}

}  // namespace strut
