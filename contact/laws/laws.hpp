// All contact laws. The type of the law is resolved once for all pairs of two blocks, not for each pair.
#pragma once

#include <variant>

#include "contact/laws/hertz.hpp"
#include "contact/laws/penalty.hpp"
#include "contact/laws/surface.hpp"

namespace strut::contact {

using PairLaw = std::variant<PenaltyLaw, HertzLaw>;  // between points
using Law = std::variant<PairLaw, SurfaceLaw>;

// Upper bound of the touching distance, m.
inline double radius_of(const Law& law) {
  if (const auto* surface = std::get_if<SurfaceLaw>(&law)) return surface->radius;
  return std::visit([](const ContactLaw auto& one) { return one.radius; }, std::get<PairLaw>(law));
}

// The contact model of two blocks.
struct Model {
  Law law;
  double friction = 0;  // Coulomb's coefficient
};

}  // namespace strut::contact
