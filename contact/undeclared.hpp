// Interpenetration of material without a declared contact: between bodies, and within a body that folds.
#pragma once

#include <cstdint>
#include <optional>

#include "contact/contact.hpp"
#include "topology/domain.hpp"

namespace strut::contact {

struct Undeclared {
  std::int64_t points = 0;  // at surfaces, of all blocks without contact, that are inside others
  // `point`: on one rank the local index of one of them, −1 on others; there also its blocks, equal for a block with
  // itself.
  int point = -1, first = -1, second = -1;
};

// Collective. Points at surfaces that have come closer than half a spacing to others at surfaces: of another body, or
// of the same body if they started more than two horizons apart. Free if all blocks may touch each other and
// themselves, or if hardly anything has moved.
std::optional<Undeclared> find_undeclared(const Domain& domain, const Contact& contact);

}  // namespace strut::contact
