// SIMD: numbers of several points, one per lane, as a law may take them ("side by side"). What is written with + − * /
// < && and ?: is the same for one point (double) and for these, where a comparison gives a mask and ?: chooses by lane.
// Functions here are those of the standard library for them; exp and log are Eigen's, good to two units in the last
// place.
#pragma once

#include <cmath>
#include <cstring>
#include <type_traits>

#include "base/math/small_tensors.hpp"
#include "base/math/tensors.hpp"

namespace strut::materials {

using small::RawLanes;
template <class T>
using MaskOf = decltype(T{} < T{});  // bool of a double
using Mask = MaskOf<RawLanes>;

template <class T>
using SymmetricOf = std::conditional_t<std::is_same_v<T, double>, Symmetric, small::Symmetric3<T>>;

// The same number for each.
template <class T>
T same(double value) {
  return T{} + value;
}

inline bool any(bool is) { return is; }
inline bool any(const Mask& is) {
  const Mask none{};
  return std::memcmp(&is, &none, sizeof is) != 0;
}

using std::exp, std::log, std::expm1, std::sqrt;
inline RawLanes exp(const RawLanes& x) { return small::raw(small::lanes(x).exp()); }
inline RawLanes log(const RawLanes& x) { return small::raw(small::lanes(x).log()); }
inline RawLanes sqrt(const RawLanes& x) { return small::raw(small::lanes(x).sqrt()); }
inline RawLanes expm1(const RawLanes& x) { return exp(x) - 1; }  // near 0 good to round-off of 1

template <class T>
T absolute(const T& x) {
  return x < 0 ? -x : x;
}
template <class T>
auto is_finite(const T& x) {
  return x - x == 0;
}

}  // namespace strut::materials
