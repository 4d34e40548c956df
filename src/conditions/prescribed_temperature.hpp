// A temperature that points are given, as a deck describes it: mechanics lets them expand by it (expansion.hpp).
#pragma once

#include <vector>

#include "base/math/function.hpp"
#include "conditions/condition_type.hpp"

namespace strut {

struct PrescribedTemperature {
  Function value = Function();  // of the reference position and time: K

  static constexpr InEquilibria in_equilibria = InEquilibria::hold;

  std::vector<Function> values_at_points() const { return {value}; }
  void set_initial_state(const std::vector<int>& points, double, Body& body) const;
  std::vector<HeldDirection> held_directions(const Body&, double, double) const { return {}; }
};

}  // namespace strut
