// Bond work balance: the energy of points and the work of their bonds, for the dissipation by broken bonds.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

// One end of a step, at which a balance is evaluated: the start if `at_start`, else the end.
struct StepEnd {
  const Body& body;
  const std::vector<Vector>& start;  // positions of owned points and ghosts at the start of the step, m
  bool at_start;
  double dt = 0;  // length of the step, s

  Vector position(int j) const { return at_start ? start[j] : body.domain.current(j); }
};

struct BondWorkBalance {
  double energy = 0;  // elastic, dissipated, and of springs on the point's own gradient, J
  double work = 0;  // of the point's force states along the step's motion of its family, J: V Σ ω V_j T⟨ξ⟩·Δη
};

// The balances of a cluster's points, block.points[first] and those that follow, with their present families, states
// and force states.
std::array<BondWorkBalance, Cluster::width> balances_of(const MaterialBlock& block, int first, const Cluster& cluster,
                                                        const StepEnd& end);

// Bond work balance of the springs on the residual of both ends' gradients (mean gradient).
//
// When bonds of a point break, its F jumps, and so do the residuals of all of its intact bonds, even if their far ends
// lost none. The power of a bond i–j with the force t on the residual z = η − ½ (F_i + F_j) ξ is
//   t·(Δη − ½ ΔF_i ξ − ½ ΔF_j ξ),
// and its energy is ½ z·t. A point whose bonds broke counts its half of the bond, with its own ΔF_i, and also the half
// of a far end whose bonds did not break.
struct SpringWorkBalance {
  const StepEnd& end;
  const std::vector<GradientState>& now;     // of owned points and ghosts, at the end of the step that is evaluated
  const std::vector<GradientState>& start;   // at the start of the step
  const std::vector<GradientState>& finish;  // at the end of the step

  // Energy and work along the step (J) of the springs of owned point i, whose bonds break in this step, with this
  // family; without −½ t·ΔF_i ξ, which the work of the point's own force state contains.
  BondWorkBalance of(int i, std::span<const int> family) const;
};

// Springs on both ends' gradients beside a gradual crack. Their stiffness falls with the stress of their softer end:
// whole springs would hold over the points that soften, and the crack would take up to twice its fracture energy.

// True if the block has such springs.
inline bool springs_fade(const MaterialBlock& block) {
  return block.material.damage && block.material.damage->is_gradual && block.has_springs(ResidualKind::both_gradients);
}

// Counts as fracture energy what springs have lost since the step's start, whose gradient states are given: for a
// bond ½ (C − C') z·z', with its residuals z and z' at both ends of the step; where the bonds of an end broke, its bond
// work balance has that.
void count_fading(Body& body, const StepEnd& end, const std::vector<GradientState>& start);

}  // namespace strut
