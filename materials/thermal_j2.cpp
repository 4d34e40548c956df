#include "materials/thermal_j2.hpp"

namespace strut::materials {

ThermalJ2::State ThermalJ2::virgin_state() const {
  const auto* threshold = std::get_if<MechanicalThreshold>(&flow);
  return {{}, heating.initial, threshold ? threshold->initial : 0};
}

double ThermalJ2::flow_stress(const State& state) const {
  const auto reached = [&state](const auto& law) {
    const auto now = law.at(state, Symmetric(Symmetric::Zero()));
    return now.at_rate(state.plastic_strain_rate, now.at_rest(state.equivalent_plastic_strain)).stress;
  };
  return std::visit(reached, flow);
}

}  // namespace strut::materials
