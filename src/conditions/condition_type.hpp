// The interface of a condition. The compiler checks it (condition.hpp), so that no condition is forgotten in whole
// steps, substeps, equilibria, the ledger or reactions.
//
// Every condition defines
//   stage           when it acts in a step, relative to other conditions
//   ledger_entry    the entry of the energy ledger that gets its work
//   reaction_index  member: index of the condition in the deck, which identifies its reaction; without a reaction a
//                   static constant, no_reaction
//   in_equilibria   how it acts in a load step without inertia
// and, depending on these, the members in the concepts below. How to add one: CONTRIBUTING.md.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "base/math/function.hpp"
#include "base/math/tensors.hpp"
#include "conditions/impulse_work.hpp"
#include "conditions/reactions.hpp"

namespace strut {

// Declared only: a deck reads the types of conditions without the body that they act on.
struct Body;
struct VelocityUpdate;

// The order in which conditions act; those of one stage act in the order of the deck. `forces` change force densities.
// The other stages change velocities, after all forces: `drags` resist them, `motions` prescribe them, `planes` and
// `tools` limit them. A stage may undo earlier ones, so a point that a motion carries against a tool does not enter
// it.
enum class Stage { forces, drags, motions, planes, tools };

// `load`: its forces act as in a step; `hold`: points have given positions along some directions; `tool`: unilateral
// contact with friction, for rigid tools only; `impossible`: it has no meaning in equilibria, which is an error.
enum class InEquilibria { load, hold, tool, impossible };

// The points that move in substeps of dt/2^level.
struct MovingPoints {
  const std::vector<std::uint8_t>& levels;  // of owned points: the time-step levels of their motion
  int level;

  bool include(int i) const { return levels[i] >= level; }
  std::vector<int> among(std::vector<int> points) const {
    std::erase_if(points, [this](int i) { return !include(i); });
    return points;
  }
};

// In a load step, the position y of the point must reach y · direction = target.
struct HeldDirection {
  int reaction_index, point;
  Vector direction;  // of unit length
  double target;     // m
};

template <class T>
concept HasRoles = requires(const T& condition) {
  requires std::same_as<decltype(T::stage), const Stage>;
  requires std::same_as<decltype(T::ledger_entry), double Work::*const>;
  { condition.reaction_index } -> std::convertible_to<int>;
  requires std::same_as<decltype(T::in_equilibria), const InEquilibria>;
};

template <class T>
concept Reacts = std::is_member_object_pointer_v<decltype(&T::reaction_index)>;

// A deck makes a prototype: the condition without its points. Set-up completes it.
//   values_at_points  the functions of the deck that it evaluates, at its points or of the time alone: set-up has
//                     checked that they are finite at the initial time; solvers check later (first_not_finite)
//   on                the condition on these points, with this index in the deck
template <class T>
concept IsPrototype = requires(const T& prototype, std::vector<int> points, int index, const Body& body) {
  { prototype.values_at_points() } -> std::same_as<std::vector<Function>>;
  { prototype.on(points, index, body) } -> std::same_as<T>;
};

// Stage::forces. With substeps, add_forces and add_work may be called at several times of a step, for the mean. The
// estimate of the critical time step does not include these forces: if they are stiff, the deck needs a smaller Safety
// Factor.
//   add_forces  adds `part` of its force density at time t
//   add_work    adds the work of these forces, once velocities are final; impulse_time is the time for which they act
//   on_some     its part for some of its points
//   points      member: owned points
template <class T>
concept AddsForces = requires(const T& condition, double t, double part, double impulse_time, Body& body,
                              const Body& after, ImpulseWork& work, const MovingPoints& some) {
  { condition.add_forces(t, part, body) } -> std::same_as<void>;
  { condition.add_work(t, impulse_time, after, work) } -> std::same_as<void>;
  { condition.on_some(some) } -> std::same_as<T>;
  { condition.points } -> std::convertible_to<const std::vector<int>&>;
};

// If acts_at_start: for the initial velocities, and for the check for undeclared contact (setup), which predicts the
// motion.
//   predict_velocities  writes the velocities that it imposes at time t into `velocities`; if it imposes positions,
//                       their slope at t, by their values up to t + moment (s)
template <class T>
concept PredictsVelocities = requires(const T& condition, double t, double moment, const Body& body,
                                      std::vector<Vector>& velocities) {
  { condition.predict_velocities(t, moment, body, velocities) } -> std::same_as<void>;
};

// All other stages.
//   change_velocities  changes the velocities after the forces at update.t to those that the condition allows, and
//                      records each change. update.steps.of(i) is the time for which the velocity then moves point i:
//                      the next step, or the point's own substep; of_impulse(i) is the time for which forces have
//                      acted
//   in_substeps        its part for the points that move between whole steps; nullopt: it does not act there
//   acts_at_start      true if it changes initial velocities, too
template <class T>
concept ChangesVelocities = requires(T& condition, VelocityUpdate& update, const MovingPoints& moving) {
  { condition.change_velocities(update) } -> std::same_as<void>;
  { condition.in_substeps(moving) } -> std::same_as<std::optional<T>>;
  requires std::same_as<decltype(T::acts_at_start), const bool>;
  requires !T::acts_at_start || PredictsVelocities<T>;
};

// InEquilibria::hold.
//   held_directions  the held directions of its points in the load step from t to t + dt (s)
template <class T>
concept HoldsDirections = requires(const T& condition, const Body& body, double t, double dt) {
  { condition.held_directions(body, t, dt) } -> std::same_as<std::vector<HeldDirection>>;
};

// InEquilibria::impossible: the sentence of the error message.
template <class T>
concept SaysWhyNotInEquilibria = requires {
  { T::why_not_in_equilibria } -> std::convertible_to<const char*>;
};

template <class T>
concept ActsInSteps = (T::stage == Stage::forces && AddsForces<T> && !ChangesVelocities<T>) ||
                      (T::stage != Stage::forces && ChangesVelocities<T> && !AddsForces<T>);

template <class T>
concept ActsInEquilibria =
    (T::in_equilibria == InEquilibria::load && T::stage == Stage::forces) ||
    (T::in_equilibria == InEquilibria::hold && HoldsDirections<T>) || T::in_equilibria == InEquilibria::tool ||
    (T::in_equilibria == InEquilibria::impossible && SaysWhyNotInEquilibria<T>);

template <class T>
concept ConditionType = HasRoles<T> && IsPrototype<T> && ActsInSteps<T> && ActsInEquilibria<T>;

}  // namespace strut
