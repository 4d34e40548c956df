// Line search along a step, by the power of the residual forces.
#pragma once

#include "integrators/quasi_static/equilibrium.hpp"

namespace strut {

void move_by(Body& body, double factor, const Field& step);

// Collective. The work of the residual forces along another step as long as this one, J.
double power_along(const Equilibrium& equilibrium, const Body& body, const Field& step);

struct Stop {
  double fraction = 1;  // of the step
  Imbalance left;
};

// Collective. Starts at the end of the whole step, with the imbalance `left`; `power`: at the start, positive. Goes to
// where the power, minus `drag` · fraction, has fallen to half: beyond a kink, where a point begins to touch or to
// flow, the norm of the forces is no measure, because stiff springs dominate it.
Stop search_downhill(Equilibrium& equilibrium, const Field& step, double power, double drag, const Imbalance& left);

}  // namespace strut
