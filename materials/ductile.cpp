#include "materials/ductile.hpp"

#include <algorithm>

#include "materials/step_work.hpp"

namespace strut::materials {

namespace {

// Multiplies the deviator and the tension by x.
Symmetric scaled(const Symmetric& stress, double x) {
  const double mean = trace(stress) / 3;
  return x * deviator(stress) + spherical(mean > 0 ? x * mean : mean);
}

}  // namespace

// x at the end of a step, from x' at its start: G_c/L (x² − x'²) = x · (flow of the effective stress) + W (x − x'), W
// the elastic energy of the reduced stress. 0 below x = W L/(2 G_c), where x releases more than it dissipates.
template <class Metal>
double DuctileOf<Metal>::reduced(double x, double flowed, double elastic) const {
  const double whole = ductility.fracture_energy / length;
  if (!(whole > 0)) return 0;
  const double half = 0.5 * elastic / whole, discriminant = (x - half) * (x - half) - x * flowed / whole;
  if (!(x > half && discriminant > 0)) return 0;
  return flowed > 0 ? half + std::sqrt(discriminant) : x;
}

template <class Metal>
PointStress DuctileOf<Metal>::soften(const PointStep& step, const Symmetric& stress, State& state) const {
  if (!(state.damage < 1)) return {Symmetric::Zero(), std::isfinite(step.J)};
  const double x = 1 - state.damage;
  State reached = state;
  const auto [effective, converged] = metal.step(step, scaled(stress, 1 / x), reached.metal);
  if (!converged) return {stress, false};
  const double flowed = reached.metal.plastic_work - state.metal.plastic_work;
  const Symmetric falls = trace(effective) > 0 ? effective : deviator(effective);
  reached.damage = 1 - reduced(x, flowed, step.J * metal.elastic_energy(falls, reached.metal));
  const bool holds = reached.damage < 1;
  if (!holds) reached.metal.plastic_strain_rate = 0;
  const Symmetric next = holds ? scaled(effective, 1 - reached.damage) : Symmetric(Symmetric::Zero());
  const double old_J = old_determinant(step);
  const double stored_more = step.J * elastic_energy(next, reached) - old_J * elastic_energy(stress, state);
  const double lost = step_work(step, old_J, stress, next) - stored_more;
  reached.metal.plastic_work = state.metal.plastic_work + std::max(0.0, lost);
  if constexpr (tells_heat<Metal>) {
    reached.metal.temperature = state.metal.temperature + metal.rise(std::max(0.0, lost), step.viscous_work);
  }
  if (!std::isfinite(reached.metal.plastic_work)) return {stress, false};
  state = reached;
  return {next, true};
}

template <class Metal>
void DuctileOf<Metal>::soften_lane(int l, const StepOf<RawLanes>& step, const SymmetricOf<RawLanes>& stress,
                                   const StateOf<RawLanes>& state, StateOf<RawLanes>& next,
                                   StressOf<RawLanes>& result) const {
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

template struct DuctileOf<J2>;
template struct DuctileOf<ThermalJ2>;

}  // namespace strut::materials
