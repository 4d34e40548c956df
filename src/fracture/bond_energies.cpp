#include "fracture/bond_energies.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mechanics/formulation/ordinary.hpp"

namespace strut {

namespace {

// Σ ω V |ξ|, m⁴.
double sum_of_lengths(const Body& body, int i) {
  double sum = 0;
  bonds::with_influence(body.influence, [&](auto weight) {
    bonds::over(bonds::OfPoint{{i}, body.domain.families}, body.domain.sites.data(), weight,
                [&](int, double w, const auto& xi, double) { sum += w * std::sqrt(bonds::dot(xi, xi)); });
  });
  return sum;
}

// True for each block of a body in which a block has a critical bond energy. The same on all ranks.
std::vector<char> concerned_blocks(const Body& body) {
  std::vector<char> blocks;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    bool any = false;
    for (std::size_t other = 0; other < body.blocks.size(); ++other) {
      const bool one_body = body.domain.blocks[other].body == body.domain.blocks[b].body;
      const auto& damage = body.blocks[other].material.damage;
      any = any || (one_body && damage && damage->critical_bond_energy);
    }
    if (any && !body.blocks[b].is_ordinary()) {
      throw std::logic_error("a bond that breaks by its energy must be one of ordinary blocks");
    }
    blocks.push_back(any);
  }
  return blocks;
}

}  // namespace

BondEnergies::BondEnergies(const Body& body) : concerned_(concerned_blocks(body)) {
  if (std::find(concerned_.begin(), concerned_.end(), 1) == concerned_.end()) return;
  points_.resize(body.domain.sites.size());
  for (std::size_t number = 0; number < body.blocks.size(); ++number) {
    if (!concerned_[number]) continue;
    const MaterialBlock& block = body.blocks[number];
    const auto moduli = materials::moduli_of(block.material.law);
    const auto& damage = block.material.damage;
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      const int i = block.points[k];
      const double m = block.ordinary[k].weighted_volume;
      if (!(m > 0)) continue;  // the point has no bonds
      const ScalarState of_dilatation = scalar_state(moduli, 3 * sum_of_lengths(body, i) / m, m);
      points_[i] = {.b = of_dilatation.b, .growth = std::abs(of_dilatation.a)};
      if (damage && damage->critical_bond_energy) points_[i].limit = *damage->critical_bond_energy;
    }
  }
  body.domain.halo.exchange<unchanged>(points_);
}

void BondEnergies::take_expansions(const Body& body) {
  const std::vector<double>& expansions = body.expansion_of_sites;
  for (std::size_t i = 0; i < expansions.size(); ++i) points_[i].expansion = expansions[i];
}

std::vector<char> BondEnergies::take_states(const Body& body, double travel) {
  constexpr double margin = 1 + 1e-6;  // for round-off
  std::vector<char> jumped;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& point = points_[i];
    const double a = body.force_states.scalars[i].a + point.b * point.expansion, change = std::abs(a - point.a);
    point.a = a;
    if (change <= margin * point.growth * travel) continue;
    jumped.resize(points_.size());
    jumped[i] = true;
  }
  return jumped;
}

}  // namespace strut
