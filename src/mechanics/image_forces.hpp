// Inside mechanics: the force of some images on a point.
#pragma once

#include "mechanics/force_sum.hpp"
#include "mechanics/formulation/quadratic_fits.hpp"

namespace strut {

// The images in the family of a point that a predicate selects.
template <class Picks>
struct OfImages {
  using Scalar = double;
  const Families& families;
  int i;
  const Picks& picks;

  template <int count, class Of>
  std::array<double, count> own(Of of) const {
    return bonds::OfPoint{families, i}.own<count>(of);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    families.for_each(i, [&](int j) {
      if (picks(j)) visit(j, 1.0);
    });
  }
};

inline Vector to_vector(const small::Vector3<double>& v) { return {v.c[0], v.c[1], v.c[2]}; }

// The force density (N/m³) of some bonds of a point by all formulations; `own`: includes the point's own state.
template <class Family, class Weight>
Vector force_of(const Body& body, const Family& family, bool own, Weight weight) {
  const Site* sites = body.domain.sites.data();
  const ForceStates& states = body.force_states;
  const int i = family.i;
  Vector force = Vector::Zero();
  if (!states.tensors.empty()) {
    force += to_vector(bonds::far_force<true>(family, sites, states.tensors.data(), weight));
    Vector moment = Vector::Zero(), pull = Vector::Zero();
    bonds::over(family, sites, weight, [&](int j, double w, const auto& xi, double) {
      moment += w * to_vector(xi);
      pull += w * (body.current(j) - body.current(i));
    });
    if (own) force += bonds::tensor_of(states.tensors[i]) * moment + states.tensors[i].stiffness() * pull;
  }
  if (own && !states.gradients.empty()) {
    for_each_bond_stabilization([&]<class S>(const S&, std::size_t kind) {
      if (body.block_of(i).material.stabilization.index() != kind) return;
      force += to_vector(bonds::residual<S>(kind, family, sites, states.gradients.data(), weight).force);
    });
  }
  if (!states.scalars.empty()) {
    force +=
        to_vector(bonds::ordinary_force(family, sites, states.scalars.data(), weight, bonds::OfPlaces<Family>(family)));
  }
  if (!states.quadratics.empty()) {
    const Eigen::Array4d* multipliers = body.fits->multipliers();
    force += to_vector(bonds::quadratic_far_force(family, sites, multipliers, states.quadratics.data(), weight));
    if (own && body.block_of(i).is_quadratic()) {
      QuadraticFit fit;
      bonds::over(family, sites, weight, [&](int j, double w, const auto& xi, double) {
        const auto q = bonds::squares(xi);
        fit.sums[0] += w;
        for (int c = 0; c < 3; ++c) fit.sums[1 + c] += w * xi.c[c], fit.sums[10 + c] += w * multipliers[j][c];
        for (int k = 0; k < 6; ++k) fit.sums[4 + k] += w * q[k];
      });
      force += bonds::quadratic_own_force(states.quadratics[i], fit);
    }
  }
  return force;
}

}  // namespace strut
