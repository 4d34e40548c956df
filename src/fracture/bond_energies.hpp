// Bonds of ordinary blocks that break by the energy that they store (Foster, Silling & Chen 2011).
//
// The energy of an ordinary point is quadratic in the extensions e of its bonds, so it is half of the sum of bond force
// times e. The energy density of a bond, per product of both ends' volumes, is
//   w = ½ ω [ (a_i + a_j) |ξ| + (b_i + b_j) e ] e,  J/m⁶,
// and Σ V_i V_j w over all bonds is the energy of all points. Under proportional stretch, w is the work done on the
// bond. An end that has expanded with the temperature by ε has e − ε |ξ| instead of e. A bond of points by
// correspondence has no such energy: its force is not along the bond, so that its work depends on the rotation of the
// body.
//
// w is that of the end of the last step, because a_j of a ghost is known only then.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "base/math/lanes.hpp"
#include "mechanics/body.hpp"

namespace strut {

class BondEnergies {
 public:
  BondEnergies() = default;  // without critical bond energies
  // Collective. The families of the body must be complete.
  explicit BondEnergies(const Body& body);

  bool any() const { return !points_.empty(); }
  bool any_of(std::size_t block) const { return any() && concerned_[block]; }

  // Call it before a step changes the thermal strains: stores those that belong to the present force states.
  void take_expansions(const Body& body);
  // Called before the stress update, when the points have moved by up to `travel` (m) relative to each other: stores
  // the force states of the last sum of forces, which are those at the start of the step. Returns a flag for each owned
  // point and ghost whose `a` has changed by more than that displacement explains: some of its bonds have broken. Empty
  // if there is none.
  std::vector<char> take_states(const Body& body, double travel);

  using Lanes = small::Lanes;
  using Visit = std::function<void(std::size_t n, const Lanes& load, const Lanes& slack)>;
  // Calls visit(n, load, slack) for the n-th neighbor of a cluster. load: w/w_c, with the lesser w_c of both ends; 0 if
  // a break of the bond would release no energy. slack: the relative displacement of two points (m) below which w
  // cannot reach w_c. A bond that is no longer than its ends have expanded on average has w = 0. `places`: positions of
  // owned points and ghosts at the time of the force states, m.
  void over(const Body& body, const Cluster& cluster, const std::vector<Vector>& places, const Visit& visit) const;

  double bytes() const { return static_cast<double>(points_.size() * sizeof(Point)); }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  // Data of a bond's end: w_c; a; b; the largest growth of |a| if points move apart by 1 m; ε.
  struct Point {
    double limit = never, a = 0, b = 0, growth = 0, expansion = 0;
  };
  struct Held {
    Lanes load, slack;
  };
  static Held held(const std::array<Lanes, 5>& own, const Point& there, const Lanes& omega, const Lanes& rest,
                   const Lanes& extension);

  std::vector<Point> points_;    // owned points and ghosts; empty if no block has a critical bond energy
  std::vector<char> concerned_;  // blocks of which a bond may break by its energy
};

}  // namespace strut
