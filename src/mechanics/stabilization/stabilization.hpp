// The stabilizations of zero-energy modes that a block can have: one of them (residual.hpp says what a type is).
#pragma once

#include <cstddef>
#include <type_traits>
#include <variant>

#include "mechanics/stabilization/mean_gradient.hpp"
#include "mechanics/stabilization/silling.hpp"

namespace strut {

struct NoStabilization {
  static constexpr const char* name = "None";
  static constexpr ResidualKind residual = ResidualKind::none;
  double coefficient = 0;
};

using Stabilization = std::variant<MeanGradientStabilization, SillingStabilization, NoStabilization>;

inline double coefficient_of(const Stabilization& stabilization) {
  return std::visit([](const auto& s) { return s.coefficient; }, stabilization);
}

inline ResidualKind residual_of(const Stabilization& stabilization) {
  return std::visit([]<class S>(const S&) { return S::residual; }, stabilization);
}

// Calls visit(S()) for every type S of the variant.
template <class Visit>
void for_each_stabilization(const Visit& visit) {
  [&]<class... S>(std::type_identity<std::variant<S...>>) { (visit(S()), ...); }(std::type_identity<Stabilization>());
}

// The same for the types that are sums over bonds, with their index in the variant.
template <class Visit>
void for_each_bond_stabilization(const Visit& visit) {
  std::size_t index = 0;
  for_each_stabilization([&]<class S>(const S& one) {
    if constexpr (BondStabilization<S>) visit(one, index);
    ++index;
  });
}

// The number of types that are sums over bonds.
inline constexpr int bond_stabilizations = []<class... S>(std::type_identity<std::variant<S...>>) {
  return (static_cast<int>(BondStabilization<S>) + ...);
}(std::type_identity<Stabilization>());

// The same with another coefficient.
inline Stabilization with_coefficient(Stabilization stabilization, double coefficient) {
  std::visit([&]<class S>(S& s) { s.coefficient = S::residual == ResidualKind::none ? 0 : coefficient; },
             stabilization);
  return stabilization;
}

}  // namespace strut
