// Force states by formulation: the data of an end point that a bond needs for its force.
#pragma once

#include <vector>

#include "base/math/tensors.hpp"
#include "mechanics/stabilization.hpp"

namespace strut {

// Data of a bond's end by correspondence: a tensor by columns; the fourth lane of each column holds one scalar.
struct alignas(32) TensorRecord {
  Eigen::Array4d column[3];
};

// A = P K⁻¹ − C F. Scalars: C of the springs on the residual of the end's own gradient (0 without any); 1 if the end
// has failed; 1 if bonds of it broke in this step and it has springs on the residual of both ends' gradients.
struct ForceState : TensorRecord {
  double& stiffness() { return column[0][3]; }
  double stiffness() const { return column[0][3]; }
  double& failed() { return column[1][3]; }
  double failed() const { return column[1][3]; }
  double& lost_bonds() { return column[2][3]; }
  double lost_bonds() const { return column[2][3]; }
};

// F. Scalars, of the springs on the residual of both ends' gradients: C; the factor on their force, which is the
// point's fraction of the step, or its square in a tangent (tangent_operator.cpp); the index of the stabilization in
// the variant.
struct GradientState : TensorRecord {
  double& stiffness() { return column[0][3]; }
  double stiffness() const { return column[0][3]; }
  double& force_factor() { return column[1][3]; }
  double kind() const { return column[2][3]; }
};

namespace bonds {

// A tensor and up to three scalars of a bond's end.
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

inline GradientState gradient_state(const Tensor& F, double stiffness, double force_factor,
                                    const Stabilization& stabilization) {
  GradientState state;
  pack_tensor(F, state);
  state.stiffness() = stiffness;
  state.force_factor() = force_factor;
  state.column[2][3] = static_cast<double>(stabilization.index());
  return state;
}

}  // namespace bonds

// State of an ordinary end: the force state along the bond is t = ω (a |ξ| + b e).
struct alignas(16) ScalarState {
  double a = 0, b = 0;  // (3K − 5μ) θ/m; 15 μ/m; Pa/m⁵
};

// State of an end by quadratic correspondence (quadratic_bonds.hpp): first and second force state, its part of the
// consistency correction, and 1 if all integration points of the end have failed.
struct alignas(64) QuadraticState {
  double first[9] = {}, second[18] = {}, correction[9] = {}, offset[3] = {}, failed = 0;
  static constexpr int size = 40;

  // Averages this state with the other one; `failed` keeps its value.
  void take_half_of(const QuadraticState& other) {
    for (int n = 0; n < 9; ++n) first[n] = 0.5 * (first[n] + other.first[n]);
    for (int n = 0; n < 18; ++n) second[n] = 0.5 * (second[n] + other.second[n]);
    for (int n = 0; n < 9; ++n) correction[n] = 0.5 * (correction[n] + other.correction[n]);
    for (int n = 0; n < 3; ++n) offset[n] = 0.5 * (offset[n] + other.offset[n]);
  }
};

// Each vector has an entry for every owned point and ghost if any block uses the formulation. The entry is zero if the
// point has another formulation, so that the force of any bond is the sum over the formulations.
struct ForceStates {
  std::vector<ForceState> tensors;
  std::vector<ScalarState> scalars;
  std::vector<GradientState> gradients;  // empty if no block has a stabilization by the gradients of both ends
  std::vector<QuadraticState> quadratics;

  // True if point i, owned or ghost, has failed.
  bool has_failed(std::size_t i) const {
    return (!tensors.empty() && tensors[i].failed() > 0) || (!quadratics.empty() && quadratics[i].failed > 0);
  }
  double bytes() const {
    return static_cast<double>(tensors.size() * sizeof(ForceState) + scalars.size() * sizeof(ScalarState) +
                               gradients.size() * sizeof(GradientState) + quadratics.size() * sizeof(QuadraticState));
  }
};

}  // namespace strut
