#include "deck/sections/temperatures.hpp"

#include <algorithm>

namespace strut::deck {

namespace {

// Stretch and energy that a bond may hold are those of a cold one.
void check_bonds(const HeatedSections& deck, Problems& problems) {
  for (const Block& block : deck.blocks) {
    const DamageModel* model = damage_model_of(block, deck.damage_models);
    if (!model || block.material >= static_cast<int>(deck.materials.size())) continue;
    const Material& material = deck.materials[block.material];
    if (material.thermal_expansion == 0 || !model->critical_bond_energy) continue;
    problems.add("Blocks > " + block.name + " > Damage Model",
                 "bonds of material '" + material.name +
                     "', which has a Thermal Expansion Coefficient, cannot break by 'Bond Energy'; expected 'Critical "
                     "Stretch', which counts the stretch beyond the thermal one");
  }
}

void check_condition(const HeatedSections& deck, const std::string& path, Problems& problems) {
  for (const Material& material : deck.materials) {
    const bool knows_its_own = std::visit([]<class L>(const L&) { return materials::tells_heat<L>; }, material.law);
    if (!knows_its_own) continue;
    problems.add(path, "'Prescribed Temperature' beside material '" + material.name +
                           "', whose temperature follows from its flow; expected materials without Softening, another "
                           "Flow Stress, Heating, an Equation of State or a Shear Modulus Slope");
  }
  if (std::ranges::none_of(deck.materials, [](const Material& one) { return one.thermal_expansion != 0; }))
    problems.note(path, "has no effect: no material has a Thermal Expansion Coefficient");
}

}  // namespace

void check_temperatures(const HeatedSections& deck, Problems& problems) {
  bool any = false;
  for (const Condition& condition : deck.conditions) {
    if (!std::holds_alternative<PrescribedTemperature>(condition.kind)) continue;
    any = true;
    check_condition(deck, "Boundary Conditions > " + condition.name, problems);
  }
  if (any) return check_bonds(deck, problems);
  for (const Material& material : deck.materials) {
    if (material.thermal_expansion == 0) continue;
    problems.note("Materials > " + material.name + " > Thermal Expansion Coefficient",
                  "has no effect: no Boundary Condition of the type 'Prescribed Temperature' warms the points");
  }
}

}  // namespace strut::deck
