// The displacement that points begin with. It acts once, at set-up: the body is strained then, and its energy is not
// the work of anything.
#pragma once

#include <vector>

#include "base/math/function.hpp"
#include "conditions/condition_type.hpp"

namespace strut {

// Some components, all with the same value.
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

}  // namespace strut
