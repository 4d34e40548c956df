// Keys without a meaning in equilibria, which have no inertia.
#pragma once

#include <vector>

#include "deck/sections/blocks.hpp"
#include "deck/sections/conditions.hpp"
#include "deck/sections/contact.hpp"
#include "deck/sections/solver.hpp"

namespace strut::deck {

void check_quasi_static(const Solver& solver, const std::vector<Condition>& conditions,
                        const std::vector<ContactModel>& contact_models, const std::vector<Block>& blocks,
                        Problems& problems);

}  // namespace strut::deck
