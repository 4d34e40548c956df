// Tensors of a material point: Eigen types, with the order of components that files, laws and tests share.
#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace strut {

using Vector = Eigen::Vector3d;
using Tensor = Eigen::Matrix3d;

// A symmetric tensor, components xx yy zz xy yz zx (each shear stored once).
using Symmetric = Eigen::Matrix<double, 6, 1>;

inline double trace(const Symmetric& s) { return s[0] + s[1] + s[2]; }

inline Symmetric spherical(double value) {
  Symmetric s = Symmetric::Zero();
  s[0] = s[1] = s[2] = value;
  return s;
}

inline Symmetric deviator(const Symmetric& s) {
  Symmetric d = s;
  const double mean = trace(s) / 3;
  for (int i = 0; i < 3; ++i) d[i] -= mean;
  return d;
}

// a : b
inline double double_dot(const Symmetric& a, const Symmetric& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

inline Tensor to_tensor(const Symmetric& s) {
  Tensor t;
  t << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return t;
}

inline Symmetric symmetric_part(const Tensor& t) {
  return {t(0, 0), t(1, 1), t(2, 2), 0.5 * (t(0, 1) + t(1, 0)), 0.5 * (t(1, 2) + t(2, 1)), 0.5 * (t(2, 0) + t(0, 2))};
}

// sqrt(3/2 dev(s) : dev(s))
inline double von_mises(const Symmetric& s) {
  const Symmetric d = deviator(s);
  return std::sqrt(1.5 * double_dot(d, d));
}

}  // namespace strut
