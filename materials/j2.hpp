// J2 plasticity with associated flow, isotropic hardening and rate dependence; hypoelastic below the flow stress.
//   ė_p = (3/2) ε̇ s/σ̄,  √(3/2 s:s) ≤ σ̄(ε̄, ε̇)     (Postek, Nowak & Pęcherski 2021, eqs. 18–20)
// Method: implicit radial return (radial_return.hpp). Units: Pa, 1/s, s.
#pragma once

#include <array>
#include <string_view>

#include "base/math/tensors.hpp"
#include "materials/elastic.hpp"
#include "materials/flow_stress.hpp"
#include "materials/law.hpp"
#include "materials/radial_return.hpp"

namespace strut::materials {

struct J2 {
  double bulk = 0, shear = 0;  // Pa
  FlowStress flow;

  template <class T>
  using StateOf = PlasticState<T>;
  using State = StateOf<double>;
  static constexpr std::array<std::string_view, 3> state_names{
      "Equivalent_Plastic_Strain", "Equivalent_Plastic_Strain_Rate", "Plastic_Work_Density"};

  template <class T>
  StressOf<T> step(const StepOf<T>& step, const SymmetricOf<T>& stress, PlasticState<T>& state) const {
    return RadialReturn<T, FlowStress>(flow, bulk, same<T>(shear)).step(step, stress, state);
  }

  Moduli moduli() const { return {bulk, shear}; }
  double elastic_energy(const Symmetric& stress, const State&) const {
    return Elastic{bulk, shear}.elastic_energy(stress);
  }
  double plastic_strain(const State& state) const { return state.equivalent_plastic_strain; }
  bool has_flowed(const State& state) const { return state.equivalent_plastic_strain > 0; }
  double dissipation(const State& state) const { return state.plastic_work; }
  double flow_stress(const State& state) const {
    return flow(state.equivalent_plastic_strain, state.plastic_strain_rate).stress;
  }
};

static_assert(Law<J2> && takes_lanes<J2>);

}  // namespace strut::materials
