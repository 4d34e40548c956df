// A condition as a deck describes it: its type with all data except its points. Here also the conditions that act once,
// at set-up: a deck lists them among the others, but they do nothing in steps.
#pragma once

#include <variant>
#include <vector>

#include "base/math/function.hpp"
#include "conditions/condition.hpp"

namespace strut {

// Some components, all with the same value. The body is strained at the start, and its energy is not the work of
// anything.
struct InitialDisplacement {
  std::vector<int> components = {0};
  Function value = Function();  // of the reference position and time: m

  static constexpr InEquilibria in_equilibria = InEquilibria::impossible;
  static constexpr const char* why_not_in_equilibria =
      "'Initial Displacement' has no meaning with Solver > QuasiStatic, whose equilibria do not depend on where points "
      "begin; expected a prescribed motion, a load, a plane or a tool";

  std::vector<Function> values_at_points() const { return {value}; }
  void set_initial_state(const std::vector<int>& points, double t, Body& body) const;
};

// Some components, all with the same value.
struct InitialVelocity {
  std::vector<int> components = {0};
  Function value = Function();  // of the reference position and time: m/s

  static constexpr InEquilibria in_equilibria = InEquilibria::impossible;
  static constexpr const char* why_not_in_equilibria =
      "'Initial Velocity' has no meaning with Solver > QuasiStatic, which knows no inertia; expected a prescribed "
      "motion, a load, a plane or a tool";

  std::vector<Function> values_at_points() const { return {value}; }
  void set_initial_state(const std::vector<int>& points, double t, Body& body) const;
};

// A temperature that points are given: mechanics lets them expand by it (expansion.hpp).
struct PrescribedTemperature {
  Function value = Function();  // of the reference position and time: K

  static constexpr InEquilibria in_equilibria = InEquilibria::hold;

  std::vector<Function> values_at_points() const { return {value}; }
  void set_initial_state(const std::vector<int>& points, double, Body& body) const;
  std::vector<HeldDirection> held_directions(const Body&, double, double) const { return {}; }
};

// Set-up makes a Period of these sides (topology/mirror.hpp); images replace the neighbors beyond them.
struct PeriodicSides {
  int axis = 0;
  double lower = 0, upper = 0;     // places of the sides along the axis, m
  Function stretch = Function(1);  // of the time: their distance over that of the reference state
  int reaction_index = no_reaction;

  static constexpr InEquilibria in_equilibria = InEquilibria::hold;

  std::vector<Function> values_at_points() const { return {stretch}; }
  void set_initial_state(const std::vector<int>&, double, Body&) const {}
  std::vector<HeldDirection> held_directions(const Body&, double, double) const { return {}; }
};

// The interface of these conditions.
//   set_initial_state  sets the state of these points at time t
template <class T>
concept ActsOnce = !ConditionType<T> && ActsInEquilibria<T> &&
                   requires(const T& prototype, const std::vector<int>& points, double t, Body& body) {
  { prototype.values_at_points() } -> std::same_as<std::vector<Function>>;
  { prototype.set_initial_state(points, t, body) } -> std::same_as<void>;
};
static_assert(ActsOnce<InitialVelocity> && ActsOnce<InitialDisplacement> && ActsOnce<PeriodicSides> &&
              ActsOnce<PrescribedTemperature>);

template <class Conditions>
struct WithWhatActsOnce;
template <class... Types>
struct WithWhatActsOnce<std::variant<Types...>> {
  using type = std::variant<InitialVelocity, InitialDisplacement, PeriodicSides, PrescribedTemperature, Types...>;
};

using ConditionPrototype = WithWhatActsOnce<Condition>::type;

}  // namespace strut
