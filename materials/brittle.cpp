#include "materials/brittle.hpp"

#include <algorithm>
#include <cmath>

#include "materials/failure_criterion.hpp"
#include "materials/step_work.hpp"

namespace strut::materials {

namespace {

// Multiplies the deviator and the tension by x.
Symmetric scaled(const Symmetric& stress, double x) {
  const double mean = trace(stress) / 3;
  return x * deviator(stress) + spherical(mean > 0 ? x * mean : mean);
}

}  // namespace

PointStress Brittle::soften(const PointStep& step, const Symmetric& stress, State& state) const {
  constexpr double most_damage = 0.999;
  const double x = 1 - state.damage;
  Elastic::State nothing;
  const auto [effective, converged] = solid.step(step, scaled(stress, 1 / x), nothing);
  if (!converged) return {stress, false};
  const double most = CockcroftLatham::largest_principal(effective), whole = fracture_energy / width;
  const double left = 1 - state.dissipated / whole;
  State reached = state;
  if (x * most > strength * left) {
    const Symmetric falls = trace(effective) > 0 ? effective : Symmetric(deviator(effective));
    const double slope = strength * step.J * solid.elastic_energy(falls) / whole, room = most - slope;
    const double to = room > 0 ? (most - strength * left - slope * state.damage) / room : 1;
    reached.damage = std::max(state.damage, std::min(to, most_damage));
  }
  const Symmetric next = scaled(effective, 1 - reached.damage);
  if (reached.damage > state.damage) {
    const double old_J = old_determinant(step);
    const double stored_more = step.J * elastic_energy(next, reached) - old_J * elastic_energy(stress, state);
    reached.dissipated += std::max(0.0, step_work(step, old_J, stress, next) - stored_more);
  }
  if (!std::isfinite(reached.dissipated)) return {stress, false};
  state = reached;
  return {next, true};
}

void Brittle::soften_lane(int l, const StepOf<RawLanes>& step, const SymmetricOf<RawLanes>& stress,
                          const StateOf<RawLanes>& state, StateOf<RawLanes>& next, StressOf<RawLanes>& result) const {
  PointStep of_one{{}, step.dt[l], step.J[l], {}, step.viscous_work[l]};
  Symmetric old;
  for (int c = 0; c < 6; ++c) of_one.rate[c] = step.rate[c][l], of_one.stretch[c] = step.stretch[c][l];
  for (int c = 0; c < 6; ++c) old[c] = stress[c][l];
  State one = lane_of<State>(state, l);
  const auto [reached, converged] = soften(of_one, old, one);
  set_lane(next, l, one);
  for (int c = 0; c < 6; ++c) result.stress[c][l] = reached[c];
  result.converged[l] = converged ? -1 : 0;
}

}  // namespace strut::materials
