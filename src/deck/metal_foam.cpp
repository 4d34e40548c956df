// The keys of Deshpande and Fleck's metal foam, and how the law is made from them.
#include <cmath>

#include "deck/laws.hpp"
#include "deck/problems.hpp"

namespace strut::deck {

namespace {

// Exactly one of two keys; says so where it is otherwise.
bool exactly_one(const Values& material, const std::string& one, const std::string& other, Problems& problems) {
  if (material.given(one) != material.given(other)) return true;
  problems.add(material.path(), material.given(one)
                                    ? "'" + one + "' and '" + other + "' are both given; expected one of them"
                                    : "'" + one + "' or '" + other + "' is missing; expected one of them");
  return false;
}

// α² = (9/2)(1 − 2ν_p)/(1 + ν_p)
double alpha_of(const Values& material) {
  if (material.has("Alpha")) return material.real("Alpha");
  const double nu = material.real("Plastic Poisson's Ratio");
  return std::sqrt(4.5 * (1 - 2 * nu) / (1 + nu));
}

// ε_D = −(9 + α²)/(3 α²) ln(ρ_f/ρ_s)
double densification_of(const Values& material, double alpha, Problems& problems) {
  if (material.has("Densification Strain")) return material.real("Densification Strain");
  const double foam = material.real("Density"), solid = material.real("Solid Density");
  if (alpha == 0) {
    problems.add(material.path(),
                 "'Solid Density' gives no densification strain to a foam that keeps its volume (Alpha "
                 "0, Plastic Poisson's Ratio 0.5); expected 'Densification Strain'");
  } else if (!(solid > foam)) {
    problems.add(path_to(material.path(), "Solid Density"), "expected more than the Density of the foam, in kg/m³");
  }
  return (9 + alpha * alpha) / (3 * alpha * alpha) * std::log(solid / foam);
}

materials::Moduli compacted_moduli(const Values& material, const materials::Moduli& foam, Problems& problems) {
  const std::string young = "Compacted Young's Modulus", poisson = "Compacted Poisson's Ratio";
  if (!material.given(young) && !material.given(poisson)) return foam;
  if (!material.given(young) || !material.given(poisson)) {
    problems.add(material.path(), "'" + young + "' and '" + poisson + "' belong together; expected both or none");
    return foam;
  }
  return moduli_from(material.real(young), material.real(poisson));
}

Key number(const std::string& name, const std::string& unit, Range range, const std::string& meaning) {
  return {.name = name, .unit = unit, .range = range, .meaning = meaning};
}

Key required(Key key) {
  key.required = true;
  return key;
}

}  // namespace

Section metal_foam_section() {
  return {.name = "Metal Foam Correspondence",
          .meaning =
              "A metal foam as a continuum (Deshpande & Fleck 2000): plastic flow that changes the volume, on "
              "σ̂² = (σ_e² + α² σ_m²)/(1 + (α/3)²) = Y², Y = σ_p + γ e + α₂ ln(1/(1 − e^β)), e = ε̂/ε_D.",
          .keys = {number("Alpha", "", {.low = 0, .high = 2.1213203435596428}, "α; or Plastic Poisson's Ratio."),
                   number("Plastic Poisson's Ratio", "", {.low = 0, .high = 0.5},
                          "ν_p of uniaxial compression: α² = (9/2)(1 − 2ν_p)/(1 + ν_p)."),
                   required(number("Plateau Stress", "Pa", positive, "σ_p: where the foam yields.")),
                   required(number("Linear Hardening", "Pa", not_negative, "γ.")),
                   required(number("Locking Stress", "Pa", not_negative, "α₂.")),
                   required(number("Locking Exponent", "", positive, "β.")),
                   number("Densification Strain", "", positive, "ε_D; or Solid Density."),
                   number("Solid Density", "kg/m³", positive,
                          "ρ_s of the cell walls: ε_D = −(9 + α²)/(3 α²) ln(Density/ρ_s)."),
                   number("Failure Strain", "", positive,
                          "A point fails when its volume has grown by a factor of exp of this: it carries no stress "
                          "from then on, and keeps its mass and contact. None fails without it."),
                   number("Compacted Young's Modulus", "Pa", positive,
                          "Of the solid: moduli grow with the plastic compaction up to its. With the next key."),
                   number("Compacted Poisson's Ratio", "", {-1, 0.5, false, false}, "Of the solid.")}};
}

materials::AnyLaw make_metal_foam(const Values& material, const materials::Moduli& foam, Problems& problems) {
  materials::DeshpandeFleck law;
  law.initial = foam;
  law.compacted = compacted_moduli(material, foam, problems);
  if (exactly_one(material, "Alpha", "Plastic Poisson's Ratio", problems)) law.alpha = alpha_of(material);
  law.plateau = material.real("Plateau Stress");
  law.linear = material.real("Linear Hardening");
  law.locking = material.real("Locking Stress");
  law.exponent = material.real("Locking Exponent");
  if (exactly_one(material, "Densification Strain", "Solid Density", problems)) {
    law.densification = densification_of(material, law.alpha, problems);
  }
  if (material.has("Failure Strain")) law.failure_strain = material.real("Failure Strain");
  return law;
}

}  // namespace strut::deck
