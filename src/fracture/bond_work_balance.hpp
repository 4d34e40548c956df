// Bond work balance: the energy of points and the work of their bonds, for the dissipation by broken bonds.
#pragma once

#include <array>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

// The positions of the points at one end of a step.
struct StepEnd {
  const Body& body;
  const std::vector<Vector>& start;  // positions of owned points and ghosts at the start of the step, m
  bool at_start;
  double dt = 0;  // length of the step, s

  Vector place(int j) const { return at_start ? start[j] : body.domain.current(j); }
};

struct BondWorkBalance {
  double energy = 0;  // elastic, dissipated, and of springs on the point's own gradient, J
  double work = 0;  // of the point's force states along the step's motion of its family, J: V Σ ω V_j T⟨ξ⟩·Δη
};

// The balances of a cluster's points, block.points[first] and those that follow, with their present families, states
// and force states.
std::array<BondWorkBalance, Cluster::width> balances_of(const MaterialBlock& block, int first, const Cluster& cluster,
                                                        const StepEnd& end);

}  // namespace strut
