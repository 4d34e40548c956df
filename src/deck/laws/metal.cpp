#include <cmath>
#include <sstream>

#include "deck/laws/constants.hpp"
#include "deck/laws/flow_stress.hpp"
#include "deck/laws/laws.hpp"

namespace strut::deck {

namespace {

using namespace materials;

const char* const heating_name = "Heating";
const char* const equation_name = "Equation of State";

const RealKey specific_heat({.name = "Specific Heat", .unit = "J/(kg K)", .range = positive, .meaning = "c_p."});
const RealKey taylor_quinney({.name = "Taylor-Quinney Coefficient",
                              .range = {.low = 0, .high = 1},
                              .fallback = "0.9",
                              .meaning = "β, the fraction of plastic work that heats."});

const RealKey shear_fall({.name = "Shear Modulus Slope",
                          .unit = "1/K",
                          .range = not_negative,
                          .fallback = "0",
                          .meaning = "a of G(T) = G (1 − a (T − T_r)), not below a tenth of G."});
const RealKey shear_reference({.name = "Shear Modulus Temperature",
                               .unit = "K",
                               .range = not_negative,
                               .fallback = "293",
                               .meaning = "T_r, the temperature of the elastic constants."});

const RealKey sound({.name = "Sound Speed",
                     .unit = "m/s",
                     .range = positive,
                     .meaning = "c₀ of the Hugoniot U_s = c₀ + s u_p. The bulk modulus is ρ₀ c₀²; only the shear "
                                "modulus of the elastic constants counts."});
const RealKey hugoniot_slope({.name = "Hugoniot Slope", .range = not_negative, .meaning = "s."});
const RealKey gruneisen({.name = "Gruneisen Parameter", .range = not_negative, .meaning = "Γ₀; ρ Γ is constant."});
const RealKey exponent({.name = "Exponent", .range = positive, .meaning = "n."});

// Without an equation of state the pressure is that of Hooke's law.
using EquationCase = Case<std::optional<EquationOfState>, double, double>;  // of density and bulk modulus

const std::vector<EquationCase>& equations() {
  static const std::vector<EquationCase> entries = {
      {{.name = "None", .meaning = "ṗ = −K tr D."},
       [](const Values&, double, double) -> std::optional<EquationOfState> { return std::nullopt; }},
      {{.name = "Mie-Gruneisen",
        .meaning = "p = p_H (1 − Γ₀ x/2) + Γ₀ e, p_H = ρ₀ c₀² x/(1 − s x)², x = 1 − ρ₀/ρ, e the internal energy per "
                   "reference volume; in tension p = ρ₀ c₀² x + Γ₀ e.",
        .keys = {sound, hugoniot_slope, gruneisen}},
       [](const Values& v, double density, double) -> std::optional<EquationOfState> {
         return MieGruneisen{density, v[sound], v[hugoniot_slope], v[gruneisen]};
       }},
      {{.name = "Tait", .meaning = "p = K/n ((ρ/ρ₀)^n − 1), K the bulk modulus.", .keys = {exponent}},
       [](const Values& v, double, double bulk) -> std::optional<EquationOfState> {
         return Tait{bulk, v[exponent]};
       }},
  };
  return entries;
}

std::optional<EquationOfState> make_equation(const Values& material, double bulk) {
  return make_one_of(equations(), material.section(equation_name), read_density(material), bulk);
}

Heating make_heating(const Values& material) {
  if (!material.has_section(heating_name)) return {};
  const Values& section = material.section(heating_name);
  return {.capacity = read_density(material) * section[specific_heat], .taylor_quinney = section[taylor_quinney]};
}

// Notes a bulk modulus of the elastic constants that differs: only their shear modulus counts.
void note_two_bulk_moduli(const Values& material, double elastic, double of_equation, Problems& problems) {
  constexpr double differs = 0.25;  // static and shock measurements differ by some percent
  if (std::abs(of_equation - elastic) <= differs * elastic) return;
  std::ostringstream text;
  text.precision(4);
  text << "has a bulk modulus of " << of_equation << " Pa, the elastic constants one of " << elastic
       << " Pa, which does not count: are they of one metal?";
  problems.note("WARNING: " + material.section(equation_name).path(), text.str());
}

bool is_thermal(const Values& material) {
  return has_thermal_flow(material) || material.has_section(heating_name) || material[shear_fall] > 0;
}

}  // namespace

Section metal_section() {
  Section section = flow_stress_section();
  section.name = "Elastic Plastic Correspondence";
  section.meaning =
      "Hypoelastic J2 plasticity. Yield Stress, Hardening and Rate, or Flow Stress, define the flow stress; Softening, "
      "Flow Stress and Heating its dependence on temperature.";
  section.keys.insert(section.keys.end(), {shear_fall, shear_reference});
  for (Section& one : thermal_flow_sections()) section.sections.push_back(std::move(one));
  section.sections.push_back({.name = heating_name,
                              .meaning = "Adiabatic heating, ρ c_p Ṫ = β σ̄ ε̄̇ + power of the artificial viscosity, from "
                                         "Blocks > Initial Temperature. Without this section T is constant.",
                              .keys = {specific_heat, taylor_quinney}});
  section.sections.push_back(one_of(equation_name, "Pressure p under shock, instead of Hooke's law.", equations()));
  return section;
}

AnyLaw make_metal(const Values& material, Problems& problems) {
  const Moduli moduli = checked_moduli(material, problems);
  const std::optional<EquationOfState> equation = make_equation(material, moduli.bulk);
  if (!equation && !is_thermal(material)) {
    return J2{.bulk = moduli.bulk, .shear = moduli.shear, .flow = make_flow_stress(material, problems)};
  }
  ThermalJ2 metal{.bulk = moduli.bulk,
                  .shear = moduli.shear,
                  .flow = make_thermal_flow(material, problems),
                  .heating = make_heating(material),
                  .shear_fall = material[shear_fall],
                  .shear_reference = material[shear_reference]};
  if (!equation) return metal;
  metal.bulk = std::visit([](const auto& law) { return law.bulk(); }, *equation);
  note_two_bulk_moduli(material, moduli.bulk, metal.bulk, problems);
  return ShockJ2{metal, *equation};
}

}  // namespace strut::deck
