#include "mechanics/formulation/steepness.hpp"

#include "mechanics/formulation/quadratic_fits.hpp"

namespace strut {

double steepness(const Body& body, int i) {
  const bool is_cell = body.block_of(i).is_quadratic();
  return body.domain.volume(i) * (is_cell ? body.fits->steepness(i) : trace(body.shape_inverse[i]));
}

}  // namespace strut
