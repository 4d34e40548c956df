#include "conditions/conditions.hpp"

#include <algorithm>
#include <cmath>

namespace strut {

namespace {

double at_point(const Function& value, const Body& body, int i, double t) {
  const Vector X = body.domain.reference(i);
  return value(X[0], X[1], X[2], t);
}

// The velocity that carries point i along a prescribed motion from t to t + dt.
double motion_velocity(const PrescribedMotion& motion, const Body& body, int i, double t, double dt) {
  if (motion.is_velocity) return at_point(motion.value, body, i, t + 0.5 * dt);
  const double target = body.domain.reference(i)[motion.component] + at_point(motion.value, body, i, t + dt);
  return (target - body.domain.sites[i].current[motion.component]) / dt;
}

struct Push {
  int point;
  Vector half_impulse;  // N s
  double Work::*share;  // of the ledger
};

// What conditions do to the velocities of one kick, at the time t.
struct VelocityUpdate {
  double t;
  const PointSteps& steps;
  Body& body;
  Impulses& impulses;
  std::vector<Push> pushes = {};

  // After the velocity of point i was changed.
  void record(int i, const Vector& change, double Work::*share, int condition = -1) {
    const Vector half_impulse = 0.5 * body.mass(i) * change;
    pushes.push_back({i, half_impulse, share});
    impulses.add(condition, 2 * half_impulse);
  }
};

// With the velocities that all conditions together leave.
void add_work(const VelocityUpdate& update, ImpulseWork& work) {
  for (const auto& [i, half_impulse, share] : update.pushes) {
    work.before.*share += half_impulse.dot(update.body.previous_velocity[i]);
    work.after.*share += half_impulse.dot(update.body.velocity[i]);
  }
}

void constrain_motion(const PrescribedMotion& motion, VelocityUpdate& update) {
  for (const int i : motion.points) {
    double& v = update.body.velocity[i][motion.component];
    const double imposed = motion_velocity(motion, update.body, i, update.t, update.steps.of(i));
    const double change = imposed - v;
    v = imposed;
    update.record(i, change * Vector::Unit(motion.component), &Work::external, motion.condition);
  }
}

// The velocity after a kick that would change `before` by `kick`, with a drag on the mean of both: stable at any rate.
double dragged(double before, double update, double rate, double dt) {
  return (before * (1 - 0.5 * rate * dt) + update) / (1 + 0.5 * rate * dt);
}

void drag(const OpenEnd& end, VelocityUpdate& update) {
  for (const auto& [i, along, across, gain] : end.drags) {
    const Vector before = update.body.previous_velocity[i], change = gain * (update.body.velocity[i] - before);
    const double speed = end.normal.dot(before), push = end.normal.dot(change), dt = update.steps.of(i);
    const Vector sliding = before - speed * end.normal, shear = change - push * end.normal;
    Vector& v = update.body.velocity[i];
    const Vector kicked = v;
    v = dragged(speed, push, along, dt) * end.normal;
    for (int c = 0; c < 3; ++c) v[c] += dragged(sliding[c], shear[c], across, dt);
    update.record(i, v - kicked, &Work::external);
  }
}

void constrain_plane(const SymmetryPlane& plane, VelocityUpdate& update) {
  for (const int i : plane.points) {
    const Vector change = -plane.normal.dot(update.body.velocity[i]) * plane.normal;
    update.body.velocity[i] += change;
    update.record(i, change, &Work::external, plane.condition);
  }
}

// Where a tool is, and how fast over the steps of its points, which differ by how often they are halved.
class ToolMotion {
 public:
  ToolMotion(const Tool& tool, double t, double whole_step)
      : tool_(tool), t_(t), whole_step_(whole_step), offset_(tool.offset(t)) {}

  const Vector& offset() const { return offset_; }
  const Vector& velocity(int levels) {
    while (static_cast<int>(velocities_.size()) <= levels) {
      const double dt = std::ldexp(whole_step_, -static_cast<int>(velocities_.size()));
      velocities_.push_back((tool_.offset(t_ + dt) - offset_) / dt);
    }
    return velocities_[levels];
  }

 private:
  const Tool& tool_;
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

void constrain_tool(const Tool& tool, VelocityUpdate& update) {
  ToolMotion motion(tool, update.t, update.steps.whole);
  const auto keep_out = [&](const auto& shape) {
    for (const int i : tool.points) {
      const double dt = update.steps.of(i);
      const Surface at = surface(shape, update.body.current(i) - motion.offset());
      const Vector relative = update.body.velocity[i] - motion.velocity(update.steps.level(i));
      if (at.gap + dt * at.normal.dot(relative) >= 0) continue;
      const Vector change = correction(at, tool.friction, relative, dt);
      update.body.velocity[i] += change;
      update.record(i, change, &Work::contact, tool.condition);
    }
  };
  std::visit(keep_out, tool.shape);
}

}  // namespace

void add_body_forces(const Conditions& conditions, double t, Body& body) {
  for (const BodyForce& load : conditions.body_forces) {
    for (const int i : load.points) body.force_density[i][load.component] += at_point(load.value, body, i, t);
  }
}

void start_motions(const Conditions& conditions, double t, double dt, Body& body) {
  Impulses none;
  const PointSteps steps{dt};
  VelocityUpdate update{t, steps, body, none};
  for (const PrescribedMotion& motion : conditions.motions) constrain_motion(motion, update);
  for (const SymmetryPlane& plane : conditions.symmetry_planes) constrain_plane(plane, update);
}

void constrain(const Conditions& conditions, double t, const PointSteps& steps, Body& body, ImpulseWork& work,
               Impulses& impulses) {
  VelocityUpdate update{t, steps, body, impulses};
  for (const OpenEnd& end : conditions.open_ends) drag(end, update);
  for (const PrescribedMotion& motion : conditions.motions) constrain_motion(motion, update);
  for (const SymmetryPlane& plane : conditions.symmetry_planes) constrain_plane(plane, update);
  for (const Tool& tool : conditions.tools) constrain_tool(tool, update);
  add_work(update, work);
}

Conditions restricted_to(const Conditions& conditions, const std::vector<std::uint8_t>& levels, int level) {
  const auto restrict = [&](auto all) {
    std::erase_if(all.points, [&](int i) { return levels[i] < level; });
    return all;
  };
  Conditions some;
  for (OpenEnd end : conditions.open_ends) {
    std::erase_if(end.drags, [&](const OpenEnd::Drag& drag) { return levels[drag.point] < level; });
    some.open_ends.push_back(end);
  }
  for (const PrescribedMotion& motion : conditions.motions) some.motions.push_back(restrict(motion));
  for (const SymmetryPlane& plane : conditions.symmetry_planes) some.symmetry_planes.push_back(restrict(plane));
  for (const Tool& tool : conditions.tools) some.tools.push_back(restrict(tool));
  return some;
}

OpenEnd open_end(const std::vector<int>& points, const Vector& normal, const Body& body) {
  OpenEnd end{normal, {}};
  for (const int i : points) {
    const BlockMaterial& material = body.blocks[body.domain.cloud.blocks[i]].material;
    const auto moduli = std::visit([](const auto& law) { return law.moduli(); }, material.law);
    const double s = body.domain.cloud.spacings[i];
    end.drags.push_back({.point = i,
                         .along = 2 / s * std::sqrt(moduli.longitudinal() / material.density),
                         .across = 2 / s * std::sqrt(moduli.shear / material.density),
                         .gain = std::max(1.0, 2 * body.domain.volume(i) / (s * s * s))});
  }
  return end;
}

void add_work_of_body_forces(const Conditions& conditions, double t, double update, const Body& body,
                             ImpulseWork& work) {
  for (const BodyForce& load : conditions.body_forces) {
    const int c = load.component;
    for (const int i : load.points) {
      const double half_impulse = 0.5 * at_point(load.value, body, i, t) * body.domain.volume(i) * update;
      work.before.external += half_impulse * body.previous_velocity[i][c];
      work.after.external += half_impulse * body.velocity[i][c];
    }
  }
}

}  // namespace strut
