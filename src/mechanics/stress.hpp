// Inside mechanics: the pass over the points that ends in their force states.
#pragma once

#include "mechanics/mechanics.hpp"

namespace strut {

enum class Part { interior, boundary };  // the points that need no ghost; the others

inline std::pair<int, int> range(const MaterialBlock& block, Part part) {
  if (part == Part::interior) return {0, block.interior};
  return {block.interior, static_cast<int>(block.points.size())};
}

inline ForceState packed(const Tensor& A, double stabilization) {
  ForceState state;
  for (int c = 0; c < 3; ++c) state.column[c] << A.col(c).array(), 0;
  state.column[0][3] = stabilization;
  return state;
}

void advance_stress(Body& body, double dt, bool with_energy, Part part, StepReport& report);

}  // namespace strut
