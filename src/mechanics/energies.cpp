#include "mechanics/energies.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "mechanics/formulation/tangent.hpp"
#include "mechanics/steepness.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

namespace {

template <class L>
PointEnergy law_energy(const Body& body, const MaterialBlock& block, const L& law, std::size_t k) {
  const int places = block.points_per_cell();
  const bool carries_stress = steepness(body, block.points[k]) > 0;
  PointEnergy sum;
  for (int q = 0; q < places; ++q) {
    const MaterialPoint point = body.integration_point(block, k, q);
    const auto state = block.state_of<L>(block.index(k, q));
    const double J = point.deformation_gradient.determinant();
    if (carries_stress) sum.elastic += materials::stored_energy_of(law, point.stress, state, J) / places;
    sum.dissipated += law.dissipation(state) / places;
    if constexpr (materials::opens_cracks<L>) sum.cracks += law.crack_work(state) / places;
    if constexpr (materials::tells_heat<L>) sum.heat += law.heat(state) / places;
    if (!block.viscous.empty()) sum.dissipated += block.viscous[block.index(k, q)].work / places;
  }
  return sum;
}

}  // namespace

PointEnergy law_energy(const Body& body, const MaterialBlock& block, std::size_t k) {
  return std::visit([&](const auto& law) { return law_energy(body, block, law, k); }, block.material.law);
}

// ½ K θ² + 15μ/(2m) Σ ω V (e − θ|ξ|/3)²; for a whole family the sum is Σ ω V e² − m θ²/9. With the initial m, this
// stays the potential of the forces as bonds break.
double ordinary_energy(const MaterialBlock& block, const OrdinaryPoint& point, double square) {
  const auto moduli = materials::moduli_of(block.material.law);
  const double theta2 = point.dilatation * point.dilatation;
  return 0.5 * moduli.bulk * theta2 + 7.5 * moduli.shear * (square / point.weighted_volume - theta2 / 9);
}

double work_of_expansion(const Body& body) {
  double sum = 0;
  for (std::size_t i = 0; i < body.expansion.size(); ++i)
    sum += body.expansion[i].work * body.domain.volume(static_cast<int>(i));
  return sum;
}

namespace {

void add_energies(const Body& body, const MaterialBlock& block, Energies& sum) {
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    const double volume = body.domain.volume(block.points[k]);
    const PointEnergy of_point =
        block.is_ordinary() ? PointEnergy{.elastic = block.ordinary[k].energy} : law_energy(body, block, k);
    sum.elastic += volume * of_point.elastic;
    sum.dissipated += volume * (of_point.dissipated - of_point.cracks);
    sum.fracture += volume * of_point.cracks;
    sum.heat += volume * of_point.heat;
  }
}

// Collective.
void sum_over_ranks(std::span<Energies> sums, const Communicator& ranks) {
  std::vector<double> values;
  for (const Energies& sum : sums) {
    values.insert(values.end(),
                  {sum.elastic, sum.dissipated, sum.stabilization, sum.fracture, sum.expansion, sum.heat});
  }
  ranks.sum(values);
  for (std::size_t n = 0; n < sums.size(); ++n) {
    const double* of_one = &values[6 * n];
    sums[n] = {of_one[0], of_one[1], of_one[2], of_one[3], of_one[4], of_one[5]};
  }
}

}  // namespace

Energies stored_energies(const Body& body) {
  Energies sum;
  for (const MaterialBlock& block : body.blocks) add_energies(body, block, sum);
  sum.stabilization = total(0, body.owned(), [&](int i) { return body.stabilization_work(i) * body.domain.volume(i); });
  sum.fracture = std::accumulate(body.fracture_energy.begin(), body.fracture_energy.end(), sum.fracture);
  sum.expansion = work_of_expansion(body);
  sum_over_ranks({&sum, 1}, body.domain.communicator);
  return sum;
}

std::vector<Energies> stored_energies_of_bodies(const Body& body) {
  const Domain& domain = body.domain;
  std::vector<Energies> sums(domain.body_count());
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    Energies& sum = sums[domain.blocks[b].body];
    add_energies(body, body.blocks[b], sum);
    for (const int i : body.blocks[b].points) sum.stabilization += body.stabilization_work(i) * domain.volume(i);
  }
  sum_over_ranks(sums, domain.communicator);
  return sums;
}

double missed_plastic_work(const Body& body, const Committed& start) {
  double sum = 0;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const MaterialBlock& block = body.blocks[b];
    const auto of_block = [&]<class L>(const L& law) {
      if constexpr (materials::tells_plastic_strain<L>) {
        const std::size_t places = block.points_per_cell();
        for (std::size_t n = 0; n < places * block.points.size(); ++n) {
          const std::size_t k = n / places, q = n % places, index = block.index(k, static_cast<int>(q));
          const auto old = state_in<L>(start.state(b), index), now = block.state_of<L>(index);
          const double J = body.integration_point(block, k, static_cast<int>(q)).deformation_gradient.determinant();
          const double flowed = law.plastic_strain(now) - law.plastic_strain(old);
          const double work = 0.5 * J * (law.flow_stress(old) + law.flow_stress(now)) * flowed;
          const double missed = work - (law.dissipation(now) - law.dissipation(old));
          if (flowed > 0 && std::isfinite(work)) {
            sum += body.domain.volume(block.points[k]) * std::max(0.0, missed) / static_cast<double>(places);
          }
        }
      }
    };
    std::visit(of_block, block.material.law);
  }
  return sum;
}

}  // namespace strut
