// The forms of the flow stress: hardening curves, rate factors, softening, forms with temperature; the keys of each,
// and how it is made from them. A new one is one entry.
#include "deck/laws/flow_stress.hpp"

#include <cmath>

#include "base/numbers.hpp"
#include "deck/laws/tables.hpp"

namespace strut::deck {

namespace {

using namespace materials;

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

const std::vector<Case<Hardening>>& hardenings() {
  static const std::vector<Case<Hardening>> entries = {
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

// Keys of both rate factors.
const RealKey reference_rate({.name = "Reference Rate", .unit = "1/s", .range = positive, .meaning = "ε̇₀."});
const RealKey rate_exponent({.name = "Exponent", .range = not_negative, .meaning = "M."});
const RealKey rate_coefficient({.name = "Coefficient", .range = not_negative, .meaning = "C."});

const std::vector<Case<Rate>>& rates() {
  static const std::vector<Case<Rate>> entries = {
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

// Reports any of these keys if the deck also gives a flow stress of another form.
void refuse_flow_stress(const Values& material, const std::string& flow, Problems& problems) {
  const std::string other = "given, but Flow Stress has the Type '" + flow + "'; expected no ";
  if (material.given(yield_stress)) problems.add(material.path_to(yield_stress), other + "Yield Stress");
  for (const char* const section : {hardening_name, rate_name}) {
    if (material.has_section(section)) problems.add(material.path() + " > " + section, other + "section " + section);
  }
}

const char* const flow_name = "Flow Stress";
const char* const softening_name = "Softening";

// ---- Softening ------------------------------------------------------------------------------------------------------

namespace softening {
const RealKey reference({.name = "Reference Temperature", .unit = "K", .range = not_negative, .meaning = "T_r."});
const RealKey melting({.name = "Melting Temperature", .unit = "K", .range = positive, .meaning = "T_m."});
const RealKey exponent({.name = "Exponent", .range = positive, .meaning = "m."});
}  // namespace softening

const std::vector<Case<Softening>>& softenings() {
  static const std::vector<Case<Softening>> entries = {
      {{.name = "None", .meaning = "θ = 1."}, [](const Values&) -> Softening { return NoSoftening{}; }},
      {{.name = "Johnson-Cook",
        .meaning = "θ = 1 − T*^m with T* = (T − T_r)/(T_m − T_r), between 0 and 1.",
        .keys = {softening::reference, softening::melting, softening::exponent}},
       [](const Values& v) -> Softening {
         return JohnsonCookSoftening{v[softening::reference], v[softening::melting], v[softening::exponent]};
       }},
  };
  return entries;
}

void check_softening(const Values& section, Problems& problems) {
  if (section.chosen() != "Johnson-Cook") return;
  if (!section.has(softening::reference) || !section.has(softening::melting)) return;  // already reported
  if (section[softening::melting] > section[softening::reference]) return;
  problems.add(section.path_to(softening::melting), "expected more than the Reference Temperature, in K");
}

// ---- Zerilli & Armstrong --------------------------------------------------------------------------------------------

const RealKey athermal_stress({.name = "Athermal Stress", .unit = "Pa", .range = not_negative, .meaning = "σ_a."});

namespace zerilli {
const RealKey modulus(
    {.name = "Modulus", .unit = "Pa", .range = not_negative, .fallback = "0", .meaning = "K; 0 for fcc metals."});
const RealKey exponent({.name = "Exponent", .range = positive, .fallback = "1", .meaning = "n."});
const RealKey thermal({.name = "Thermal Stress", .unit = "Pa", .range = positive, .meaning = "B."});
const RealKey thermal_exponent({.name = "Thermal Exponent",
                                .range = not_negative,
                                .meaning = "N: 0.5 for fcc metals, 0 for bcc metals."});
const RealKey softening({.name = "Softening", .unit = "1/K", .range = not_negative, .meaning = "C₃."});
const RealKey rate({.name = "Rate Softening", .unit = "1/K", .range = not_negative, .meaning = "C₄."});
}  // namespace zerilli

ThermalFlow make_zerilli_armstrong(const Values& v) {
  return ZerilliArmstrong{.athermal = v[athermal_stress],
                          .hardening = {v[zerilli::modulus], v[zerilli::exponent]},
                          .thermal = {v[zerilli::thermal], v[zerilli::thermal_exponent]},
                          .softening = v[zerilli::softening],
                          .rate_softening = v[zerilli::rate]};
}

// ---- Mechanical threshold -------------------------------------------------------------------------------------------

namespace threshold {
const RealKey initial(
    {.name = "Initial Threshold", .unit = "Pa", .range = not_negative, .fallback = "0", .meaning = "Initial σ̂."});
const RealKey shear({.name = "Cold Shear Modulus",
                     .unit = "Pa",
                     .range = positive,
                     .meaning = "μ₀ of μ = μ₀ − D/(exp(T₀/T) − 1) (Varshni 1970), used by the flow stress alone."});
const RealKey shear_fall({.name = "Shear Modulus Drop", .unit = "Pa", .range = not_negative, .meaning = "D."});
const RealKey shear_temperature(
    {.name = "Shear Modulus Temperature", .unit = "K", .range = positive, .meaning = "T₀."});
const RealKey burgers({.name = "Burgers Vector", .unit = "m", .range = positive, .meaning = "b."});
const RealKey energy({.name = "Activation Energy", .range = positive, .meaning = "g₀, in μ b³."});
const RealKey rate({.name = "Reference Rate", .unit = "1/s", .range = positive, .meaning = "ε̇₀."});
const RealKey p({.name = "P", .range = positive, .meaning = "p."});
const RealKey q({.name = "Q", .range = positive, .meaning = "q."});
const RealKey slope({.name = "Hardening Modulus", .unit = "Pa", .range = positive, .meaning = "a₀."});
const RealKey slope_log(
    {.name = "Hardening Modulus of Log Rate", .unit = "Pa", .range = not_negative, .fallback = "0", .meaning = "a₁."});
const RealKey slope_root({.name = "Hardening Modulus of Root Rate",
                          .unit = "Pa √s",
                          .range = not_negative,
                          .fallback = "0",
                          .meaning = "a₂."});
const RealKey curvature({.name = "Curvature", .range = positive, .meaning = "α."});
const RealKey saturation({.name = "Saturation Threshold", .unit = "Pa", .range = positive, .meaning = "σ̂_s0."});
const RealKey saturation_energy({.name = "Saturation Energy", .range = positive, .meaning = "g_s0, in μ b³."});
const RealKey saturation_rate({.name = "Saturation Rate", .unit = "1/s", .range = positive, .meaning = "ε̇_s0."});
}  // namespace threshold

ThermalFlow make_threshold(const Values& v) {
  using namespace threshold;
  constexpr double boltzmann = 1.380649e-23;  // J/K
  return MechanicalThreshold{.athermal = v[athermal_stress],
                             .initial = v[initial],
                             .shear = v[shear],
                             .shear_fall = v[shear_fall],
                             .shear_temperature = v[shear_temperature],
                             .boltzmann = boltzmann / std::pow(v[burgers], 3),
                             .energy = v[energy],
                             .rate = v[rate],
                             .p = v[p],
                             .q = v[q],
                             .slopes = {v[slope], v[slope_log], v[slope_root]},
                             .curvature = v[curvature],
                             .saturation = v[saturation],
                             .saturation_energy = v[saturation_energy],
                             .saturation_rate = v[saturation_rate]};
}

// Reports a threshold that does not harden at the slowest rate that the law distinguishes.
void check_threshold(const Values& v, Problems& problems) {
  using namespace threshold;
  if (v.chosen() != "Mechanical Threshold" || !v.has(slope) || !v.has(slope_log) || !v.has(slope_root)) return;
  if (v[slope] + v[slope_log] * std::log(slowest_rate) + v[slope_root] * std::sqrt(slowest_rate) > 0) return;
  problems.add(v.path_to(slope), "a₀ + a₁ ln ε̇ + a₂ √ε̇ is not positive at 1e-3 /s; expected a larger one");
}

// ---- All ------------------------------------------------------------------------------------------------------------

const std::vector<Case<ThermalFlow>>& flows() {
  using namespace threshold;
  static const std::vector<Case<ThermalFlow>> entries = {
      {{.name = "Hardening and Rate",
        .meaning = "σ̄ = h(ε̄) r(ε̇) θ(T), by Yield Stress and the sections Hardening, Rate and Softening."},
       [](const Values&) -> ThermalFlow { return SoftenedFlow{}; }},
      {{.name = "Zerilli-Armstrong",
        .meaning = "σ̄ = σ_a + K ε̄^n + B ε̄^N exp(−C₃ T + C₄ T ln ε̇), ε̇ in 1/s (Zerilli and Armstrong 1987).",
        .keys = {athermal_stress, zerilli::modulus, zerilli::exponent, zerilli::thermal, zerilli::thermal_exponent,
                 zerilli::softening, zerilli::rate}},
       make_zerilli_armstrong},
      {{.name = "Mechanical Threshold",
        .meaning =
            "σ̄ = σ_a + S(ε̇, T) σ̂ μ(T)/μ₀ with S = (1 − (e/g₀ ln(ε̇₀/ε̇))^(1/q))^(1/p), e = k T/(μ b³), and "
            "dσ̂/dε̄ = (a₀ + a₁ ln ε̇ + a₂ √ε̇) (1 − tanh(α σ̂/σ̂_s)/tanh α), σ̂_s = σ̂_s0 (ε̇/ε̇_s0)^(e/g_s0) (Follansbee "
            "and Kocks 1988, of fcc metals).",
        .keys = {athermal_stress, initial, shear, shear_fall, shear_temperature, burgers, energy, rate, p, q, slope,
                 slope_log, slope_root, curvature, saturation, saturation_energy, saturation_rate}},
       make_threshold},
  };
  return entries;
}

// True also if the form itself is wrong.
bool is_product(const Values& material) {
  const std::string form = material.section(flow_name).chosen();
  return form.empty() || form == flows().front().schema.name;
}

}  // namespace

Section flow_stress_section() {
  return {.keys = {yield_stress},
          .sections = {
              one_of(hardening_name, "h of the flow stress h(ε̄) r(ε̇), ε̄ the equivalent plastic strain.", hardenings()),
              one_of(rate_name, "r of the flow stress, ε̇ the rate of ε̄.", rates())}};
}

materials::FlowStress make_flow_stress(const Values& material, Problems& problems) {
  const Values& hardening = material.section(hardening_name);
  return {.yield_stress = read_yield_stress(material, hardening, problems),
          .hardening = make_one_of(hardenings(), hardening),
          .rate = make_one_of(rates(), material.section(rate_name))};
}

std::vector<Section> thermal_flow_sections() {
  return {one_of(flow_name, "Form of the flow stress.", flows()),
          one_of(softening_name, "θ of the flow stress, T the temperature.", softenings())};
}

bool has_thermal_flow(const Values& material) {
  return !is_product(material) || material.section(softening_name).chosen() != softenings().front().schema.name;
}

ThermalFlow make_thermal_flow(const Values& material, Problems& problems) {
  const Values& flow = material.section(flow_name);
  if (is_product(material)) {
    const Values& softening = material.section(softening_name);
    check_softening(softening, problems);
    return SoftenedFlow{make_flow_stress(material, problems), make_one_of(softenings(), softening)};
  }
  refuse_flow_stress(material, flow.chosen(), problems);
  check_threshold(flow, problems);
  if (material.has_section(softening_name)) {
    problems.add(material.path() + " > " + softening_name,
                 "given, but Flow Stress has the Type '" + flow.chosen() + "'; expected no section Softening");
  }
  return make_one_of(flows(), flow);
}

}  // namespace strut::deck
