// SIMD: one number of each of several points, one per lane, and its transfer from the records of the points. Such
// points are said to be side by side.
#pragma once

#ifdef __AVX__
#include <immintrin.h>
#endif

#include <Eigen/Core>
#include <array>
#include <cstring>
#include <utility>

// Inlined, because calls would pass their lanes through memory.
#define STRUT_INLINE __attribute__((always_inline)) inline

namespace strut::small {

// As many points as a register has lanes; at least four.
#ifdef __AVX512F__
inline constexpr int lane_count = 8;
#else
inline constexpr int lane_count = 4;
#endif
using Lanes = Eigen::Array<double, lane_count, 1>;
// The same as the compiler's vector type, whose comparisons give masks.
using RawLanes = double __attribute__((vector_size(8 * lane_count)));

// Local indices of points side by side.
using Indices = std::array<int, lane_count>;

template <class Expression>
RawLanes raw(const Expression& x) {
  RawLanes result;
  Eigen::Map<Lanes, Eigen::AlignedMax>(reinterpret_cast<double*>(&result)) = x;
  return result;
}
inline Eigen::Map<const Lanes, Eigen::AlignedMax> lanes(const RawLanes& x) {
  return Eigen::Map<const Lanes, Eigen::AlignedMax>(reinterpret_cast<const double*>(&x));
}

// Bit l: lane l is negative. Written lane by lane it costs several times as much.
STRUT_INLINE unsigned lanes_below_zero(const Lanes& x) {
#if defined __AVX512F__
  return _mm512_cmp_pd_mask(_mm512_load_pd(x.data()), _mm512_setzero_pd(), _CMP_LT_OQ);
#elif defined __AVX__
  return static_cast<unsigned>(
      _mm256_movemask_pd(_mm256_cmp_pd(_mm256_load_pd(x.data()), _mm256_setzero_pd(), _CMP_LT_OQ)));
#else
  unsigned bits = 0;
  for (int l = 0; l < lane_count; ++l) bits |= static_cast<unsigned>(x[l] < 0) << l;
  return bits;
#endif
}

// Lanes filled with of(lane).
template <class Of>
STRUT_INLINE Lanes lanes_of(const Of& of) {
  Lanes values;
  for (int l = 0; l < lane_count; ++l) values[l] = of(l);
  return values;
}

#ifndef __AVX512F__
namespace detail {

struct alignas(Lanes) Ones {
  double lane[lane_count];
};
inline constexpr std::array<Ones, 1 << lane_count> ones = [] {
  std::array<Ones, 1 << lane_count> table{};
  for (unsigned mask = 0; mask < table.size(); ++mask) {
    for (int l = 0; l < lane_count; ++l) table[mask].lane[l] = mask >> l & 1;
  }
  return table;
}();

}  // namespace detail
#endif

// 1 in the lanes whose bit is set, 0 in others.
STRUT_INLINE Lanes ones_in(unsigned bits) {
#ifdef __AVX512F__
  return lanes(RawLanes(_mm512_maskz_mov_pd(static_cast<__mmask8>(bits), _mm512_set1_pd(1))));
#else
  return Eigen::Map<const Lanes, Eigen::AlignedMax>(detail::ones[bits].lane);
#endif
}

// ---- Consecutive numbers of each record: registers of records, transposed ------------------------------------------

namespace detail {

using Quad = double __attribute__((vector_size(32)));
using Rows = std::array<RawLanes, 4>;

STRUT_INLINE Quad quad_at(const double* numbers) {
  Quad quad;
  std::memcpy(&quad, numbers, sizeof quad);
  return quad;
}

// Four numbers of record k, and of record k + 4 if there are eight lanes.
template <class Of>
STRUT_INLINE RawLanes row_of(const Of& of, int k) {
#ifdef __AVX512F__
  return __builtin_shufflevector(quad_at(of(k)), quad_at(of(k + 4)), 0, 1, 2, 3, 4, 5, 6, 7);
#else
  return quad_at(of(k));
#endif
}

// Selects place(lane) among the numbers of a followed by those of b.
template <int (*place)(int), int... lane>
STRUT_INLINE RawLanes mixed(const RawLanes& a, const RawLanes& b, std::integer_sequence<int, lane...>) {
  return __builtin_shufflevector(a, b, place(lane)...);
}

constexpr int even(int lane) { return lane % 2 == 0 ? lane : lane_count + lane - 1; }
constexpr int odd(int lane) { return lane % 2 == 0 ? lane + 1 : lane_count + lane; }
constexpr int low(int lane) { return lane % 4 < 2 ? lane : lane_count + lane - 2; }
constexpr int high(int lane) { return lane % 4 < 2 ? lane + 2 : lane_count + lane; }

// Transposes four rows of four, or two such blocks side by side.
STRUT_INLINE Rows transposed(const Rows& r) {
  constexpr std::make_integer_sequence<int, lane_count> all;
  const RawLanes a = mixed<even>(r[0], r[1], all), b = mixed<odd>(r[0], r[1], all);
  const RawLanes c = mixed<even>(r[2], r[3], all), d = mixed<odd>(r[2], r[3], all);
  return {mixed<low>(a, c, all), mixed<low>(b, d, all), mixed<high>(a, c, all), mixed<high>(b, d, all)};
}

template <int count, int first, class Of>
STRUT_INLINE void take_numbers(const Of& of, std::array<Lanes, count>& numbers) {
  if constexpr (first < count) {
    constexpr int at = first + 4 <= count ? first : count - 4;
    const auto from = [&](int l) { return of(l) + at; };
    const Rows rows = transposed({row_of(from, 0), row_of(from, 1), row_of(from, 2), row_of(from, 3)});
    for (int n = 0; n < 4; ++n) numbers[at + n] = lanes(rows[n]);
    take_numbers<count, first + 4>(of, numbers);
  }
}

}  // namespace detail

// The `count` numbers from of(lane) on; at least four.
template <int count, class Of>
STRUT_INLINE std::array<Lanes, count> numbers_of(const Of& of) {
  static_assert(count >= 4);
  std::array<Lanes, count> numbers;
  detail::take_numbers<count, 0>(of, numbers);
  return numbers;
}

// The inverse: stores `count` numbers of each lane from to(lane) on, for the first `lanes` lanes; a multiple of four.
template <std::size_t count, class To>
STRUT_INLINE void store_numbers(const std::array<Lanes, count>& numbers, int lanes, const To& to) {
  static_assert(count % 4 == 0);
  for (std::size_t n = 0; n < count; n += 4) {
    const detail::Rows rows =
        detail::transposed({raw(numbers[n]), raw(numbers[n + 1]), raw(numbers[n + 2]), raw(numbers[n + 3])});
    for (int l = 0; l < lanes; ++l) {
      std::memcpy(to(l) + n, reinterpret_cast<const double*>(&rows[l % 4]) + l / 4 * 4, 4 * sizeof(double));
    }
  }
}

// ---- Selection by lane ---------------------------------------------------------------------------------------------

// `one` where `which` is positive, else `other`. (Eigen's select works lane by lane.)
STRUT_INLINE Lanes where_positive(const Lanes& which, const Lanes& one, const Lanes& other) {
  return lanes(RawLanes(raw(which) > 0 ? raw(one) : raw(other)));
}
STRUT_INLINE bool any_positive(const Lanes& which) { return lanes_below_zero(-which) != 0; }

}  // namespace strut::small

#undef STRUT_INLINE
