// The critical stretch or bond energy for which a crack dissipates the given fracture energy, at a given spacing.
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "fracture/separation.hpp"
#include "mechanics/kernels/bonds.hpp"

namespace strut {

namespace {

// C of the springs, Pa/m⁵.
double spring_stiffness(const PulledLattice& lattice, const std::vector<LatticeBond>& family) {
  double trace = 0;
  for (const LatticeBond& bond : family) trace += bond.weight * bond.xi.squaredNorm();
  return lattice.coefficient * lattice.moduli.longitudinal() / (trace / 3);
}

// The energy of a point `layer` layers above the plane, J/m³, at an opening (m), without springs on both ends'
// gradients. Bonds across the plane with an opening of at most `broken` have broken.
class SeparatedPoint {
 public:
  SeparatedPoint(const PulledLattice& lattice, const std::vector<LatticeBond>& family, int layer)
      : lattice_(lattice), family_(family), layer_(layer) {}

  // The gradient of displacements, H = N K⁻¹; N; and Σ ω V |η|² of the displacements.
  struct Fit {
    Tensor gradient, moment;
    double squares;
  };
  Fit fit(double opening, double broken) const;
  double energy(double opening, double broken) const {
    return lattice_.formulation == Formulation::ordinary ? ordinary(opening, broken) : correspondence(opening, broken);
  }

 private:
  bool crosses(const LatticeBond& bond) const { return bond.layers_below > layer_; }
  double ordinary(double opening, double broken) const;
  double correspondence(double opening, double broken) const;

  const PulledLattice& lattice_;
  const std::vector<LatticeBond>& family_;
  int layer_;
};

double SeparatedPoint::ordinary(double opening, double broken) const {
  double m = 0, moment = 0, squares = 0;
  for (const LatticeBond& bond : family_) {
    m += bond.weight * bond.xi.squaredNorm();
    if (!crosses(bond) || bond.opening <= broken) continue;
    const double extension = opening * std::abs(bond.xi[2]) / bond.xi.norm();
    moment += bond.weight * bond.xi.norm() * extension;
    squares += bond.weight * extension * extension;
  }
  const double theta = 3 * moment / m;
  const auto& [bulk, shear] = lattice_.moduli;
  return 0.5 * bulk * theta * theta + 7.5 * shear * (squares / m - theta * theta / 9);
}

double SeparatedPoint::correspondence(double opening, double broken) const {
  const auto [gradient, N, squares] = fit(opening, broken);
  const Tensor strain = 0.5 * (gradient + gradient.transpose());
  const auto& [bulk, shear] = lattice_.moduli;
  const double trace = strain.trace();
  const double elastic = 0.5 * (bulk - 2 * shear / 3) * trace * trace + shear * strain.squaredNorm();
  if (lattice_.springs != ResidualKind::own_gradient) return elastic;
  return elastic + 0.5 * spring_stiffness(lattice_, family_) * (squares - (N.transpose() * gradient).trace());
}

SeparatedPoint::Fit SeparatedPoint::fit(double opening, double broken) const {
  Tensor K = Tensor::Zero();
  Fit fit{Tensor::Zero(), Tensor::Zero(), 0};
  const Vector apart(0, 0, -opening);  // displacement of a far end below the plane
  for (const LatticeBond& bond : family_) {
    if (crosses(bond) && bond.opening <= broken) continue;
    K += bond.weight * bond.xi * bond.xi.transpose();
    if (!crosses(bond)) continue;
    fit.moment += bond.weight * apart * bond.xi.transpose();
    fit.squares += bond.weight * apart.squaredNorm();
  }
  fit.gradient = fit.moment * K.inverse();
  return fit;
}

// Energy of the springs on both ends' gradients over the layers of one half, J/m³: ½ C Σ ω V |η − ½ (H_i + H_j) ξ|² per
// point. The halves are mirror images, and H has only the component along the normal.
double energy_of_mean_springs(const PulledLattice& lattice, const std::vector<LatticeBond>& family, int layers,
                              double opening, double broken) {
  std::vector<double> stretch(2 * layers, 0);  // layers farther away have no bond across the plane
  for (int layer = 0; layer < layers; ++layer) {
    stretch[layer] = SeparatedPoint(lattice, family, layer).fit(opening, broken).gradient(2, 2);
  }
  const auto of = [&](int layer) { return layer < 2 * layers ? stretch[layer] : 0.0; };
  double sum = 0;
  for (int layer = 0; layer < 2 * layers; ++layer) {
    for (const LatticeBond& bond : family) {
      const bool crosses = bond.layers_below > layer;
      if (crosses && bond.opening <= broken) continue;
      const int far = crosses ? bond.layers_below - layer - 1 : layer - bond.layers_below;
      const double z = (crosses ? -opening : 0) - 0.5 * (of(layer) + of(far)) * bond.xi[2];
      sum += 0.5 * bond.weight * z * z;
    }
  }
  return spring_stiffness(lattice, family) * sum;
}

// The energy of the layers of one half, J/m³.
double energy_of_half(const PulledLattice& lattice, const std::vector<LatticeBond>& family, int layers, double opening,
                      double broken) {
  double sum = 0;
  for (int layer = 0; layer < layers; ++layer) {
    sum += SeparatedPoint(lattice, family, layer).energy(opening, broken);
  }
  if (lattice.springs != ResidualKind::both_gradients || !(lattice.coefficient > 0)) return sum;
  return sum + energy_of_mean_springs(lattice, family, layers, opening, broken);
}

// The family of a point of each row.
std::vector<std::vector<LatticeBond>> families_of_rows(const PulledLattice& lattice) {
  std::vector<std::vector<LatticeBond>> families(std::max(1, lattice.rows), family_of(lattice));
  for (int row = 0; row < std::ssize(families); ++row) {
    std::erase_if(families[row], [&](const LatticeBond& bond) { return far_row(lattice, bond, row) < 0; });
  }
  return families;
}

}  // namespace

double energy_of_separation(const PulledLattice& lattice) {
  if (lattice.formulation == Formulation::quadratic) return separation_of_cells(lattice);
  const std::vector<std::vector<LatticeBond>> families = families_of_rows(lattice);
  const auto [openings, layers] = openings_of(family_of(lattice));
  double released = 0, before = 0;
  for (const double opening : openings) {
    if (opening <= before * (1 + 1e-12)) continue;
    const double after = opening * (1 + 1e-12);
    for (const std::vector<LatticeBond>& family : families) {
      released += energy_of_half(lattice, family, layers, opening, before) -
                  energy_of_half(lattice, family, layers, opening, after);
    }
    before = after;
  }
  return 2 * lattice.spacing * released / static_cast<double>(families.size());  // both halves
}

GradualCrack gradual_crack(const PulledLattice& lattice, double fracture_energy) {
  constexpr double zone = 4;                    // E G_c/σ_c², spacings: fewer do not resolve the zone that softens
  double trace = 0, stretches = 0, across = 0;  // stretches: sum of their squares at an opening of 1 m
  const std::vector<LatticeBond> family = family_of(lattice);
  std::vector<double> parts(openings_of(family).layers, 0);  // gradients of the layers, first times K
  for (const LatticeBond& bond : family) {
    trace += bond.weight * bond.xi.squaredNorm();
    if (bond.layers_below <= 0) continue;
    for (int layer = 0; layer < bond.layers_below; ++layer) parts[layer] += bond.weight * std::abs(bond.xi[2]);
    stretches += bond.layers_below / (bond.opening * bond.opening), across += bond.layers_below;
  }
  double squares = 0;  // Σ g², 1/m²; both halves are alike
  for (const double part : parts) squares += 2 * std::pow(part / (trace / 3), 2);
  const auto [bulk, shear] = lattice.moduli;
  const double young = 9 * bulk * shear / (3 * bulk + shear);
  double springs = 0;  // their energy over that of the layers: they fall alike
  if (lattice.springs == ResidualKind::both_gradients) {
    const double of_layers = 0.25 * lattice.moduli.longitudinal() * squares;
    springs = energy_of_mean_springs(lattice, family, static_cast<int>(parts.size()), 1, 0) / of_layers;
  }
  const double of_points = fracture_energy / (1 + springs);
  const double strength = std::sqrt(young * of_points / (zone * lattice.spacing)), last = 2 * of_points / strength;
  return {strength, (1 + springs) / (lattice.spacing * squares), last * std::sqrt(stretches / across)};
}

namespace {

// The longest bond of a block on all ranks, m. By quadratic correspondence a family may be the touching cells, whatever
// the horizon.
double longest_bond(const Body& body, const MaterialBlock& block) {
  double longest = 0;
  for (const int i : block.points) {
    body.domain.families.for_each(
        i, [&](int j) { longest = std::max(longest, (body.domain.reference(j) - body.domain.reference(i)).norm()); });
  }
  return body.domain.communicator.max(longest);
}

PulledLattice lattice_of(const Body& body, std::size_t b) {
  const BlockMaterial& material = body.blocks[b].material;
  const BlockHorizons& of_block = body.domain.blocks[b];
  const auto moduli = materials::moduli_of(material.law);
  const double horizon = body.blocks[b].is_quadratic() ? longest_bond(body, body.blocks[b]) : of_block.largest;
  return {of_block.spacing,
          horizon,
          body.influence,
          material.formulation,
          moduli,
          residual_of(material.stabilization),
          coefficient_of(material.stabilization)};
}

void set_gradual_crack(BlockMaterial& material, const GradualCrack& crack) {
  const auto set = [&crack]<class L>(L& law) {
    if constexpr (materials::opens_cracks<L>) law.set_crack(crack.strength, crack.width);
  };
  std::visit(set, material.law);
  material.damage->critical_stretch = Function(crack.critical_stretch);
}

}  // namespace

double part_in_plates(const Body& body, std::size_t block, int layers) {
  PulledLattice lattice = lattice_of(body, block);
  const bool by_energy = body.blocks[block].material.damage->critical_bond_energy.has_value();
  const auto energy = [&] { return by_energy ? separation_by_bond_energy(lattice) : energy_of_separation(lattice); };
  const double without_faces = energy();
  lattice.rows = layers;
  return energy() / without_faces;
}

void set_critical_values(Body& body) {
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    auto& damage = body.blocks[b].material.damage;
    if (!damage || !(damage->fracture_energy > 0)) continue;
    if (!(body.domain.blocks[b].spacing > 0)) continue;  // no points
    const PulledLattice lattice = lattice_of(body, b);
    if (damage->is_gradual) {
      if (!body.blocks[b].is_quadratic() && openings_of(family_of(lattice)).layers != 1) {  // the same on all ranks
        throw Error("Damage Models: block '" + body.blocks[b].name +
                    "' has cracks by 'Cohesive Crack', which open between two layers of points; expected a horizon of "
                    "more than one and less than two spacings, such as a Horizon Factor of 1.75");
      }
      set_gradual_crack(body.blocks[b].material, gradual_crack(lattice, damage->fracture_energy));
      continue;
    }
    const bool by_energy = damage->critical_bond_energy.has_value();
    const double energy = by_energy ? separation_by_bond_energy(lattice) : energy_of_separation(lattice);
    if (!(energy > 0)) {  // the same on all ranks
      throw Error("Damage Models: block '" + body.blocks[b].name +
                  "' has a Fracture Energy, but no bonds from one layer of points to the next; expected a horizon of "
                  "more than a spacing");
    }
    const double ratio = damage->fracture_energy / energy;
    if (by_energy) {
      damage->critical_bond_energy = ratio;
    } else {
      damage->critical_stretch = Function(std::sqrt(ratio));
    }
  }
}

void set_crack_lengths(Body& body) {
  constexpr double cells_reach = 1.75;  // spacings; reach of families of touching cells
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const BlockHorizons& of_block = body.domain.blocks[b];
    const double reach = body.blocks[b].is_quadratic() ? cells_reach * of_block.spacing : of_block.largest;
    const auto set = [reach]<class L>(L& law) {
      if constexpr (materials::takes_crack_length<L>) law.set_crack_length(2 * reach);
    };
    std::visit(set, body.blocks[b].material.law);
  }
}

}  // namespace strut
