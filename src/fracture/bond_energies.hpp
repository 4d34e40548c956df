// Bonds that break by the energy that they hold (Foster, Silling & Chen 2011), in ordinary blocks.
//
// The energy of an ordinary point is of second degree in the extensions e of its bonds, so it is half of the sum of
// what they carry times e. Of a bond, for the volumes of both ends:
//   w = ½ ω [ (a_i + a_j) |ξ| + (b_i + b_j) e ] e,  J/m⁶,
// and Σ V_i V_j w over all bonds is all that the points store. Where bonds are stretched in proportion, w is the work
// that the bond has taken. A bond of points by correspondence has no such energy: its force is not along it, so that
// its work depends on how the body turns.
//
// It is that of the end of the last step, since a_j of a ghost is known from then only.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "mechanics/kernels/bonds.hpp"

namespace strut {

class BondEnergies {
 public:
  BondEnergies() = default;  // none
  // Collective. Of a body whose families are whole.
  explicit BondEnergies(const Body& body);

  bool any() const { return !points_.empty(); }
  bool any_of(std::size_t block) const { return any() && concerned_[block]; }

  // At the start of a step, takes the force states that the last sum of forces has left. Returns, of owned points and
  // ghosts, which have changed by more than two points that moved apart by `travel` (m) since then explain: their bonds
  // have broken. Empty where there is none.
  std::vector<char> take_states(const Body& body, double travel);

  // Calls visit(n, w/w_c, or 0 where the bond holds whatever its w, room) over the n neighbors of a cluster: how far
  // (m) any two points have to move apart before w can be w_c; w_c is the lesser one of the two ends. A bond that is
  // not stretched has w = 0. `places`: of owned points and ghosts at the time of the states, m.
  template <class Visit>
  void over(const Body& body, const Cluster& cluster, const std::vector<Vector>& places, const Visit& visit) const;

  double bytes() const { return static_cast<double>(points_.size() * sizeof(Point)); }

 private:
  using Lanes = bonds::Lanes;
  static constexpr double never = std::numeric_limits<double>::infinity();

  // What bonds ask of an end: w_c; a; b; by how much |a| grows at most where points move apart by 1 m.
  struct Point {
    double limit = never, a = 0, b = 0, growth = 0;
  };
  struct Held {
    Lanes load, room;
  };
  static Held held(const std::array<Lanes, 4>& own, const Point& there, const Lanes& omega, const Lanes& rest,
                   const Lanes& extension);

  std::vector<Point> points_;    // owned ones and ghosts; empty where no block has a critical bond energy
  std::vector<char> concerned_;  // blocks of which a bond may break so
};

// As a bond breaks, the body loses the energy 2 w − ½ ω (b_i + b_j) e², as the bond's part of θ goes, too. Where this
// is negative, as it is under pressure, the bond holds. (How much the break changes θ of both ends is left out.)
//
// With |a| ≤ |a₀| + growth·d and e ≤ max(e₀, 0) + d, w reaches w_c no sooner than at the root d of a quadratic
// equation.
inline BondEnergies::Held BondEnergies::held(const std::array<Lanes, 4>& own, const Point& there, const Lanes& omega,
                                             const Lanes& rest, const Lanes& extension) {
  const Lanes limit = own[0].min(there.limit), a = own[1] + there.a, b = own[2] + there.b;
  const Lanes stretched = extension.max(0.0), pull = a * rest + b * stretched;
  const Lanes constant = a.abs() * rest + b * stretched, slope = (own[3] + there.growth) * rest + b;
  const Lanes half = 0.5 * (constant + slope * stretched), left = 2 * limit / omega - constant * stretched;
  const Lanes released = pull + a * rest;
  return {(released > 0).select(0.5 * omega * pull * stretched / limit, 0.0),
          ((half.square() + slope * left).max(0.0).sqrt() - half) / slope};
}

template <class Visit>
void BondEnergies::over(const Body& body, const Cluster& cluster, const std::vector<Vector>& places,
                        const Visit& visit) const {
  const Site* sites = body.domain.sites.data();
  const bonds::OfCluster family{cluster};
  const auto y = family.own<3>([&](int i) { return places[i].data(); });
  const auto own = family.own<4>([&](int i) { return &points_[i].limit; });
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
