// The section Discretization > Bond Filters: initial cracks.
#pragma once

#include <vector>

#include "deck/forward.hpp"
#include "topology/neighbors/cracks.hpp"

namespace strut::deck {

Section bond_filters_section();
std::vector<Crack> read_bond_filters(const Values& discretization, Problems& problems);

}  // namespace strut::deck
