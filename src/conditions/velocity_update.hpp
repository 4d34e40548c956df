// One change of velocities by conditions: after forces have changed them, and before they move the points.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/math/function.hpp"
#include "conditions/impulse_work.hpp"
#include "conditions/reactions.hpp"
#include "mechanics/body.hpp"

namespace strut {

// The time for which a velocity moves each point before forces change it again: the whole step, or 2^−level of it for
// points that are stepped more often.
struct PointTimeSteps {
  double whole;                                       // s
  const std::vector<std::uint8_t>* levels = nullptr;  // of owned points; none if null or empty
  double impulse = 1;         // time of the impulse of forces, the mean of two steps, over the next step
  bool none_follows = false;  // at the final time

  int level(int i) const { return !levels || levels->empty() ? 0 : (*levels)[i]; }
  double of(int i) const { return whole / (1 << level(i)); }
  double of_impulse(int i) const { return impulse * of(i); }
  // The value at a time; at the final time it need not be a number later.
  double value(const Function& motion, const Vector& X, double time) const {
    return none_follows ? motion.evaluate(X, time) : motion(X, time);
  }
  // The value at t + dt (s) of the motion value(t). At the final time a motion that ends then, such as a table at its
  // last row or where its value is no number any more, goes on at its last velocity: else the output would contain
  // velocities of the stop. So does one that turns then, as the sum of a table that ends and another motion does.
  template <class Motion>
  double after(const Motion& value, double t, double dt) const {
    const double next = value(t + dt);
    const bool ends = none_follows && (!std::isfinite(next) || next == value(t + 2 * dt) || turns(value, t, dt));
    return ends ? 2 * value(t) - value(t - dt) : next;
  }
  // The velocity over dt (s) from t of a motion that has the velocity `value` at a time. At the final time one that
  // ends there goes on as before, too, also where its value has jumped by then.
  template <class Velocity>
  double velocity_after(const Velocity& value, double t, double dt) const {
    const double next = value(t + 0.5 * dt);
    const bool ends =
        none_follows && (!std::isfinite(next) || next == value(t + 1.5 * dt) || turns(value, t - 0.5 * dt, dt));
    if (!ends) return next;
    const double now = value(t), before = value(t - 0.5 * dt);
    const bool goes_on = std::abs(now - before) <= 2 * std::abs(before - value(t - dt));
    return goes_on ? 2 * now - before : before;
  }
  // True if the slope of a value changes far more at t than over the two steps before.
  template <class Value>
  static bool turns(const Value& value, double t, double dt) {
    const auto bend = [&](double at) { return std::abs(value(at + dt) - 2 * value(at) + value(at - dt)); };
    return bend(t) > 2 * (bend(t - dt) + bend(t - 2 * dt));
  }
};

// The changes of velocities by all conditions at the time t, and a record of them: reactions are added up at once, work
// is added when all conditions have acted.
struct VelocityUpdate {
  double t;  // s
  const PointTimeSteps& steps;
  Body& body;
  ReactionImpulses& impulses;

  // The condition that is acting now.
  double Work::*ledger_entry = nullptr;
  int reaction_index = no_reaction;

  struct Impulse {
    int point;
    Vector half;  // N s
    double Work::*ledger_entry;
  };
  std::vector<Impulse> recorded = {};
  ImpulseWork of_tools = {};  // work on tools with a mass, on rank 0
  // Bit c of a point: its velocity along c is prescribed. Empty unless a tool has friction.
  std::vector<std::uint8_t> held = {};

  // Call it after the velocity of point i has changed.
  void record(int i, const Vector& change) {
    const Vector half_impulse = 0.5 * body.mass(i) * change;
    recorded.push_back({i, half_impulse, ledger_entry});
    impulses.add(reaction_index, 2 * half_impulse);
  }
};

// Adds the work of the recorded impulses, with the velocities after all conditions.
inline void add_work(const VelocityUpdate& update, ImpulseWork& work) {
  for (const auto& [i, half_impulse, entry] : update.recorded) {
    work.before.*entry += half_impulse.dot(update.body.previous_velocity[i]);
    work.after.*entry += half_impulse.dot(update.body.velocity[i]);
  }
  work.before = work.before + update.of_tools.before;
  work.after = work.after + update.of_tools.after;
}

}  // namespace strut
