// The work of what acts from outside, as the energy ledger keeps it.
#pragma once

namespace strut {

// J done on this rank's points.
struct Work {
  double external = 0;  // by loads and prescribed motion
  double tools = 0;     // by rigid tools, their friction included (negative: what a plastic impact takes)
  double contact = 0;   // by friction between bodies

  Work operator+(const Work& other) const {
    return {external + other.external, tools + other.tools, contact + other.contact};
  }
};

// The work of the impulses p at one time, p · ½(v⁻ + v⁺): exactly what the kinetic energy of central differences gains.
// One half, ½ p · v⁻, belongs to the interval before that time, the other, ½ p · v⁺, to the one after.
struct ImpulseWork {
  Work before, after;
};

}  // namespace strut
