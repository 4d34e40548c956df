// The interface of a constitutive law: one pure step of one material point in the unrotated frame.
//
// A law is a plain struct of parameters. It sees no bonds, halos, files or decks.
//
// clang-format off
//   step              takes a step of length dt (s), the old unrotated Cauchy stress (Pa) and its own State, which it
//                     updates; returns the new unrotated Cauchy stress. A law of the first form uses the unrotated
//                     rate of deformation d = Rᵀ D R, one of the second form the stretch at the end. A step is inline,
//                     so that unused inputs are not computed, unless it costs far more than a call.
//   State             a struct of doubles only; State{} is the state of an undeformed point.
//   state_names       the names of the members of State in their order, as in output.
//   virgin_state      optional: the state of an undeformed point for output, if it is not State{}.
//   moduli            the elastic moduli of the Cauchy stress, which bound the critical time step; with the state as
//                     an argument if they change.
//   elastic_energy    stored energy, J per m³ of current volume.
//   dissipation       energy dissipated so far, J per m³ of reference volume.
//   flow_stress       the equivalent stress at which the point yields, Pa; infinity if it never yields.
//   plastic_strain    optional, for laws with plastic work: its rate times flow_stress is the power of that work.
//   has_flowed        optional, for laws whose plastic flow conserves volume, or that soften: true if the point ever
//                     flowed or softened. The integration points of its cell then get their mean change of volume
//                     (volumetric locking: src/mechanics/formulation/quadratic.md).
//   follows_stretch   optional, true for laws of the second form whose stress is the derivative of an energy of the
//                     stretch. Cells whose integration points share their volume give these the stretch of their mean
//                     volume (src/mechanics/formulation/shared_volume.hpp).
//   part_left         optional, for laws that soften as they fail: fraction, 1 to 0, of its stress that a point still
//                     carries, with the state as an argument. It also scales the stabilization.
//   set_crack_length  optional: sets the length over which a crack smears its opening, m.
//   move_stress       optional, for laws of the second form with a history: changes the state so that the stress stays
//                     where the stretch jumps without motion, for instance because bonds of the point broke; the next
//                     step continues from that stress. Without it the stress would follow the jump.
//   crack_work        optional, for laws whose dissipation opens cracks: the part of dissipation that counts as energy of
//                     fracture, J per m³ of reference volume; with set_crack, which sets their strength, Pa, and the
//                     width over which a crack dissipates its energy, m.
//   stored_energy     optional, for laws that count their elastic energy: J per m³ of reference volume.
//   heat              optional, for laws with a temperature: ρ c_p (T − T₀), J per m³ of reference volume.
//   set_initial_temperature  optional, with heat: K.
//   why_no_stress     optional: a message for users with the reason why a step has not converged.
//   shows             optional: false for the index of a state variable that output does not have.
//   StateOf<T>        optional, SIMD: a law may process several points at once, one per lane. Its step and StateOf<T>
//                     are then templates over the scalar, double or RawLanes, State is StateOf<double>. All lanes are
//                     computed; results of lanes where J is not positive are discarded.
//   tangent           optional: ∂σ_c/∂U_d at the end of a step from the old stress and state; U_d changes together
//                     with its mirror image, and J with it (J = det U). NaN if the step does not converge. For laws
//                     without one, tangent_of (tangent.hpp) uses differences.
// clang-format on
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <string_view>

#include "materials/side_by_side.hpp"

namespace strut::materials {

template <class T>
struct StepOf {
  SymmetricOf<T> rate;     // unrotated rate of deformation at mid-step, 1/s
  T dt;                    // s
  T J;                     // det F at the end of the step
  SymmetricOf<T> stretch;  // U at the end of the step; F = U in the unrotated frame
  T viscous_work{};  // of the artificial viscosity in this step, J per m³ of reference volume: it heats the point
};

template <class T>
struct StressOf {
  SymmetricOf<T> stress;  // unrotated Cauchy stress at the end of the step, Pa
  MaskOf<T> converged;    // false: the law could not find a stress, which the caller must report
};

using PointStep = StepOf<double>;
using PointStress = StressOf<double>;

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
  { law.flow_stress(committed) } -> std::same_as<double>;             // Pa
  { L::state_names.size() } -> std::convertible_to<std::size_t>;
};

// True if a law can process several points at once, one per SIMD lane.
template <class L>
inline constexpr bool takes_lanes = requires(const L law, const StepOf<RawLanes>& step,
                                             const SymmetricOf<RawLanes>& stress,
                                             typename L::template StateOf<RawLanes>& state) {
  { law.step(step, stress, state) } -> std::same_as<StressOf<RawLanes>>;
};

// True if a law's moduli depend on its state.
template <class L>
inline constexpr bool has_changing_moduli = requires(const L law, const typename L::State& state) {
  law.moduli(state);
};

// True if a law has plastic_strain().
template <class L>
inline constexpr bool tells_plastic_strain = requires(const L law, const typename L::State& state) {
  { law.plastic_strain(state) } -> std::same_as<double>;
};

// True if a law has has_flowed().
template <class L>
inline constexpr bool tells_flow = requires(const L law, const typename L::State& state) {
  { law.has_flowed(state) } -> std::same_as<bool>;
};

template <class L>
inline constexpr bool follows_stretch = requires {
  requires L::follows_stretch;
};

// True if the law defines part_left(), the fraction of stress that a softening point still carries.
template <class L>
inline constexpr bool softens = requires(const L law, const typename L::State& state) {
  { law.part_left(state) } -> std::same_as<double>;
};

template <class L>
inline constexpr bool takes_crack_length = requires(L law, double length) {
  law.set_crack_length(length);
};

// True if dissipation of the law counts as energy of fracture.
template <class L>
inline constexpr bool opens_cracks = requires(L law, const typename L::State& state) {
  law.set_crack(1.0, 1.0);
  { law.crack_work(state) } -> std::same_as<double>;
};

// True if a law has a temperature.
template <class L>
inline constexpr bool tells_heat = requires(const L law, const typename L::State& state) {
  { law.heat(state) } -> std::same_as<double>;
};

template <class L>
Moduli moduli_of(const L& law, const typename L::State& state) {
  if constexpr (has_changing_moduli<L>) {
    return law.moduli(state);
  } else {
    return law.moduli();
  }
}

// Elastic energy, J per m³ of reference volume; J: det F of the point.
template <class L>
double stored_energy_of(const L& law, const Symmetric& stress, const typename L::State& state, double J) {
  if constexpr (requires { law.stored_energy(state); }) {
    return law.stored_energy(state);
  } else {
    return J * law.elastic_energy(stress, state);
  }
}

// The state of an undeformed point as output shows it.
template <class L>
typename L::State virgin_state_of(const L& law) {
  if constexpr (requires { law.virgin_state(); }) {
    return law.virgin_state();
  } else {
    return {};
  }
}

// ∂σ_c/∂U_d, rows and columns xx yy zz xy yz zx, Pa.
using StretchTangent = Eigen::Matrix<double, 6, 6>;

// True if a law has a tangent of its own.
template <class L>
inline constexpr bool has_tangent = requires(const L law, const PointStep& step, const Symmetric& stress,
                                             const typename L::State& state) {
  { law.tangent(step, stress, state) } -> std::same_as<StretchTangent>;
};

// The names in a text, separated by blanks.
template <std::size_t count>
consteval std::array<std::string_view, count> words(std::string_view text) {
  std::array<std::string_view, count> names;
  for (std::string_view& name : names) {
    name = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(name.size() + 1, text.size()));
  }
  if (!text.empty() || names[count - 1].empty()) throw "another number of names";
  return names;
}

// The number of doubles in a law's State.
template <class L>
inline constexpr std::size_t state_size = L::state_names.size();

// State as it is stored: one double per column. An empty State has no columns.
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
