// Hardening curves and rate factors: the keys of each, and how it is made from them. A new one is one entry.
#include "deck/laws/flow_stress.hpp"

#include "base/numbers.hpp"
#include "deck/laws/one_of.hpp"
#include "deck/laws/tables.hpp"

namespace strut::deck {

namespace {

using namespace materials;

struct HardeningEntry {
  Section schema;  // named by the values of "Type"
  Hardening (*make)(const Values& hardening);
};

const char* const table_name = "Table";

namespace linear {
const RealKey modulus({.name = "Hardening Modulus", .unit = "Pa", .range = not_negative, .meaning = "H."});
}  // namespace linear

namespace power {
const RealKey reference({.name = "Reference Strain", .range = positive, .meaning = "ε̄₀."});
const RealKey exponent({.name = "Exponent", .range = not_negative, .meaning = "N."});
}  // namespace power

namespace ludwik {
const RealKey modulus({.name = "Modulus", .unit = "Pa", .range = not_negative, .meaning = "B."});
const RealKey exponent({.name = "Exponent", .range = not_negative, .meaning = "n."});
}  // namespace ludwik

namespace voce {
const RealKey saturation({.name = "Saturation Stress", .unit = "Pa", .range = not_negative, .meaning = "Q."});
const RealKey rate({.name = "Saturation Rate", .range = not_negative, .meaning = "b."});
}  // namespace voce

namespace needleman {
const RealKey softening({.name = "Softening Strain", .range = positive, .meaning = "ε̄₁."});
}  // namespace needleman

const std::vector<HardeningEntry>& hardenings() {
  static const std::vector<HardeningEntry> entries = {
      {{.name = "None", .meaning = "h = σ_y."}, [](const Values&) -> Hardening { return NoHardening{}; }},
      {{.name = "Linear", .meaning = "h = σ_y + H ε̄.", .keys = {linear::modulus}},
       [](const Values& v) -> Hardening { return LinearHardening{.modulus = v[linear::modulus]}; }},
      {{.name = "Power Law", .meaning = "h = σ_y (1 + ε̄/ε̄₀)^N.", .keys = {power::reference, power::exponent}},
       [](const Values& v) -> Hardening {
         return PowerHardening{.reference_strain = v[power::reference], .exponent = v[power::exponent]};
       }},
      {{.name = "Ludwik",
        .meaning = "h = σ_y + B ε̄^n, as in the law of Johnson and Cook.",
        .keys = {ludwik::modulus, ludwik::exponent}},
       [](const Values& v) -> Hardening {
         return LudwikHardening{.modulus = v[ludwik::modulus], .exponent = v[ludwik::exponent]};
       }},
      {{.name = "Voce", .meaning = "h = σ_y + Q (1 − exp(−b ε̄)).", .keys = {voce::saturation, voce::rate}},
       [](const Values& v) -> Hardening {
         return VoceHardening{.saturation = v[voce::saturation], .rate = v[voce::rate]};
       }},
      {{.name = "Needleman",
        .meaning = "h = σ_y (1 + ε̄/ε̄₀)^N/(1 + (ε̄/ε̄₁)²).",
        .keys = {power::reference, power::exponent, needleman::softening}},
       [](const Values& v) -> Hardening {
         return NeedlemanHardening{.reference_strain = v[power::reference],
                                   .exponent = v[power::exponent],
                                   .softening_strain = v[needleman::softening]};
       }},
      {{.name = table_name,
        .meaning = "h is piecewise linear, and constant beyond the last strain. The first stress is the yield stress.",
        .keys = table_keys("Equivalent plastic strains, increasing, the first 0.", "Flow stress at each.", positive)},
       [](const Values& v) -> Hardening { return read_table(v); }},
  };
  return entries;
}

struct RateEntry {
  Section schema;
  Rate (*make)(const Values& rate);
};

// Keys of both rate factors.
const RealKey reference_rate({.name = "Reference Rate", .unit = "1/s", .range = positive, .meaning = "ε̇₀."});
const RealKey rate_exponent({.name = "Exponent", .range = not_negative, .meaning = "M."});
const RealKey rate_coefficient({.name = "Coefficient", .range = not_negative, .meaning = "C."});

const std::vector<RateEntry>& rates() {
  static const std::vector<RateEntry> entries = {
      {{.name = "None", .meaning = "r = 1."}, [](const Values&) -> Rate { return NoRate{}; }},
      {{.name = "Power Law", .meaning = "r = (1 + ε̇/ε̇₀)^M.", .keys = {reference_rate, rate_exponent}},
       [](const Values& v) -> Rate {
         return PowerRate{.reference_rate = v[reference_rate], .exponent = v[rate_exponent]};
       }},
      {{.name = "Needleman", .meaning = "r = max(ε̇/ε̇₀, 1)^M.", .keys = {reference_rate, rate_exponent}},
       [](const Values& v) -> Rate {
         return NeedlemanRate{.reference_rate = v[reference_rate], .exponent = v[rate_exponent]};
       }},
      {{.name = "Johnson-Cook", .meaning = "r = 1 + C ln(max(ε̇/ε̇₀, 1)).", .keys = {reference_rate, rate_coefficient}},
       [](const Values& v) -> Rate {
         return JohnsonCookRate{.reference_rate = v[reference_rate], .coefficient = v[rate_coefficient]};
       }},
  };
  return entries;
}

const OptionalKey<double> yield_stress({.name = "Yield Stress",
                                        .unit = "Pa",
                                        .range = positive,
                                        .meaning = "σ_y, the initial static flow stress. Required unless Hardening is "
                                                   "a Table, or Flow Stress has another Type."});

const char* const hardening_name = "Hardening";
const char* const rate_name = "Rate";

// A table contains the yield stress; every other curve needs the key.
double read_yield_stress(const Values& material, const Values& hardening, Problems& problems) {
  const std::optional<double> given = material[yield_stress];
  const std::string path = material.path_to(yield_stress);
  if (hardening.chosen() != table_name) {
    if (!material.given(yield_stress)) problems.add(path, "missing; " + expected(yield_stress));
    return given.value_or(0);
  }
  check_table(hardening, problems);
  const TableHardening table = read_table(hardening);
  if (table.stresses.empty()) return 0;
  const double first = table.stresses.front();
  if (given && *given != first) {
    problems.add(path, "'" + to_text(*given) + "' is not the first of Hardening > Stresses, " + to_text(first) +
                           "; expected the same, or no Yield Stress");
  }
  return first;
}

}  // namespace

Section flow_stress_section() {
  return {.keys = {yield_stress},
          .sections = {
              one_of(hardening_name, "h of the flow stress h(ε̄) r(ε̇), ε̄ the equivalent plastic strain.", hardenings()),
              one_of(rate_name, "r of the flow stress, ε̇ the rate of ε̄.", rates())}};
}

void refuse_flow_stress(const Values& material, const std::string& flow, Problems& problems) {
  const std::string other = "given, but Flow Stress has the Type '" + flow + "'; expected no ";
  if (material.given(yield_stress)) problems.add(material.path_to(yield_stress), other + "Yield Stress");
  for (const char* const section : {hardening_name, rate_name}) {
    if (material.has_section(section)) problems.add(material.path() + " > " + section, other + "section " + section);
  }
}

materials::FlowStress make_flow_stress(const Values& material, Problems& problems) {
  const Values& hardening = material.section(hardening_name);
  return {.yield_stress = read_yield_stress(material, hardening, problems),
          .hardening = make_one_of(hardenings(), hardening),
          .rate = make_one_of(rates(), material.section(rate_name))};
}

}  // namespace strut::deck
