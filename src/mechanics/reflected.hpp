// Inside mechanics and integrators: reflects what bonds read of a point to its image by symmetry planes
// (topology/mirror.hpp). Scalars stay, vectors are reflected, tensors are reflected on both sides.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

inline void reflect(const Reflection& by, TensorRecord& record) {
  const Tensor tensor = by.turn * bonds::tensor_of(record) * by.turn.transpose();
  for (int c = 0; c < 3; ++c) record.column[c].head<3>() = tensor.col(c).array();
}

inline void reflect(const Reflection&, ScalarState&) {}

// Reflects a vector of three numbers.
inline void turn(const Reflection& by, double* numbers) {
  Eigen::Map<Vector> direction(numbers);
  direction = (by.turn * direction).eval();
}

// Reflects a tensor that is stored by rows.
inline void reflect_rows(const Reflection& by, double* rows) {
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> tensor(rows);
  tensor = (by.turn * tensor * by.turn.transpose()).eval();
}

inline void reflect_multiplier(const Reflection& by, Eigen::Array4d& multiplier) {
  multiplier.head<3>() = (by.turn * multiplier.head<3>().matrix()).eval().array();
}

// Each row is a symmetric tensor M as xx, yy, zz, xy, yz, zx: ½ ξ·M ξ = M q.
inline void reflect_second(const Reflection& by, double* rows) {
  Eigen::Map<Eigen::Matrix<double, 3, 6, Eigen::RowMajor>> second(rows);
  Eigen::Matrix<double, 3, 6> turned;
  for (int r = 0; r < 3; ++r) {
    const Symmetric M = second.row(r).transpose();
    turned.row(r) = symmetric_part(by.turn * to_tensor(M) * by.turn.transpose()).transpose();
  }
  second = by.turn * turned;
}

inline void reflect(const Reflection& by, QuadraticState& state) {
  reflect_rows(by, state.first);
  reflect_second(by, state.second);
  reflect_rows(by, state.correction);
  turn(by, state.offset);
}

}  // namespace strut
