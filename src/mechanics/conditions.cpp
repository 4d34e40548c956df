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

void constrain_motion(const PrescribedMotion& motion, double t, double dt, Body& body, Work& work) {
  const int c = motion.component;
  for (const int i : motion.points) {
    double& v = body.velocity[i][c];
    const double imposed = motion_velocity(motion, body, i, t, dt);
    work.external += body.mass(i) * (imposed - v) * 0.5 * (body.previous_velocity[i][c] + imposed);
    v = imposed;
  }
}

void constrain_plane(const Plane& plane, double dt, Body& body, Work& work) {
  const Vector& n = plane.normal;
  for (const int i : plane.points) {
    const double speed = n.dot(body.velocity[i]);
    double allowed = 0;
    if (plane.one_sided) {
      const double gap = n.dot(body.current(i) - plane.point);
      if (gap + dt * speed >= 0) continue;
      allowed = -gap / dt;  // lands on the plane; one found behind it comes back
    }
    const double mean = 0.5 * (n.dot(body.previous_velocity[i]) + allowed);
    (plane.one_sided ? work.contact : work.external) += body.mass(i) * (allowed - speed) * mean;
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
  Work none;
  for (const PrescribedMotion& motion : conditions.motions) constrain_motion(motion, t, dt, body, none);
  for (const Plane& plane : conditions.planes) {
    if (!plane.one_sided) constrain_plane(plane, dt, body, none);
  }
}

void constrain(const Conditions& conditions, double t, double dt, Body& body, Work& work) {
  for (const PrescribedMotion& motion : conditions.motions) constrain_motion(motion, t, dt, body, work);
  for (const Plane& plane : conditions.planes) constrain_plane(plane, dt, body, work);
}

double work_of_body_forces(const Conditions& conditions, double t, double kick, const Body& body) {
  double work = 0;
  for (const BodyForce& load : conditions.body_forces) {
    for (const int i : load.points) {
      const double mean = 0.5 * (body.previous_velocity[i] + body.velocity[i])[load.component];
      work += at_point(load.value, body, i, t) * body.domain.volumes[i] * kick * mean;
    }
  }
  return work;
}

}  // namespace strut
