// The rotation of the material: the frame in which laws see their stress. Inline: it stands in the loop over points.
#pragma once

#include "base/tensors.hpp"

namespace strut {

struct Polar {
  Tensor rotation;    // R
  Symmetric stretch;  // U
};

namespace rotation {


// ε_ikj A_jk: twice the axial vector of the skew part of A.
inline Vector axial(const Tensor& a) { return {a(2, 1) - a(1, 2), a(0, 2) - a(2, 0), a(1, 0) - a(0, 1)}; }

// [(tr S) I − S]⁻¹ v
inline Vector solved(const Symmetric& s, const Vector& v) {
  const Symmetric inverse = inverted({s[1] + s[2], s[0] + s[2], s[0] + s[1], -s[3], -s[4], -s[5]}).inverse;
  return {inverse[0] * v[0] + inverse[3] * v[1] + inverse[5] * v[2],
          inverse[3] * v[0] + inverse[1] * v[1] + inverse[4] * v[2],
          inverse[5] * v[0] + inverse[4] * v[1] + inverse[2] * v[2]};
}

// tan(angle/2) over tan(angle), from the square of tan(angle).
inline double half_angle(double squared) {
  // A step turns little as a rule; the series is then exact to round-off and saves a root.
  if (squared < 1e-5) return 0.5 - squared * (0.125 - 0.0625 * squared);
  return 1 / (1 + std::sqrt(1 + squared));
}

// The rotation whose axis is h and whose angle is 2 atan |h| (Rodrigues' parameters, the Cayley transform):
// (1 − |h|²) I + 2 h⊗h + 2 [h×], over 1 + |h|².
inline Tensor rotation_of(const Vector& h) {
  const double scale = 2 / (1 + h.squaredNorm()), diagonal = scale - 1;
  const Vector g = scale * h;
  Tensor r;
  r << diagonal + g[0] * h[0], g[0] * h[1] - g[2], g[0] * h[2] + g[1],  //
      g[1] * h[0] + g[2], diagonal + g[1] * h[1], g[1] * h[2] - g[0],   //
      g[2] * h[0] - g[1], g[2] * h[1] + g[0], diagonal + g[2] * h[2];
  return r;
}

}  // namespace rotation

// The polar decomposition F = R U at the end of a step, from R at its start: Flanagan & Taylor's (1987) condition that
// the stretch stay symmetric, posed for the step instead of the instant. Their rate form
//   ω = w − [V − (tr V) I]⁻¹ z,  z_i = ε_ikj D_jm V_mk
// is integrated with V at the start and drifts by a term of first order in dt; the step form
//   [(tr S) I − S] θ = axial(R_nᵀ F),  S = sym(R_nᵀ F),  R = R_n exp(θ)
// is one Newton step towards the polar decomposition itself, so an error of one step is removed in the next. It costs
// the same, needs no velocity gradient, and is exact for a rigid rotation of any size below 90° a step.
inline Polar polar_update(const Tensor& old_rotation, const Tensor& deformation_gradient) {
  const Tensor turned = old_rotation.transpose() * deformation_gradient;  // the rotation of this step, times U
  const Vector tangent = rotation::solved(symmetric_part(turned), rotation::axial(turned));   // tan of its angle, about its axis
  const Tensor increment = rotation::rotation_of(rotation::half_angle(tangent.squaredNorm()) * tangent);
  return {old_rotation * increment, symmetric_part(increment.transpose() * turned)};
}

}  // namespace strut
