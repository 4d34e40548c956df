#include "deck/sections/damage_models.hpp"

#include "deck/problems.hpp"
#include "deck/sections/two_keys.hpp"
#include "deck/values.hpp"

namespace strut::deck {

namespace {

const char* const name = "Damage Models";

const OptionalKey<double> critical_stretch(
    {.name = "Critical Stretch",
     .range = positive,
     .meaning =
         "s_c: a bond breaks where its length has grown by more than this part. Either this or Fracture Energy."});

const OptionalKey<double> fracture_energy(
    {.name = "Fracture Energy",
     .unit = "J/m²",
     .range = positive,
     .meaning =
         "G_c: s_c is such that a flat cut through the lattice of the block's spacing dissipates it, summed over "
         "the bonds that it breaks (Influence Function, horizon and moduli as they are)."});

const ExpressionKey stretch_over_time({.name = "Time Dependent Critical Stretch",
                                       .range = positive,
                                       .meaning = "s_c as a function of the time t (s)."});

DamageModel read_critical_stretch(const Values& values, Problems& problems) {
  check_one_of(values, critical_stretch, fracture_energy, problems);
  if (!values.given(critical_stretch) && !values.given(fracture_energy)) {
    problems.add(values.path_to(critical_stretch),
                 "missing; " + expected(critical_stretch) + ", or 'Fracture Energy' in its place");
  }
  return {.critical_stretch = Function(values[critical_stretch].value_or(1)),
          .fracture_energy = values[fracture_energy].value_or(0)};
}

DamageModel read_stretch_over_time(const Values& values, Problems& problems) {
  const Function stretch = values[stretch_over_time];
  if (stretch.depends_on_place()) {
    problems.add(values.path_to(stretch_over_time), "'" + stretch.text() + "'; expected an expression in t alone");
  }
  return {.critical_stretch = stretch};
}

struct ModelEntry {
  Section schema;  // named as "Damage Model" has it
  DamageModel (*read)(const Values& values, Problems& problems);
};

const std::vector<ModelEntry>& entries() {
  static const std::vector<ModelEntry> all = {
      {{.name = "Critical Stretch",
        .meaning =
            "A bond breaks, for both of its ends, where it is stretched too far; of bonds between two blocks the "
            "lesser s_c counts.",
        .keys = {critical_stretch, fracture_energy}},
       read_critical_stretch},
      {{.name = "Time Dependent Critical Stretch",
        .meaning = "The same, with an s_c that changes.",
        .keys = {stretch_over_time}},
       read_stretch_over_time}};
  return all;
}

}  // namespace

Section damage_models_section() {
  Section one{.name = any_name,
              .required = true,
              .meaning = "One model.",
              .hints = {{"Thermal Expansion Coefficient", "unknown key; there is no temperature here"}}};
  return {.name = name,
          .meaning = "When the bonds of a block break (Blocks > Damage Model).",
          .sections = {with_cases(std::move(one),
                                  {.name = "Damage Model", .meaning = "The criterion; it decides on further keys."},
                                  schemas_of(entries()))}};
}

std::vector<NamedDamageModel> read_damage_models(const Values& deck, Problems& problems) {
  std::vector<NamedDamageModel> all;
  for (const Values& section : deck.section(name).sections()) {
    NamedDamageModel one{section.name(), {}};
    if (const ModelEntry* entry = chosen_of(entries(), section)) one.model = entry->read(section, problems);
    all.push_back(one);
  }
  return all;
}

}  // namespace strut::deck
