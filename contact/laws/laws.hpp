// All laws of contact. Whoever has one of them asks which it is once for all pairs of two blocks, not for each.
#pragma once

#include <variant>

#include "contact/laws/hertz.hpp"
#include "contact/laws/penalty.hpp"
#include "contact/laws/surface.hpp"

namespace strut::contact {

using PairLaw = std::variant<PenaltyLaw, HertzLaw>;  // of two points
using Law = std::variant<PairLaw, SurfaceLaw>;

// No two points touch from farther than this, m.
inline double radius_of(const Law& law) {
  if (const auto* surface = std::get_if<SurfaceLaw>(&law)) return surface->radius;
  return std::visit([](const ContactLaw auto& one) { return one.radius; }, std::get<PairLaw>(law));
}

// What two blocks do to each other where they touch.
struct Model {
  Law law;
  double friction = 0;  // Coulomb's coefficient
};

}  // namespace strut::contact
