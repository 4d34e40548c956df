// Criteria for the onset of failure of a metal: they grow with the plastic strain and are met at 1,
//   D = ∫ growth(σ, ε̇, T) dε̄.
// Each is a plain struct whose growth is written for one point or for several, one per SIMD lane. To add one: a struct
// here, and its name in the variant. Units: Pa, 1/s, K, strain -.
#pragma once

#include <algorithm>
#include <cmath>
#include <variant>

#include "base/math/tensors.hpp"
#include "materials/side_by_side.hpp"

namespace strut::materials {

// D = ε̄/ε_f
struct FailureStrain {
  double strain = 1;  // ε_f
  template <class T>
  T growth(const SymmetricOf<T>&, const T&, const T&) const {
    return same<T>(1 / strain);
  }
};

// D = ∫ dε̄/ε_f,  ε_f = (D1 + D2 exp(D3 σ*)) (1 + D4 ln max(ε̇/ε̇₀, 1)) (1 + D5 T*),  T* = (T − T_r)/(T_m − T_r) ≥ 0
//     (Johnson & Cook 1985), σ* = mean/von Mises stress, limited to ±1.5; no metal fails near −1.5.
struct JohnsonCookFailure {
  double constants[5] = {1, 0, 0, 0, 0};        // D1 … D5
  double reference_rate = 1;                    // ε̇₀, 1/s
  double reference = 0, melting = 1;            // T_r, T_m, K
  static constexpr double most = 1.5;           // limit of |σ*|
  static constexpr double least_strain = 1e-6;  // lower limit where the fit gives less

  template <class T>
  T growth(const SymmetricOf<T>& stress, const T& rate, const T& temperature) const {
    const SymmetricOf<T> s = deviator(stress);
    const T mean = trace(stress) / 3, mises = sqrt(T(1.5 * double_dot(s, s)));
    const T bound = most * mises, within = mean < bound ? mean : bound;
    const T triaxiality = within > -bound ? T(within / mises) : mean < 0 ? same<T>(-most) : same<T>(most);
    const T slow = constants[0] + constants[1] * exp(T(constants[2] * triaxiality));
    const T relative = rate / reference_rate, log_rate = log(relative < 1 ? same<T>(1) : relative);
    const T relative_heat = (temperature - reference) / (melting - reference);
    const T warm = 1 + constants[4] * (relative_heat > 0 ? relative_heat : T{});
    const T strain = slow * (1 + constants[3] * log_rate) * warm;
    return 1 / (strain >= least_strain ? strain : same<T>(least_strain));
  }
};

// D = ∫ max(σ₁, 0) dε̄ / W_c,  σ₁ the largest principal stress     (Cockcroft & Latham 1968)
struct CockcroftLatham {
  double work = 1;  // W_c, Pa
  double growth(const Symmetric& stress, double, double = 0) const {
    return std::max(0.0, largest_principal(stress)) / work;
  }
  RawLanes growth(const SymmetricOf<RawLanes>& stress, const RawLanes& rate, const RawLanes&) const {
    RawLanes result{};
    for (int l = 0; l < small::lane_count; ++l) {
      Symmetric of_one;
      for (int c = 0; c < 6; ++c) of_one[c] = stress[c][l];
      result[l] = growth(of_one, rate[l]);
    }
    return result;
  }

  // From the invariants of the deviator: σ_m + ⅔ σ̄ cos θ with cos 3θ = 27/2 det s/σ̄³.
  static double largest_principal(const Symmetric& stress) {
    const Symmetric s = deviator(stress);
    const double q = std::sqrt(1.5 * double_dot(s, s)), mean = trace(stress) / 3;
    if (!(q > 0)) return mean;
    const double cosine = std::clamp(13.5 * to_tensor(s).determinant() / (q * q * q), -1.0, 1.0);
    return mean + 2 * q / 3 * std::cos(std::acos(cosine) / 3);
  }
};

using FailureCriterion = std::variant<FailureStrain, JohnsonCookFailure, CockcroftLatham>;

// The failure of a metal: its criterion and its fracture energy.
struct Ductility {
  FailureCriterion criterion;
  double fracture_energy = 0;   // G_c, J/m²: dissipation per area of crack from then on; 0: it fails at once
  double averaging_radius = 0;  // of the ball over which the growth of the criterion is averaged, m; 0: no average
};

}  // namespace strut::materials
