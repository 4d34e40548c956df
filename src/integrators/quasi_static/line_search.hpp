// How far to go along a step, by the power of the residual forces.
#pragma once

#include "integrators/quasi_static/equilibrium.hpp"

namespace strut {

void move_by(Body& body, double factor, const Field& step);

// Collective. The work of the forces that are left, along a step as long as this one, J.
double power_along(const Equilibrium& equilibrium, const Body& body, const Field& step);

struct Stop {
  double fraction = 1;  // of the step
  Imbalance left;
};

// Collective. From the end of the whole step, where `left` is what is left; `power` is that at its start, positive.
// Goes to where it has fallen to a half of that, with `drag` · fraction taken off: beyond a kink, a point that begins
// to touch or to flow, the norm of the forces says nothing, for stiff springs have most of it.
Stop search_downhill(Equilibrium& equilibrium, const Field& step, double power, double drag, const Imbalance& left);

}  // namespace strut
