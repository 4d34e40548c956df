// An end that waves leave as if the body went on behind it: the viscous traction −ρ c_p v_n − ρ c_s v_t (Lysmer &
// Kuhlemeyer 1969) on the layer of points that has the end's surface. The traction acts in the middle of the layer:
// what is beyond it, half of a layer of whole cells, is taken to belong to the other side, and its inertia is the other
// side's (docs/theory.md, Non-reflecting ends).
#pragma once

#include <optional>
#include <vector>

#include "conditions/condition_type.hpp"

namespace strut {

struct NonReflectingEnd {
  struct Drag {
    int point;
    double along, across;  // traction over speed and mass of half a layer: 2 c_p/s and 2 c_s/s, s the spacing; 1/s
    double gain;           // mass of the point over that of half a layer
  };
  Vector normal = Vector::UnitX();  // of unit length
  std::vector<Drag> drags = {};

  static constexpr Stage stage = Stage::drags;
  static constexpr double Work::*ledger_entry = &Work::external;
  static constexpr int reaction_place = no_reaction;
  static constexpr InEquilibria in_equilibria = InEquilibria::impossible;
  static constexpr const char* why_not_in_equilibria =
      "'Non-Reflecting End' has no meaning with Solver > QuasiStatic, which knows no inertia; expected a prescribed "
      "motion, a load, a plane or a tool";

  std::vector<Function> values_at_points() const { return {}; }
  // The drags are by the moduli of the undeformed blocks.
  NonReflectingEnd on(std::vector<int> points, int, const Body& body) const;

  void change_velocities(VelocityUpdate& update) const;
  std::optional<NonReflectingEnd> in_substeps(const MovingPoints& moving) const;
  static constexpr bool acts_at_start = false;
};

}  // namespace strut
