#include <algorithm>
#include <cmath>

#include "fracture/separation.hpp"
#include "mechanics/formulation/stress_pass.hpp"

namespace strut {

namespace {

// A bond across the plane, at an opening of 1 m. All points of a layer have equal values, and the halves are symmetric.
struct CrossingBond {
  double weight, length, extension;  // ω V, m³; m; m
  int layer, far_layer;              // of its ends, counted from the plane
};

class SeparatedHalves {
 public:
  explicit SeparatedHalves(const PulledLattice& lattice);

  bool hold() const { return !bonds_.empty(); }
  // The largest w of any bond; the energy of the layers of one half, J/m³; both at an opening of 1 m.
  double most() const;
  double energy() const;
  // Removes the bonds whose w, at an opening of 1 m, is at least this.
  void cut(double least);

 private:
  void set_dilatations();
  double bond_energy(const CrossingBond& bond) const;

  const PulledLattice& lattice_;
  double weighted_volume_ = 0;
  std::vector<CrossingBond> bonds_;
  std::vector<double> dilatations_;  // of the layers, at an opening of 1 m
};

SeparatedHalves::SeparatedHalves(const PulledLattice& lattice) : lattice_(lattice) {
  for (const LatticeBond& bond : family_of(lattice)) {
    const double length = bond.xi.norm();
    weighted_volume_ += bond.weight * length * length;
    for (int layer = 0; layer < bond.layers_below; ++layer) {
      bonds_.push_back({bond.weight, length, std::abs(bond.xi[2]) / length, layer, bond.layers_below - 1 - layer});
    }
  }
  int layers = 0;
  for (const CrossingBond& bond : bonds_) layers = std::max(layers, bond.layer + 1);
  dilatations_.resize(layers);
  set_dilatations();
}

void SeparatedHalves::set_dilatations() {
  std::fill(dilatations_.begin(), dilatations_.end(), 0.0);
  for (const CrossingBond& bond : bonds_) {
    dilatations_[bond.layer] += 3 * bond.weight * bond.length * bond.extension / weighted_volume_;
  }
}

double SeparatedHalves::bond_energy(const CrossingBond& bond) const {
  const double both = dilatations_[bond.layer] + dilatations_[bond.far_layer];
  const ScalarState sum = scalar_state(lattice_.moduli, both, weighted_volume_);
  const double omega = bond.weight / std::pow(lattice_.spacing, 3);
  return 0.5 * omega * (sum.a * bond.length + 2 * sum.b * bond.extension) * bond.extension;
}

double SeparatedHalves::most() const {
  double most = 0;
  for (const CrossingBond& bond : bonds_) most = std::max(most, bond_energy(bond));
  return most;
}

double SeparatedHalves::energy() const {
  const auto [bulk, shear] = lattice_.moduli;
  double sum = 0;
  for (const double theta : dilatations_) sum += (0.5 * bulk - 7.5 * shear / 9) * theta * theta;
  for (const CrossingBond& bond : bonds_) {
    sum += 7.5 * shear * bond.weight * bond.extension * bond.extension / weighted_volume_;
  }
  return sum;
}

void SeparatedHalves::cut(double least) {
  std::vector<CrossingBond> left;
  for (const CrossingBond& bond : bonds_) {
    if (bond_energy(bond) < least) left.push_back(bond);
  }
  bonds_ = left;
  set_dilatations();
}

}  // namespace

double separation_by_bond_energy(const PulledLattice& lattice) {
  constexpr double alike = 1 - 1e-9;  // bonds that are equal up to round-off break together
  SeparatedHalves halves(lattice);
  double released = 0, opening2 = 0;
  while (halves.hold()) {
    // After a break other bonds may store more than before: they break at the same opening.
    opening2 = std::max(opening2, 1 / halves.most());
    const double before = halves.energy();
    halves.cut(alike / opening2);
    released += opening2 * (before - halves.energy());
  }
  return 2 * lattice.spacing * released;
}

}  // namespace strut
