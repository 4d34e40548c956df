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
  };
  Vector normal = Vector::UnitX();  // of unit length
  std::vector<Drag> drags = {};
  int place = 0;  // in the deck

  static constexpr Stage stage = Stage::drags;
  static constexpr double Work::*ledger_entry = &Work::external;
  static constexpr int reaction_place = no_reaction;
  static constexpr InEquilibria in_equilibria = InEquilibria::impossible;
  static constexpr const char* why_not_in_equilibria =
      "'Non-Reflecting End' has no meaning with Solver > QuasiStatic, which knows no inertia; expected a prescribed "
      "motion, a load, a plane or a tool";

  std::vector<Function> values_at_points() const { return {}; }
  // The drags are by the moduli of the undeformed blocks. What is beyond the ends still has to be taken off the inertia
  // of the points: part_within, of all ends of a point together.
  NonReflectingEnd on(std::vector<int> points, int place, const Body&) const;

  void change_velocities(VelocityUpdate& update) const;
  std::optional<NonReflectingEnd> in_substeps(const MovingPoints& moving) const;
  static constexpr bool acts_at_start = false;
};

// The part of a whole cell that is within ends through its middle with these outward normals (of unit length): half of
// it within one, a quarter at an edge of a box, an eighth at a corner; 0 where they are more than three, in
// one plane, or two of them one.
double part_within(const std::vector<Vector>& normals);

}  // namespace strut
