// Springs that pull every point of a body back to where it was.
#pragma once

#include <utility>
#include <vector>

#include "conditions/condition_type.hpp"
#include "mechanics/body.hpp"

namespace strut {

struct Anchor {
  std::vector<int> points = {};
  double stiffness = 0;  // N/m³ of reference volume per m

  static constexpr Stage stage = Stage::forces;
  static constexpr double Work::*ledger_entry = &Work::external;
  static constexpr int reaction_index = no_reaction;
  static constexpr InEquilibria in_equilibria = InEquilibria::impossible;
  static constexpr const char* why_not_in_equilibria =
      "'Anchor' is not known with Solver > QuasiStatic, whose tangent does not have its springs; expected a prescribed "
      "motion, a load, a plane or a tool";

  std::vector<Function> values_at_points() const { return {}; }
  Anchor on(std::vector<int> all, int, const Body&) const { return {std::move(all), stiffness}; }

  Anchor on_some(const MovingPoints& some) const { return {some.among(points), stiffness}; }
  void add_forces(double, double part, Body& body) const {
    for (const int i : points) body.force_density[i] -= part * stiffness * body.displacement(i);
  }
  void add_work(double, double impulse_time, const Body& body, ImpulseWork& work) const {
    for (const int i : points) {
      const Vector half_impulse = -0.5 * impulse_time * body.domain.volume(i) * stiffness * body.displacement(i);
      work.before.*ledger_entry += half_impulse.dot(body.previous_velocity[i]);
      work.after.*ledger_entry += half_impulse.dot(body.velocity[i]);
    }
  }
};

}  // namespace strut
