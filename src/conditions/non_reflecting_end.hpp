// An end that absorbs waves as if the body continued behind it: the viscous traction −ρ c_p v_n − ρ c_s v_t (Lysmer &
// Kuhlemeyer 1969) on the layer of points at the end's surface. The traction acts in the middle of the layer; the part
// beyond it, half a layer of whole cells, and its inertia belong to the other side (docs/theory.md, Non-reflecting
// ends).
#pragma once

#include <optional>
#include <vector>

#include "conditions/condition_type.hpp"

namespace strut {

struct NonReflectingEnd {
  struct Drag {
    int point;
    double along, across;  // traction over speed and mass of half a layer, 1/s: 2 c_p/h and 2 c_s/h, h its thickness
  };
  Vector normal = Vector::UnitX();  // of unit length
  std::vector<Drag> drags = {};
  int index = 0;  // in the deck

  static constexpr Stage stage = Stage::drags;
  static constexpr double Work::*ledger_entry = &Work::external;
  static constexpr int reaction_index = no_reaction;
  static constexpr InEquilibria in_equilibria = InEquilibria::impossible;
  static constexpr const char* why_not_in_equilibria =
      "'Non-Reflecting End' has no meaning with Solver > QuasiStatic, which knows no inertia; expected a prescribed "
      "motion, a load, a plane or a tool";

  std::vector<Function> values_at_points() const { return {}; }
  // The drags use the moduli of the undeformed blocks. The inertia of the points must still be reduced by the part
  // beyond the ends: part_within, for all ends of a point together.
  NonReflectingEnd on(std::vector<int> points, int index, const Body&) const;

  void change_velocities(VelocityUpdate& update) const;
  std::optional<NonReflectingEnd> in_substeps(const MovingPoints& moving) const;
  static constexpr bool acts_at_start = false;
};

// The part of a whole cell inside ends through its center with these outward normals (of unit length): half inside one,
// a quarter at an edge of a box, an eighth at a corner; 0 if there are more than three, if they are in one plane, or if
// two are equal.
double part_within(const std::vector<Vector>& normals);

}  // namespace strut
