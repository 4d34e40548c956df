// Line search along a step, by the power of the residual forces.
#pragma once

#include "integrators/quasi_static/equilibrium.hpp"

namespace strut {

void move_by(Body& body, double factor, const Field& step);

// Collective. The power of the search: work of the present residual forces over the displacement `step`, J.
double power_along(const Equilibrium& equilibrium, const Body& body, const Field& step);

struct Stop {
  double fraction = 1;  // of the step
  Imbalance left;
};

// Collective. Call it at the end of the whole step, with the imbalance `left` there; `power`: at the start of the step,
// positive. Stays if the power less `drag` · fraction is not negative there; else moves back, in at most 12
// evaluations, to a fraction at which it is at most half of `power` in size. The norm of the forces is no measure
// beyond a kink, where a point begins to touch or to flow: stiff springs dominate it.
Stop search_downhill(Equilibrium& equilibrium, const Field& step, double power, double drag, const Imbalance& left);

}  // namespace strut
