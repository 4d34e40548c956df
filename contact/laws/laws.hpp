// All laws of contact. Whoever has one of them asks which it is once for all pairs of two blocks, not for each.
#pragma once

#include <variant>

#include "contact/laws/hertz.hpp"
#include "contact/laws/penalty.hpp"

namespace strut::contact {

using Law = std::variant<PenaltyLaw, HertzLaw>;

// r_c, m.
inline double radius_of(const Law& law) {
  return std::visit([](const ContactLaw auto& one) { return one.radius; }, law);
}

// What two blocks do to each other where they touch.
struct Model {
  Law law;
  double friction = 0;  // Coulomb's coefficient
};

}  // namespace strut::contact
