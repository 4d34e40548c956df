// Bodies whose bonds break as a test moves their points.
#pragma once

#include "fracture/fracture.hpp"
#include "verification/lattice.hpp"

namespace strut {

// As deform(), in a step of one second in which bonds may break.
inline void deform(Body& body, Fracture& fracture, const std::function<Vector(const Vector&)>& place) {
  std::vector<Vector> steps;
  for (int i = 0; i < body.owned(); ++i) steps.push_back(place(body.domain.reference(i)) - body.current(i));
  fracture.start_step(body, steps, 1);
  deform(body, place);
}

}  // namespace strut
