// What a type must state to be a condition. The compiler asks for it (condition.hpp), so that nothing is forgotten in
// whole steps, substeps, equilibria, the ledger or reactions.
//
// Every condition states
//   stage           when it acts in a step, relative to others
//   ledger_entry    the entry of the energy ledger that its work goes to
//   reaction_place  a member: its place in the deck, by which its reaction is asked for; static and no_reaction: it
//                   has none
//   in_equilibria   what it is in a load step without inertia
// and, as these demand, what the concepts below list. How to add one: CONTRIBUTING.md.
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

// Named only: a deck reads the types of conditions without the body that they act on.
struct Body;
struct VelocityUpdate;

// The order in which conditions act; those of one stage act in the order of the deck. `forces` change force densities,
// the others velocities, after all forces have: `drags` resist them, `motions` prescribe them, `planes` and `tools`
// limit them. Each may undo what earlier stages did, and so a point that a motion carries against a tool does not enter
// it.
enum class Stage { forces, drags, motions, planes, tools };

// `load`: its forces act there as in a step; `hold`: points have given places along some directions; `tool`: unilateral
// contact with friction, which only rigid tools are; `impossible`: it has no meaning there, and decks say so.
enum class InEquilibria { load, hold, tool, impossible };

// The points that move at times between whole steps: at those of `level`, which come every 2^−level of the step.
struct MovingPoints {
  const std::vector<std::uint8_t>& levels;  // of owned points: the time-step levels of their motion
  int level;

  bool include(int i) const { return levels[i] >= level; }
  std::vector<int> among(std::vector<int> points) const {
    std::erase_if(points, [this](int i) { return !include(i); });
    return points;
  }
};

// A load step leads the place y of the point to y · direction = target.
struct HeldDirection {
  int reaction_place, point;
  Vector direction;  // of unit length
  double target;     // m
};

template <class T>
concept HasRoles = requires(const T& condition) {
  requires std::same_as<decltype(T::stage), const Stage>;
  requires std::same_as<decltype(T::ledger_entry), double Work::*const>;
  { condition.reaction_place } -> std::convertible_to<int>;
  requires std::same_as<decltype(T::in_equilibria), const InEquilibria>;
};

template <class T>
concept Reacts = std::is_member_object_pointer_v<decltype(&T::reaction_place)>;

// A deck makes a prototype: what it says of the condition, without points. Set-up completes it.
//   values_at_points  the functions of the deck that it evaluates at its points, or of the time alone: set-up has seen
//                     to it that they are numbers there at the initial time, solvers ask later (first_not_finite)
//   on                the condition on these points, at this place in the deck
template <class T>
concept IsPrototype = requires(const T& prototype, std::vector<int> points, int place, const Body& body) {
  { prototype.values_at_points() } -> std::same_as<std::vector<Function>>;
  { prototype.on(points, place, body) } -> std::same_as<T>;
};

// Stage::forces. It acts once a whole step, not in substeps: these are for stiff points, and a load is not stiff. Where
// there are substeps, both are asked at several times of the step, for their mean. The
// estimate of the critical time step does not know it: where it is stiff, the deck needs a smaller Safety Factor.
//   add_forces  adds to the force density what it does at time t
//   add_work    adds the work of these forces, once velocities are final; impulse_time is what they have acted for, the
//               mean of the steps before and after t
template <class T>
concept AddsForces = requires(const T& condition, double t, double impulse_time, Body& body, const Body& after,
                              ImpulseWork& work) {
  { condition.add_forces(t, body) } -> std::same_as<void>;
  { condition.add_work(t, impulse_time, after, work) } -> std::same_as<void>;
};

// Where acts_at_start: of the initial velocities, and of the check for undeclared contact (setup), which looks ahead.
//   predict_velocities  puts the velocities that it imposes at time t, as a mean over `moment` (s) where it imposes
//                       places, into `velocities`
template <class T>
concept PredictsVelocities = requires(const T& condition, double t, double moment, const Body& body,
                                      std::vector<Vector>& velocities) {
  { condition.predict_velocities(t, moment, body, velocities) } -> std::same_as<void>;
};

// All other stages.
//   change_velocities  changes velocities, as the forces at update.t leave them, to what it allows, and records each
//                      change. update.steps.of(i) is the time for which the velocity then carries point i on: the next
//                      step, or the part of it that is the point's own step; of_impulse(i) the time for which forces
//                      have acted
//   in_substeps        its part for the points that move between whole steps; nothing: it does not act there
//   acts_at_start      initial velocities are changed, too
template <class T>
concept ChangesVelocities = requires(T& condition, VelocityUpdate& update, const MovingPoints& moving) {
  { condition.change_velocities(update) } -> std::same_as<void>;
  { condition.in_substeps(moving) } -> std::same_as<std::optional<T>>;
  requires std::same_as<decltype(T::acts_at_start), const bool>;
  requires !T::acts_at_start || PredictsVelocities<T>;
};

// InEquilibria::hold.
//   held_directions  of its points, which are where the load step from t over dt begins
template <class T>
concept HoldsDirections = requires(const T& condition, const Body& body, double t, double dt) {
  { condition.held_directions(body, t, dt) } -> std::same_as<std::vector<HeldDirection>>;
};

// InEquilibria::impossible: the sentence of the error.
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
