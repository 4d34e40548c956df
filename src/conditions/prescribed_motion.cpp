#include "conditions/prescribed_motion.hpp"

#include "conditions/value_at_point.hpp"
#include "conditions/velocity_update.hpp"

namespace strut {

namespace {

// The velocity that carries point i along the motion from t to t + dt.
double imposed_velocity(const PrescribedMotion& motion, const Body& body, int i, double t, double dt) {
  if (motion.is_velocity) return value_at_point(motion.value, body, i, t + 0.5 * dt);
  const double target = body.domain.reference(i)[motion.component] + value_at_point(motion.value, body, i, t + dt);
  return (target - body.domain.sites[i].current[motion.component]) / dt;
}

// Where the motion takes its component of the place of point i, m.
double target_of(const PrescribedMotion& motion, const Body& body, int i, double t, double dt) {
  const auto value = [&](double time) { return value_at_point(motion.value, body, i, time); };
  if (motion.is_velocity) return body.current(i)[motion.component] + dt * value(t + 0.5 * dt);
  return body.domain.reference(i)[motion.component] + value(t + dt);
}

}  // namespace

void PrescribedMotion::change_velocities(VelocityUpdate& update) const {
  for (const int i : points) {
    double& v = update.body.velocity[i][component];
    const double imposed = imposed_velocity(*this, update.body, i, update.t, update.steps.of(i));
    const double change = imposed - v;
    v = imposed;
    update.record(i, change * Vector::Unit(component));
  }
}

std::optional<PrescribedMotion> PrescribedMotion::in_substeps(const MovingPoints& moving) const {
  return PrescribedMotion{moving.among(points), component, value, is_velocity, reaction_place};
}

void PrescribedMotion::predict_velocities(double t, double moment, const Body& body,
                                          std::vector<Vector>& velocities) const {
  for (const int i : points) {
    const auto at = [&](double time) { return value_at_point(value, body, i, time); };
    velocities[i][component] = is_velocity ? at(t) : (at(t + moment) - at(t)) / moment;
  }
}

std::vector<HeldDirection> PrescribedMotion::held_directions(const Body& body, double t, double dt) const {
  std::vector<HeldDirection> all;
  for (const int i : points) {
    all.push_back({reaction_place, i, Vector::Unit(component), target_of(*this, body, i, t, dt)});
  }
  return all;
}

}  // namespace strut
