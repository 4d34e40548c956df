// 3×3 tensors over any scalar: double for one point, Lanes (SIMD) for several points, one per lane. The arithmetic of
// points and bonds (mechanics) is written once and runs on a register's width of points at a time; Eigen's matrices of
// doubles would leave most of each register empty.
#pragma once

#include "base/math/lanes.hpp"
#include "base/math/tensors.hpp"

namespace strut::small {

template <class T>
struct Vector3 {
  T c[3];
};

template <class T>
struct Tensor3 {
  T c[3][3];  // [row][column]
};

template <class T>
struct Symmetric3 {
  T c[6];  // xx yy zz xy yz zx
  const T& operator[](int i) const { return c[i]; }
  T& operator[](int i) { return c[i]; }
};

template <class T>
T trace(const Symmetric3<T>& s) {
  return s[0] + s[1] + s[2];
}

template <class T>
Symmetric3<T> deviator(const Symmetric3<T>& s) {
  const T mean = trace(s) / 3;
  return {{s[0] - mean, s[1] - mean, s[2] - mean, s[3], s[4], s[5]}};
}

// a : b
template <class T>
T double_dot(const Symmetric3<T>& a, const Symmetric3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

// a b
template <class T>
Tensor3<T> product(const Tensor3<T>& a, const Tensor3<T>& b) {
  Tensor3<T> r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r.c[i][j] = a.c[i][0] * b.c[0][j] + a.c[i][1] * b.c[1][j] + a.c[i][2] * b.c[2][j];
  }
  return r;
}

// aᵀ b
template <class T>
Tensor3<T> transposed_product(const Tensor3<T>& a, const Tensor3<T>& b) {
  Tensor3<T> r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r.c[i][j] = a.c[0][i] * b.c[0][j] + a.c[1][i] * b.c[1][j] + a.c[2][i] * b.c[2][j];
  }
  return r;
}

template <class T>
Tensor3<T> full(const Symmetric3<T>& s) {
  return {{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}};
}

template <class T>
Symmetric3<T> symmetric_part(const Tensor3<T>& a) {
  return {{a.c[0][0], a.c[1][1], a.c[2][2], 0.5 * (a.c[0][1] + a.c[1][0]), 0.5 * (a.c[1][2] + a.c[2][1]),
           0.5 * (a.c[2][0] + a.c[0][2])}};
}

// ε_ikj A_jk: twice the axial vector of the skew part of A.
template <class T>
Vector3<T> axial(const Tensor3<T>& a) {
  return {{a.c[2][1] - a.c[1][2], a.c[0][2] - a.c[2][0], a.c[1][0] - a.c[0][1]}};
}

template <class T>
T determinant(const Tensor3<T>& a) {
  return a.c[0][0] * (a.c[1][1] * a.c[2][2] - a.c[1][2] * a.c[2][1]) -
         a.c[0][1] * (a.c[1][0] * a.c[2][2] - a.c[1][2] * a.c[2][0]) +
         a.c[0][2] * (a.c[1][0] * a.c[2][1] - a.c[1][1] * a.c[2][0]);
}

template <class T>
Symmetric3<T> inverse(const Symmetric3<T>& s) {
  const T xx = s[1] * s[2] - s[4] * s[4], xy = s[4] * s[5] - s[3] * s[2], zx = s[3] * s[4] - s[1] * s[5];
  const T scale = 1 / (s[0] * xx + s[3] * xy + s[5] * zx);
  return {{xx * scale, (s[0] * s[2] - s[5] * s[5]) * scale, (s[0] * s[1] - s[3] * s[3]) * scale, xy * scale,
           (s[3] * s[5] - s[0] * s[4]) * scale, zx * scale}};
}

// s : s
template <class T>
T square(const Symmetric3<T>& s) {
  return double_dot(s, s);
}

// s v
template <class T>
Vector3<T> product(const Symmetric3<T>& s, const Vector3<T>& v) {
  return {{s[0] * v.c[0] + s[3] * v.c[1] + s[5] * v.c[2], s[3] * v.c[0] + s[1] * v.c[1] + s[4] * v.c[2],
           s[5] * v.c[0] + s[4] * v.c[1] + s[2] * v.c[2]}};
}

// The tensor of one lane.
inline Tensor at(const Tensor3<Lanes>& t, int lane) {
  Tensor r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r(i, j) = t.c[i][j][lane];
  }
  return r;
}
inline Vector at(const Vector3<Lanes>& v, int lane) { return {v.c[0][lane], v.c[1][lane], v.c[2][lane]}; }

}  // namespace strut::small
