// Points that conditions hold, and that rigid tools move all the same.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. A warning for each tool and condition of which the path of the one runs into points that the other moves
// as given, or keeps at a symmetry plane, along the tool's normal: tools act last. A forecast: what else moves such
// points is not seen, nor where forces drive a tool.
std::string overruled_motions(const Situation& situation);

}  // namespace strut
