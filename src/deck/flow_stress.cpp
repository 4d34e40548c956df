// Hardening curves and rate factors: for each its keys and how it is made from them. A new one is one entry.
#include "base/errors.hpp"
#include "deck/laws.hpp"
#include "deck/numbers.hpp"

namespace strut::deck {

namespace {

struct HardeningEntry {
  Section schema;  // named as "Type" has it
  materials::Hardening (*make)(const Values& hardening);
};

struct RateEntry {
  Section schema;
  materials::Rate (*make)(const Values& rate);
};

Key number(const std::string& name, const std::string& unit, Range range, const std::string& meaning) {
  return {.name = name, .unit = unit, .range = range, .required = true, .meaning = meaning};
}

const std::vector<HardeningEntry>& hardenings() {
  using namespace materials;
  static const std::vector<HardeningEntry> entries = {
      {{.name = "None", .meaning = "h = σ_y."}, [](const Values&) -> Hardening { return NoHardening{}; }},
      {{.name = "Linear", .meaning = "h = σ_y + H ε̄.", .keys = {number("Hardening Modulus", "Pa", not_negative, "H.")}},
       [](const Values& v) -> Hardening { return LinearHardening{.modulus = v.real("Hardening Modulus")}; }},
      {{.name = "Power Law",
        .meaning = "h = σ_y (1 + ε̄/ε̄₀)^N.",
        .keys = {number("Reference Strain", "", positive, "ε̄₀."), number("Exponent", "", not_negative, "N.")}},
       [](const Values& v) -> Hardening {
         return PowerHardening{.reference_strain = v.real("Reference Strain"), .exponent = v.real("Exponent")};
       }},
      {{.name = "Ludwik",
        .meaning = "h = σ_y + B ε̄^n, as in the law of Johnson and Cook.",
        .keys = {number("Modulus", "Pa", not_negative, "B."), number("Exponent", "", not_negative, "n.")}},
       [](const Values& v) -> Hardening {
         return LudwikHardening{.modulus = v.real("Modulus"), .exponent = v.real("Exponent")};
       }},
      {{.name = "Voce",
        .meaning = "h = σ_y + Q (1 − exp(−b ε̄)).",
        .keys = {number("Saturation Stress", "Pa", not_negative, "Q: what hardening adds in the end."),
                 number("Saturation Rate", "", not_negative, "b.")}},
       [](const Values& v) -> Hardening {
         return VoceHardening{.saturation = v.real("Saturation Stress"), .rate = v.real("Saturation Rate")};
       }},
      {{.name = "Table",
        .meaning = "h piecewise linear, constant beyond the last strain. The first stress is the yield stress.",
        .keys = {{.name = "Strains",
                  .kind = Kind::reals,
                  .range = not_negative,
                  .required = true,
                  .meaning = "Equivalent plastic strains, rising, the first 0."},
                 {.name = "Stresses",
                  .kind = Kind::reals,
                  .unit = "Pa",
                  .range = positive,
                  .required = true,
                  .meaning = "As many flow stresses."}}},
       [](const Values& v) -> Hardening {
         return TableHardening{.strains = v.reals("Strains"), .stresses = v.reals("Stresses")};
       }},
  };
  return entries;
}

const std::vector<RateEntry>& rates() {
  using namespace materials;
  static const std::vector<RateEntry> entries = {
      {{.name = "None", .meaning = "r = 1."}, [](const Values&) -> Rate { return NoRate{}; }},
      {{.name = "Power Law",
        .meaning = "r = (1 + ε̇/ε̇₀)^M.",
        .keys = {number("Reference Rate", "1/s", positive, "ε̇₀."), number("Exponent", "", not_negative, "M.")}},
       [](const Values& v) -> Rate {
         return PowerRate{.reference_rate = v.real("Reference Rate"), .exponent = v.real("Exponent")};
       }},
      {{.name = "Johnson-Cook",
        .meaning = "r = 1 + C ln(max(ε̇/ε̇₀, 1)).",
        .keys = {number("Reference Rate", "1/s", positive, "ε̇₀."), number("Coefficient", "", not_negative, "C.")}},
       [](const Values& v) -> Rate {
         return JohnsonCookRate{.reference_rate = v.real("Reference Rate"), .coefficient = v.real("Coefficient")};
       }},
  };
  return entries;
}

template <class Entry>
Section one_of(const std::string& name, const std::string& meaning, const std::vector<Entry>& entries) {
  std::vector<Section> cases;
  for (const Entry& entry : entries) cases.push_back(entry.schema);
  Key type = {.name = "Type", .kind = Kind::choice, .fallback = "None", .meaning = "The form; it decides on the keys."};
  return with_cases({.name = name, .meaning = meaning}, std::move(type), std::move(cases));
}

// What the chosen entry makes of `values`; of the first entry where the choice itself is among the problems.
template <class Entry>
auto make_one_of(const std::vector<Entry>& entries, const Values& values) {
  for (const Entry& entry : entries) {
    if (entry.schema.name == values.text("Type")) return entry.make(values);
  }
  return entries.front().make(values);
}

// A table brings its own yield stress; every other curve needs the key.
double yield_stress(const Values& material, const Values& hardening, Problems& problems) {
  const std::string path = path_to(material.path(), "Yield Stress");
  if (hardening.text("Type") != "Table") {
    if (!material.given("Yield Stress")) problems.add(path, "missing; expected a real number > 0, in Pa");
    return material.real("Yield Stress");
  }
  check_table(hardening, problems);
  if (!hardening.has("Stresses")) return 0;
  const double first = hardening.reals("Stresses").front();
  if (material.has("Yield Stress") && material.real("Yield Stress") != first) {
    problems.add(path, "'" + to_text(material.real("Yield Stress")) + "' is not the first of Hardening > Stresses, " +
                           to_text(first) + "; expected the same, or no Yield Stress");
  }
  return first;
}

}  // namespace

bool check_table(const Values& hardening, Problems& problems) {
  if (!hardening.has("Strains") || !hardening.has("Stresses")) return false;
  const std::vector<double>& strains = hardening.reals("Strains");
  const std::vector<double>& stresses = hardening.reals("Stresses");
  const std::string path = path_to(hardening.path(), "Strains");
  bool good = true;
  const auto wrong = [&](const std::string& what) {
    problems.add(path, what);
    good = false;
  };
  if (strains.size() != stresses.size()) {
    wrong(std::to_string(strains.size()) + " strains for " + std::to_string(stresses.size()) +
          " stresses; expected as many");
  }
  if (strains.front() != 0) wrong("the first is " + to_text(strains.front()) + "; expected 0");
  for (std::size_t i = 1; i < strains.size(); ++i) {
    if (strains[i] > strains[i - 1]) continue;
    wrong(to_text(strains[i]) + " follows " + to_text(strains[i - 1]) + "; expected rising strains");
  }
  return good;
}

Section flow_stress_section() {
  return {
      .keys = {{.name = "Yield Stress",
                .unit = "Pa",
                .range = positive,
                .meaning = "σ_y: the flow stress at rest without plastic strain. Required unless Hardening is a "
                           "Table."}},
      .sections = {one_of("Hardening", "The flow stress is h(ε̄) r(ε̇), with ε̄ the equivalent plastic strain. This is h.",
                          hardenings()),
                   one_of("Rate", "The factor r of the flow stress, with ε̇ the rate of ε̄.", rates())}};
}

materials::FlowStress make_flow_stress(const Values& material, Problems& problems) {
  const Values& hardening = material.section("Hardening");
  return {.yield_stress = yield_stress(material, hardening, problems),
          .hardening = make_one_of(hardenings(), hardening),
          .rate = make_one_of(rates(), material.section("Rate"))};
}

}  // namespace strut::deck
