#include "deck/sections/temperatures.hpp"

#include <algorithm>

namespace strut::deck {

namespace {

void check_condition(const std::vector<Material>& materials, const std::string& path, Problems& problems) {
  for (const Material& material : materials) {
    const bool knows_its_own = std::visit([]<class L>(const L&) { return materials::tells_heat<L>; }, material.law);
    if (!knows_its_own) continue;
    problems.add(path, "'Prescribed Temperature' beside material '" + material.name +
                           "', whose temperature follows from its flow; expected materials without Softening, another "
                           "Flow Stress, Heating, an Equation of State or a Shear Modulus Slope");
  }
  if (std::ranges::none_of(materials, [](const Material& one) { return one.thermal_expansion != 0; }))
    problems.note(path, "has no effect: no material has a Thermal Expansion Coefficient");
}

}  // namespace

void check_temperatures(const std::vector<Material>& materials, const std::vector<Condition>& conditions,
                        bool has_expanded, Problems& problems) {
  std::vector<const Condition*> heating;
  bool changes = has_expanded;
  for (const Condition& condition : conditions) {
    const auto* one = std::get_if<PrescribedTemperature>(&condition.kind);
    if (!one) continue;
    heating.push_back(&condition);
    changes = changes || one->value.depends_on_time();
    check_condition(materials, "Boundary Conditions > " + condition.name, problems);
  }
  for (const Condition* one : heating) {
    if (changes) break;
    problems.note("Boundary Conditions > " + one->name + " > Value",
                  "has no effect: points expand by the change of T since the initial time; expected a function of t");
  }
  if (!heating.empty()) return;
  for (const Material& material : materials) {
    if (material.thermal_expansion == 0) continue;
    problems.note("Materials > " + material.name + " > Thermal Expansion Coefficient",
                  "has no effect: no Boundary Condition of the type 'Prescribed Temperature' warms the points");
  }
}

}  // namespace strut::deck
