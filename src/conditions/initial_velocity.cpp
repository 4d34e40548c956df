#include "conditions/initial_velocity.hpp"

#include "conditions/value_at_point.hpp"

namespace strut {

void InitialVelocity::set_initial_state(const std::vector<int>& points, double t, Body& body) const {
  for (const int c : components) {
    for (const int i : points) body.velocity[i][c] = value_at_point(value, body, i, t);
  }
}

}  // namespace strut
