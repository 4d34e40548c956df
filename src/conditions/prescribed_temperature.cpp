#include "conditions/prescribed_temperature.hpp"

#include "mechanics/body.hpp"

namespace strut {

void PrescribedTemperature::set_initial_state(const std::vector<int>& points, double, Body& body) const {
  add_heated(body, {points, value});
}

}  // namespace strut
