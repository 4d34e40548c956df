// Connected pieces of a body: sets of points that are connected by bonds.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "topology/domain.hpp"

namespace strut {

// Collective. For each owned point, the least id of the points of its piece.
std::vector<std::int64_t> piece_ids(const Domain& domain);
// The same with only the bonds for which joins(owned point, point) is true; joins must be symmetric.
std::vector<std::int64_t> piece_ids(const Domain& domain, const std::function<bool(int, int)>& joins);

// Collective. For each owned point, the number of its piece, in the order of their least ids; and the number of pieces.
std::pair<std::vector<int>, int> numbered_pieces(const Domain& domain);

}  // namespace strut
