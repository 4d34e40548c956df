// One number of each of some points, side by side, and its way from the records of the points.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstring>

// As calls these would pass their lanes through memory.
#define STRUT_INLINE __attribute__((always_inline)) inline

namespace strut::small {

// As many points as a register holds; four at least.
#ifdef __AVX512F__
inline constexpr int lane_count = 8;
#else
inline constexpr int lane_count = 4;
#endif
using Lanes = Eigen::Array<double, lane_count, 1>;
// The same as the compiler's vector, whose comparisons give masks.
using RawLanes = double __attribute__((vector_size(8 * lane_count)));

template <class Expression>
RawLanes raw(const Expression& x) {
  RawLanes result;
  Eigen::Map<Lanes, Eigen::AlignedMax>(reinterpret_cast<double*>(&result)) = x;
  return result;
}
inline Eigen::Map<const Lanes, Eigen::AlignedMax> lanes(const RawLanes& x) {
  return Eigen::Map<const Lanes, Eigen::AlignedMax>(reinterpret_cast<const double*>(&x));
}

namespace detail {

using Quad = double __attribute__((vector_size(32)));
using Rows = std::array<RawLanes, 4>;

STRUT_INLINE Quad quad_at(const double* numbers) {
  Quad quad;
  std::memcpy(&quad, numbers, sizeof quad);
  return quad;
}

// Four rows of four or, for eight points, twice that beside each other: rows become columns.
STRUT_INLINE Rows transposed(const Rows& r) {
#ifdef __AVX512F__
#define STRUT_EVEN 0, 8, 2, 10, 4, 12, 6, 14
#define STRUT_ODD 1, 9, 3, 11, 5, 13, 7, 15
#define STRUT_LOW 0, 1, 8, 9, 4, 5, 12, 13
#define STRUT_HIGH 2, 3, 10, 11, 6, 7, 14, 15
#else
#define STRUT_EVEN 0, 4, 2, 6
#define STRUT_ODD 1, 5, 3, 7
#define STRUT_LOW 0, 1, 4, 5
#define STRUT_HIGH 2, 3, 6, 7
#endif
  const RawLanes a = __builtin_shufflevector(r[0], r[1], STRUT_EVEN),
                 b = __builtin_shufflevector(r[0], r[1], STRUT_ODD);
  const RawLanes c = __builtin_shufflevector(r[2], r[3], STRUT_EVEN),
                 d = __builtin_shufflevector(r[2], r[3], STRUT_ODD);
  return {__builtin_shufflevector(a, c, STRUT_LOW), __builtin_shufflevector(b, d, STRUT_LOW),
          __builtin_shufflevector(a, c, STRUT_HIGH), __builtin_shufflevector(b, d, STRUT_HIGH)};
#undef STRUT_EVEN
#undef STRUT_ODD
#undef STRUT_LOW
#undef STRUT_HIGH
}

}  // namespace detail

namespace detail {

template <class Of>
STRUT_INLINE RawLanes row_of(const Of& of, int k) {
#ifdef __AVX512F__
  return __builtin_shufflevector(quad_at(of(k)), quad_at(of(k + 4)), 0, 1, 2, 3, 4, 5, 6, 7);
#else
  return quad_at(of(k));
#endif
}

}  // namespace detail

// The four numbers from of(lane) on, of all lanes.
template <class Of>
STRUT_INLINE std::array<Lanes, 4> four_of(const Of& of) {
  const detail::Rows rows =
      detail::transposed({detail::row_of(of, 0), detail::row_of(of, 1), detail::row_of(of, 2), detail::row_of(of, 3)});
  return {lanes(rows[0]), lanes(rows[1]), lanes(rows[2]), lanes(rows[3])};
}

// The `count` numbers from of(lane) on; count is 4 at least.
template <int count, int first = 0, class Of>
STRUT_INLINE void take_numbers(const Of& of, std::array<Lanes, count>& numbers) {
  static_assert(count >= 4);
  if constexpr (first < count) {
    constexpr int at = first + 4 <= count ? first : count - 4;
    const std::array<Lanes, 4> four = four_of([&](int l) { return of(l) + at; });
    numbers[at] = four[0], numbers[at + 1] = four[1], numbers[at + 2] = four[2], numbers[at + 3] = four[3];
    take_numbers<count, first + 4>(of, numbers);
  }
}
template <int count, class Of>
STRUT_INLINE std::array<Lanes, count> numbers_of(const Of& of) {
  std::array<Lanes, count> numbers;
  take_numbers<count>(of, numbers);
  return numbers;
}

}  // namespace strut::small
