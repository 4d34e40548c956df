// Bond work balance of the springs on the residual of both ends' gradients (mean gradient).
//
// When bonds of a point break, its F jumps, and so do the residuals of all of its intact bonds, even if their far ends
// lost none. The power of a bond i–j with the force t on the residual z = η − ½ (F_i + F_j) ξ is
//   t·(Δη − ½ ΔF_i ξ − ½ ΔF_j ξ),
// and its energy is ½ z·t. A point whose bonds broke counts its half of the bond, with its own ΔF_i, and also the half
// of a far end whose bonds did not break.
#pragma once

#include <span>
#include <vector>

#include "fracture/bond_work_balance.hpp"

namespace strut {

struct SpringWorkBalance {
  const StepEnd& end;
  const std::vector<GradientState>& now;     // of owned points and ghosts, at the end of the step that is evaluated
  const std::vector<GradientState>& start;   // at the start of the step
  const std::vector<GradientState>& finish;  // at the end of the step

  // Energy and work along the step (J) of owned point i, whose bonds break in this step, with this family; without the
  // work −½ t·ΔF_i ξ, which is part of the point's own force state.
  BondWorkBalance of(int i, std::span<const int> family) const;
};

}  // namespace strut
