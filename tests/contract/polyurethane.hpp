// The rigid polyurethane foam of the reference problems: parameters as da Costa Machado, Alves, Al-Qureshi & Rossi
// print them. Their hardening tables are not in print and are replaced by the closed form of Neilsen, Morgan & Krieg
// (1987, SAND86-2927) for rigid closed-cell polyurethane foam, a skeleton of constant strength and the air in its
// cells, which is compressed at constant temperature (also Gibson & Ashby 1997, ch. 5):
//   σ = σ_skeleton + p_air (1 − J)/(J − ρ₀*),
// in Cauchy stress, the same in uniaxial compression (without lateral strain) and hydrostatic compression; τ = J σ.
#pragma once

#include <cmath>

#include "materials/polymer_foam.hpp"

namespace strut::testing {

struct Polyurethane {
  static constexpr double young = 928.092e6, poisson = 0.25;                                  // of the solid; Pa
  static constexpr double density = 0.049, exponent = 1.54;                                   // ρ₀*, γ
  static constexpr double uniaxial = 82.034e3, hydrostatic = 40.470e3, tension_ratio = 0.30;  // Pa
  static constexpr double air = 101.325e3;                                                    // Pa

  // Growth of the Kirchhoff stress up to the compaction ε.
  static double hardening(double strength, double strain) {
    const double J = std::exp(-strain);
    return J * (strength + air * (1 - J) / (J - density)) - strength;
  }
  // A table that follows the curve to 1 % of the stress, down to J = 0.061. `axial`: ε_a/ε_v, for a uniaxial curve.
  static materials::TableHardening table(double strength, double axial = 1) {
    materials::TableHardening result;
    for (const double strain : {0.0, 0.1,  0.2, 0.35, 0.5, 0.7, 0.9,  1.1,  1.3,  1.5,  1.7,
                                1.9, 2.05, 2.2, 2.3,  2.4, 2.5, 2.58, 2.65, 2.71, 2.76, 2.8}) {
      result.strains.push_back(axial * strain);
      result.stresses.push_back(hardening(strength, strain));
    }
    return result;
  }

  static materials::PolymerFoam perfect(double plastic_poisson = 0) {
    return {.solid = {young / (3 * (1 - 2 * poisson)), young / (2 * (1 + poisson))},
            .initial_density = density,
            .density_exponent = exponent,
            .plastic_poisson = plastic_poisson,
            .tension_ratio = tension_ratio,
            .uniaxial_yield = uniaxial,
            .hydrostatic_yield = hydrostatic,
            .uniaxial_hardening = {},
            .hydrostatic_hardening = {}};
  }
  static materials::PolymerFoam hardening(double plastic_poisson = 0) {
    materials::PolymerFoam law = perfect(plastic_poisson);
    law.uniaxial_hardening = table(uniaxial, 1 / (1 - 2 * plastic_poisson));
    law.hydrostatic_hardening = table(hydrostatic);
    return law;
  }
};

}  // namespace strut::testing
