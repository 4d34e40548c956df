// Initial displacement and velocity of points. Both act once, at set-up: a deck lists them among the conditions, but
// they do nothing in steps.
#pragma once

#include <vector>

#include "base/math/function.hpp"
#include "conditions/condition_type.hpp"

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

}  // namespace strut
