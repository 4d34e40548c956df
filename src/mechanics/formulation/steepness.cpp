#include "mechanics/formulation/steepness.hpp"

#include <cmath>

#include "mechanics/formulation/quadratic_fits.hpp"
#include "topology/planes_through.hpp"

namespace strut {

double steepness(const Body& body, int i) {
  const bool is_cell = body.block_of(i).is_quadratic();
  return body.domain.volume(i) * (is_cell ? body.fits->steepness(i) : trace(body.shape_inverse[i]));
}

double flatness(const Domain& domain, int i) {
  const double volume = coincident_images(domain, i) * domain.volume(i);
  return std::pow(volume, 5.0 / 3) * family_spread(domain, i).inverse().trace();
}

}  // namespace strut
