#include "mechanics/conditions.hpp"

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

void constrain_motion(const PrescribedMotion& motion, double t, double dt, Body& body, KickWork& work) {
  const int c = motion.component;
  for (const int i : motion.points) {
    double& v = body.velocity[i][c];
    const double imposed = motion_velocity(motion, body, i, t, dt);
    const double half_impulse = 0.5 * body.mass(i) * (imposed - v);
    work.before.external += half_impulse * body.previous_velocity[i][c];
    work.after.external += half_impulse * imposed;
    v = imposed;
  }
}

void constrain_plane(const Plane& plane, double dt, Body& body, KickWork& work) {
  const Vector& n = plane.normal;
  const auto share = plane.one_sided ? &Work::contact : &Work::external;
  for (const int i : plane.points) {
    const double speed = n.dot(body.velocity[i]);
    double allowed = 0;
    if (plane.one_sided) {
      const double gap = n.dot(body.current(i) - plane.point);
      if (gap + dt * speed >= 0) continue;
      allowed = -gap / dt;  // lands on the plane; one found behind it comes back
    }
    const double half_impulse = 0.5 * body.mass(i) * (allowed - speed);
    work.before.*share += half_impulse * n.dot(body.previous_velocity[i]);
    work.after.*share += half_impulse * allowed;
    body.velocity[i] += (allowed - speed) * n;
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
  for (const PrescribedMotion& motion : conditions.motions) constrain_motion(motion, t, dt, body, none);
  for (const Plane& plane : conditions.planes) {
    if (!plane.one_sided) constrain_plane(plane, dt, body, none);
  }
}

void constrain(const Conditions& conditions, double t, double dt, Body& body, KickWork& work) {
  for (const PrescribedMotion& motion : conditions.motions) constrain_motion(motion, t, dt, body, work);
  for (const Plane& plane : conditions.planes) constrain_plane(plane, dt, body, work);
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
