// Compressible neo-Hookean elasticity, a law by the stretch, for rubbers:
//   W = ½ μ (tr B − 3 − 2 ln J) + ½ λ (ln J)²,  σ = (μ/J) (B − I) + (λ/J) ln J I,  λ = K − 2μ/3
// per volume of the reference state. B = F Fᵀ is U² in the unrotated frame. K and μ are those of small strains.
// Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis: compressible neo-Hookean material. Units:
// Pa.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "base/math/tensors.hpp"
#include "materials/law.hpp"

namespace strut::materials {

struct NeoHookean {
  double bulk = 0, shear = 0;  // Pa

  struct State {
    double logarithmic_volume = 0;  // ln J
    double stored_energy = 0;       // J per m³ of current volume
  };
  static constexpr std::array<std::string_view, 2> state_names{"Logarithmic_Volume", "Stored_Energy_Density"};

  double lame() const { return bulk - 2 * shear / 3; }

  // Uses E = U − I: in tr B − 3 − 2 ln J small strains would be lost in the round-off of numbers near 1. For the same
  // reason J is computed from U and not taken from the step.
  PointStress step(const PointStep& step, const Symmetric&, State& state) const {
    const Symmetric E = step.stretch - spherical(1);
    const Symmetric E_squared = symmetric_part(to_tensor(E) * to_tensor(E));
    const double first = trace(E), second = 0.5 * (first * first - trace(E_squared));
    const double growth = first + second + to_tensor(E).determinant();  // J − 1
    const double J = 1 + growth, log_J = std::log1p(growth);            // NaN where J < 0
    const Symmetric stress = (shear * (2 * E + E_squared) + spherical(lame() * log_J)) / J;
    const double energy = 0.5 * shear * (trace(E_squared) + 2 * (first - log_J)) + 0.5 * lame() * log_J * log_J;
    if (!stress.allFinite() || !std::isfinite(energy / J)) return {stress, false};
    state = {log_J, std::max(0.0, energy / J)};  // below 0 by round-off only
    return {stress, true};
  }

  Moduli moduli() const { return {bulk, shear}; }

  // Moduli of the spatial elasticity tensor (λ/J) I⊗I + (2/J) (μ − λ ln J) 1. The reduction of μ in expansion is left
  // out: the stress adds to the stiffness there.
  Moduli moduli(const State& state) const {
    const double J = std::exp(state.logarithmic_volume);
    const double now = std::max(shear, shear - lame() * state.logarithmic_volume) / J;
    return {lame() / J + 2 * now / 3, now};
  }

  double elastic_energy(const Symmetric&, const State& state) const { return state.stored_energy; }
  double dissipation(const State&) const { return 0; }
  double flow_stress(const State&) const { return std::numeric_limits<double>::infinity(); }
};

static_assert(Law<NeoHookean>);

}  // namespace strut::materials
