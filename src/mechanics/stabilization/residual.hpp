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

namespace strut {

enum class ResidualKind {
  none,
  own_gradient,  // z = η − F_i ξ, each end its own; t = C_i z is part of the force state: no further pass over bonds
  both_gradients  // z = η − ½ (F_i + F_j) ξ, the same for both ends: one further pass over bonds
};

template <class S>
concept BondStabilization = S::residual == ResidualKind::both_gradients;

}  // namespace strut
