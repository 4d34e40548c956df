// Rotations, and the polar decomposition that gives the unrotated frame of the laws.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/math/small_tensors.hpp"

namespace strut {

// A rotation, stored by two columns; the third is their cross product.
class Rotation {
 public:
  Rotation() : Rotation(Tensor::Identity()) {}
  explicit Rotation(const Tensor& R) { std::copy_n(R.data(), 6, numbers_); }
  Tensor tensor() const {
    const Eigen::Map<const Vector> first(numbers_), second(numbers_ + 3);
    Tensor R;
    R << first, second, first.cross(second);
    return R;
  }
  double& number(int c) { return numbers_[c]; }  // 0 ≤ c < 6
  const double& number(int c) const { return numbers_[c]; }

 private:
  double numbers_[6];
};

template <class T>
struct Polar {
  small::Tensor3<T> rotation;    // R
  small::Symmetric3<T> stretch;  // U
};

// The rotation with the axis h and the angle 2 atan |h| (Rodrigues' parameters, the Cayley transform):
// (1 − |h|²) I + 2 h⊗h + 2 [h×], over 1 + |h|².
template <class T>
small::Tensor3<T> rotation_of(const small::Vector3<T>& h) {
  const T &x = h.c[0], &y = h.c[1], &z = h.c[2];
  const T scale = 2 / (1 + x * x + y * y + z * z), diagonal = scale - 1;
  const T sx = scale * x, sy = scale * y, sz = scale * z;
  return {{{diagonal + sx * x, sx * y - sz, sx * z + sy},
           {sx * y + sz, diagonal + sy * y, sy * z - sx},
           {sx * z - sy, sy * z + sx, diagonal + sz * z}}};
}

// The third column of a rotation from the first two.
template <class T>
void complete(small::Tensor3<T>& R) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    R.c[i][2] = R.c[j][0] * R.c[k][1] - R.c[k][0] * R.c[j][1];
  }
}

// The polar decomposition F = R U at the end of a step, from R at its start: Flanagan & Taylor's (1987) condition that
// the stretch remain symmetric, applied to the step instead of the instant. Their rate form
//   ω = w − [V − (tr V) I]⁻¹ z,  z_i = ε_ikj D_jm V_mk
// is integrated with V at the start and drifts by a term of first order in dt; the step form
//   [(tr S) I − S] θ = axial(R_nᵀ F),  S = sym(R_nᵀ F),  R = R_n (rotation by θ)
// is one Newton step toward the polar decomposition itself, so that the next step removes the error of one step. It
// costs the same, needs no velocity gradient, and is exact for rigid rotations below 90° per step.
template <class T>
Polar<T> polar_update(const small::Tensor3<T>& old_rotation, const small::Tensor3<T>& deformation_gradient) {
  using std::sqrt;
  const small::Tensor3<T> turned = small::transposed_product(old_rotation, deformation_gradient);
  const small::Symmetric3<T> s = small::symmetric_part(turned);
  const small::Symmetric3<T> defect{{s[1] + s[2], s[0] + s[2], s[0] + s[1], -s[3], -s[4], -s[5]}};
  const small::Vector3<T> t = small::product(small::inverse(defect), small::axial(turned));  // axis times tan(angle)
  const T half = 1 / (1 + sqrt(1 + t.c[0] * t.c[0] + t.c[1] * t.c[1] + t.c[2] * t.c[2]));    // tan(angle/2)/tan(angle)
  const small::Tensor3<T> increment = rotation_of(small::Vector3<T>{{half * t.c[0], half * t.c[1], half * t.c[2]}});
  small::Tensor3<T> rotation = small::product(old_rotation, increment);
  complete(rotation);  // the stretch must be that of the stored rotation, or round-off would accumulate as strain
  return {rotation, small::symmetric_part(small::transposed_product(rotation, deformation_gradient))};
}

// R of F = R U from F alone, whatever the rotation was before: Newton's iteration R ← ½ (R + R⁻ᵀ) (Higham 1986). It
// converges quadratically from any F with det F > 0, in half a dozen iterations at moderate stretches. For occasional
// output; polar_update is cheaper for successive steps.
Tensor polar_rotation(const Tensor& deformation_gradient);

}  // namespace strut
