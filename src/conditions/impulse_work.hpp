// The work of what acts from outside, as the energy ledger keeps it.
#pragma once

namespace strut {

// J done on this rank's points.
struct Work {
  double external = 0;  // by loads and prescribed motion
  double contact = 0;   // by tools and friction (negative: what a plastic impact takes)

  Work operator+(const Work& other) const { return {external + other.external, contact + other.contact}; }
};

// The work of the impulses p at one time, p · ½(v⁻ + v⁺): exactly what the kinetic energy of central differences gains.
// One half, ½ p · v⁻, belongs to the interval before that time, the other, ½ p · v⁺, to the one after.
struct ImpulseWork {
  Work before, after;
};

}  // namespace strut
