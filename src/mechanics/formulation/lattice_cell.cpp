#include "mechanics/formulation/lattice_cell.hpp"

#include "mechanics/formulation/cell_fit.hpp"

namespace strut {

CellWeights lattice_cell(double spacing, const std::vector<FitBond>& family) {
  const double volume = spacing * spacing * spacing;
  QuadraticFit fit;
  set_cell(cube_of(volume), fit);
  const auto over = [&](const auto& visit) {
    for (const FitBond& bond : family) visit(bond.weight, volume, bond.xi);
  };
  CellWeights weights;
  if (!fit_motion(sums_of_family(spacing, volume, over), spacing, volume, least_penalty, fit)) return weights;
  std::array<Vector, 4> own;
  own.fill(Vector::Zero());
  for (const FitBond& bond : family) {
    std::array<Vector, 4>& of_bond = weights.bonds.emplace_back();
    for (int q = 0; q < 4; ++q) {
      of_bond[q] = weight_of_bond(fit, volume, bond.weight, bond.xi, Eigen::Array4d::Zero(), place_of(fit, q));
      weights.steepness += of_bond[q].squaredNorm() / 4;
      own[q] -= of_bond[q];
    }
  }
  for (const Vector& g : own) weights.steepness += g.squaredNorm() / 4;
  return weights;
}

}  // namespace strut
