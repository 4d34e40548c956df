// Equilibrium by Newton's method: the consistent tangent, GMRES, a line search.
#pragma once

#include "solvers/krylov.hpp"
#include "solvers/search.hpp"

namespace strut {

class Newton {
 public:
  explicit Newton(Equilibrium& equilibrium);

  // Collective. From the present places, within the step that the equilibrium has begun.
  Search solve(const Tolerance& tolerance);

 private:
  int correct(const Field& way, bool moves, double accuracy, Field& step);
  Imbalance advance(const Imbalance& now, const Field& step, bool moves);
  void renew_preconditioner();

  Equilibrium& equilibrium_;
  Krylov krylov_;
  int products_when_new_ = 0;
  bool preconditioner_due_ = true;
};

}  // namespace strut
