#include "conditions/initial_state.hpp"

#include "conditions/value_at_point.hpp"

namespace strut {

void InitialDisplacement::set_initial_state(const std::vector<int>& points, double t, Body& body) const {
  for (const int c : components) {
    for (const int i : points) {
      body.domain.sites[i].current[c] = body.domain.reference(i)[c] + value_at_point(value, body, i, t);
    }
  }
}

void InitialVelocity::set_initial_state(const std::vector<int>& points, double t, Body& body) const {
  for (const int c : components) {
    for (const int i : points) body.velocity[i][c] = value_at_point(value, body, i, t);
  }
}

}  // namespace strut
