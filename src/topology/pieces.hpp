// The connected pieces of a body: points that bonds lead to from each other.
#pragma once

#include <cstdint>
#include <vector>

#include "topology/domain.hpp"

namespace strut {

// Collective. Of each owned point the least id of the points of its piece.
std::vector<std::int64_t> piece_ids(const Domain& domain);

// Collective. How many pieces there are.
std::int64_t count_pieces(const Domain& domain);

}  // namespace strut
