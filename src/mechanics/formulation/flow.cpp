#include "mechanics/formulation/flow.hpp"

#include "mechanics/formulation/quadratic_fits.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

namespace {

bool has_flowed(const MaterialBlock& block, int k) {
  const auto at_any_place = [&]<class L>(const L& law) {
    bool any = false;
    if constexpr (materials::tells_flow<L>) {
      for (int q = 0; q < 4 && !any; ++q) any = law.has_flowed(block.state_of<L>(block.index(k, q)));
    }
    return any;
  };
  return std::visit(at_any_place, block.material.law);
}

}  // namespace

bool begin_flow(Body& body, MaterialBlock& block, int k) {
  const int i = block.points[k];
  if (block.flowed[k] || !body.fits->carries_stress(i) || !has_flowed(block, k)) return false;
  block.flowed[k] = 1;
  body.fits->refit_in_flow(body, i);
  for (int q = 0; q < 4; ++q) {
    const std::size_t index = block.index(k, q);
    MaterialPoint point = block.cells[index];
    point.deformation_gradient = body.fits->gradient_at(body, i, q, [&](int j) { return body.domain.current(j); });
    point.rotation = Rotation(polar_rotation(point.deformation_gradient));
    block.cells->set(index, point);
  }
  return true;
}

bool begin_flow(Body& body) {
  bool any = false;
  for (MaterialBlock& block : body.blocks) {
    for (int k = 0; k < std::ssize(block.flowed); ++k) any = begin_flow(body, block, k) || any;
  }
  return any;
}

void refit_flowed(Body& body) {
  for (const MaterialBlock& block : body.blocks) {
    for_each_point(0, static_cast<int>(block.flowed.size()), [&](int k) {
      const int i = block.points[k];
      if (block.flowed[k] && body.fits->carries_stress(i)) body.fits->refit_in_flow(body, i);
    });
  }
}

}  // namespace strut
