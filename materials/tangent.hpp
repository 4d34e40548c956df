// ∂σ/∂U of any law, by differences: what an implicit solver needs of it.
#pragma once

#include "materials/law.hpp"

namespace strut::materials {

using Tangent = Eigen::Matrix<double, 6, 6>;

inline Symmetric rate_between(const Symmetric& old_stretch, const Symmetric& stretch, double dt) {
  const Tensor difference = to_tensor(stretch - old_stretch), middle = 0.5 * to_tensor(stretch + old_stretch);
  return symmetric_part(difference * middle.inverse()) / dt;
}

template <class L>
Tangent tangent_of(const L& law, const Symmetric& old_stretch, const Symmetric& stretch, double dt,
                   const Symmetric& stress, const typename L::State& state) {
  const auto at = [&](const Symmetric& U) {
    typename L::State trial = state;
    return law.step({rate_between(old_stretch, U, dt), dt, to_tensor(U).determinant()}, stress, trial).stress;
  };
  constexpr double h = 1e-7;
  const Symmetric here = at(stretch);
  Tangent result;
  for (int c = 0; c < 6; ++c) {
    Symmetric U = stretch;
    U[c] += h;
    result.col(c) = (at(U) - here) / h;
  }
  return result;
}

}  // namespace strut::materials
