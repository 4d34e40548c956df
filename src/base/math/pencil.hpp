// SIMD: eight numbers, those of eight cells in a row along x. GCC and Clang map the type to the registers of the
// machine: one with AVX-512, two with AVX, four with SSE2.
#pragma once

#include <utility>

namespace strut {

using Pencil = double __attribute__((vector_size(64)));
inline constexpr int pencil_width = 8;

namespace detail {

template <int first, int... lane>
Pencil window(const Pencil& left, const Pencil& right, std::integer_sequence<int, lane...>) {
  return __builtin_shufflevector(left, right, (first + lane)...);
}

}  // namespace detail

// The numbers dx cells further along x, −8 ≤ dx ≤ 8, from three adjacent pencils.
template <int dx>
inline Pencil shifted(const Pencil& before, const Pencil& here, const Pencil& after) {
  static_assert(-pencil_width <= dx && dx <= pencil_width);
  constexpr std::make_integer_sequence<int, pencil_width> lanes;
  if constexpr (dx >= 0) {
    return detail::window<dx>(here, after, lanes);
  } else {
    return detail::window<pencil_width + dx>(before, here, lanes);
  }
}

}  // namespace strut
