// What the methods of finding an equilibrium are asked for, and how it went.
#pragma once

#include "solvers/equilibrium.hpp"

namespace strut {

struct Tolerance {
  double relative = 1e-6;    // the forces that are left, over reactions, loads and contact
  int most_iterations = 20;  // Newton's
};

struct Search {
  bool converged = false;
  int iterations = 0;
  int evaluations = 0;  // of the forces, or of the tangent times a field
  Imbalance left;
};

inline bool is_balanced(const Imbalance& now, const Tolerance& tolerance) {
  return !now.failed && now.norm <= tolerance.relative * now.scale;
}

}  // namespace strut
