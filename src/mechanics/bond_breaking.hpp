// What breaks bonds takes part in a stress update; fracture implements it.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

enum class Part;

class BondBreaking {
 public:
  virtual ~BondBreaking() = default;

  // Before the stress of a part of the points is updated over the step of dt (s) that ends at `time` (s), with their
  // neighbors' positions current; and after it.
  virtual void break_bonds(Body& body, Part part, double time, double dt) = 0;
  virtual void count_dissipation(Body& body, Part part) = 0;
  // After the stress of all points.
  virtual void finish_step() = 0;
  // After the sum of forces, where there are springs on the gradients of both ends.
  virtual void count_springs(Body& body) = 0;
};

}  // namespace strut
