#include "mechanics/energies.hpp"

#include "points/parallel_for.hpp"

namespace strut {

namespace {

template <class L>
void add_energies(const Body& body, const MaterialBlock& block, const L& law, Energies& sum) {
  const int places = block.places_a_point();
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    const double volume = body.domain.volume(block.points[k]) / places;
    for (int q = 0; q < places; ++q) {
      const MaterialPoint& point = body.law_point(block, k, q);
      const auto state = block.state_of<L>(block.place(k, q));
      sum.elastic += point.deformation_gradient.determinant() * law.elastic_energy(point.stress, state) * volume;
      sum.dissipated += law.dissipation(state) * volume;
      if (!block.viscous.empty()) sum.dissipated += block.viscous[block.place(k, q)].work * volume;
    }
  }
}

void add_ordinary_energies(const Body& body, const MaterialBlock& block, Energies& sum) {
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    sum.elastic += block.ordinary[k].energy * body.domain.volume(block.points[k]);
  }
}

}  // namespace

Energies stored_energies(const Body& body) {
  Energies sum;
  for (const MaterialBlock& block : body.blocks) {
    if (block.is_ordinary()) {
      add_ordinary_energies(body, block, sum);
    } else {
      std::visit([&](const auto& law) { add_energies(body, block, law, sum); }, block.material.law);
    }
  }
  sum.stabilization = total(0, body.owned(), [&](int i) { return body.stabilization_work(i) * body.domain.volume(i); });
  double values[] = {sum.elastic, sum.dissipated, sum.stabilization};
  body.domain.communicator.sum(values);
  return {values[0], values[1], values[2]};
}

}  // namespace strut
