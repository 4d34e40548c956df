// A brittle elastic solid: where its largest principal stress reaches a strength, its stress in tension falls until the
// point has dissipated G_c over the width of a crack (crack band: Bažant & Oh 1983).
//   σ = x dev σ̃ + (x if σ̃_m > 0, else 1) σ̃_m I,   σ̃ the stress of the undamaged solid,   d = 1 − x
//   x σ̃₁ ≤ σ_c (1 − w),   dw = ℓ/G_c Y dd,   Y = dev σ̃ : dev σ̃/(4G) + ⟨σ̃_m⟩²/(2K)
// In uniaxial tension the stress falls linearly with the strain. A thousandth of the stiffness stays and holds the
// cells beside a crack in place until the bonds across it break. Units: Pa, s.
#pragma once

#include <array>
#include <limits>
#include <string_view>
#include <type_traits>

#include "materials/elastic.hpp"
#include "materials/softening.hpp"

namespace strut::materials {

struct Brittle {
  Elastic solid;
  double fracture_energy = 0;                                 // G_c, J/m²
  double strength = std::numeric_limits<double>::infinity();  // σ_c, Pa; infinite: d stays
  double width = 1;                                           // ℓ, m

  template <class T>
  struct StateOf {
    T damage{};      // d
    T dissipated{};  // J per m³ of reference volume
  };
  using State = StateOf<double>;
  static constexpr std::array<std::string_view, 2> state_names{"Brittle_Damage", "Crack_Work"};

  template <class T>
  StressOf<T> step(const StepOf<T>& step, const SymmetricOf<T>& stress, StateOf<T>& state) const {
    Elastic::StateOf<T> nothing;
    StressOf<T> result = solid.step(step, stress, nothing);
    const MaskOf<T> cracks = state.damage > 0 || may_crack<T>(result.stress);
    if constexpr (std::is_same_v<T, double>) {
      return cracks ? soften(step, stress, state) : result;
    } else {
      if (any(cracks)) [[unlikely]] {
        const StateOf<T> before = state;
        soften_lanes(*this, cracks, step, stress, before, state, result);
      }
      return result;
    }
  }

  // The step of a point that cracks.
  PointStress soften(const PointStep& step, const Symmetric& stress, State& state) const;

  Moduli moduli() const { return solid.moduli(); }
  double elastic_energy(const Symmetric& stress, const State& state) const {
    const auto whole = [this](const Symmetric& part) { return solid.elastic_energy(part); };
    return energy_of_softened(stress, 1 - state.damage, solid.bulk, whole);
  }
  double dissipation(const State& state) const { return state.dissipated; }
  double crack_work(const State& state) const { return state.dissipated; }
  void set_crack(double to_strength, double to_width) { strength = to_strength, width = to_width; }
  double flow_stress(const State&) const { return std::numeric_limits<double>::infinity(); }
  // A softening cell counts as flowed, so that its integration points open alike: the crack is narrower than the cell.
  bool has_flowed(const State& state) const { return state.damage > 0; }

 private:
  // True if an upper bound of the largest principal stress, mean + ⅔ von Mises, is above the strength.
  template <class T>
  MaskOf<T> may_crack(const SymmetricOf<T>& stress) const {
    const SymmetricOf<T> s = deviator(stress);
    const T margin = strength - trace(stress) / 3;
    return margin < 0 || 2.0 / 3 * double_dot(s, s) > margin * margin;
  }
};

static_assert(Law<Brittle> && takes_lanes<Brittle>);

}  // namespace strut::materials
