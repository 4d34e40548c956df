// Crushable polymeric foam at finite strain: Hencky's elasticity with moduli that grow with the density, an elliptic
// yield surface whose shape follows from a uniaxial and a hydrostatic test, and volumetric flow.
//   F = F_e F_p, ε_e = ½ ln b_e, τ = D(ρ*) : ε_e,  E = E_M (ρ*)^γ,  ρ* = ρ₀*/J          (τ = J σ: Kirchhoff stress)
//   q² + α² (p − (p_c − p_t)/2)² ≤ α² (p_c + p_t)²/4,  p_t = ζ p_c                      (p = −tr τ/3, q von Mises)
//   potential √(q² + β² p²),  β² = (9/2)(1 − 2ν_p)/(1 + ν_p), no plastic spin
//   τ_y = τ_y0 + H_a(ε_v/(1 − 2ν_p)),  p_c = p_c0 + H_p(ε_v),  ε_v = −ln det F_p
//     (da Costa Machado, Alves, Al-Qureshi & Rossi; tests of Zhang, Kikuchi, Li, Yee & Nusholtz 1998)
// Uniaxial compression yields at τ_y, which gives 1/α² = (p_c/τ_y − ⅓)(p_t/τ_y + ⅓), the radicand of the publication in
// factors. So α exists if τ_y < 3 p_c.
// Method: a law of the second form. The stretch U and C_p⁻¹ give the trial b_e = U C_p⁻¹ U. The flow keeps its axes,
// and with z, the remaining fraction of the deviator, one equation in z ∈ [0, 1] is solved by Newton's method within a
// bracket. C_p⁻¹ = U⁻¹ b_e U⁻¹ then contains the exponential map. Stress, energy and ledger use the Cauchy stress; J =
// det U.
// Trade-offs: first order in the step where the direction of flow changes. Because E depends on J, a closed path of
// elastic strain loses or gains work, γ ε_e of the stored energy; so does the published model. No elastic step counts
// as dissipation, so the ledger shows it. Units: Pa, 1/s, s.
#pragma once

#include <array>
#include <limits>

#include "base/math/tensors.hpp"
#include "materials/elastic.hpp"
#include "materials/flow_stress.hpp"
#include "materials/law.hpp"

namespace strut::materials {

struct PolymerFoam {
  Moduli solid{};                        // of the polymer without pores
  double initial_density = 1;            // ρ₀*, relative to the solid's
  double density_exponent = 0;           // γ
  double plastic_poisson = 0;            // ν_p < ½
  double tension_ratio = 1;              // ζ
  double uniaxial_yield = 0;             // τ_y0, Pa
  double hydrostatic_yield = 0;          // p_c0, Pa
  TableHardening uniaxial_hardening;     // H_a(ε_a), Pa; none if empty
  TableHardening hydrostatic_hardening;  // H_p(ε_v), Pa; none if empty

  struct State {
    std::array<double, 6> plastic_strain{};  // ½ (I − C_p⁻¹), in the reference frame; xx yy zz xy yz zx
    double compaction = 0;                   // ε_v
    double equivalent_plastic_strain = 0;    // that of uniaxial compression with the same sum of plastic multipliers
    double plastic_work = 0;                 // J per m³ of reference volume
    double relative_density = 0;             // ρ*; 0: not deformed yet
  };
  static constexpr auto state_names = words<10>(
      "Plastic_Strain_XX Plastic_Strain_YY Plastic_Strain_ZZ Plastic_Strain_XY Plastic_Strain_YZ Plastic_Strain_ZX "
      "Plastic_Compaction Equivalent_Plastic_Strain Plastic_Work_Density Relative_Density");

  PointStress step(const PointStep& step, const Symmetric& stress, State& state) const;

  // ∂σ_c/∂U_d; see law.hpp.
  StretchTangent tangent(const PointStep& step, const Symmetric& old_stress, const State& old_state) const;

  // b_e = U C_p⁻¹ U stays constant.
  void move_stress(const Tensor& from, const Tensor& to, State& state) const;

  State virgin_state() const { return {.relative_density = initial_density}; }

  Moduli moduli() const { return kirchhoff_moduli(1); }
  // The moduli of the Cauchy stress, D(ρ*)/J.
  Moduli moduli(const State& state) const {
    const double J = determinant(state);
    const Moduli now = kirchhoff_moduli(J);
    return {now.bulk / J, now.shear / J};
  }
  double elastic_energy(const Symmetric& stress, const State& state) const {
    const Moduli now = moduli(state);
    return Elastic{now.bulk, now.shear}.elastic_energy(stress);
  }
  double dissipation(const State& state) const { return state.plastic_work; }

  struct YieldStresses {
    double uniaxial, hydrostatic;  // τ_y, p_c, Kirchhoff, Pa
  };
  YieldStresses yield_stresses(double compaction) const {
    const Surface y = surface(compaction);
    return {y.uniaxial, y.hydrostatic};
  }

  // τ_y/J: the Cauchy stress of continued flow in uniaxial compression.
  double flow_stress(const State& state) const { return surface(state.compaction).uniaxial / determinant(state); }

 private:
  // ---- The yield surface --------------------------------------------------------------------------------------------

  // Slopes are derivatives by ε_v.
  struct Surface {
    double uniaxial, hydrostatic, hydrostatic_slope;  // τ_y, p_c, Pa
    double shape, shape_slope;                        // 1/α²
    bool exists() const { return uniaxial > 0 && uniaxial < 3 * hydrostatic; }
  };

  // Constant beyond the ends of the table, also below zero, when the foam has been stretched.
  static Curve<double> hardening(const TableHardening& table, double strain);

  Surface surface(double compaction) const;

  // The positive root n of (q²/α² + p²) − (p_c − p_t) p n − p_c p_t n² = 0: 1 on the surface, 2 at twice its stress.
  // Written without cancellation.
  double nearness(double q, double p, const Surface& y) const;

  // ---- The trial ----------------------------------------------------------------------------------------------------

  struct Trial {
    Moduli moduli;      // D(ρ*), of the Kirchhoff stress, Pa
    Vector strain;      // ε_e without flow, principal values
    Tensor axes;        // of the strain, in columns
    Vector deviator;    // s*, principal, Pa
    double mises;       // q*, Pa
    double compaction;  // −tr ε_e
    double pressure;    // p*, Pa
  };

  double determinant(const State& state) const {
    return state.relative_density > 0 ? initial_density / state.relative_density : 1;
  }

  Moduli kirchhoff_moduli(double J) const;

  static Tensor inverse_plastic(const State& state);

  // NaN if b_e is not finite or not positive definite.
  Trial trial(const PointStep& step, const State& state) const;

  // ---- The return ---------------------------------------------------------------------------------------------------

  // With x = Δγ/√(q² + β² p²): s = s*/(1 + 3G x), p = p*/(1 + K β² x), and ε_v grows by x β² p. With z = 1/(1 + 3G x),
  // w = p/p* is z/(k + (1 − k) z), k = K β²/(3G), and ε_v grows by (1 − w) p*/K, all smooth from the full return, z =
  // 0, to none, z = 1.
  struct Return {
    double deviatoric, mean;  // z, w
    double mean_slope;        // dw/dz
    double compaction;        // ε_v reached
    bool converged;
  };

  double flow_square() const { return 4.5 * (1 - 2 * plastic_poisson) / (1 + plastic_poisson); }  // β²
  double flow_ratio() const { return solid.bulk * flow_square() / (3 * solid.shear); }            // k: ν is constant

  Return place(const Trial& trial, double compaction, double z) const;

  // The yield function of the header over α²: a polynomial, defined also where α is not real.
  struct Excess {
    double value, size;                 // Pa²; the sum of the magnitudes of its terms
    double by_deviatoric;               // by z
    double by_compaction, by_pressure;  // by ε_v; by p
  };

  Excess excess(const Trial& trial, const Return& at, const Surface& y) const;

  static constexpr double epsilon = std::numeric_limits<double>::epsilon();
  static constexpr int most_iterations = 200;  // bisection alone needs 60

  Return flow(const Trial& trial, double compaction) const;

  // The excess is negative at full return and positive at the trial.
  Return solve(const Trial& trial, double compaction, double guess) const;

  static Vector kirchhoff(const Trial& trial, const Return& found);

  // ---- State after the flow -----------------------------------------------------------------------------------------

  void store_flow(const PointStep& step, const Trial& trial, const Return& found, State& state) const;

  // Δγ √(1 + β²/9): the axial plastic strain in uniaxial compression. Δγ = x √(q² + β² p²).
  double equivalent_increment(const Trial& trial, const Return& found) const;

  // ---- The tangent --------------------------------------------------------------------------------------------------

  struct PrincipalTangent {
    Tensor by_strain;  // ∂τ_i/∂ε_j of the trial
    Vector by_volume;  // ∂τ_i/∂ln J at constant ε, because D depends on J
  };
  PrincipalTangent principal_tangent(const Trial& trial, const Return& found) const;
};

static_assert(Law<PolymerFoam> && has_tangent<PolymerFoam>);

}  // namespace strut::materials
