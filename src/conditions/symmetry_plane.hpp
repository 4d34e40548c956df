// A symmetry plane, of which only one side is computed.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "conditions/condition_type.hpp"

namespace strut {

// Bodies that end at the plane continue as their mirror images (topology/mirror.hpp). Their points on the plane stay
// there, because only round-off and loads would move them off. Points of other bodies keep their distance to it.
struct SymmetryPlane {
  std::vector<int> points = {};
  Vector normal = Vector::UnitX();  // of unit length
  int reaction_index = no_reaction;
  // Velocity change, in the directions that other conditions leave free, that takes 1 m/s along the normal from a
  // point. Without it: the normal.
  std::optional<Vector> push = {};
  Vector point = Vector::Zero();  // of the plane, m

  static constexpr Stage stage = Stage::planes;
  static constexpr double Work::*ledger_entry = &Work::external;
  static constexpr InEquilibria in_equilibria = InEquilibria::hold;

  std::vector<Function> values_at_points() const { return {}; }
  SymmetryPlane on(std::vector<int> all, int index, const Body& body) const;

  void change_velocities(VelocityUpdate& update) const;
  std::optional<SymmetryPlane> in_substeps(const MovingPoints& moving) const;
  static constexpr bool acts_at_start = true;
  void predict_velocities(double t, double moment, const Body& body, std::vector<Vector>& velocities) const;
  std::vector<HeldDirection> held_directions(const Body& body, double t, double dt) const;
};

}  // namespace strut
