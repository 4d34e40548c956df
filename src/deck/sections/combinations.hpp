// Checks of what several sections say together: keys without a meaning in equilibria, which have no inertia, or for a
// law of rates, which has no strain at the start; thermal expansion.
#pragma once

#include <vector>

#include "deck/sections/blocks.hpp"
#include "deck/sections/conditions.hpp"
#include "deck/sections/contact.hpp"
#include "deck/sections/damage_models.hpp"
#include "deck/sections/solver.hpp"

namespace strut::deck {

// `steps_follow`: explicit steps follow the equilibria, and what needs inertia begins there, also bonds that cannot
// break in equilibria; but stress that falls before bonds break would fall in the equilibria already.
void check_quasi_static(const Solver& solver, const std::vector<Condition>& conditions,
                        const std::vector<ContactModel>& contact_models, const std::vector<Material>& materials,
                        const std::vector<Block>& blocks, const std::vector<NamedDamageModel>& damage_models,
                        bool steps_follow, Problems& problems);

void check_initial_strains(const std::vector<Condition>& conditions, const std::vector<Material>& materials,
                           Problems& problems);

// `has_expanded`: bodies may have thermal strains at the start.
void check_temperatures(const std::vector<Material>& materials, const std::vector<Condition>& conditions,
                        bool has_expanded, Problems& problems);

}  // namespace strut::deck
