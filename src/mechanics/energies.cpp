#include "mechanics/energies.hpp"

#include <numeric>

#include "mechanics/point_energy.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

Energies stored_energies(const Body& body) {
  Energies sum;
  for (const MaterialBlock& block : body.blocks) {
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      const double volume = body.domain.volume(block.points[k]);
      const PointEnergy of_point =
          block.is_ordinary() ? PointEnergy{.elastic = block.ordinary[k].energy} : law_energy(body, block, k);
      sum.elastic += volume * of_point.elastic;
      sum.dissipated += volume * of_point.dissipated;
      sum.heat += volume * of_point.heat;
    }
  }
  sum.stabilization = total(0, body.owned(), [&](int i) { return body.stabilization_work(i) * body.domain.volume(i); });
  sum.fracture = std::accumulate(body.fracture_energy.begin(), body.fracture_energy.end(), 0.0);
  double values[] = {sum.elastic, sum.dissipated, sum.stabilization, sum.fracture, sum.heat};
  body.domain.communicator.sum(values);
  return {values[0], values[1], values[2], values[3], values[4]};
}

}  // namespace strut
