#include "conditions/body_force.hpp"

#include "mechanics/body.hpp"

namespace strut {

namespace {

// Load at a point, N/m³, times the fraction of inertia of the point that belongs to its body (non-reflecting ends).
double load_at(const Function& value, const Body& body, int i, double t) {
  return body.inertia_fraction(i) * value(body.domain.reference(i), t);
}

}  // namespace

void BodyForce::add_forces(double t, double part, Body& body) const {
  for (const int c : components) {
    for (const int i : points) body.force_density[i][c] += part * load_at(value, body, i, t);
  }
}

void BodyForce::add_work(double t, double impulse_time, const Body& body, ImpulseWork& work) const {
  for (const int c : components) {
    for (const int i : points) {
      const double half_impulse = 0.5 * load_at(value, body, i, t) * body.domain.volume(i) * impulse_time;
      work.before.*ledger_entry += half_impulse * body.previous_velocity[i][c];
      work.after.*ledger_entry += half_impulse * body.velocity[i][c];
    }
  }
}

}  // namespace strut
