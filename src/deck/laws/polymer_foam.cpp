#include <algorithm>
#include <optional>
#include <vector>

#include "base/numbers.hpp"
#include "base/text.hpp"
#include "deck/laws/constants.hpp"
#include "deck/laws/laws.hpp"
#include "deck/laws/tables.hpp"

namespace strut::deck {

namespace {

const RealKey relative_density({.name = "Relative Density",
                                .range = {.low = 0, .high = 1, .with_low = false},
                                .meaning = "ρ₀*, initial density over that of the solid."});
const RealKey density_exponent({.name = "Density Exponent", .range = not_negative, .meaning = "γ."});
const RealKey plastic_poisson({.name = "Plastic Poisson's Ratio",
                               .range = {.low = 0, .high = 0.5, .with_high = false},
                               .fallback = "0",
                               .meaning = "ν_p of uniaxial compression: the potential √(q² + β² p²) with "
                                          "β² = (9/2)(1 − 2ν_p)/(1 + ν_p)."});
const RealKey tension_ratio({.name = "Tension Ratio",
                             .range = positive,
                             .meaning = "ζ = p_t/p_c, yield pressure in tension over that in compression."});
const RealKey uniaxial_yield(
    {.name = "Uniaxial Yield Stress", .unit = "Pa", .range = positive, .meaning = "τ_y0, in compression."});
const RealKey hydrostatic_yield(
    {.name = "Hydrostatic Yield Stress", .unit = "Pa", .range = positive, .meaning = "p_c0 > τ_y0/3, in compression."});

const char* const uniaxial_table = "Uniaxial Hardening";
const char* const hydrostatic_table = "Hydrostatic Hardening";

Section table_section(const std::string& name, const std::string& meaning, const std::string& strains) {
  return {.name = name,
          .meaning = meaning + " Piecewise linear, constant beyond the last strain; 0 without this section.",
          .keys = table_keys(strains, "Increase of the yield stress (Kirchhoff) at each, the first 0.")};
}

// nullopt if it has been reported as wrong; an empty table if the deck has no such section.
std::optional<materials::TableHardening> table(const Values& material, const std::string& name, Problems& problems) {
  const Values* section = material.find_section(name);
  if (!section) return materials::TableHardening{};
  if (!check_table(*section, problems)) return {};
  const materials::TableHardening table = read_table(*section);
  if (table.stresses.front() == 0) return table;
  problems.add(path_to_stresses(*section),
               "the first is " + to_text(table.stresses.front()) + "; expected 0, in Pa: what is added by hardening");
  return {};
}

// The compactions ε_v between which both curves are linear.
std::vector<double> knots(const materials::PolymerFoam& law) {
  std::vector<double> all{0};
  for (const double strain : law.uniaxial_hardening.strains) all.push_back(strain * (1 - 2 * law.plastic_poisson));
  for (const double strain : law.hydrostatic_hardening.strains) all.push_back(strain);
  std::sort(all.begin(), all.end());
  return all;
}

// The least ε_v at which `margin`, linear between the knots, is not positive; negative if there is none.
template <class Margin>
double first_without(const std::vector<double>& knots, Margin margin) {
  double before = 0, value_before = 0;
  for (const double knot : knots) {
    const double value = margin(knot);
    if (!(value > 0)) {
      return value_before > 0 ? before + (knot - before) * value_before / (value_before - value) : knot;
    }
    before = knot, value_before = value;
  }
  return -1;
}

// α = τ_y/√((p_c − τ_y/3)(p_t + τ_y/3)) exists where τ_y < 3 p_c; both must be positive.
void check_ellipse(const materials::PolymerFoam& law, const std::string& path, Problems& problems) {
  const auto places = knots(law);
  const auto stresses = [&law](double compaction) { return law.yield_stresses(compaction); };
  const double soft = first_without(places, [&](double v) { return stresses(v).uniaxial; });
  const double flat =
      first_without(places, [&](double v) { return 3 * stresses(v).hydrostatic - stresses(v).uniaxial; });
  if (soft >= 0) {
    problems.add(path, text_of("the uniaxial yield stress falls to 0 at the axial plastic strain ",
                               soft / (1 - 2 * law.plastic_poisson), "; expected more than 0, in Pa"));
  }
  if (flat >= 0) {
    const auto at = stresses(flat);
    problems.add(path, text_of("at the volumetric plastic strain ", flat, " the uniaxial yield stress, ", at.uniaxial,
                               " Pa, reaches three times the hydrostatic one, ", at.hydrostatic,
                               " Pa, where no ellipse goes through both; expected less than that, in Pa, at every "
                               "strain"));
  }
}

bool has_yield_stresses(const Values& material) {
  return material.has(uniaxial_yield) && material.has(hydrostatic_yield) && material.has(plastic_poisson);
}

}  // namespace

Section polymer_foam_section() {
  return {
      .name = "Polymer Foam Correspondence",
      .meaning =
          "Crushable polymeric foam at finite strain: Hencky elasticity with E = E_M (ρ*)^γ, ρ* = ρ₀*/J, and an "
          "elliptic yield surface in Kirchhoff stress through a uniaxial and a hydrostatic test. The elastic constants "
          "are E_M and ν of the solid polymer.",
      .keys = {relative_density, density_exponent, plastic_poisson, tension_ratio, uniaxial_yield, hydrostatic_yield},
      .sections = {table_section(uniaxial_table, "H_a: τ_y = τ_y0 + H_a(ε_a), ε_a = ε_v/(1 − 2ν_p).",
                                 "Axial logarithmic plastic strains ε_a in compression, increasing, the first 0."),
                   table_section(hydrostatic_table, "H_p: p_c = p_c0 + H_p(ε_v), ε_v = −ln det F_p.",
                                 "Volumetric plastic strains ε_v in compression, increasing, the first 0.")}};
}

materials::AnyLaw make_polymer_foam(const Values& material, Problems& problems) {
  const materials::Moduli solid = checked_moduli(material, problems);
  const auto uniaxial = table(material, uniaxial_table, problems);
  const auto hydrostatic = table(material, hydrostatic_table, problems);
  const materials::PolymerFoam law{.solid = solid,
                                   .initial_density = material[relative_density],
                                   .density_exponent = material[density_exponent],
                                   .plastic_poisson = material[plastic_poisson],
                                   .tension_ratio = material[tension_ratio],
                                   .uniaxial_yield = material[uniaxial_yield],
                                   .hydrostatic_yield = material[hydrostatic_yield],
                                   .uniaxial_hardening = uniaxial.value_or(materials::TableHardening{}),
                                   .hydrostatic_hardening = hydrostatic.value_or(materials::TableHardening{})};
  if (uniaxial && hydrostatic && has_yield_stresses(material)) check_ellipse(law, material.path(), problems);
  return law;
}

}  // namespace strut::deck
