// The two sums over a family that ordinary points need. With ξ = X_j − X_i, η = y_j − y_i and e = |η| − |ξ|:
//   extensions:  Σ ω V_j |ξ| e  (θ = 3/m of it),  Σ ω V_j e²
//   force:       f_i = Σ ω V_j [ (a_i + a_j)|ξ| + (b_i + b_j) e ] η/|η|
// For any kind of family, as in bonds.hpp. A square root or a division costs as much as ten other operations, so as few
// as possible are used:
//   |ξ| e = √(|ξ|² |η|²) − |ξ|²,  |ξ|/|η| = √(|ξ|²/|η|²),  e/|η| = 1 − |ξ|/|η|
#pragma once

#include "mechanics/kernels/bonds.hpp"

namespace strut::bonds {

// A bond to point j, for one point or for several in lanes.
template <class T>
struct Stretched {
  int j;
  T weight;  // ω V_j; 0 where j is not in the family
  T xi2;     // |ξ|²; 1 where j is not in the family, because the point itself has ξ = 0
  Vector3<T> eta;
  T eta2;  // |η|²; 1 likewise
};

// Calls visit(bond) for each bond of a family.
template <class Family, class Weight, class Visit, class... Record>
inline void over_stretched(const Family& family, const Site* sites, Weight weight, Visit&& visit,
                           const Record*... read) {
  using T = ScalarOf<Family>;
  const Vector3<T> y = own_position(family, sites, &Site::current);
  over(
      family, sites, weight,
      [&](int j, const T& w, const Vector3<T>& xi, const auto& present) {
        const Vector3<T> eta = apart(sites[j].current, y);
        const T absent = 1 - present;
        visit(Stretched<T>{j, w, dot(xi, xi) + absent, eta, dot(eta, eta) + absent});
      },
      read...);
}

// The extension e of a bond: from the positions …
template <class Family>
class OfPlaces {
 public:
  using T = ScalarOf<Family>;
  explicit OfPlaces(const Family&) {}
  T times_length(const Stretched<T>& bond) const {  // |ξ| e
    using std::sqrt;
    return sqrt(bond.xi2 * bond.eta2) - bond.xi2;
  }
  T over_length(const Stretched<T>&, const T& shrinkage) const { return 1 - shrinkage; }  // e/|η|
};

// … less the expansion ε |ξ| of the point's own temperature …
template <class Family>
class OfExpanded {
 public:
  using T = ScalarOf<Family>;
  OfExpanded(const Family& family, const T& expansion) : places_(family), expansion_(expansion) {}
  T times_length(const Stretched<T>& bond) const { return places_.times_length(bond) - expansion_ * bond.xi2; }

 private:
  OfPlaces<Family> places_;
  T expansion_;
};

// … or 1 for each |ξ| …
template <class Family>
struct OfLengths {
  using T = ScalarOf<Family>;
  T times_length(const Stretched<T>& bond) const { return bond.xi2; }
};

// … or its derivative η·(v_j − v_i)/|η| along a field v, which is stored as the current positions of other sites.
template <class Family>
class OfField {
 public:
  using T = ScalarOf<Family>;
  OfField(const Family& family, const Site* field) : field_(field), own_(own_position(family, field, &Site::current)) {}
  T times_length(const Stretched<T>& bond) const {
    using std::sqrt;
    return sqrt(bond.xi2 / bond.eta2) * eta_times_change(bond);
  }
  T over_length(const Stretched<T>& bond, const T&) const { return eta_times_change(bond) / bond.eta2; }

 private:
  T eta_times_change(const Stretched<T>& bond) const { return dot(bond.eta, apart(field_[bond.j].current, own_)); }

  const Site* field_;
  Vector3<T> own_;
};

// Σ ω V |ξ| e
template <class Family, class Weight, class Extension>
inline ScalarOf<Family> extensions(const Family& family, const Site* sites, Weight weight, const Extension& extension) {
  using T = ScalarOf<Family>;
  T moment = zero_vector<T>().c[0];
  over_stretched(family, sites, weight,
                 [&](const Stretched<T>& bond) { moment += bond.weight * extension.times_length(bond); });
  return moment;
}

// Σ ω V (|η| − (1 + ε) |ξ|)², from the difference of lengths: that of squares would lose the digits of a small strain.
template <class Family, class Weight>
inline ScalarOf<Family> squared_extensions(const Family& family, const Site* sites, Weight weight,
                                           const ScalarOf<Family>& expansion) {
  using T = ScalarOf<Family>;
  using std::sqrt;
  T square = zero_vector<T>().c[0];
  over_stretched(family, sites, weight, [&](const Stretched<T>& bond) {
    const T rest = sqrt(bond.xi2), e = sqrt(bond.eta2) - rest - expansion * rest;
    square += bond.weight * e * e;
  });
  return square;
}

template <class Family, class Weight, class Extension>
inline Vector3<ScalarOf<Family>> ordinary_force(const Family& family, const Site* sites, const ScalarState* states,
                                                Weight weight, const Extension& extension) {
  using T = ScalarOf<Family>;
  using std::sqrt;
  const auto own = family.template own<2>([&](int i) { return &states[i].a; });  // a, b
  Vector3<T> sum = zero_vector<T>();
  over_stretched(
      family, sites, weight,
      [&](const Stretched<T>& bond) {
        const ScalarState& there = states[bond.j];
        const T shrinkage = sqrt(bond.xi2 / bond.eta2);  // |ξ|/|η|
        const T pull = (own[0] + there.a) * shrinkage + (own[1] + there.b) * extension.over_length(bond, shrinkage);
        const T weighted = bond.weight * pull;
        for (int c = 0; c < 3; ++c) sum.c[c] += weighted * bond.eta.c[c];
      },
      states);
  return sum;
}

}  // namespace strut::bonds
