// Inside mechanics: packs a tensor and up to three scalars of a bond's end into a record.
#pragma once

#include "mechanics/body.hpp"

namespace strut::bonds {

inline void pack_tensor(const Tensor& tensor, TensorRecord& record) {
  for (int c = 0; c < 3; ++c) record.column[c] << tensor.col(c).array(), 0;
}

inline Tensor tensor_of(const TensorRecord& record) {
  Tensor tensor;
  for (int c = 0; c < 3; ++c) tensor.col(c) = record.column[c].head<3>().matrix();
  return tensor;
}

inline ForceState force_state(const Tensor& A, double stiffness) {
  ForceState state;
  pack_tensor(A, state);
  state.stiffness() = stiffness;
  return state;
}

inline GradientState gradient_state(const Tensor& F, double stiffness, double step_share,
                                    const Stabilization& stabilization) {
  GradientState state;
  pack_tensor(F, state);
  state.stiffness() = stiffness;
  state.step_share() = step_share;
  state.column[2][3] = static_cast<double>(stabilization.index());
  return state;
}

}  // namespace strut::bonds
