// Families with their broken bonds.
#pragma once

#include "topology/domain.hpp"

namespace strut {

// Collective. The largest number of bonds of a point over all ranks, broken bonds included.
std::size_t largest_whole_family(const Domain& domain);

}  // namespace strut
