// A load per volume of the body, such as weight.
#pragma once

#include <utility>
#include <vector>

#include "base/math/function.hpp"
#include "conditions/condition_type.hpp"

namespace strut {

// Acts along some coordinate axes, with the same value along each.
struct BodyForce {
  std::vector<int> points = {};
  std::vector<int> components = {0};
  Function value = Function();  // of the reference position and time: N/m³ of reference volume

  static constexpr Stage stage = Stage::forces;
  static constexpr double Work::*ledger_entry = &Work::external;
  static constexpr int reaction_index = no_reaction;
  static constexpr InEquilibria in_equilibria = InEquilibria::load;

  std::vector<Function> values_at_points() const { return {value}; }
  BodyForce on(std::vector<int> all, int, const Body&) const { return {std::move(all), components, value}; }

  BodyForce on_some(const MovingPoints& some) const { return {some.among(points), components, value}; }
  void add_forces(double t, double part, Body& body) const;
  void add_work(double t, double impulse_time, const Body& body, ImpulseWork& work) const;
};

}  // namespace strut
