// A condition as a deck describes it: its type with all data except its points.
#pragma once

#include <variant>
#include <vector>

#include "conditions/condition.hpp"
#include "conditions/initial_state.hpp"
#include "conditions/periodic_sides.hpp"
#include "conditions/prescribed_temperature.hpp"

namespace strut {

// Conditions that act once, at set-up.
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
