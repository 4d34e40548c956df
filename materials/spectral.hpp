// Spectral decomposition of symmetric tensors.
#pragma once

#include "base/math/tensors.hpp"

namespace strut::materials {

struct Principal {
  Vector values;
  Tensor axes;  // columns, a rotation or a reflection
};

// By rotations (QL), accurate to round-off of the largest value even for equal values, for which the closed form by the
// cosine loses half the digits. NaN if it fails. Not inline, because it would fill the loop over the points.
Principal principal(const Symmetric& s);

// Σ v_i n_i ⊗ n_i
Symmetric from_principal(const Vector& values, const Tensor& axes);

Symmetric exponential(const Symmetric& s);

}  // namespace strut::materials
