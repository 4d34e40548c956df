#include <algorithm>
#include <array>
#include <cmath>

#include "fracture/separation.hpp"
#include "mechanics/formulation/cell_fit.hpp"
#include "mechanics/kernels/bonds.hpp"

namespace strut {

namespace {

// A cell `layer` layers above the plane as the halves move apart, with the strains that its stress has followed; after
// a break these differ from those of its fit (refit_in_step).
class SeparatedCell {
 public:
  SeparatedCell(const PulledLattice& lattice, std::vector<LatticeBond> family, int layer, double most)
      : lattice_(lattice), family_(std::move(family)), layer_(layer), most_(most), gradients_(gradients()) {
    strains_.fill(Tensor::Zero());
  }

  // Opens to an opening (m), breaks the bonds with at most that opening, and returns the energy released, J/m³.
  double open(double opening);

 private:
  using Places = std::array<Tensor, 4>;

  bool crosses(const LatticeBond& bond) const { return bond.layers_below > layer_; }
  Places gradients();
  double energy() const;

  const PulledLattice& lattice_;
  std::vector<LatticeBond> family_;
  int layer_;
  double most_;  // steepness above which the cell carries no stress, 1/m²
  bool carries_stress_ = true;
  double opening_ = 0;
  Places gradients_, strains_;  // of displacements, at an opening of 1 m; strains
};

SeparatedCell::Places SeparatedCell::gradients() {
  std::vector<FitBond> bonds;
  for (const LatticeBond& bond : family_) bonds.push_back({bond.xi, bond.weight});
  const CellWeights cell = lattice_cell(lattice_.spacing, bonds);
  carries_stress_ = !cell.bonds.empty() && cell.steepness <= most_;
  Places sums;
  sums.fill(Tensor::Zero());
  for (std::size_t n = 0; carries_stress_ && n < family_.size(); ++n) {
    if (!crosses(family_[n])) continue;
    for (int q = 0; q < 4; ++q) sums[q].row(2) -= cell.bonds[n][q].transpose();
  }
  return sums;
}

double SeparatedCell::energy() const {
  const auto& [bulk, shear] = lattice_.moduli;
  double sum = 0;
  for (const Tensor& strain : strains_) {
    const double trace = strain.trace();
    sum += 0.25 * (0.5 * (bulk - 2 * shear / 3) * trace * trace + shear * strain.squaredNorm());
  }
  return sum;
}

double SeparatedCell::open(double opening) {
  const auto strain_of = [](const Tensor& gradient) -> Tensor { return 0.5 * (gradient + gradient.transpose()); };
  for (int q = 0; q < 4; ++q) strains_[q] += (opening - opening_) * strain_of(gradients_[q]);
  opening_ = opening;
  const double before = energy();
  const std::size_t bonds = family_.size();
  std::erase_if(family_, [&](const LatticeBond& b) { return crosses(b) && b.opening <= opening * (1 + 1e-12); });
  if (!carries_stress_ || family_.size() == bonds) return 0;
  const Places old = gradients_;
  gradients_ = gradients();
  if (!carries_stress_) strains_.fill(Tensor::Zero());
  for (int q = 0; carries_stress_ && q < 4; ++q) {
    const Tensor jump = opening * strain_of(gradients_[q] - old[q]);
    strains_[q] += part_that_releases(lattice_.moduli, strains_[q], jump) * jump;
  }
  return before - energy();
}

}  // namespace

double separation_of_cells(const PulledLattice& lattice) {
  const std::vector<LatticeBond> family = family_of(lattice);
  std::vector<FitBond> bonds;
  for (const LatticeBond& bond : family) bonds.push_back({bond.xi, bond.weight});
  const auto [openings, layers] = openings_of(family);
  const double most = steepness_of_corners * lattice_cell(lattice.spacing, bonds).steepness;
  double released = 0;
  for (int layer = 0; layer < layers; ++layer) {
    SeparatedCell cell(lattice, family, layer, most);
    for (const double opening : openings) released += cell.open(opening);
  }
  return 2 * lattice.spacing * released;  // both halves
}

std::vector<LatticeBond> family_of(const PulledLattice& lattice) {
  const double h = lattice.spacing;
  const int reach = static_cast<int>(lattice.horizon / h * with_round_off);
  std::vector<LatticeBond> family;
  bonds::with_influence(lattice.influence, [&]<class Weight>(Weight) {
    for (int x = -reach; x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        for (int z = -reach; z <= reach; ++z) {
          const Vector xi = h * Vector(x, y, z);
          if (xi.norm() == 0 || !bonded(lattice.horizon, lattice.horizon, xi)) continue;
          const double weight = Weight::of(xi.norm() / lattice.horizon) * h * h * h;
          family.push_back({xi, weight, z < 0 ? xi.squaredNorm() / -xi[2] : 0, -z});
        }
      }
    }
  });
  return family;
}

int far_row(const PulledLattice& lattice, const LatticeBond& bond, int row) {
  if (lattice.rows == 0) return row;
  const int far = row + static_cast<int>(std::lround(bond.xi[0] / lattice.spacing));
  return far >= 0 && far < lattice.rows ? far : -1;
}

Openings openings_of(const std::vector<LatticeBond>& family) {
  Openings openings;
  for (const LatticeBond& bond : family) {
    if (bond.layers_below <= 0) continue;
    openings.all.push_back(bond.opening);
    openings.layers = std::max(openings.layers, bond.layers_below);
  }
  std::sort(openings.all.begin(), openings.all.end());
  return openings;
}

}  // namespace strut
