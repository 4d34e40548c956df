#include "conditions/prototype.hpp"

#include "mechanics/body.hpp"

namespace strut {

void InitialDisplacement::set_initial_state(const std::vector<int>& points, double t, Body& body) const {
  for (const int c : components) {
    for (const int i : points) {
      body.domain.sites[i].current[c] = body.domain.reference(i)[c] + value(body.domain.reference(i), t);
    }
  }
}

void InitialVelocity::set_initial_state(const std::vector<int>& points, double t, Body& body) const {
  for (const int c : components) {
    for (const int i : points) body.velocity[i][c] = value(body.domain.reference(i), t);
  }
}

void PrescribedTemperature::set_initial_state(const std::vector<int>& points, double, Body& body) const {
  add_heated(body, {points, value});
}

}  // namespace strut
