// SIMD: numbers of several points, one per lane, for laws that process points side by side. Code with + − * / < && and
// ?: is the same for one point (double) and for lanes, for which a comparison gives a mask and ?: selects by lane. The
// functions here correspond to those of the standard library; exp and log are Eigen's, accurate to two units in the
// last place.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "base/math/small_tensors.hpp"
#include "base/math/tensors.hpp"

namespace strut::materials {

using small::RawLanes;
template <class T>
using MaskOf = decltype(T{} < T{});  // bool for double
using Mask = MaskOf<RawLanes>;

template <class T>
using SymmetricOf = std::conditional_t<std::is_same_v<T, double>, Symmetric, small::Symmetric3<T>>;

// The same number in each lane.
template <class T>
T same(double value) {
  return T{} + value;
}

inline bool any(bool is) { return is; }
inline bool any(const Mask& is) {
#ifdef __AVX512F__
  return _mm512_test_epi64_mask(reinterpret_cast<__m512i>(is), reinterpret_cast<__m512i>(is)) != 0;
#else
  const Mask none{};
  return std::memcmp(&is, &none, sizeof is) != 0;
#endif
}

using std::exp, std::log, std::expm1, std::sqrt;
inline RawLanes exp(const RawLanes& x) { return small::raw(small::lanes(x).exp()); }
inline RawLanes log(const RawLanes& x) { return small::raw(small::lanes(x).log()); }
inline RawLanes sqrt(const RawLanes& x) { return small::raw(small::lanes(x).sqrt()); }
inline RawLanes expm1(const RawLanes& x) { return exp(x) - 1; }  // near 0 accurate to the round-off of 1

// A struct of such numbers only, such as a law's state, as an array of them.
template <class T, class S>
auto numbers_in(const S& all) {
  return std::bit_cast<std::array<T, sizeof(S) / sizeof(T)>>(all);
}

// `one` where the mask is set, else `other`.
template <class S>
S chosen(bool where, const S& one, const S& other) {
  return where ? one : other;
}
template <class S>
S chosen(const Mask& where, const S& one, const S& other) {
  const auto from = numbers_in<RawLanes>(one);
  auto to = numbers_in<RawLanes>(other);
  for (std::size_t c = 0; c < to.size(); ++c) to[c] = where ? from[c] : to[c];
  return std::bit_cast<S>(to);
}

// One lane, as the same struct of doubles; and back.
template <class One, class S>
One lane_of(const S& all, int lane) {
  const auto numbers = numbers_in<RawLanes>(all);
  std::array<double, numbers.size()> of_lane;
  for (std::size_t c = 0; c < numbers.size(); ++c) of_lane[c] = numbers[c][lane];
  return std::bit_cast<One>(of_lane);
}
template <class One, class S>
void set_lane(S& all, int lane, const One& one) {
  auto numbers = numbers_in<RawLanes>(all);
  const auto of_lane = numbers_in<double>(one);
  for (std::size_t c = 0; c < numbers.size(); ++c) numbers[c][lane] = of_lane[c];
  all = std::bit_cast<S>(numbers);
}

template <class T>
T absolute(const T& x) {
  return x < 0 ? -x : x;
}
template <class T>
auto is_finite(const T& x) {
  return x - x == 0;
}

}  // namespace strut::materials
