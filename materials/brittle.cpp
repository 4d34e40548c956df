#include "materials/brittle.hpp"

#include <algorithm>
#include <cmath>

#include "materials/failure_criterion.hpp"
#include "materials/softening.hpp"
#include "materials/step_work.hpp"

namespace strut::materials {

PointStress Brittle::soften(const PointStep& step, const Symmetric& stress, State& state) const {
  constexpr double most_damage = 0.999;
  const double x = 1 - state.damage;
  Elastic::State nothing;
  const auto [effective, converged] = solid.step(step, scaled(stress, 1 / x), nothing);
  if (!converged) return {stress, false};
  const double most = CockcroftLatham::largest_principal(effective), whole = fracture_energy / width;
  const double left = std::max(0.0, 1 - state.dissipated / whole);  // times an infinite strength it is never exceeded
  State reached = state;
  if (x * most > strength * left) {
    const double slope = strength * step.J * solid.elastic_energy(falling(effective)) / whole, margin = most - slope;
    const double to = margin > 0 ? (most - strength * left - slope * state.damage) / margin : 1;
    reached.damage = std::max(state.damage, std::min(to, most_damage));
  }
  const Symmetric next = scaled(effective, 1 - reached.damage);
  if (reached.damage > state.damage) {
    reached.dissipated += std::max(0.0, lost(*this, step, old_determinant(step), stress, state, next, reached));
  }
  if (!std::isfinite(reached.dissipated)) return {stress, false};
  state = reached;
  return {next, true};
}

}  // namespace strut::materials
