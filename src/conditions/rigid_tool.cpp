#include "conditions/rigid_tool.hpp"

#include <cmath>

#include "conditions/velocity_update.hpp"

namespace strut {

namespace {

// Where a tool is, and how fast over the steps of its points, which differ by their time-step level.
class ToolMotion {
 public:
  ToolMotion(const RigidTool& tool, double t, double whole_step)
      : tool_(tool), t_(t), whole_step_(whole_step), offset_(tool.offset(t)) {}

  const Vector& offset() const { return offset_; }
  const Vector& velocity(int level) {
    while (static_cast<int>(velocities_.size()) <= level) {
      const double dt = std::ldexp(whole_step_, -static_cast<int>(velocities_.size()));
      velocities_.push_back((tool_.offset(t_ + dt) - offset_) / dt);
    }
    return velocities_[level];
  }

 private:
  const RigidTool& tool_;
  double t_, whole_step_;
  Vector offset_;
  std::vector<Vector> velocities_;  // by time-step levels
};

// The change of velocity that keeps a point which has this one, relative to the tool, out of it over dt.
Vector correction(const Surface& at, double friction, const Vector& velocity, double dt) {
  const double speed = at.normal.dot(velocity);
  const double allowed = -at.gap / dt;  // lands on the surface; one found inside comes back
  const Vector push = (allowed - speed) * at.normal;
  if (friction == 0) return push;
  const Vector sliding = velocity - speed * at.normal;
  const double length = sliding.norm();
  const double grip = friction * std::abs(allowed - speed);
  return grip < length ? push - grip / length * sliding : Vector(push - sliding);
}

}  // namespace

Vector RigidTool::offset(double t) const {
  Vector sum = Vector::Zero();
  for (int c = 0; c < 3; ++c) {
    if (travel[c]) sum[c] = (*travel[c])(0, 0, 0, t);
  }
  return sum;
}

void RigidTool::change_velocities(VelocityUpdate& update) const {
  ToolMotion motion(*this, update.t, update.steps.whole);
  const auto keep_out = [&](const auto& shape) {
    for (const int i : points) {
      const double dt = update.steps.of(i);
      const Surface at = surface(shape, update.body.current(i) - motion.offset());
      const Vector relative = update.body.velocity[i] - motion.velocity(update.steps.level(i));
      if (at.gap + dt * at.normal.dot(relative) >= 0) continue;
      const Vector change = correction(at, friction, relative, dt);
      update.body.velocity[i] += change;
      update.record(i, change);
    }
  };
  std::visit(keep_out, shape);
}

std::optional<RigidTool> RigidTool::in_substeps(const MovingPoints& moving) const {
  return RigidTool{moving.among(points), shape, travel, friction, reaction_place};
}

}  // namespace strut
