#include "contact/at_surface.hpp"

#include <cmath>
#include <numbers>

namespace strut::contact {

namespace {

// |Σ V ξ| over the family, divided by its volume and the horizon: about 0 inside a body.
double one_sidedness(const Domain& domain, int i) {
  Vector sum = Vector::Zero();
  double volume = 0;
  domain.families.for_each(i, [&](int j) {
    sum += domain.volume(j) * (domain.reference(j) - domain.reference(i));
    volume += domain.volume(j);
  });
  return volume > 0 ? sum.norm() / (volume * domain.horizon(i)) : 1;
}

}  // namespace

bool is_at_surface(const Domain& domain, int i) {
  constexpr double least_one_sided = 0.15, least_full = 0.85;
  const double full = 4 * std::numbers::pi / 3 * std::pow(domain.horizon(i), 3);
  return one_sidedness(domain, i) > least_one_sided || family_volume(domain, i) < least_full * full;
}

}  // namespace strut::contact
