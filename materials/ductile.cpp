#include "materials/ductile.hpp"

#include <algorithm>

#include "materials/softening.hpp"
#include "materials/step_work.hpp"

namespace strut::materials {

// x at the end of a step, from x' at its start: G_c/L (x² − x'²) = x · (flow of the effective stress) + W (x − x'), W
// the elastic energy of the effective stress that damage reduces (falling). Below x = W L/(2 G_c) softening would
// release more energy than it dissipates: the result is 0. `flowed`, `elastic` (W): J/m³.
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
  reached.damage = 1 - reduced(x, flowed, step.J * metal.elastic_energy(falling(effective), reached.metal));
  const bool holds = reached.damage < 1;
  if (!holds) reached.metal.plastic_strain_rate = 0;
  const Symmetric next = holds ? scaled(effective, 1 - reached.damage) : Symmetric(Symmetric::Zero());
  const double more = std::max(0.0, lost(*this, step, old_determinant(step), stress, state, next, reached));
  reached.metal.plastic_work = state.metal.plastic_work + more;
  if constexpr (tells_heat<Metal>) {
    reached.metal.temperature = state.metal.temperature + metal.rise(more, step.viscous_work);
  }
  if (!std::isfinite(reached.metal.plastic_work)) return {stress, false};
  state = reached;
  return {next, true};
}

template struct DuctileOf<J2>;
template struct DuctileOf<ThermalJ2>;

}  // namespace strut::materials
