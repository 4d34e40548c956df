// A load on the volume of the body, such as weight.
#pragma once

#include <vector>

#include "base/math/function.hpp"
#include "conditions/condition_type.hpp"

namespace strut {

// Along one axis of coordinates.
struct BodyForce {
  std::vector<int> points;
  int component;
  Function value;  // of the reference position and time: N/m³ of reference volume

  static constexpr Stage stage = Stage::forces;
  static constexpr double Work::*ledger_entry = &Work::external;
  static constexpr int reaction_place = no_reaction;
  static constexpr InEquilibria in_equilibria = InEquilibria::load;

  void add_forces(double t, Body& body) const;
  void add_work(double t, double impulse_time, const Body& body, ImpulseWork& work) const;
};

}  // namespace strut
