// Interface by which a stress update breaks bonds; fracture implements it.
#pragma once

#include "mechanics/body.hpp"

namespace strut {

enum class Part;

class BondBreaking {
 public:
  virtual ~BondBreaking() = default;

  // break_bonds is called before the stress update of a part of the points, count_dissipation after it. The step of dt
  // (s) ends at `time` (s); the neighbors' positions must be current.
  virtual void break_bonds(Body& body, Part part, double time, double dt) = 0;
  virtual void count_dissipation(Body& body, Part part) = 0;
  // Called after the stress update of all points.
  virtual void finish_step() = 0;
  // Called after the sum of forces if there are springs on the gradients of both ends.
  virtual void count_springs(Body& body) = 0;
};

}  // namespace strut
