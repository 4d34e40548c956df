#include "conditions/body_force.hpp"

#include "conditions/value_at_point.hpp"

namespace strut {

void BodyForce::add_forces(double t, Body& body) const {
  for (const int c : components) {
    for (const int i : points) body.force_density[i][c] += value_at_point(value, body, i, t);
  }
}

void BodyForce::add_work(double t, double impulse_time, const Body& body, ImpulseWork& work) const {
  for (const int c : components) {
    for (const int i : points) {
      const double half_impulse = 0.5 * value_at_point(value, body, i, t) * body.domain.volume(i) * impulse_time;
      work.before.*ledger_entry += half_impulse * body.previous_velocity[i][c];
      work.after.*ledger_entry += half_impulse * body.velocity[i][c];
    }
  }
}

}  // namespace strut
