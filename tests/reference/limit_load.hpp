// A clamped and guided square strut of an ideally plastic metal: one end is held, the other moves across without
// turning. Plastic hinges at both ends carry F = 2 M_p/L, M_p = σ_y a³/4 (README.md has what refined finite elements
// say).
#pragma once

#include <functional>

#include "schemes.hpp"

namespace strut::reference {

// Calls at(d, F, balance error) as the deflection d grows to `furthest`, in `steps` equal load steps; d over that at
// which an elastic beam would carry the limit load, σ_y L²/(2 E a), F over 2 M_p/L. Throws Error where no equilibrium
// is found.
void bend_to_limit(const Scheme& scheme, PointsAt points, int across, double furthest, int steps,
                   const std::function<void(double, double, double)>& at);

}  // namespace strut::reference
