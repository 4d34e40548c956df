// The two sums over a family that ordinary points need. With ξ = X_j − X_i, η = y_j − y_i and e = |η| − |ξ|:
//   extensions:  Σ ω V_j |ξ| e  (θ = 3/m of it),  Σ ω V_j e²
//   force:       f_i = Σ ω V_j [ (a_i + a_j)|ξ| + (b_i + b_j) e ] η/|η|
// All of a bond but its direction is numbers here, so four bonds run side by side, one a lane. A square root or a
// division costs as much as ten other operations; as few as can be are left:
//   |ξ| e = √(|ξ|² |η|²) − |ξ|²,  |ξ|/|η| = √(|ξ|²/|η|²),  e/|η| = 1 − |ξ|/|η|
// Lanes take the bonds in the order of global ids, so that the sums are the same on any number of ranks.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>

#include "base/small_tensors.hpp"
#include "mechanics/bonds.hpp"

namespace strut::bonds {

using small::Lanes;
using LaneVector = small::Vector3<Lanes>;

inline Lanes dot(const LaneVector& u, const LaneVector& v) {
  return u.c[0] * v.c[0] + u.c[1] * v.c[1] + u.c[2] * v.c[2];
}

// The first and the second number of four records, one record a lane. With vectors of the compiler: number by number it
// takes twice the instructions.
struct TwoLanes {
  Lanes first, second;
};

inline TwoLanes side_by_side(const std::array<const double*, 4>& records) {
  using Two = double __attribute__((vector_size(16)));
  using Four = double __attribute__((vector_size(32)));
  const auto load = [&records](int l) {
    Two two;
    std::memcpy(&two, records[l], sizeof two);
    return two;
  };
  const auto lanes = [](const Four& four) {
    Lanes result;
    std::memcpy(result.data(), &four, sizeof four);
    return result;
  };
  const Four even = __builtin_shufflevector(load(0), load(2), 0, 1, 2, 3);
  const Four odd = __builtin_shufflevector(load(1), load(3), 0, 1, 2, 3);
  return {lanes(__builtin_shufflevector(even, odd, 0, 4, 2, 6)), lanes(__builtin_shufflevector(even, odd, 1, 5, 3, 7))};
}

// Local indices of the far ends of four bonds.
using Ends = std::array<int, 4>;

// Differences to `here`, and the fourth lanes as they are: V of references, δ of current places.
struct Apart {
  LaneVector vector;
  Lanes fourth;
};

inline Apart apart(const Ends& ends, const Site* sites, Eigen::Array4d Site::*place, const Eigen::Array4d& here) {
  std::array<const double*, 4> front, back;
  for (int l = 0; l < 4; ++l) {
    front[l] = (sites[ends[l]].*place).data();
    back[l] = front[l] + 2;
  }
  const auto [x, y] = side_by_side(front);
  const auto [z, fourth] = side_by_side(back);
  return {{{x - here[0], y - here[1], z - here[2]}}, fourth};
}

struct FourBonds {
  Ends ends;
  Lanes weight;  // ω V_j; 0 of a bond that stands in for a missing one
  Lanes xi2;     // |ξ|²
  LaneVector eta;
  Lanes eta2;  // |η|²
};

// Calls visit(four bonds) over the family of point i. Where the family ends, its last bond stands in.
template <class Weight, class Visit>
inline void over_fours(const Families& families, const Site* sites, int i, Weight, Visit&& visit) {
  const Site here = sites[i];
  const auto bonds = [&](const Ends& ends, const Lanes& present) {
    const Apart reference = apart(ends, sites, &Site::reference, here.reference);
    const Apart current = apart(ends, sites, &Site::current, here.current);
    const Lanes xi2 = dot(reference.vector, reference.vector), eta2 = dot(current.vector, current.vector);
    const Lanes ratio = 2 * xi2.sqrt() / (here.current[3] + current.fourth);
    visit(FourBonds{ends, present * reference.fourth * Weight::of(ratio), xi2, current.vector, eta2});
  };
  const int* const all = families.neighbours.data();
  const std::size_t end = families.start[i + 1];
  std::size_t b = families.start[i];
  for (; b + 4 <= end; b += 4) bonds({all[b], all[b + 1], all[b + 2], all[b + 3]}, Lanes::Ones());
  if (b == end) return;
  Ends ends;
  Lanes present;
  for (std::size_t l = 0; l < 4; ++l) {
    ends[l] = all[std::min(b + l, end - 1)];
    present[static_cast<int>(l)] = b + l < end ? 1 : 0;
  }
  bonds(ends, present);
}

// What the extension e of a bond is: that of its places …
struct OfPlaces {
  Lanes times_length(const FourBonds& four, int) const { return (four.xi2 * four.eta2).sqrt() - four.xi2; }  // |ξ| e
  Lanes over_length(const FourBonds&, int, const Lanes& shrinkage) const { return 1 - shrinkage; }           // e/|η|
};

// … or its change η·(v_j − v_i)/|η| along a field v, which stands in the current places of sites of its own.
struct OfField {
  const Site* field;

  Lanes times_length(const FourBonds& four, int i) const {
    return (four.xi2 / four.eta2).sqrt() * eta_times_change(four, i);
  }
  Lanes over_length(const FourBonds& four, int i, const Lanes&) const { return eta_times_change(four, i) / four.eta2; }

 private:
  Lanes eta_times_change(const FourBonds& four, int i) const {
    return dot(four.eta, apart(four.ends, field, &Site::current, field[i].current).vector);
  }
};

struct Extensions {
  double moment;  // Σ ω V |ξ| e
  double square;  // Σ ω V (|η| − |ξ|)², if asked for
};

template <bool with_square, class Weight, class Extension>
inline Extensions extensions(const Families& families, const Site* sites, int i, Weight weight, Extension extension) {
  Lanes moment = Lanes::Zero(), square = Lanes::Zero();
  over_fours(families, sites, i, weight, [&](const FourBonds& four) {
    moment += four.weight * extension.times_length(four, i);
    // Of the difference of lengths: in that of squares nothing would be left of a small strain's.
    if constexpr (with_square) square += four.weight * (four.eta2.sqrt() - four.xi2.sqrt()).square();
  });
  return {moment.sum(), square.sum()};
}

template <class Weight, class Extension>
inline Vector ordinary_force(const Families& families, const Site* sites, const ScalarState* states, int i,
                             Weight weight, Extension extension) {
  const ScalarState here = states[i];
  LaneVector sum{{Lanes::Zero(), Lanes::Zero(), Lanes::Zero()}};
  over_fours(families, sites, i, weight, [&](const FourBonds& four) {
    const Ends& ends = four.ends;
    const auto [a, b] = side_by_side({&states[ends[0]].a, &states[ends[1]].a, &states[ends[2]].a, &states[ends[3]].a});
    const Lanes shrinkage = (four.xi2 / four.eta2).sqrt();  // |ξ|/|η|
    const Lanes pull = (here.a + a) * shrinkage + (here.b + b) * extension.over_length(four, i, shrinkage);
    const Lanes weighted = four.weight * pull;
    for (int c = 0; c < 3; ++c) sum.c[c] += weighted * four.eta.c[c];
  });
  return {sum.c[0].sum(), sum.c[1].sum(), sum.c[2].sum()};
}

}  // namespace strut::bonds
