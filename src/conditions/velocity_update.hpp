// One change of velocities by conditions: after forces have changed them, and before they carry the points on.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "conditions/impulse_work.hpp"
#include "conditions/reactions.hpp"
#include "mechanics/body.hpp"

namespace strut {

// How long a velocity carries each point on before forces change it again: the whole step, or 2^−level of it where the
// motion of the point is stepped more often.
struct PointTimeSteps {
  double whole;                                       // s
  const std::vector<std::uint8_t>* levels = nullptr;  // of owned points; none if null or empty
  double impulse = 1;  // the time that the impulse of forces stands for, the mean of two steps, as a part of the next

  int level(int i) const { return !levels || levels->empty() ? 0 : (*levels)[i]; }
  double of(int i) const { return level(i) == 0 ? whole : std::ldexp(whole, -level(i)); }
  double of_impulse(int i) const { return impulse * of(i); }
};

// What one condition after the other does to the velocities at the time t, and a record of it: reactions are summed up
// at once, work is added when all conditions have had their say.
struct VelocityUpdate {
  double t;  // s
  const PointTimeSteps& steps;
  Body& body;
  ReactionImpulses& impulses;

  // Of the condition whose turn it is.
  double Work::*ledger_entry = nullptr;
  int reaction_place = no_reaction;

  struct Impulse {
    int point;
    Vector half;  // N s
    double Work::*ledger_entry;
  };
  std::vector<Impulse> recorded = {};
  ImpulseWork of_tools = {};  // of what acts on tools with a mass: on rank 0

  // After the velocity of point i was changed.
  void record(int i, const Vector& change) {
    const Vector half_impulse = 0.5 * body.mass(i) * change;
    recorded.push_back({i, half_impulse, ledger_entry});
    impulses.add(reaction_place, 2 * half_impulse);
  }
};

// Adds the work of the impulses recorded, with the velocities that all conditions together leave.
void add_work(const VelocityUpdate& update, ImpulseWork& work);

}  // namespace strut
