// Points with a prescribed motion, whatever force it takes.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/math/function.hpp"
#include "conditions/condition_type.hpp"

namespace strut {

// Some components of the motion of some points, each with the same value.
struct PrescribedMotion {
  std::vector<int> points = {};
  std::vector<int> components = {0};
  Function value = Function();  // of the reference position and time: m, or m/s
  bool is_velocity = false;
  int reaction_index = no_reaction;

  static constexpr Stage stage = Stage::motions;
  static constexpr double Work::*ledger_entry = &Work::external;
  static constexpr InEquilibria in_equilibria = InEquilibria::hold;

  std::vector<Function> values_at_points() const { return {value}; }
  PrescribedMotion on(std::vector<int> all, int index, const Body&) const {
    return {std::move(all), components, value, is_velocity, index};
  }

  void change_velocities(VelocityUpdate& update) const;
  std::optional<PrescribedMotion> in_substeps(const MovingPoints& moving) const;
  static constexpr bool acts_at_start = true;
  void predict_velocities(double t, double moment, const Body& body, std::vector<Vector>& velocities) const;
  std::vector<HeldDirection> held_directions(const Body& body, double t, double dt) const;
};

}  // namespace strut
