// The schema of a whole deck, assembled from its sections.
#pragma once

#include "deck/schema.hpp"

namespace strut::deck {

const Section& schema();

}  // namespace strut::deck
