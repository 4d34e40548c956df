#include <algorithm>
#include <cmath>

#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/mechanics.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

double largest_frequency_bound(const Body& body, const MaterialBlock& block) {
  const auto of_point = [&](int k) { return frequency_bound(body, block, k) * body.step_fraction(block.points[k]); };
  return largest(0, static_cast<int>(block.points.size()), 0, of_point);
}

namespace {

double frequency_bound_of_cell(const Body& body, const MaterialBlock& block, int k) {
  const int i = block.points[k];
  double fastest2 = 0;
  for (int q = 0; q < block.points_per_cell(); ++q) {
    const std::size_t index = block.index(k, q);
    const Tensor F = block.cells[index].deformation_gradient;
    const double speed2 = block.moduli(index).longitudinal() / (3 * body.density[i]);
    fastest2 = std::max(fastest2, speed2 * F.determinant() * F.inverse().squaredNorm());
  }
  return std::sqrt(fastest2 * body.domain.volume(i) * body.fits->steepness(i));
}

}  // namespace

double frequency_bound(const Body& body, const MaterialBlock& block, int k) {
  const int i = block.points[k];
  if (block.is_quadratic()) return frequency_bound_of_cell(body, block, k);
  const MaterialPoint& point = body.points[i];
  const Tensor& F = point.deformation_gradient;
  const double speed2 = block.moduli(k).longitudinal() / body.density[i];
  // tr K⁻¹ of an isotropic family is 9/m; ordinary points may have any family.
  if (block.is_ordinary()) return std::sqrt(speed2 * body.domain.volume(i) * 9 / block.ordinary[k].weighted_volume);
  const double steepness = F.determinant() * F.inverse().squaredNorm();
  return std::sqrt(speed2 * body.domain.volume(i) * trace(body.shape_inverse[i]) / 3 * steepness);
}

std::vector<double> frequency_bounds(const Body& body) {
  std::vector<double> bounds(body.owned(), 0);
  for (const MaterialBlock& block : body.blocks) {
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      bounds[block.points[k]] = frequency_bound(body, block, static_cast<int>(k));
    }
  }
  return bounds;
}

}  // namespace strut
