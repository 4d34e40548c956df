// Contact that cannot withstand an impact, found before the first step (docs/theory.md, "Contact that cannot hold").
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. Warnings, a line each, for points that slip between those of the other body; for two bodies whose
// impact, by their initial velocities, exceeds the pressure that contact withstands before points pass each other;
// for parts of one body whose contact withstands less than the flow stress. Throws Error on all ranks if contact
// could not take the energy of the impact even if all points pressed on all others within reach, and no tool or
// third block may stop them; that is only a warning if the deck continues beyond its limits (Watch > Beyond
// Limits).
std::string weak_contacts(const Situation& situation);

}  // namespace strut
