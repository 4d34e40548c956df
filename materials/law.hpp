// The contract of a constitutive law: one pure step of one material point in the unrotated frame.
//
// A law is a plain struct of parameters. It sees no bonds, halos, files or decks.
//   step      takes the unrotated rate of deformation d = Rᵀ D R over a step of length dt, the old unrotated Cauchy
//             stress (Pa) and its own State, which it updates; it returns the new unrotated Cauchy stress.
//   State     a struct of doubles only; state_names names them in order, as they appear in output.
//   moduli    the elastic moduli that bound the stable step; of the state, where they change with it.
//   energies  elastic_energy and dissipation feed the ledger of a run.
//   flow_stress  what the equivalent stress equals while the point yields; infinity where it never yields.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <string_view>

#include "base/tensors.hpp"

namespace strut::materials {

struct PointStep {
  Symmetric rate;  // unrotated rate of deformation at mid-step, 1/s
  double dt;       // s
  double J;        // det F at the end of the step
};

struct PointStress {
  Symmetric stress;  // unrotated Cauchy stress at the end of the step, Pa
  bool converged;    // false: the law could not find a stress; the caller must not go on silently
};

struct Moduli {
  double bulk;   // Pa
  double shear;  // Pa
  double longitudinal() const { return bulk + 4 * shear / 3; }
};

template <class L>
concept Law = std::copyable<L> && std::default_initializable<typename L::State> &&
    std::is_trivially_copyable_v<typename L::State> &&
    requires(const L law, const PointStep& step, const Symmetric& stress, typename L::State& state,
             const typename L::State& committed) {
  { law.step(step, stress, state) } -> std::same_as<PointStress>;
  { law.moduli() } -> std::same_as<Moduli>;
  { law.elastic_energy(stress, committed) } -> std::same_as<double>;  // J per m³ of current volume
  { law.dissipation(committed) } -> std::same_as<double>;             // J per m³ of reference volume, so far
  { law.equivalent_stress(stress) } -> std::same_as<double>;          // Pa
  { law.flow_stress(committed) } -> std::same_as<double>;             // Pa
  { L::state_names.size() } -> std::convertible_to<std::size_t>;
};

// Whether a law's moduli change with its state.
template <class L>
inline constexpr bool has_changing_moduli = requires(const L law, const typename L::State& state) {
  law.moduli(state);
};

template <class L>
Moduli moduli_of(const L& law, const typename L::State& state) {
  if constexpr (has_changing_moduli<L>) {
    return law.moduli(state);
  } else {
    return law.moduli();
  }
}

// The number of doubles in a law's State.
template <class L>
inline constexpr std::size_t state_size = L::state_names.size();

// State as the machine stores it: one double a column. An empty State has no columns.
template <class L>
std::array<double, state_size<L>> to_columns(const typename L::State& state) {
  if constexpr (state_size<L> == 0) {
    return {};
  } else {
    static_assert(sizeof(typename L::State) == state_size<L> * sizeof(double));
    return std::bit_cast<std::array<double, state_size<L>>>(state);
  }
}

template <class L>
typename L::State from_columns(const std::array<double, state_size<L>>& columns) {
  if constexpr (state_size<L> == 0) {
    return {};
  } else {
    return std::bit_cast<typename L::State>(columns);
  }
}

}  // namespace strut::materials
