#include <cmath>

#include "deck/laws/constants.hpp"
#include "deck/laws/laws.hpp"
#include "deck/sections/several_sections.hpp"

namespace strut::deck {

namespace {

const OptionalKey<double> alpha({.name = "Alpha",
                                 .range = {.low = 0, .high = 2.1213203435596428},
                                 .meaning = "α; or Plastic Poisson's Ratio."});

const OptionalKey<double> plastic_poisson({.name = "Plastic Poisson's Ratio",
                                           .range = {.low = 0, .high = 0.5},
                                           .meaning = "ν_p of uniaxial compression: α² = (9/2)(1 − 2ν_p)/(1 + ν_p)."});

const RealKey plateau({.name = "Plateau Stress", .unit = "Pa", .range = positive, .meaning = "σ_p."});
const RealKey linear({.name = "Linear Hardening", .unit = "Pa", .range = not_negative, .meaning = "γ."});
const RealKey locking({.name = "Locking Stress", .unit = "Pa", .range = not_negative, .meaning = "α₂."});
const RealKey exponent({.name = "Locking Exponent", .range = positive, .meaning = "β."});

const OptionalKey<double> densification({.name = "Densification Strain",
                                         .range = positive,
                                         .meaning = "ε_D; or Solid Density."});

const OptionalKey<double> solid_density({.name = "Solid Density",
                                         .unit = "kg/m³",
                                         .range = positive,
                                         .meaning = "ρ_s of the cell walls; ε_D = −(9 + α²)/(3 α²) ln(Density/ρ_s)."});

const OptionalKey<double> failure_strain(
    {.name = "Failure Strain",
     .range = positive,
     .meaning = "A point fails when the logarithm of its volume ratio exceeds this: it loses its stress, not its mass "
                "and contact. Without this key none fails."});

const OptionalKey<double> compacted_young(
    {.name = "Compacted Young's Modulus",
     .unit = "Pa",
     .range = positive,
     .meaning = "E of the solid, to which the modulus grows with plastic compaction. Needs the next key."});

const OptionalKey<double> compacted_poisson({.name = "Compacted Poisson's Ratio",
                                             .range = {-1, 0.5, false, false},
                                             .meaning = "ν of the solid."});

// α² = (9/2)(1 − 2ν_p)/(1 + ν_p)
double alpha_of(const Values& material) {
  if (const auto given = material[alpha]) return *given;
  const double nu = material[plastic_poisson].value_or(0);
  return std::sqrt(4.5 * (1 - 2 * nu) / (1 + nu));
}

// ε_D = −(9 + α²)/(3 α²) ln(ρ_f/ρ_s)
double densification_of(const Values& material, double alpha, Problems& problems) {
  if (const auto given = material[densification]) return *given;
  const double foam = read_density(material), solid = material[solid_density].value_or(0);
  if (alpha == 0) {
    problems.add(material.path(),
                 "'Solid Density' gives no densification strain to a foam that keeps its volume (Alpha "
                 "0, Plastic Poisson's Ratio 0.5); expected 'Densification Strain'");
  } else if (!(solid > foam)) {
    problems.add(material.path_to(solid_density), "expected more than the Density of the foam, in kg/m³");
  }
  return (9 + alpha * alpha) / (3 * alpha * alpha) * std::log(solid / foam);
}

materials::Moduli compacted_moduli(const Values& material, const materials::Moduli& foam, Problems& problems) {
  const bool young = material.given(compacted_young), poisson = material.given(compacted_poisson);
  if (!young && !poisson) return foam;
  if (!young || !poisson) {
    problems.add(material.path(), "'" + compacted_young.name + "' and '" + compacted_poisson.name +
                                      "' belong together; expected both or none");
    return foam;
  }
  return moduli_from(material[compacted_young].value_or(0), material[compacted_poisson].value_or(0));
}

}  // namespace

Section metal_foam_section() {
  return {.name = "Metal Foam Correspondence",
          .meaning =
              "Metal foam as a continuum (Deshpande & Fleck 2000), with plastic change of volume: σ̂² = (σ_e² + α² "
              "σ_m²)/(1 + (α/3)²) = Y², Y = σ_p + γ e + α₂ ln(1/(1 − e^β)), e = ε̂/ε_D.",
          .keys = {alpha, plastic_poisson, plateau, linear, locking, exponent, densification, solid_density,
                   failure_strain, compacted_young, compacted_poisson}};
}

materials::AnyLaw make_metal_foam(const Values& material, Problems& problems) {
  materials::DeshpandeFleck law;
  law.initial = checked_moduli(material, problems);
  law.compacted = compacted_moduli(material, law.initial, problems);
  if (check_exactly_one(material, alpha, plastic_poisson, problems)) law.alpha = alpha_of(material);
  law.plateau = material[plateau];
  law.linear = material[linear];
  law.locking = material[locking];
  law.exponent = material[exponent];
  if (check_exactly_one(material, densification, solid_density, problems)) {
    law.densification = densification_of(material, law.alpha, problems);
  }
  law.failure_strain = material[failure_strain].value_or(law.failure_strain);
  return law;
}

}  // namespace strut::deck
