// A stabilization of zero-energy modes is a type that says which residual of a bond it penalizes, and how.
// F does not see every motion of its family; a spring in each bond on a residual z resists the rest. A type has
// clang-format off
//   name         as in the deck (Stabilization)
//   coefficient  c, a number; the stiffness of a point is C = c (λ + 2μ)/(tr K/3), Pa/m⁵, so that c means the same for
//                every ω and horizon
//   residual     what z is (ResidualKind)
// and where z takes the gradients of both ends
//   bond_force   t(C_ij, z, ξ), Pa/m⁵ times m: linear in C_ij and in z, with a symmetric derivative ∂t/∂z. It has the
//                energy ½ z·t a bond, C_ij = 2 min(C_i, C_j): a bond is as stiff as its softer end, and has none to a
//                point without C.
// clang-format on
// bond_force is a template, and returns the type of z. By neighbor lists it is called with Lanes for C and
// Vector3<Lanes> for z and ξ (for a single point double and Vector3<double>), on lattices with Pencil, Vector3<Pencil>
// and, ξ being the same for all eight points, Vector3<double>. C comes with the weight ω V_j of the bond, which is 0 in
// a lane whose point does not have the bond. Sums also pass over the point itself, where ξ = z = 0: a division by |ξ|
// needs a guard, or 0/0 spoils the sum.
#pragma once

#include <cstddef>
#include <type_traits>
#include <variant>

namespace strut {

enum class ResidualKind {
  none,
  own_gradient,  // z = η − F_i ξ, each end its own; t = C_i z is part of the force state: no further pass over bonds
  both_gradients  // z = η − ½ (F_i + F_j) ξ, the same for both ends: one further pass over bonds
};

template <class S>
concept BondStabilization = S::residual == ResidualKind::both_gradients;

// A spring on the residual of the mean deformation gradient of both ends, z = η − ½ (F_i + F_j) ξ. It vanishes for any
// quadratic motion inside the body, so it suppresses the same noise with a fraction of the artificial stiffness that
// Silling's has.
struct MeanGradientStabilization {
  static constexpr const char* name = "Mean Gradient";
  static constexpr ResidualKind residual = ResidualKind::both_gradients;
  double coefficient = 0;

  template <class Scalar, class Residual, class Bond>
  static Residual bond_force(const Scalar& C, const Residual& z, const Bond&) {
    return {{C * z.c[0], C * z.c[1], C * z.c[2]}};
  }
};

// Silling's stabilization (2017): a spring on the residual of each end's own deformation gradient, with the energy
// ½ C_i Σ ω V_j |η − F_i ξ|² per point. A smooth gradient of strain stores energy in it, too.
struct SillingStabilization {
  static constexpr const char* name = "Silling";
  static constexpr ResidualKind residual = ResidualKind::own_gradient;
  double coefficient = 0;
};

struct NoStabilization {
  static constexpr const char* name = "None";
  static constexpr ResidualKind residual = ResidualKind::none;
  double coefficient = 0;
};

// The stabilization of a block.
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
