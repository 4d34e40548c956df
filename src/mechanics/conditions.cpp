#include "mechanics/conditions.hpp"

#include <algorithm>
#include <cmath>

namespace strut {

namespace {

double at_point(const Function& value, const Body& body, int i, double t) {
  const Vector& X = body.domain.positions[i];
  return value(X[0], X[1], X[2], t);
}

// The velocity that carries point i along a prescribed motion from t to t + dt.
double motion_velocity(const PrescribedMotion& motion, const Body& body, int i, double t, double dt) {
  if (motion.is_velocity) return at_point(motion.value, body, i, t + 0.5 * dt);
  const double target = body.domain.positions[i][motion.component] + at_point(motion.value, body, i, t + dt);
  return (target - body.sites[i].current[motion.component]) / dt;
}

void constrain_motion(const PrescribedMotion& motion, double t, const PointSteps& steps, Body& body, KickWork& work) {
  const int c = motion.component;
  for (const int i : motion.points) {
    double& v = body.velocity[i][c];
    const double imposed = motion_velocity(motion, body, i, t, steps.of(i));
    const double half_impulse = 0.5 * body.mass(i) * (imposed - v);
    work.before.external += half_impulse * body.previous_velocity[i][c];
    work.after.external += half_impulse * imposed;
    v = imposed;
  }
}

// The velocity after a kick that would change `before` by `kick`, with a drag on the mean of both: stable at any rate.
double dragged(double before, double kick, double rate, double dt) {
  return (before * (1 - 0.5 * rate * dt) + kick) / (1 + 0.5 * rate * dt);
}

struct Impulse {
  int point;
  Vector half;  // N s
};

void drag(const OpenEnd& end, const PointSteps& steps, Body& body, std::vector<Impulse>& impulses) {
  for (const auto& [i, along, across, gain] : end.drags) {
    const Vector before = body.previous_velocity[i], kick = gain * (body.velocity[i] - before);
    const double speed = end.normal.dot(before), push = end.normal.dot(kick), dt = steps.of(i);
    const Vector sliding = before - speed * end.normal, shear = kick - push * end.normal;
    Vector& v = body.velocity[i];
    const Vector kicked = v;
    v = dragged(speed, push, along, dt) * end.normal;
    for (int c = 0; c < 3; ++c) v[c] += dragged(sliding[c], shear[c], across, dt);
    impulses.push_back({i, 0.5 * body.mass(i) * (v - kicked)});
  }
}

// The change of velocity by which a plane allows `velocity`, at a gap (m) in front of it.
Vector correction(const Plane& plane, double gap, const Vector& velocity, double dt) {
  const double speed = plane.normal.dot(velocity);
  double allowed = 0;
  if (plane.one_sided) {
    if (gap + dt * speed >= 0) return Vector::Zero();
    allowed = -gap / dt;  // lands on the plane; one found behind it comes back
  }
  const Vector push = (allowed - speed) * plane.normal;
  if (plane.friction == 0) return push;
  const Vector sliding = velocity - speed * plane.normal;
  const double length = sliding.norm();
  const double grip = plane.friction * std::abs(allowed - speed);
  return grip < length ? push - grip / length * sliding : Vector(push - sliding);
}

void constrain_plane(const Plane& plane, const PointSteps& steps, Body& body, KickWork& work) {
  const auto share = plane.one_sided ? &Work::contact : &Work::external;
  for (const int i : plane.points) {
    const double gap = plane.normal.dot(body.current(i) - plane.point);
    const Vector change = correction(plane, gap, body.velocity[i], steps.of(i));
    body.velocity[i] += change;
    const Vector half_impulse = 0.5 * body.mass(i) * change;
    work.before.*share += half_impulse.dot(body.previous_velocity[i]);
    work.after.*share += half_impulse.dot(body.velocity[i]);
  }
}

}  // namespace

void add_body_forces(const Conditions& conditions, double t, Body& body) {
  for (const BodyForce& load : conditions.body_forces) {
    for (const int i : load.points) body.force_density[i][load.component] += at_point(load.value, body, i, t);
  }
}

void start_motions(const Conditions& conditions, double t, double dt, Body& body) {
  KickWork none;
  for (const PrescribedMotion& motion : conditions.motions) constrain_motion(motion, t, {dt}, body, none);
  for (const Plane& plane : conditions.planes) {
    if (!plane.one_sided) constrain_plane(plane, {dt}, body, none);
  }
}

void constrain(const Conditions& conditions, double t, const PointSteps& steps, Body& body, KickWork& work) {
  std::vector<Impulse> drags;
  for (const OpenEnd& end : conditions.open_ends) drag(end, steps, body, drags);
  for (const PrescribedMotion& motion : conditions.motions) constrain_motion(motion, t, steps, body, work);
  for (const Plane& plane : conditions.planes) constrain_plane(plane, steps, body, work);
  for (const auto& [i, half] : drags) {  // with the velocity that the others leave
    work.before.external += half.dot(body.previous_velocity[i]);
    work.after.external += half.dot(body.velocity[i]);
  }
}

Conditions restricted_to(const Conditions& conditions, const std::vector<std::uint8_t>& halvings, int order) {
  const auto restrict = [&](auto all) {
    std::erase_if(all.points, [&](int i) { return halvings[i] < order; });
    return all;
  };
  Conditions some;
  for (OpenEnd end : conditions.open_ends) {
    std::erase_if(end.drags, [&](const OpenEnd::Drag& drag) { return halvings[drag.point] < order; });
    some.open_ends.push_back(end);
  }
  for (const PrescribedMotion& motion : conditions.motions) some.motions.push_back(restrict(motion));
  for (const Plane& plane : conditions.planes) some.planes.push_back(restrict(plane));
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
                         .gain = std::max(1.0, 2 * body.domain.volumes[i] / (s * s * s))});
  }
  return end;
}

void add_work_of_body_forces(const Conditions& conditions, double t, double kick, const Body& body, KickWork& work) {
  for (const BodyForce& load : conditions.body_forces) {
    const int c = load.component;
    for (const int i : load.points) {
      const double half_impulse = 0.5 * at_point(load.value, body, i, t) * body.domain.volumes[i] * kick;
      work.before.external += half_impulse * body.previous_velocity[i][c];
      work.after.external += half_impulse * body.velocity[i][c];
    }
  }
}

}  // namespace strut
