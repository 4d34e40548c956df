// From the places of the points to the force state of each: F, rotation, law, first Piola–Kirchhoff stress.
#include "mechanics/stress.hpp"

#include "base/rotation.hpp"
#include "mechanics/bonds.hpp"
#include "points/parallel.hpp"

namespace strut {

namespace {

template <class L>
typename L::State load(const MaterialBlock& block, std::size_t k) {
  std::array<double, materials::state_size<L>> columns{};
  for (std::size_t c = 0; c < columns.size(); ++c) columns[c] = block.state[c * block.points.size() + k];
  return materials::from_columns<L>(columns);
}

template <class L>
void store(MaterialBlock& block, std::size_t k, const typename L::State& state) {
  const auto columns = materials::to_columns<L>(state);
  for (std::size_t c = 0; c < columns.size(); ++c) block.state[c * block.points.size() + k] = columns[c];
}

// Advances one point to F = R U. False: the law found no stress.
// The increment of unrotated strain is d dt = Rᵀ D R dt = sym(ΔU U_mid⁻¹): exact up to the midpoint rule, because F is
// linear in y and the velocity constant over the step, and zero to round-off for a rigid motion.
template <class L>
bool advance(const L& law, MaterialPoint& point, typename L::State& state, const Polar& polar, double J, double dt) {
  const Symmetric old_stretch = symmetric_part(point.rotation.transpose() * point.deformation_gradient);
  const Symmetric mid_inverse = inverted(0.5 * (old_stretch + polar.stretch)).inverse;
  const Symmetric rate = symmetric_product(polar.stretch - old_stretch, mid_inverse) / dt;
  const auto [stress, converged] = law.step({rate, dt, J}, point.stress, state);
  if (converged) point.stress = stress;
  return converged;
}

// A = P K⁻¹ − C F, P = J R τ Rᵀ F⁻ᵀ = J R τ U⁻¹
ForceState force_state(const MaterialPoint& point, const Symmetric& inverse_stretch, double J) {
  const Tensor P = point.rotation * (J * to_tensor(point.stress) * to_tensor(inverse_stretch));
  return packed(P * to_tensor(point.shape_inverse) - point.stabilization * point.deformation_gradient,
                point.stabilization);
}

template <bool with_energy, class L, class Weight>
void advance_points(Body& body, MaterialBlock& block, const L& law, Weight weight, double dt, Part part,
                    StepReport& report) {
  const auto [begin, end] = range(block, part);
  int failed = -1;
  Failure::Kind kind{};
  // flatten: the law and the small tensor functions must be inlined, or their tensors go through memory.
  const auto advance_point = [&](int k) __attribute__((flatten)) {
    const int i = block.points[k];
    MaterialPoint& point = body.points[i];
    const bonds::Gathered sums = bonds::gather<with_energy>(body.domain.families, body.sites.data(), i, weight);
    const Tensor F = sums.moment * to_tensor(point.shape_inverse);
    const double J = F.determinant();
    if (!(J > 0)) {  // NaN too
      failed = k, kind = Failure::Kind::inverted;
      return 0.0;
    }
    const Polar polar = polar_update(point.rotation, F);
    if (dt > 0) {
      typename L::State state = load<L>(block, k);
      if (!advance(law, point, state, polar, J, dt)) failed = k, kind = Failure::Kind::no_stress;
      store<L>(block, k, state);
    }
    point.rotation = polar.rotation;
    point.deformation_gradient = F;
    const Symmetric inverse_stretch = inverted(polar.stretch).inverse;
    body.force_states[i] = force_state(point, inverse_stretch, J);
    if constexpr (with_energy) {
      // ½ C Σ ω V |y_j − y_i − F ξ|², the least-squares residual of F
      body.stabilization_work[i] = 0.5 * point.stabilization * (sums.square - sums.moment.cwiseProduct(F).sum());
    }
    return double_dot(inverse_stretch, inverse_stretch);  // ‖F⁻¹‖²
  };
  const double steepest = largest(begin, end, 0, advance_point);
  report.steepest = std::max(report.steepest, std::sqrt(steepest));
  if (failed >= 0 && !report.failure) report.failure = Failure{block.points[failed], kind};
}

}  // namespace

void advance_stress(Body& body, double dt, bool with_energy, Part part, StepReport& report) {
  for (MaterialBlock& block : body.blocks) {
    bonds::with_influence(body.influence, [&](auto weight) {
      const auto with_law = [&](const auto& law) {
        if (with_energy) {
          advance_points<true>(body, block, law, weight, dt, part, report);
        } else {
          advance_points<false>(body, block, law, weight, dt, part, report);
        }
      };
      std::visit(with_law, block.material.law);
    });
  }
}

}  // namespace strut
