#include "conditions/prescribed_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math/time_integral.hpp"
#include "conditions/velocity_update.hpp"

namespace strut {

namespace {

// Component c of the velocity that moves point i along the motion in its next step.
double imposed_velocity(const PrescribedMotion& motion, int c, int i, const VelocityUpdate& update) {
  const Body& body = update.body;
  const auto value = [&](double time) { return update.steps.value(motion.value, body.domain.reference(i), time); };
  const double dt = update.steps.of(i);
  if (motion.is_velocity) return update.steps.velocity_after(value, update.t, dt);
  const double target = body.domain.reference(i)[c] + update.steps.after(value, update.t, dt);
  return (target - body.domain.sites[i].current[c]) / dt;
}

// The slope of a displacement at t, m/s, to second order in a short part of `moment`: for one that grows with t² it is
// 0. If the value jumps at t, or grows there as fast as a root, the mean slope over `moment`, which the first step
// imposes; if the motion begins later, 0.
double slope_of(const auto& value, double t, double moment) {
  const double resolved = 1e4 * std::numeric_limits<double>::epsilon() * std::abs(t);  // s
  const double part = std::min(moment, std::max(moment / 1024, resolved)), at = value(t);
  const double half = value(t + 0.5 * part) - at, whole = value(t + part) - at;
  if (std::abs(whole) < 1.5 * std::abs(half)) return (value(t + moment) - at) / moment;
  const double slope = (4 * half - whole) / part;
  return slope * whole > 0 ? slope : 0;
}

// All points for one component after the other, which equals one condition per component to the last bit.
void for_each_component(const PrescribedMotion& motion, const auto& act) {
  for (const int c : motion.components) {
    for (const int i : motion.points) act(c, i);
  }
}

}  // namespace

void PrescribedMotion::change_velocities(VelocityUpdate& update) const {
  for_each_component(*this, [&](int c, int i) {
    double& v = update.body.velocity[i][c];
    const double imposed = imposed_velocity(*this, c, i, update);
    const double change = imposed - v;
    v = imposed;
    update.record(i, change * Vector::Unit(c));
    if (!update.held.empty()) update.held[i] |= 1 << c;
  });
}

std::optional<PrescribedMotion> PrescribedMotion::in_substeps(const MovingPoints& moving) const {
  return PrescribedMotion{moving.among(points), components, value, is_velocity, reaction_index};
}

void PrescribedMotion::predict_velocities(double t, double moment, const Body& body,
                                          std::vector<Vector>& velocities) const {
  for_each_component(*this, [&](int c, int i) {
    const auto at = [&](double time) { return value(body.domain.reference(i), time); };
    velocities[i][c] = is_velocity ? at(t) : slope_of(at, t, moment);
  });
}

std::vector<HeldDirection> PrescribedMotion::held_directions(const Body& body, double t, double dt) const {
  // A load step may be as long as the run: a velocity is integrated over it.
  const auto value_at = [&](const Vector& X) {
    return is_velocity ? time_integral(value, X, t, t + dt) : value(X, t + dt);
  };
  const bool is_common = !value.depends_on_position() && !points.empty();
  const double common = is_common ? value_at(Vector::Zero()) : 0;
  std::vector<double> displacements;
  for (const int i : points) displacements.push_back(is_common ? common : value_at(body.domain.reference(i)));
  std::vector<HeldDirection> all;
  for (const int c : components) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      const int i = points[k];
      const double from = is_velocity ? body.current(i)[c] : body.domain.reference(i)[c];
      all.push_back({reaction_index, i, Vector::Unit(c), from + displacements[k]});
    }
  }
  return all;
}

}  // namespace strut
