// The work of external forces, by entries of the energy ledger, and the velocity between two steps that it needs.
#pragma once

#include <algorithm>

#include "base/math/tensors.hpp"

namespace strut {

// Central differences have velocities at mid-steps; this interpolates them to the time between two steps.
struct MidSteps {
  // Length of the step before the time over the sum of both steps: ½ for equal ones, 0 if there was no step before.
  double before = 0.5;

  // The velocity at the time, from those in the middle of the steps before and after it.
  Vector velocity(const Vector& v_before, const Vector& v_after) const {
    return (1 - before) * v_before + before * v_after;
  }

  // v² at the time, minus (½ Δt a)² with the longer of both steps: with ½ m times this, the energy of a linear body is
  // conserved to round-off over steps of this length. For equal steps it is v⁻·v⁺; at the start of a run, v².
  double conserved_square(const Vector& v, const Vector& v_after) const {
    if (before == 0) return v.squaredNorm();
    const Vector half_step = std::max(before, 1 - before) / (1 - before) * (v_after - v);
    return (v - half_step).dot(v + half_step);
  }
};

// Work on this rank's points, J.
struct Work {
  double external = 0;  // by loads and prescribed motion
  double tools = 0;     // by rigid tools, with their friction (negative: a plastic impact takes energy from them)
  double contact = 0;   // by friction between bodies

  Work operator*(double factor) const { return {factor * external, factor * tools, factor * contact}; }
  Work operator+(const Work& other) const {
    return {external + other.external, tools + other.tools, contact + other.contact};
  }
};

// The work of the impulses p at one time, p · ½(v⁻ + v⁺), which is exactly the change of the kinetic energy of central
// differences. The half ½ p · v⁻ belongs to the interval before that time, the half ½ p · v⁺ to the one after.
struct ImpulseWork {
  Work before, after;

  // The same between steps of different lengths: the longer step gets the work of its part of the impulse, the shorter
  // step the rest of the work, because the conserved kinetic energy is that of the longer step
  // (MidSteps::conserved_square). At the start of a run all work belongs to the step after.
  ImpulseWork split(const MidSteps& steps) const {
    const Work all = before + after;
    if (steps.before > 0 && steps.before < 0.5) {
      const Work last = after * (2 * (1 - steps.before));
      return {all + last * -1, last};
    }
    const Work first = before * (2 * steps.before);
    return {first, all + first * -1};
  }
};

}  // namespace strut
