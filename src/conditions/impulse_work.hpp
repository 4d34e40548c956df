// The work of what acts from outside, as the energy ledger keeps it.
#pragma once

#include "conditions/mid_steps.hpp"

namespace strut {

// J done on this rank's points.
struct Work {
  double external = 0;  // by loads and prescribed motion
  double tools = 0;     // by rigid tools, their friction included (negative: what a plastic impact takes)
  double contact = 0;   // by friction between bodies

  Work operator*(double factor) const { return {factor * external, factor * tools, factor * contact}; }
  Work operator+(const Work& other) const {
    return {external + other.external, tools + other.tools, contact + other.contact};
  }
};

// The work of the impulses p at one time, p · ½(v⁻ + v⁺): exactly what the kinetic energy of central differences gains.
// One half, ½ p · v⁻, belongs to the interval before that time, the other, ½ p · v⁺, to the one after.
struct ImpulseWork {
  Work before, after;

  // The same between steps of two lengths: each has its part of the impulse. What this leaves of the work belongs to
  // the side of the shorter step, as the kinetic energy is that of the longer one; where a run begins, all is after.
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
