// Keeps the stress of a point whose stretch jumps without motion, for instance because some of its bonds broke; the
// next step continues from that stress. A law of the first form uses rates only; a law of the second form with a
// history needs a function here, because its stress would follow the stretch.
#pragma once

#include "materials/polymer_foam.hpp"
#include "materials/user_law.hpp"

namespace strut::materials {

template <class L>
void move_stress(const L&, const Tensor& /* from */, const Tensor& /* to */, typename L::State&) {}

// b_e = U C_p⁻¹ U stays constant.
inline void move_stress(const PolymerFoam& law, const Tensor& from, const Tensor& to, PolymerFoam::State& state) {
  Eigen::Map<Symmetric> plastic(state.plastic_strain.data());
  const Tensor inverse = Tensor::Identity() - 2 * to_tensor(plastic), change = to.inverse() * from;
  plastic = 0.5 * symmetric_part(Tensor::Identity() - change * inverse * change.transpose());
  state.relative_density = law.initial_density / to.determinant();
}

// The next step of a library begins at the new stretch. A library of rates goes on from its stress; one whose stress is
// a function of the stretch follows the jump.
inline void move_stress(const UserLaw&, const Tensor& /* from */, const Tensor& to, UserLaw::State& state) {
  Eigen::Map<Symmetric>(state.displacement) = symmetric_part(to - Tensor::Identity());
}

}  // namespace strut::materials
