// By correspondence, what the break of a bond releases, compared with the bond's share of the fracture energy.
//
// A break at fixed positions changes the fit of F. With z = η − F ξ and κ = ω V_j ξ·K⁻¹ξ,
//   ΔF = −ω V_j z ⊗ K⁻¹ξ/(1 − κ),
// and an end releases V (−P:ΔF − ½ Δε:C:Δε) and the energy of the bond's springs. A flat cut of a body must take G_c
// per area A. N bonds ξ per volume cross it as often as N |ξ·n| A, so an end's part of the energy of a bond is
//   S = ½ G_c V_i ω V_j/(|ξ| f),  f(n) = ½ Σ ω V_k |ξ_k·n|/|ξ_k|  over its first family,
// with the direction n in which the bond opens: the sum over all bonds across any flat cut is G_c A. A bond breaks
// where both ends together release their parts. A uniform strain leaves no z: there S counts as released where the
// strain stretches the bond by the critical stretch.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

class BondReleases {
 public:
  // Below this fraction of the critical stretch no bond is examined.
  static constexpr double least_stretch = 0.3;

  BondReleases() = default;  // no block has such bonds
  explicit BondReleases(const Body& body);

  bool any() const { return !records_.empty(); }
  // True if the bonds of this block break by what they release.
  static bool decide(const MaterialBlock& block);

  // Collective. At the start of a step, examines the bonds of the points of these clusters; `due`: a flag of each.
  void take(const Body& body, const std::vector<char>& due);
  // True if the bond between owned point i and j releases the parts of those of its ends that count.
  bool breaks(const Body& body, int i, int j, bool own_counts, bool far_counts) const;
  // What the stress of owned point i gives up if its bond to j breaks, J.
  double given_up(const Body& body, int i, int j) const;

  double bytes() const { return static_cast<double>(records_.size() * sizeof(Record)); }

 private:
  // A bond that may break: the id of the far end, |ξ|², the energy released minus its part, what the stress gives up.
  struct Bond {
    std::int64_t far;
    double square, excess, gives;
  };
  struct Record {
    static constexpr int most = 8;
    int count = 0;
    int carries_stress = 1;
    Bond bonds[most];
  };
  static void add(Record& record, const Bond& bond);
  void examine(const Body& body, int i);
  const Bond* find(const Body& body, int i, int j) const;

  std::vector<Record> records_;  // of owned points and ghosts
  std::vector<int> filled_;      // owned points with bonds in their records
  bool any_filled_ = false;      // on any rank
};

}  // namespace strut
