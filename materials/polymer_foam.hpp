// Crushable polymeric foam at finite strain: Hencky's elasticity with moduli that grow with the density, an ellipse of
// yield whose shape follows from a uniaxial and a hydrostatic test, and flow that changes the volume.
//   F = F_e F_p, ε_e = ½ ln b_e, τ = D(ρ*) : ε_e,  E = E_M (ρ*)^γ,  ρ* = ρ₀*/J          (τ = J σ: Kirchhoff stress)
//   q² + α² (p − (p_c − p_t)/2)² ≤ α² (p_c + p_t)²/4,  p_t = ζ p_c                      (p = −tr τ/3, q von Mises)
//   potential √(q² + β² p²),  β² = (9/2)(1 − 2ν_p)/(1 + ν_p), no plastic spin
//   τ_y = τ_y0 + H_a(ε_v/(1 − 2ν_p)),  p_c = p_c0 + H_p(ε_v),  ε_v = −ln det F_p
//     (da Costa Machado, Alves, Al-Qureshi & Rossi; tests of Zhang, Kikuchi, Li, Yee & Nusholtz 1998)
// Uniaxial compression yields at τ_y, which makes 1/α² = (p_c/τ_y − ⅓)(p_t/τ_y + ⅓): the radicand of the print in
// factors. So α exists as long as τ_y < 3 p_c.
// Method: a law of the second form. From the stretch U and C_p⁻¹ comes the trial b_e = U C_p⁻¹ U; the flow leaves its
// axes as they are, and with z for what is left of the deviator one equation in z ∈ [0, 1] is to be solved, by Newton
// within a bracket. C_p⁻¹ = U⁻¹ b_e U⁻¹ then holds the exponential map. Stress, energy and ledger are of the Cauchy
// stress; J = det U.
// Trade-offs: first order in the step where the direction of flow turns. As E depends on J, a closed path of elastic
// strain does not give back all its work, or gives more: by γ ε_e of what it stores. The published model has that; no
// elastic step counts as dissipation, so the ledger shows it. Units: Pa, 1/s, s.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "base/math/tensors.hpp"
#include "materials/elastic.hpp"
#include "materials/flow_stress.hpp"
#include "materials/law.hpp"
#include "materials/spectral.hpp"
#include "materials/step_work.hpp"

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
    double equivalent_plastic_strain = 0;    // that of uniaxial compression with the same sum of multipliers
    double plastic_work = 0;                 // J per m³ of reference volume
    double relative_density = 0;             // ρ*; 0: not deformed yet
  };
  static constexpr std::array<std::string_view, 10> state_names{
      "Plastic_Strain_XX",    "Plastic_Strain_YY", "Plastic_Strain_ZZ",  "Plastic_Strain_XY",
      "Plastic_Strain_YZ",    "Plastic_Strain_ZX", "Plastic_Compaction", "Equivalent_Plastic_Strain",
      "Plastic_Work_Density", "Relative_Density"};

  PointStress step(const PointStep& step, const Symmetric& stress, State& state) const {
    const Trial trial = this->trial(step, state);
    const Return found = flow(trial, state.compaction);
    const Vector tau = kirchhoff(trial, found);
    const Symmetric next = from_principal(tau / step.J, trial.axes);
    if (!found.converged || !std::isfinite(next[0] + next[1] + next[2] + next[3] + next[4] + next[5])) {
      return {stress, false};
    }
    State reached = state;
    reached.relative_density = initial_density / step.J;
    if (found.deviatoric < 1) {
      store_flow(step, trial, found, reached);
      const double lost = this->lost(step, stress, state, next, reached);
      if (!std::isfinite(lost)) return {stress, false};
      reached.plastic_work += std::max(0.0, lost);
    }
    state = reached;
    return {next, true};
  }

  // ∂σ_c/∂U_d; see law.hpp.
  StretchTangent tangent(const PointStep& step, const Symmetric& old_stress, const State& old_state) const;

  State virgin_state() const { return {.relative_density = initial_density}; }

  Moduli moduli() const { return kirchhoff_moduli(1); }
  // Of the Cauchy stress: D(ρ*)/J.
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

  // The uniaxial compression that is as near to yield: τ_y/J times the factor by which the yield surface, shrunk
  // towards zero stress, passes through the stress.
  double equivalent_stress(const Symmetric& stress, const State& state) const {
    const double J = determinant(state);
    return nearness(J * von_mises(stress), -J * trace(stress) / 3, surface(state.compaction)) * flow_stress(state);
  }
  // τ_y/J: the Cauchy stress at which uniaxial compression goes on to flow.
  double flow_stress(const State& state) const { return surface(state.compaction).uniaxial / determinant(state); }

 private:
  // ---- The yield surface --------------------------------------------------------------------------------------------

  // Slopes are by ε_v.
  struct Surface {
    double uniaxial, hydrostatic, hydrostatic_slope;  // τ_y, p_c, Pa
    double shape, shape_slope;                        // 1/α²
    bool exists() const { return uniaxial > 0 && uniaxial < 3 * hydrostatic; }
  };

  // Constant beyond the ends of the table, also below zero: where the foam has been pulled longer.
  static Curve<double> hardening(const TableHardening& table, double strain) {
    if (table.strains.empty()) return {0, 0};
    return strain < 0 ? Curve<double>{table.stresses.front(), 0} : table(0, strain);
  }

  Surface surface(double compaction) const {
    const double axial = 1 / (1 - 2 * plastic_poisson);  // ε_a/ε_v
    const Curve<double> a = hardening(uniaxial_hardening, axial * compaction);
    const Curve<double> p = hardening(hydrostatic_hardening, compaction);
    const double uniaxial = uniaxial_yield + a.value, hydrostatic = hydrostatic_yield + p.value;
    const double ratio = hydrostatic / uniaxial, ratio_slope = (p.slope - ratio * axial * a.slope) / uniaxial;
    const double compression = ratio - 1.0 / 3, tension = tension_ratio * ratio + 1.0 / 3;
    return {uniaxial, hydrostatic, p.slope, compression * tension,
            ratio_slope * (tension + tension_ratio * compression)};
  }

  // The positive root n of (q²/α² + p²) − (p_c − p_t) p n − p_c p_t n² = 0: 1 on the surface, 2 at twice its stress.
  // The form without cancellation.
  double nearness(double q, double p, const Surface& y) const {
    const double square = y.shape * q * q + p * p, offset = (1 - tension_ratio) * y.hydrostatic * p / 2;
    const double product = tension_ratio * y.hydrostatic * y.hydrostatic;
    const double root = std::sqrt(offset * offset + product * square);
    if (square == 0) return 0;
    return offset > 0 ? square / (root + offset) : (root - offset) / product;
  }

  // ---- The trial ----------------------------------------------------------------------------------------------------

  struct Trial {
    Moduli moduli;      // D(ρ*), of the Kirchhoff stress, Pa
    Vector strain;      // ε_e without flow, principal
    Tensor axes;        // of it, in columns
    Vector deviator;    // s*, principal, Pa
    double mises;       // q*, Pa
    double compaction;  // −tr ε_e
    double pressure;    // p*, Pa
  };

  double determinant(const State& state) const {
    return state.relative_density > 0 ? initial_density / state.relative_density : 1;
  }

  Moduli kirchhoff_moduli(double J) const {
    const double factor = std::pow(initial_density / J, density_exponent);
    return {factor * solid.bulk, factor * solid.shear};
  }

  static Tensor inverse_plastic(const State& state) {
    const Eigen::Map<const Symmetric> P(state.plastic_strain.data());
    return Tensor::Identity() - 2 * to_tensor(P);
  }

  // NaN where there is none.
  Trial trial(const PointStep& step, const State& state) const {
    const Tensor U = to_tensor(step.stretch);
    const auto [squares, axes] = principal(symmetric_part(U * inverse_plastic(state) * U));
    const Moduli now = kirchhoff_moduli(step.J);
    const Vector strain = 0.5 * squares.array().log();
    const double compaction = -strain.sum();
    const Vector deviator = 2 * now.shear * (strain.array() + compaction / 3);
    return {now, strain, axes, deviator, std::sqrt(1.5) * deviator.norm(), compaction, now.bulk * compaction};
  }

  // ---- The return ---------------------------------------------------------------------------------------------------

  // With x = Δγ/√(q² + β² p²): s = s*/(1 + 3G x), p = p*/(1 + K β² x), ε_v grows by x β² p. In z = 1/(1 + 3G x), w =
  // p/p* is z/(k + (1 − k) z), k = K β²/(3G), and ε_v grows by (1 − w) p*/K, all of them smooth from the whole return,
  // z = 0, to none, z = 1.
  struct Return {
    double deviatoric, mean;  // z, w
    double mean_slope;        // dw/dz
    double compaction;        // ε_v reached
    bool converged;
  };

  double flow_square() const { return 4.5 * (1 - 2 * plastic_poisson) / (1 + plastic_poisson); }  // β²
  double flow_ratio() const { return solid.bulk * flow_square() / (3 * solid.shear); }            // k: ν is constant

  Return place(const Trial& trial, double compaction, double z) const {
    const double k = flow_ratio(), divisor = k + (1 - k) * z;
    return {z, z / divisor, k / (divisor * divisor), compaction + (1 - z) * k / divisor * trial.compaction, false};
  }

  // The yield function times α⁻² and (p_c + p_t) α⁻¹, a polynomial: no root to be taken of what may be negative.
  struct Excess {
    double value, size;                 // Pa²; the sum of its parts without their signs
    double by_deviatoric;               // by z
    double by_compaction, by_pressure;  // by ε_v; by p
  };

  Excess excess(const Trial& trial, const Return& at, const Surface& y) const {
    const double q = at.deviatoric * trial.mises, p = at.mean * trial.pressure, p_c = y.hydrostatic;
    const double round = y.shape * q * q + p * p, offset = (1 - tension_ratio) * p_c * p,
                 product = tension_ratio * p_c * p_c;
    const double by_compaction =
        y.shape_slope * q * q - ((1 - tension_ratio) * p + 2 * tension_ratio * p_c) * y.hydrostatic_slope;
    const double by_pressure = 2 * p - (1 - tension_ratio) * p_c;
    const double by_mean = by_pressure * trial.pressure - by_compaction * trial.compaction;
    return {round - offset - product, std::abs(y.shape) * q * q + p * p + std::abs(offset) + product,
            2 * y.shape * q * trial.mises + by_mean * at.mean_slope, by_compaction, by_pressure};
  }

  static constexpr double epsilon = std::numeric_limits<double>::epsilon();
  static constexpr int most_iterations = 200;  // bisection alone takes 60

  Return flow(const Trial& trial, double compaction) const {
    const Surface y = surface(compaction);
    const double near = nearness(trial.mises, trial.pressure, y);
    if (near <= 1 + 16 * epsilon) return {1, 1, 0, compaction, y.exists()};
    return solve(trial, compaction, 1 / near);
  }

  // The excess is negative where all stress is returned and positive at the trial.
  Return solve(const Trial& trial, double compaction, double guess) const {
    double left = 0, right = 1, z = guess, last_step = 1;
    for (int i = 0; i < most_iterations; ++i) {
      Return at = place(trial, compaction, z);
      const Surface y = surface(at.compaction);
      const Excess f = excess(trial, at, y);
      const double round_off = 2 * epsilon * z;
      if (std::abs(f.value) <= 4 * epsilon * f.size || right - left <= round_off || last_step <= round_off) {
        at.converged = y.exists();
        return at;
      }
      (f.value > 0 ? right : left) = z;
      const double next = z - f.value / f.by_deviatoric;
      const double safe = next > left && next < right ? next : (left + right) / 2;
      last_step = std::abs(safe - z);
      z = safe;
    }
    return {1, 1, 0, compaction, false};
  }

  static Vector kirchhoff(const Trial& trial, const Return& found) {
    return (found.deviatoric * trial.deviator).array() - found.mean * trial.pressure;
  }

  // ---- What flow leaves ---------------------------------------------------------------------------------------------

  void store_flow(const PointStep& step, const Trial& trial, const Return& found, State& state) const {
    const double volume = -found.mean * trial.compaction / 3;
    const Vector strain = (found.deviatoric * trial.deviator / (2 * trial.moduli.shear)).array() + volume;
    const Tensor inverse = to_tensor(step.stretch).inverse();
    const Tensor left = to_tensor(from_principal((2 * strain).array().exp(), trial.axes));  // b_e
    const Symmetric plastic = 0.5 * (spherical(1) - symmetric_part(inverse * left * inverse));
    for (int c = 0; c < 6; ++c) state.plastic_strain[c] = plastic[c];
    state.compaction = found.compaction;
    state.equivalent_plastic_strain += equivalent_increment(trial, found);
  }

  // Δγ √(1 + β²/9): in uniaxial compression the axial plastic strain. Δγ = x √(q² + β² p²).
  double equivalent_increment(const Trial& trial, const Return& found) const {
    const double beta2 = flow_square(), q = found.deviatoric * trial.mises, p = found.mean * trial.pressure;
    const double x = (1 - found.deviatoric) / (3 * trial.moduli.shear * found.deviatoric);
    return x * std::sqrt((q * q + beta2 * p * p) * (1 + beta2 / 9));
  }

  // The step's work less what is stored more, so that the ledger of a step that flows closes: also by what a foam that
  // stores at a higher modulus gives up.
  double lost(const PointStep& step, const Symmetric& before, const State& old_state, const Symmetric& after,
              const State& state) const {
    const double old_J = determinant(old_state);
    const double stored_more = step.J * elastic_energy(after, state) - old_J * elastic_energy(before, old_state);
    return step_work(step, old_J, before, after) - stored_more;
  }

  // ---- The tangent --------------------------------------------------------------------------------------------------

  struct PrincipalTangent {
    Tensor by_strain;  // ∂τ_i/∂ε_j of the trial
    Vector by_volume;  // ∂τ_i/∂ln J at constant ε: D depends on it
  };
  PrincipalTangent principal_tangent(const Trial& trial, const Return& found) const;
};

static_assert(Law<PolymerFoam> && has_tangent<PolymerFoam>);

}  // namespace strut::materials
