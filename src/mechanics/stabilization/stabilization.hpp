// The stabilizations of zero-energy modes that a block can have: one of them (residual.hpp says what a type is).
#pragma once

#include <stdexcept>
#include <string>
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

using Stabilization = std::variant<NoStabilization, SillingStabilization, MeanGradientStabilization>;

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

// The same for those that are sums over bonds, with their place in the variant.
template <class Visit>
void for_each_bond_stabilization(const Visit& visit) {
  std::size_t place = 0;
  for_each_stabilization([&]<class S>(const S& one) {
    if constexpr (BondStabilization<S>) visit(one, place);
    ++place;
  });
}

// How many of the types are sums over bonds.
inline constexpr int bond_stabilizations = []<class... S>(std::type_identity<std::variant<S...>>) {
  return (static_cast<int>(BondStabilization<S>) + ...);
}(std::type_identity<Stabilization>());

// Of the name that the deck gives it.
inline Stabilization stabilization_named(const std::string& name, double coefficient) {
  Stabilization result;
  bool known = false;
  for_each_stabilization([&]<class S>(S one) {
    if (name != S::name) return;
    one.coefficient = S::residual == ResidualKind::none ? 0 : coefficient;
    result = one, known = true;
  });
  if (!known) throw std::logic_error("there is no stabilization '" + name + "'");
  return result;
}

}  // namespace strut
