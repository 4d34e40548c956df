#include <algorithm>
#include <cmath>

#include "fracture/separation.hpp"
#include "mechanics/formulation/stress_pass.hpp"

namespace strut {

namespace {

// A bond across the plane, at an opening of 1 m. All points of a layer (in a plate, of a row of it) have equal values,
// and the halves are symmetric.
struct CrossingBond {
  double weight, length, extension;  // ω V, m³; m; m
  int place, far_place;              // of its ends: index layer · rows + row; layers are counted from the plane
};

class SeparatedHalves {
 public:
  explicit SeparatedHalves(const PulledLattice& lattice);

  bool hold() const { return !bonds_.empty(); }
  // The largest w of any bond; the energy of the layers of one half, J/m³, mean of the rows; both at an opening of 1 m.
  double most() const;
  double energy() const;
  // Removes the bonds whose w, at an opening of 1 m, is at least this.
  void cut(double least);

 private:
  void set_dilatations();
  double bond_energy(const CrossingBond& bond) const;
  double weighted_volume(int place) const { return weighted_volumes_[place % weighted_volumes_.size()]; }

  const PulledLattice& lattice_;
  std::vector<double> weighted_volumes_;  // of the rows
  std::vector<CrossingBond> bonds_;
  std::vector<double> dilatations_;  // of places, at an opening of 1 m
};

SeparatedHalves::SeparatedHalves(const PulledLattice& lattice) : lattice_(lattice) {
  const int rows = std::max(1, lattice.rows);
  weighted_volumes_.assign(rows, 0);
  int places = 0;
  for (const LatticeBond& bond : family_of(lattice)) {
    const double length = bond.xi.norm();
    for (int row = 0; row < rows; ++row) {
      const int far = far_row(lattice, bond, row);
      if (far < 0) continue;
      weighted_volumes_[row] += bond.weight * length * length;
      for (int layer = 0; layer < bond.layers_below; ++layer) {
        bonds_.push_back({bond.weight, length, std::abs(bond.xi[2]) / length, layer * rows + row,
                          (bond.layers_below - 1 - layer) * rows + far});
      }
      places = std::max(places, bond.layers_below * rows);
    }
  }
  dilatations_.resize(places);
  set_dilatations();
}

void SeparatedHalves::set_dilatations() {
  std::fill(dilatations_.begin(), dilatations_.end(), 0.0);
  for (const CrossingBond& bond : bonds_) {
    dilatations_[bond.place] += 3 * bond.weight * bond.length * bond.extension / weighted_volume(bond.place);
  }
}

double SeparatedHalves::bond_energy(const CrossingBond& bond) const {
  const auto state_at = [this](int place) {
    return scalar_state(lattice_.moduli, dilatations_[place], weighted_volume(place));
  };
  const ScalarState near = state_at(bond.place), far = state_at(bond.far_place);
  const double omega = bond.weight / std::pow(lattice_.spacing, 3);
  return 0.5 * omega * ((near.a + far.a) * bond.length + (near.b + far.b) * bond.extension) * bond.extension;
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
    sum += 7.5 * shear * bond.weight * bond.extension * bond.extension / weighted_volume(bond.place);
  }
  return sum / static_cast<double>(weighted_volumes_.size());
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
