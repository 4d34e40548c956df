// Points that conditions hold, but that rigid tools will move in spite of it.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A warning for each tool and condition if the tool's path meets points whose motion the condition
// prescribes, or that it keeps at a symmetry plane, along the tool's normal, because tools act last. It is a forecast:
// other motions of such points, and tools driven by forces, are not considered.
std::string overruled_motions(const Situation& situation);

}  // namespace strut
