// Checks at compile time that every law of the variant satisfies the interface; selects the law of a metal that may
// fail; defines the longer functions of thermal laws.
#include "materials/laws.hpp"

#include <algorithm>

namespace strut::materials {

template <class... Laws>
constexpr bool all_keep_the_contract(const std::variant<Laws...>*) {
  return (Law<Laws> && ...);
}
static_assert(all_keep_the_contract(static_cast<const AnyLaw*>(nullptr)));

Moduli moduli_of(const AnyLaw& law) {
  return std::visit([](const auto& one) -> Moduli { return one.moduli(); }, law);
}

double bulk_over_shear(const AnyLaw& law) {
  const Moduli moduli = moduli_of(law);
  return moduli.bulk / moduli.shear;
}

bool law_follows_stretch(const AnyLaw& law) {
  return std::visit([]<class L>(const L&) { return follows_stretch<L>; }, law);
}

bool shares_volume(const AnyLaw& law) {
  const auto is_told = []<class L>(const L&) {
    return std::is_same_v<L, Elastic> || follows_stretch<L> || (tells_flow<L> && !std::is_same_v<L, UserLaw>);
  };
  return bulk_over_shear(law) >= hardly_compressible && std::visit(is_told, law);
}

namespace {

bool has_rate(const FlowStress& flow) { return !std::holds_alternative<NoRate>(flow.rate); }
bool has_rate(const ThermalFlow& flow) {
  const auto* softened = std::get_if<SoftenedFlow>(&flow);
  return !softened || has_rate(softened->cold);
}
template <class L>
bool has_rate(const L& law) {
  if constexpr (requires { law.flow; }) {
    return has_rate(law.flow);
  } else if constexpr (requires { law.metal; }) {
    return has_rate(law.metal);
  } else if constexpr (requires { law.kept(); }) {
    return law.kept() < 1;
  } else {
    return std::is_same_v<L, UserLaw>;
  }
}

}  // namespace

bool depends_on_rate(const AnyLaw& law) {
  return std::visit([](const auto& one) { return has_rate(one); }, law);
}

std::optional<AnyLaw> failing(const AnyLaw& metal, const Ductility& ductility) {
  if (const auto* cold = std::get_if<J2>(&metal)) return Ductile{*cold, ductility};
  if (const auto* hot = std::get_if<ThermalJ2>(&metal)) return ThermalDuctile{*hot, ductility};
  return std::nullopt;
}

std::optional<AnyLaw> cracking(const AnyLaw& solid, double fracture_energy) {
  const auto* elastic = std::get_if<Elastic>(&solid);
  if (!elastic) return std::nullopt;
  return Brittle{.solid = *elastic, .fracture_energy = fracture_energy};
}

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
