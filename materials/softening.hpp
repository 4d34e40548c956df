// Functions of laws with damage: it reduces the deviator and the tension of the stress, and keeps the pressure.
#pragma once

#include <algorithm>

#include "materials/law.hpp"

namespace strut::materials {

// Multiplies the deviator and the tension by x.
inline Symmetric scaled(const Symmetric& stress, double x) {
  const double mean = trace(stress) / 3;
  return x * deviator(stress) + spherical(mean > 0 ? x * mean : mean);
}

// The part of a stress that damage reduces.
inline Symmetric falling(const Symmetric& stress) { return trace(stress) > 0 ? stress : Symmetric(deviator(stress)); }

// Elastic energy, J/m³, of a stress whose deviator and tension have fallen to x of their values. whole(stress): that of
// the undamaged solid with this bulk modulus.
template <class Whole>
double energy_of_softened(const Symmetric& stress, double x, double bulk, const Whole& whole) {
  const double pressed = std::min(trace(stress) / 3, 0.0);
  return pressed * pressed / (2 * bulk) + whole(falling(stress)) / x;
}

// Computes the chosen lanes of a step by law.soften, which steps one point. Not inline: it is rare, and laws are
// inlined everywhere.
template <class L, class Lanes>
__attribute__((noinline)) void soften_lanes(const L& law, const MaskOf<RawLanes>& chosen, const StepOf<RawLanes>& step,
                                            const SymmetricOf<RawLanes>& stress, const Lanes& state, Lanes& next,
                                            StressOf<RawLanes>& result) {
  for (int l = 0; l < small::lane_count; ++l) {
    if (!chosen[l]) continue;
    PointStep of_one{{}, step.dt[l], step.J[l], {}, step.viscous_work[l]};
    Symmetric old;
    for (int c = 0; c < 6; ++c) of_one.rate[c] = step.rate[c][l], of_one.stretch[c] = step.stretch[c][l];
    for (int c = 0; c < 6; ++c) old[c] = stress[c][l];
    auto one = lane_of<typename L::State>(state, l);
    const auto [reached, converged] = law.soften(of_one, old, one);
    set_lane(next, l, one);
    for (int c = 0; c < 6; ++c) result.stress[c][l] = reached[c];
    result.converged[l] = converged ? -1 : 0;
  }
}

}  // namespace strut::materials
