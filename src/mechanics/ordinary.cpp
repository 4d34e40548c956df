// Ordinary points: from the places to the force state of each, t = ω (a |ξ| + b e), and what F would be.
#include <cmath>

#include "base/rotation.hpp"
#include "mechanics/ordinary_bonds.hpp"
#include "mechanics/stress.hpp"

namespace strut {

namespace {

// ½ K θ² + 15μ/(2m) Σ ω V (e − θ|ξ|/3)², whose sum is Σ ω V e² − m θ²/9.
double energy(const materials::Moduli& moduli, double weighted_volume, double dilatation, double square) {
  const double theta2 = dilatation * dilatation;
  return 0.5 * moduli.bulk * theta2 + 7.5 * moduli.shear * (square / weighted_volume - theta2 / 9);
}

template <bool with_energy, class Weight>
void advance_points(Body& body, MaterialBlock& block, Weight weight, Part part, WorstFailure& failure) {
  const auto [begin, end] = range(block, part);
  const auto moduli = std::visit([](const auto& law) { return law.moduli(); }, block.material.law);
  for_each_point(begin, end, [&, weight](int k) {
    const int i = block.points[k];
    OrdinaryPoint& point = block.ordinary[k];
    const bonds::Extensions sums =
        bonds::extensions<with_energy>(body.domain.families, body.sites.data(), i, weight, bonds::OfPlaces{});
    const double m = point.weighted_volume;
    point.dilatation = 3 * sums.moment / m;
    if constexpr (with_energy) point.energy = energy(moduli, m, point.dilatation, sums.square);
    body.force_states.scalars[i] = scalar_state(moduli, point.dilatation, m);
    if (!std::isfinite(point.dilatation)) failure.report(k, Failure::Kind::not_finite);
  });
}

// The unrotated Cauchy stress J⁻¹ T U of a family that deforms as one, T = λ tr(U − I) I + 2μ (U − I): what the bonds
// carry, exactly for an isotropic stretch and to the first order in the strain for any other.
Symmetric stress_of(const materials::Moduli& moduli, const Tensor& U) {
  const Tensor strain = U - Tensor::Identity();
  const double lambda = moduli.bulk - 2 * moduli.shear / 3;
  const Tensor T = lambda * strain.trace() * Tensor::Identity() + 2 * moduli.shear * strain;
  return symmetric_part(T * U / U.determinant());
}

template <class Weight>
void set_views(Body& body, const MaterialBlock& block, Weight weight, Part part) {
  const auto [begin, end] = range(block, part);
  const auto moduli = std::visit([](const auto& law) { return law.moduli(); }, block.material.law);
  for_each_point(begin, end, [&, weight](int k) {
    MaterialPoint& point = body.points[block.points[k]];
    const Tensor N = bonds::gather(body.domain.families, body.sites.data(), block.points[k], weight);
    point.deformation_gradient = N * to_tensor(point.shape_inverse);
    point.rotation = polar_rotation(point.deformation_gradient);
    point.stress = stress_of(moduli, point.rotation.transpose() * point.deformation_gradient);
  });
}

}  // namespace

void advance_ordinary(Body& body, MaterialBlock& block, bool with_views, Part part, StepReport& report) {
  WorstFailure failure;
  bonds::with_influence(body.influence, [&](auto weight) {
    if (!with_views) return advance_points<false>(body, block, weight, part, failure);
    advance_points<true>(body, block, weight, part, failure);
    set_views(body, block, weight, part);
  });
  // Bonds in compression become no stiffer than they were.
  report.pace = std::max(report.pace, block.resting_pace);
  take_worse(failure.found(block), report.failure);
}

}  // namespace strut
