// The springs on the residual of both ends' gradients (mean gradient), for the ledger of bonds that break.
//
// As a point loses bonds its F jumps, and with it the residuals of all bonds that are left to it: their far ends need
// not have lost any. Of a bond i–j with the force t on the residual z = η − ½ (F_i + F_j) ξ the power is
//   t·(Δη − ½ ΔF_i ξ − ½ ΔF_j ξ),
// and its energy ½ z·t. Who has lost bonds counts half of it, to which his own ΔF_i belongs, and the half of a far end
// that has lost none as well.
#pragma once

#include <span>
#include <vector>

#include "fracture/point_account.hpp"

namespace strut {

struct SpringAccount {
  const StepEnd& end;
  const std::vector<GradientState>& now;     // of owned points and ghosts at this end of the step
  const std::vector<GradientState>& start;   // at its start
  const std::vector<GradientState>& finish;  // at its end

  // Of owned point i, whose bonds break in this step, with this family: the energy, J, and the work along the step, J,
  // but for −½ t·ΔF_i ξ, which its own force state holds.
  PointAccount of(int i, std::span<const int> family) const;
};

}  // namespace strut
