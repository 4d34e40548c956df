// Bonds of ordinary blocks that break by the energy that they store (Foster, Silling & Chen 2011).
//
// The energy of an ordinary point is quadratic in the extensions e of its bonds, so it is half of the sum of bond force
// times e. The energy density of a bond, per product of both ends' volumes, is
//   w = ½ ω [ (a_i + a_j) |ξ| + (b_i + b_j) e ] e,  J/m⁶,
// and Σ V_i V_j w over all bonds is the energy of all points. Under proportional stretch, w is the work done on the
// bond. Ends that expand with the temperature, by ε, have extensions e − ε |ξ| of their own in the place of e. A bond
// of points by correspondence has no such energy: its force is not along the bond, so that its work depends on the
// rotation of the body.
//
// w is that of the end of the last step, because a_j of a ghost is known only then.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "mechanics/kernels/bonds.hpp"

namespace strut {

class BondEnergies {
 public:
  BondEnergies() = default;  // without critical bond energies
  // Collective. The families of the body must be complete.
  explicit BondEnergies(const Body& body);

  bool any() const { return !points_.empty(); }
  bool any_of(std::size_t block) const { return any() && concerned_[block]; }

  // Before the points of a step get their next expansion: takes the one that the force states have.
  void take_expansions(const Body& body);
  // At the start of a step, stores the force states of the last sum of forces. Returns a flag for each owned point and
  // ghost whose a changed by more than a relative displacement of two points by `travel` (m) explains: bonds of it have
  // broken. Empty if there is none.
  std::vector<char> take_states(const Body& body, double travel);

  // Calls visit(n, load, slack) for each of the n neighbors of a cluster: load = w/w_c, or 0 if the bond holds for any
  // w; slack = the relative displacement (m) of two points below which w cannot reach w_c, the lesser of the two ends'.
  // A bond that is no longer than its ends have expanded, on the mean, has w = 0. `places`: positions of owned points
  // and ghosts at the time of the states, m.
  template <class Visit>
  void over(const Body& body, const Cluster& cluster, const std::vector<Vector>& places, const Visit& visit) const;

  double bytes() const { return static_cast<double>(points_.size() * sizeof(Point)); }

 private:
  using Lanes = bonds::Lanes;
  static constexpr double never = std::numeric_limits<double>::infinity();

  // Data of a bond's end: w_c; a; b; the largest growth of |a| if points move apart by 1 m; ε.
  struct Point {
    double limit = never, a = 0, b = 0, growth = 0, expansion = 0;
  };
  struct Held {
    Lanes load, room;
  };
  static Held held(const std::array<Lanes, 5>& own, const Point& there, const Lanes& omega, const Lanes& rest,
                   const Lanes& extension);

  std::vector<Point> points_;    // owned points and ghosts; empty if no block has a critical bond energy
  std::vector<char> concerned_;  // blocks of which a bond may break by its energy
};

// When a bond breaks, the body loses the energy 2 w − ½ ω (b_i + b_j) e², because the bond's part of θ vanishes, too.
// If this is negative, as under pressure, the bond holds. (The change of θ at both ends by the break is neglected.)
//
// Ends that have expanded unequally have the extensions e − u and e + u. What u adds is a product of two differences of
// both ends, so that both get the same bits.
//
// With |a| ≤ |a₀| + growth·d and e ≤ max(e₀, 0) + d, the relative displacement d at which w can first reach w_c is the
// root of a quadratic equation.
inline BondEnergies::Held BondEnergies::held(const std::array<Lanes, 5>& own, const Point& there, const Lanes& omega,
                                             const Lanes& rest, const Lanes& extension) {
  const Lanes limit = own[0].min(there.limit), a = own[1] + there.a, b = own[2] + there.b;
  const Lanes mean = 0.5 * (own[4] + there.expansion), u = 0.5 * (own[4] - there.expansion) * rest;
  const Lanes stretched = (extension - mean * rest).max(0.0), pull = a * rest + b * stretched;
  const Lanes constant = a.abs() * rest + b * stretched, slope = (own[3] + there.growth) * rest + b;
  const Lanes half = 0.5 * (constant + slope * stretched), left = 2 * limit / omega - constant * stretched;
  const Lanes by_a = u * ((there.a - own[1]) * rest), by_b = 2 * u * (there.b - own[2]) * stretched + b * u.square();
  const Lanes twice = pull * stretched + (by_a + by_b), released = (pull + a * rest) * stretched + (2 * by_a + by_b);
  return {(stretched > 0 && released > 0).select(0.5 * omega * twice / limit, 0.0),
          ((half.square() + slope * left).max(0.0).sqrt() - half) / slope};
}

template <class Visit>
void BondEnergies::over(const Body& body, const Cluster& cluster, const std::vector<Vector>& places,
                        const Visit& visit) const {
  const Site* sites = body.domain.sites.data();
  const bonds::OfCluster family{cluster};
  const auto y = family.own<3>([&](int i) { return places[i].data(); });
  const auto own = family.own<5>([&](int i) { return &points_[i].limit; });
  const Lanes horizon = family.own<1>([&](int i) { return sites[i].current.data() + 3; })[0];
  bonds::with_influence(body.influence, [&]<class Weight>(Weight) {
    std::size_t n = 0;
    bonds::over(family, sites, bonds::One(), [&](int j, const Lanes&, const auto& xi, const auto& present) {
      Eigen::Array4d there;
      there << places[j].array(), 0;
      const auto eta = bonds::apart(there, bonds::Vector3<Lanes>{{y[0], y[1], y[2]}});
      const Lanes rest = (bonds::dot(xi, xi) + (1 - present)).sqrt(), extension = bonds::dot(eta, eta).sqrt() - rest;
      const Lanes omega = Lanes::Ones() * Weight::of(Lanes(2 * rest / (horizon + sites[j].horizon())));
      const Held of_bond = held(own, points_[j], omega, rest, extension);
      visit(n++, Lanes((present > 0).select(of_bond.load, Lanes::Zero())),
            Lanes((present > 0).select(of_bond.room, Lanes::Constant(never))));
    });
  });
}

}  // namespace strut
