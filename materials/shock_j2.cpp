#include "materials/shock_j2.hpp"

#include <algorithm>

namespace strut::materials {

ShockJ2::State ShockJ2::virgin_state() const {
  State state;
  static_cast<ThermalJ2::State&>(state) = metal.virgin_state();
  return state;
}

// ρ c² at constant entropy is v (γ p − dp_c/dv); the lower limit, a tenth of the value at rest, is for tension.
Moduli ShockJ2::moduli(const State& state) const {
  const auto bulk_of = [&state](const auto& law) {
    const Curve<double> cold = law.cold(state.volume);
    const double gamma = law.energy_factor(), pressure = cold.value + gamma * state.energy;
    return std::max(0.1 * law.bulk(), state.volume * (gamma * pressure - cold.slope));
  };
  return {std::visit(bulk_of, equation), metal.shear_modulus(state)};
}

}  // namespace strut::materials
