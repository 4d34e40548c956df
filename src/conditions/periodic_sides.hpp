// Periodic sides, as a deck describes them: set-up makes a period of them (topology/mirror.hpp), whose images do the
// rest.
#pragma once

#include <vector>

#include "base/math/function.hpp"
#include "conditions/condition_type.hpp"

namespace strut {

struct PeriodicSides {
  int axis = 0;
  double lower = 0, upper = 0;     // places of the sides along the axis, m
  Function stretch = Function(1);  // of the time: their distance over that of the reference state
  int reaction_place = no_reaction;

  static constexpr InEquilibria in_equilibria = InEquilibria::hold;

  std::vector<Function> values_at_points() const { return {stretch}; }
  void set_initial_state(const std::vector<int>&, double, Body&) const {}
  std::vector<HeldDirection> held_directions(const Body&, double, double) const { return {}; }
};

}  // namespace strut
