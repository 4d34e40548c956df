// Families with their broken bonds.
#pragma once

#include "topology/domain.hpp"

namespace strut {

// Collective. The largest number of bonds, broken ones included, of a point of any rank.
std::size_t largest_whole_family(const Domain& domain);

}  // namespace strut
