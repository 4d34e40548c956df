// Rubber and other elastomers: Ogden's strain energy (1972) per reference volume,
//   W = Σ_p μ_p/α_p (λ̄₁^α_p + λ̄₂^α_p + λ̄₃^α_p − 3) + ½ K (J − 1)²,   λ̄_i = J^(−1/3) λ_i
// of which neo-Hooke (α = 2) and Mooney & Rivlin (α = 2, −2) are cases; and relaxation of the deviator by a Prony
// series (Simo 1987; Simo & Hughes, Computational Inelasticity, 10.3): S̃ = J^(2/3) U⁻¹ dev τ U⁻¹, and
//   dev τ = γ_∞ dev τ₀ + Σ_k γ_k dev(J^(−2/3) U h_k U),   h_k ← e^(−x) h_k + (1 − e^(−x))/x ΔS̃₀,   x = Δt/t_k,
// γ_∞ = 1 − Σ γ_k: exact if S̃₀ changes at a constant rate, however long the step.
// A law of the second form (law.hpp): it reads U, in the unrotated frame. The moduli are those of fast loading.
// Units: Pa, s.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "materials/elastic.hpp"
#include "materials/law.hpp"

namespace strut::materials {

struct Hyperelastic {
  static constexpr bool follows_stretch = true;
  static constexpr int most_terms = 3, most_times = 4;

  struct Term {
    double modulus = 0, exponent = 2;  // μ_p (Pa), α_p
  };
  struct Relaxation {
    double fraction = 0, time = 1;  // γ_k, t_k (s)
  };

  double bulk = 0;                             // K, Pa
  std::array<Term, most_terms> terms{};        // unused ones have a modulus of 0
  std::array<Relaxation, most_times> times{};  // unused ones have a fraction of 0

  struct State {
    double stiffening = 0;  // the largest tangent along a principal axis over that of the undeformed state, − 1
    double stored = 0, dissipated = 0;              // J per m³ of reference volume
    std::array<double, 6> last{};                   // U − 1 at the end of the last step, if it relaxes
    std::array<double, 6 * most_times> branches{};  // h_k, Pa
  };
  static constexpr auto state_names = words<9 + 6 * most_times>(
      "Stiffening Elastic_Energy_Density Dissipated_Energy_Density "
      "Last_Stretch_XX Last_Stretch_YY Last_Stretch_ZZ Last_Stretch_XY Last_Stretch_YZ Last_Stretch_ZX "
      "Branch_1_XX Branch_1_YY Branch_1_ZZ Branch_1_XY Branch_1_YZ Branch_1_ZX "
      "Branch_2_XX Branch_2_YY Branch_2_ZZ Branch_2_XY Branch_2_YZ Branch_2_ZX "
      "Branch_3_XX Branch_3_YY Branch_3_ZZ Branch_3_XY Branch_3_YZ Branch_3_ZX "
      "Branch_4_XX Branch_4_YY Branch_4_ZZ Branch_4_XY Branch_4_YZ Branch_4_ZX");
  bool shows(std::size_t k) const { return k == 1 || k == 2; }

  PointStress step(const PointStep& step, const Symmetric& stress, State& state) const;

  double shear() const {  // ½ Σ μ_p α_p
    double sum = 0;
    for (const Term& term : terms) sum += 0.5 * term.modulus * term.exponent;
    return sum;
  }
  double kept() const {  // γ_∞
    double rest = 1;
    for (const Relaxation& one : times) rest -= one.fraction;
    return rest;
  }
  // The elastomer that is left when this one has been held for a time, s.
  Hyperelastic relaxed(double held) const {
    Hyperelastic rest{.bulk = bulk, .terms = terms};
    double left = 1;
    for (const Relaxation& one : times) left += one.fraction * std::expm1(-held / one.time);
    for (Term& term : rest.terms) term.modulus *= left;
    return rest;
  }
  Moduli moduli() const { return {bulk, shear()}; }
  Moduli moduli(const State& state) const { return {(1 + state.stiffening) * bulk, (1 + state.stiffening) * shear()}; }
  double elastic_energy(const Symmetric& stress, const State&) const {
    return Elastic{bulk, shear()}.elastic_energy(stress);
  }
  double stored_energy(const State& state) const { return state.stored; }
  double dissipation(const State& state) const { return state.dissipated; }
  double flow_stress(const State&) const { return std::numeric_limits<double>::infinity(); }
};

static_assert(Law<Hyperelastic> && has_changing_moduli<Hyperelastic>);

}  // namespace strut::materials
