// Ordinary points: from the positions to the force state of each, t = ω (a |ξ| + b e), and an F for output.
#include <cmath>

#include "base/math/rotation.hpp"
#include "mechanics/energies.hpp"
#include "mechanics/formulation/stress_pass.hpp"
#include "mechanics/kernels/ordinary_bonds.hpp"
#include "mechanics/steepness.hpp"

namespace strut {

using small::Lanes, small::lanes_of;

namespace {

Lanes expansions(const Body& body, const LaneGroup& group) {
  if (body.expansion.empty()) return Lanes::Zero();
  return lanes_of([&](int l) { return body.expansion[group.i[l]].now; });
}

// Corrects force state and dilatation for the thermal strain ε: extensions become e − ε |ξ|. Counts the work of the
// expansion, ∂W/∂ε = −θ [(3K − 5μ) s + 5μ], s the fraction of m in intact bonds.
template <class Weight>
__attribute__((noinline)) void expand(Body& body, MaterialBlock& block, Weight weight, const LaneGroup& group) {
  const auto moduli = materials::moduli_of(block.material.law);
  const bonds::OfCluster family{*group.cluster};
  const Site* sites = body.domain.sites.data();
  const bonds::OfExpanded extension(family, expansions(body, group));
  const bonds::Lanes moment = bonds::extensions(family, sites, weight, extension);
  const bonds::Lanes whole = bonds::extensions(family, sites, weight, bonds::OfLengths<bonds::OfCluster>());
  for (int l = 0; l < group.count; ++l) {
    OrdinaryPoint& point = block.ordinary[group.k[l]];
    PointExpansion& expansion = body.expansion[group.i[l]];
    const double m = point.weighted_volume;
    point.dilatation = 3 * moment[l] / m;
    ScalarState state = scalar_state(moduli, point.dilatation, m);
    state.a -= state.b * expansion.now;
    body.force_states.scalars[group.i[l]] = state;
    expansion.count(-point.dilatation * ((3 * moduli.bulk - 5 * moduli.shear) * whole[l] / m + 5 * moduli.shear));
  }
}

template <class Weight>
void advance_points(Body& body, MaterialBlock& block, Weight weight, const LaneGroups& groups, WorstFailure& failure) {
  const auto moduli = materials::moduli_of(block.material.law);
  for_each_point(0, groups.count(), [&, weight](int g) {
    const LaneGroup group = groups[g];
    const bonds::OfCluster family{*group.cluster};
    const bonds::Lanes moment = bonds::extensions(family, body.domain.sites.data(), weight, bonds::OfPlaces(family));
    for (int l = 0; l < group.count; ++l) {
      OrdinaryPoint& point = block.ordinary[group.k[l]];
      const double m = point.weighted_volume;
      point.dilatation = 3 * moment[l] / m;
      body.force_states.scalars[group.i[l]] = scalar_state(moduli, point.dilatation, m);
      body.force_density[group.i[l]].setZero();  // bonds rotate: their sums cannot be precomputed
      if (!std::isfinite(point.dilatation)) failure.report(group.k[l], Failure::Kind::not_finite);
    }
    if (!body.expansion.empty()) expand(body, block, weight, group);
  });
}

// The unrotated Cauchy stress J⁻¹ T U of a homogeneously deformed family, T = λ tr(U − I) I + 2μ (U − I). It is the
// stress that the bonds carry: exact for isotropic stretch, and to first order in the strain otherwise.
Symmetric stress_of(const materials::Moduli& moduli, const Tensor& U, double expansion) {
  const Tensor strain = U - (1 + expansion) * Tensor::Identity();
  const double lambda = moduli.bulk - 2 * moduli.shear / 3;
  const Tensor T = lambda * strain.trace() * Tensor::Identity() + 2 * moduli.shear * strain;
  return symmetric_part(T * U / U.determinant());
}

// The Cauchy stress that the bonds of a point carry, Σ ω V t η⊗η/|η| over its present volume ratio, Pa. Few bonds turn
// without resistance, and an F that is fitted to them may be anything.
Tensor stress_of_bonds(const Body& body, int i, double dilatation) {
  const ScalarState state = body.force_states.scalars[i];
  Tensor sum = Tensor::Zero();
  bonds::with_influence(body.influence, [&](auto weight) {
    bonds::over(bonds::OfPoint{{i}, body.domain.families}, body.domain.sites.data(), weight,
                [&](int j, double w, const auto& xi, double) {
                  const double length = std::sqrt(bonds::dot(xi, xi));
                  const Vector bond = body.domain.current(j) - body.domain.current(i);
                  const double now = bond.norm();
                  sum += w * (state.a * length + state.b * (now - length)) / now * bond * bond.transpose();
                });
  });
  return sum / std::pow(1 + dilatation / 3, 3);
}

// K⁻¹ of the intact bonds; zero if they do not span space.
Symmetric present_shape_inverse(const Body& body, int i) {
  return body.has_lost_bonds(i) ? inverse_of(shape_tensor(body, i)) : body.shape_inverse[i];
}

template <class Weight>
void set_diagnostics(Body& body, MaterialBlock& block, Weight weight, const LaneGroups& groups) {
  const auto moduli = materials::moduli_of(block.material.law);
  for_each_point(0, groups.count(), [&, weight](int g) {
    const LaneGroup group = groups[g];
    const bonds::OfCluster family{*group.cluster};
    const Lanes expansion = expansions(body, group);
    const bonds::Lanes squares = bonds::squared_extensions(family, body.domain.sites.data(), weight, expansion);
    const auto N = bonds::gather<false>(family, body.domain.sites.data(), weight).tensor;
    for (int l = 0; l < group.count; ++l) {
      OrdinaryPoint& ordinary = block.ordinary[group.k[l]];
      ordinary.energy = ordinary_energy(block, ordinary, squares[l]);
      MaterialPoint& point = body.points[group.i[l]];
      const Symmetric shape_inverse = present_shape_inverse(body, group.i[l]);
      if (!(trace(shape_inverse) > 0)) {  // its neighbors do not span space: its strain is undetermined
        point = {};
        continue;
      }
      point.deformation_gradient = at(N, l) * to_tensor(shape_inverse);
      const Tensor R = polar_rotation(point.deformation_gradient);
      point.rotation = Rotation(R);
      point.stress = body.has_lost_bonds(group.i[l])
                         ? symmetric_part(R.transpose() * stress_of_bonds(body, group.i[l], ordinary.dilatation) * R)
                         : stress_of(moduli, R.transpose() * point.deformation_gradient, expansion[l]);
    }
  });
}

}  // namespace

void advance_ordinary(Body& body, MaterialBlock& block, bool with_diagnostics, const LaneGroups& groups,
                      StepReport& report) {
  WorstFailure failure;
  bonds::with_influence(body.influence, [&](auto weight) {
    advance_points(body, block, weight, groups, failure);
    if (with_diagnostics) set_diagnostics(body, block, weight, groups);
  });
  // Compressed bonds do not become stiffer than at rest.
  report.frequency_bound = std::max(report.frequency_bound, block.rest_frequency_bound);
  take_worse(failure.found(block), report.failure);
}

}  // namespace strut
