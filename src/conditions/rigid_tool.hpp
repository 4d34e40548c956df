// Rigid tools: shapes that move along given paths, and that the points of a body do not enter.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/math/function.hpp"
#include "conditions/condition_type.hpp"
#include "conditions/free_motion.hpp"
#include "conditions/tool_shapes.hpp"

namespace strut {

// A tool that some points meet, where their cells end. One that would enter it is stopped at its surface, and is free
// to leave. While it is stopped, Coulomb friction takes up to `friction` times the impulse of the tool from its sliding
// over the tool.
struct RigidTool {
  std::vector<int> points = {};
  Shape shape;                                         // before it travels
  std::array<std::optional<Function>, 3> travel = {};  // along x, y, z, of t only, m; nothing: it stays
  double friction = 0;
  int reaction_place = no_reaction;
  // Of a tool with a mass, in the place of `travel`; one with its parts for substeps, where it only takes note of what
  // it gives.
  std::shared_ptr<FreeMotion> free = {};
  bool in_whole_steps = true;
  // Of all owned points, m. Nothing: it meets the points themselves.
  std::shared_ptr<const std::vector<double>> reaches = {};
  // Whether it has met a point of this rank; one with its parts for substeps and its copies.
  std::shared_ptr<bool> touched = std::make_shared<bool>(false);

  // How far it has traveled at time t (s), m. Its surface is seen from a place y as `shape` is from y − offset(t).
  Vector offset(double t) const;
  // Its surface, of the kind S of shape or any, as the cell of point i meets it from a place y − offset(t).
  template <class S>
  Surface met_by(int i, const S& kind, const Vector& place) const {
    Surface at = surface(kind, place);
    if (reaches) at.gap -= (*reaches)[i];
    return at;
  }
  // Of the body as it was read and the tool where it is at time t (s): cells that would overlap it there end at its
  // surface. None of nodes, for those at a surface lie on it.
  void set_reaches(double t, const Body& body);

  static constexpr Stage stage = Stage::tools;
  static constexpr double Work::*ledger_entry = &Work::tools;
  static constexpr InEquilibria in_equilibria = InEquilibria::tool;

  std::vector<Function> values_at_points() const;  // of the time alone
  RigidTool on(std::vector<int> all, int place, const Body&) const {
    return {std::move(all), shape, travel, friction, place, free ? std::make_shared<FreeMotion>(*free) : nullptr};
  }

  void change_velocities(VelocityUpdate& update);  // collective where it has a mass
  std::optional<RigidTool> in_substeps(const MovingPoints& moving) const;
  static constexpr bool acts_at_start = false;

 private:
  void fly(VelocityUpdate& update);
};

}  // namespace strut
