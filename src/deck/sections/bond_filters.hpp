// The section Discretization > Bond Filters: initial cracks.
#pragma once

#include <filesystem>
#include <vector>

#include "deck/forward.hpp"
#include "topology/neighbors/cracks.hpp"

namespace strut::deck {

Section bond_filters_section();
std::vector<Crack> read_bond_filters(const Values& discretization, Problems& problems);
// The meshes of shells, as paths from the deck's folder.
std::vector<std::filesystem::path> read_shell_filters(const Values& discretization,
                                                      const std::filesystem::path& folder);

}  // namespace strut::deck
