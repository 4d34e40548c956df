// A sum that does not depend on the number of ranks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/parallel/communicator.hpp"

namespace strut {

// Collective. Σ term(k), k = 0 … count − 1, over all ranks, the same to the last bit for any distribution: terms are
// added as integers, in units of 2⁻⁶² times the largest term times the number of terms. Not finite if a term is not.
// Evaluates each term twice.
template <class Term>
double reproducible_sum(const Communicator& communicator, int count, const Term& term) {
  double largest = 0;
  for (int k = 0; k < count; ++k) {
    const double size = std::abs(term(k));
    largest = std::isfinite(size) ? std::max(largest, size) : std::numeric_limits<double>::infinity();
  }
  largest = communicator.max(largest);
  if (largest == 0 || !std::isfinite(largest)) return largest;
  const std::int64_t terms = communicator.sum(static_cast<std::int64_t>(count));
  const int unit = std::ilogb(largest) + 1 + std::ilogb(static_cast<double>(terms)) + 1 - 62;
  // Multiplies by 2^−unit in two factors, because one might overflow: much faster than std::ldexp.
  const double one = std::ldexp(1.0, -unit / 2), other = std::ldexp(1.0, -unit - (-unit / 2));
  std::int64_t total = 0;
  for (int k = 0; k < count; ++k) total += std::llrint(term(k) * one * other);
  return std::ldexp(static_cast<double>(communicator.sum(total)), unit);
}

}  // namespace strut
