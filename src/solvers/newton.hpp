// Equilibrium by Newton's method: the consistent tangent, GMRES, a line search.
#pragma once

#include <functional>
#include <string>

#include "solvers/equilibrium.hpp"
#include "solvers/krylov.hpp"

namespace strut {

// How a search for equilibrium went.
struct Search {
  bool converged = false;
  int iterations = 0;
  int products = 0;  // of the tangent with a field, or evaluations of the forces by relaxation
  Imbalance left;
};

// What both methods are asked for.
struct Tolerance {
  double relative = 1e-6;  // the forces that are left, over reactions, loads and contact
  int most_iterations = 20;
};

class Newton {
 public:
  explicit Newton(Equilibrium& equilibrium);

  // Collective. From the present places, within the step that the equilibrium has begun.
  Search solve(const Tolerance& tolerance);

 private:
  int correct(const Imbalance& now, const Field& way, double accuracy, Field& step);
  Imbalance advance(const Imbalance& now, const Field& step, bool is_first);
  void renew_preconditioner();

  Equilibrium& equilibrium_;
  Krylov krylov_;
  int products_when_new_ = 0;
  bool preconditioner_due_ = true;
};

}  // namespace strut
