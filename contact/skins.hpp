// How far points may go before the next search.
#pragma once

#include "contact/search.hpp"

namespace strut::contact {

// Collective. The mean of the velocities of the parties' points, m/s.
Vector mean_velocity(const Crowd& crowd, const Parties& parties);

// Collective. Skins for points that go on as they do: `smallest` (m) for nearly all of them, more in proportion to
// their speed beside the mean for the few that are faster, so that these do not decide when the next search is due.
// `dt`: of a step, s; 0 if that is not known, and all skins are the smallest.
Skins skins_by_speed(const Crowd& crowd, const Parties& parties, const Vector& mean_velocity, double smallest,
                     double dt);

// The largest part of its skin that a point of this rank uses in a second, 1/s.
double largest_use(const Crowd& crowd, const Parties& parties, const Vector& mean_velocity, const Skins& skins);

// Collective. The largest part of its skin that any point has used on its way from `places`, beside the mean way.
double part_used(const Crowd& crowd, const Parties& parties, std::span<const Vector> places, const Skins& skins);

}  // namespace strut::contact
