#include "fracture/bond_energies.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mechanics/formulation/stress_pass.hpp"
#include "mechanics/kernels/bonds.hpp"

namespace strut {

namespace {

// Σ ω V |ξ|, m⁴.
double sum_of_lengths(const Body& body, int i) {
  double sum = 0;
  over_family(body, i, [&](int, double w, const Vector& xi) {
    sum += w * std::sqrt(xi[0] * xi[0] + xi[1] * xi[1] + xi[2] * xi[2]);
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

// When a bond breaks, the body loses the energy 2 w − ½ ω (b_i + b_j) e², because the bond's part of θ vanishes, too.
// If this is negative, as under pressure, the bond holds. (The change of θ at both ends by the break is neglected.)
//
// Ends that have expanded unequally have the extensions e − u and e + u. The terms in u are products of two differences
// between the ends, so that both ends get the same bits.
//
// With |a| ≤ |a₀| + growth·d and e ≤ max(e₀, 0) + d, the relative displacement d at which w can first reach w_c is the
// root of a quadratic equation.
BondEnergies::Held BondEnergies::held(const std::array<Lanes, 5>& own, const Point& there, const Lanes& omega,
                                      const Lanes& rest, const Lanes& extension) {
  const Lanes limit = own[0].min(there.limit), a = own[1] + there.a, b = own[2] + there.b;
  const Lanes mean = 0.5 * (own[4] + there.expansion), u = 0.5 * (own[4] - there.expansion) * rest;
  const Lanes stretched = (extension - mean * rest).max(0.0), pull = a * rest + b * stretched;
  const Lanes constant = a.abs() * rest + b * stretched, slope = (own[3] + there.growth) * rest + b;
  const Lanes half = 0.5 * (constant + slope * stretched), left = 2 * limit / omega - constant * stretched;
  const Lanes by_a = u * ((there.a - own[1]) * rest), by_b = 2 * u * (there.b - own[2]) * stretched + b * u.square();
  const Lanes twice = pull * stretched + (by_a + by_b), released = (pull + a * rest) * stretched + (2 * by_a + by_b);
  return {(stretched > 0 && released > 0).select(0.5 * omega * twice / limit, 0.0),
          ((half.square() + slope * left).max(0.0).sqrt() - half) / slope};
}

void BondEnergies::over(const Body& body, const Cluster& cluster, const std::vector<Vector>& places,
                        const Visit& visit) const {
  const Site* sites = body.domain.sites.data();
  const bonds::OfCluster family{cluster};
  const auto y = family.own<3>([&](int i) { return places[i].data(); });
  const auto own = family.own<5>([&](int i) { return &points_[i].limit; });
  const Lanes horizon = family.own<1>([&](int i) { return sites[i].current.data() + 3; })[0];
  bonds::with_influence(body.influence, [&]<class Weight>(Weight) {
    std::size_t n = 0;
    bonds::over(family, sites, bonds::One(), [&](int j, const Lanes&, const auto& xi, const auto& present) {
      Eigen::Array4d there;
      there << places[j].array(), 0;
      const auto eta = bonds::apart(there, bonds::Vector3<Lanes>{{y[0], y[1], y[2]}});
      const Lanes rest = (bonds::dot(xi, xi) + (1 - present)).sqrt(), extension = bonds::dot(eta, eta).sqrt() - rest;
      const Lanes omega = Lanes::Ones() * Weight::of(Lanes(2 * rest / (horizon + sites[j].horizon())));
      const Held of_bond = held(own, points_[j], omega, rest, extension);
      visit(n++, Lanes((present > 0).select(of_bond.load, Lanes::Zero())),
            Lanes((present > 0).select(of_bond.slack, Lanes::Constant(never))));
    });
  });
}

}  // namespace strut
