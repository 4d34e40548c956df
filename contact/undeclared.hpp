// Material that goes through material where the deck declares no contact: between bodies, and of a body that folds.
#pragma once

#include <cstdint>
#include <optional>

#include "contact/contact.hpp"
#include "topology/domain.hpp"

namespace strut::contact {

struct Undeclared {
  std::int64_t points = 0;  // at surfaces, of all blocks without contact, that are inside of others
  // On one rank, of its own: local index and blocks, the same of a block with itself; −1 on the others.
  int point = -1, first = -1, second = -1;
};

// Collective. Points at surfaces that have come nearer than half a spacing to others at surfaces: of another body than
// their own, or of the same one where they were farther than two horizons from each other. Free where all blocks may
// touch each other and themselves, or hardly anything has moved.
std::optional<Undeclared> find_undeclared(const Domain& domain, const Contact& contact);

}  // namespace strut::contact
