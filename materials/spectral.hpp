// Symmetric tensors by their principal values.
#pragma once

#include "base/math/tensors.hpp"

namespace strut::materials {

struct Principal {
  Vector values;
  Tensor axes;  // columns, a rotation or a reflection
};

// By rotations (QL), to round-off of the largest value also where values are equal; the closed form by the cosine loses
// half the digits there. NaN where none are found. Not inline: it would fill the loop over the points.
Principal principal(const Symmetric& s);

// Σ v_i n_i ⊗ n_i
Symmetric from_principal(const Vector& values, const Tensor& axes);

Symmetric exponential(const Symmetric& s);

}  // namespace strut::materials
