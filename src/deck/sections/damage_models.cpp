#include "deck/sections/damage_models.hpp"

#include "deck/problems.hpp"
#include "deck/sections/several_sections.hpp"
#include "deck/values.hpp"

namespace strut::deck {

namespace {

const char* const name = "Damage Models";

const OptionalKey<double> critical_stretch(
    {.name = "Critical Stretch",
     .range = positive,
     .meaning = "s_c, relative to the reference length. Either this or Fracture Energy."});

const OptionalKey<double> fracture_energy(
    {.name = "Fracture Energy",
     .unit = "J/m²",
     .range = positive,
     .meaning =
         "G_c of a flat cut through a lattice of the block's spacing; s_c follows. Without QuasiStatic, "
         "elastic solids by quadratic correspondence, or by the mean gradient with a horizon below two spacings, crack "
         "as by 'Cohesive Crack'."});

const OptionalKey<double> critical_bond_energy(
    {.name = "Critical Bond Energy",
     .unit = "J/m⁶",
     .range = positive,
     .meaning = "w_c, energy per volume of either end. Either this or Fracture Energy."});

const OptionalKey<double> separation_energy(
    {.name = "Fracture Energy",
     .unit = "J/m²",
     .range = positive,
     .meaning = "G_c of a flat cut through a lattice of the block's spacing; w_c follows."});

const RealKey cohesive_energy(
    {.name = "Fracture Energy",
     .unit = "J/m²",
     .range = positive,
     .meaning =
         "G_c. The strength follows: E G/σ_c² is 4 spacings, so that the zone that softens is resolved; G is G_c "
         "less what springs take (18 % by the default coefficient)."});

const ExpressionKey stretch_over_time({.name = "Time Dependent Critical Stretch",
                                       .range = positive,
                                       .meaning = "s_c(t), t in s."});

const RealKey tearing_energy(
    {.name = "Fracture Energy",
     .unit = "J/m²",
     .range = not_negative,
     .fallback = "0",
     .meaning = "G_c, dissipated per area of crack (roughly) while the stress falls once the criterion is met. 0: a "
                "point fails at once, and the dissipation depends on the spacing."});

const RealKey averaging_radius(
    {.name = "Averaging Radius",
     .unit = "m",
     .range = not_negative,
     .fallback = "0",
     .meaning = "R of the ball over which the criterion's growth is averaged (in equilibria after each load "
                "step); 0: none."});

const RealKey failure_strain({.name = "Failure Strain", .range = positive, .meaning = "ε_f."});

const RealKey d1({.name = "D1", .meaning = "D₁ of ε_f = (D₁ + D₂ exp(D₃ σ*)) (1 + D₄ ln max(ε̇/ε̇₀, 1))."});
const RealKey d2({.name = "D2", .range = not_negative, .meaning = "D₂."});
const RealKey d3({.name = "D3", .range = {.high = 0}, .meaning = "D₃."});
const RealKey d5({.name = "D5", .fallback = "0", .meaning = "D₅ of the factor 1 + D₅ T*."});
const RealKey d4({.name = "D4", .range = not_negative, .fallback = "0", .meaning = "D₄."});
const RealKey reference({.name = "Reference Temperature",
                         .unit = "K",
                         .range = not_negative,
                         .fallback = "293",
                         .meaning = "T_r of T* = (T − T_r)/(T_m − T_r), at least 0."});
const RealKey melting({.name = "Melting Temperature",
                       .unit = "K",
                       .range = positive,
                       .fallback = "1e9",
                       .meaning = "T_m, above T_r; needed with D5."});
const RealKey reference_rate(
    {.name = "Reference Strain Rate", .unit = "1/s", .range = positive, .fallback = "1", .meaning = "ε̇₀."});

const RealKey critical_work({.name = "Critical Work",
                             .unit = "Pa",
                             .range = positive,
                             .meaning = "W_c = ∫ max(σ₁, 0) dε̄, σ₁ the largest principal stress."});

DamageModel ductile(materials::FailureCriterion criterion, const Values& values) {
  return {.ductility = materials::Ductility{criterion, values[tearing_energy], values[averaging_radius]}};
}

DamageModel read_johnson_cook(const Values& v, Problems& problems) {
  if (v.has(d1) && v.has(d2) && !(v[d1] + v[d2] > 0)) {
    problems.add(v.path_to(d1), "D1 + D2 is not positive: there is no plastic strain at failure in pure shear");
  }
  if (v.has(reference) && v.has(melting) && !(v[melting] > v[reference])) {
    problems.add(v.path_to(melting), "expected more than the Reference Temperature, in K");
  }
  if (v[d5] != 0 && !v.given(melting)) problems.add(v.path_to(melting), "missing; with D5, " + expected(melting));
  return ductile(materials::JohnsonCookFailure{.constants = {v[d1], v[d2], v[d3], v[d4], v[d5]},
                                               .reference_rate = v[reference_rate],
                                               .reference = v[reference],
                                               .melting = v[melting]},
                 v);
}

DamageModel read_critical_stretch(const Values& values, Problems& problems) {
  check_exactly_one(values, critical_stretch, fracture_energy, problems);
  Function limit(values[critical_stretch].value_or(1));
  limit.set_path(values.path_to(critical_stretch));
  return {.critical_stretch = limit, .fracture_energy = values[fracture_energy].value_or(0)};
}

DamageModel read_bond_energy(const Values& values, Problems& problems) {
  check_exactly_one(values, critical_bond_energy, separation_energy, problems);
  return {.fracture_energy = values[separation_energy].value_or(0),
          .critical_bond_energy = values[critical_bond_energy].value_or(1)};
}

DamageModel read_stretch_over_time(const Values& values, Problems& problems) {
  const Function stretch = values[stretch_over_time];
  if (stretch.depends_on_position()) {
    problems.add(values.path_to(stretch_over_time), "'" + stretch.text() + "'; expected an expression in t alone");
  }
  return {.critical_stretch = stretch};
}

const std::vector<Case<DamageModel, Problems&>>& entries() {
  static const std::vector<Case<DamageModel, Problems&>> all = {
      {{.name = "Critical Stretch",
        .meaning = "A bond breaks where its stretch exceeds s_c, between two blocks the lesser s_c.",
        .keys = {critical_stretch, fracture_energy}},
       read_critical_stretch},
      {{.name = "Time Dependent Critical Stretch",
        .meaning = "The same with s_c as a function of time.",
        .keys = {stretch_over_time}},
       read_stretch_over_time},
      {{.name = "Cohesive Crack",
        .meaning = "The stress of an elastic solid by correspondence (mean gradient, horizon below two spacings, or "
                   "quadratic) falls where its largest principal value "
                   "reaches a strength, until a crack has taken G_c; then bonds across it break.",
        .keys = {cohesive_energy}},
       [](const Values& v, Problems&) {
         return DamageModel{.fracture_energy = v[cohesive_energy], .is_gradual = true};
       }},
      {{.name = "Bond Energy",
        .meaning = "A stretched bond breaks where its energy exceeds w_c (Foster, Silling and Chen 2011). All blocks "
                   "of the body must be ordinary solids (Elastic).",
        .keys = {critical_bond_energy, separation_energy}},
       read_bond_energy},
      {{.name = "Plastic Strain",
        .meaning = "A point of a J2 metal fails, and all its bonds break, where its plastic strain reaches ε_f.",
        .keys = {failure_strain, tearing_energy, averaging_radius}},
       [](const Values& v, Problems&) { return ductile(materials::FailureStrain{v[failure_strain]}, v); }},
      {{.name = "Johnson-Cook",
        .meaning = "The same where ∫ dε̄/ε_f = 1 with ε_f of Johnson and Cook (1985); σ* is the mean stress over the "
                   "von Mises stress, between -1.5 and 1.5.",
        .keys = {d1, d2, d3, d4, d5, reference_rate, reference, melting, tearing_energy, averaging_radius}},
       read_johnson_cook},
      {{.name = "Cockcroft-Latham",
        .meaning = "The same where the plastic work of the largest tensile principal stress reaches W_c.",
        .keys = {critical_work, tearing_energy, averaging_radius}},
       [](const Values& v, Problems&) { return ductile(materials::CockcroftLatham{v[critical_work]}, v); }}};
  return all;
}

}  // namespace

Section damage_models_section() {
  Section one{.name = any_name,
              .required = true,
              .meaning = "One model.",
              .hints = {{"Thermal Expansion Coefficient", "unknown key; there is no thermal expansion here"}}};
  return {.name = name,
          .meaning = "Criteria for breaking bonds or failing points (Blocks > Damage Model).",
          .sections = {
              with_cases(std::move(one), {.name = "Damage Model", .meaning = "Criterion."}, schemas_of(entries()))}};
}

std::vector<NamedDamageModel> read_damage_models(const Values& deck, Problems& problems) {
  std::vector<NamedDamageModel> all;
  for (const Values& section : deck.section(name).sections()) {
    NamedDamageModel one{section.name(), {}};
    if (const auto* entry = chosen_of(entries(), section)) one.model = entry->make(section, problems);
    all.push_back(one);
  }
  return all;
}

}  // namespace strut::deck
