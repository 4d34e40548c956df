// What of a damage model depends on the spacing, so that a crack dissipates a given fracture energy.
#pragma once

#include <vector>

#include "mechanics/body.hpp"

namespace strut {

// A lattice as it is about to be pulled apart.
struct PulledLattice {
  double spacing, horizon;  // m
  Influence influence;
  Formulation formulation;
  materials::Moduli moduli;
  ResidualKind springs = ResidualKind::none;  // of what residual
  double coefficient = 0;                     // c of these
};

struct LatticeBond {
  Vector xi;
  double weight;     // ω V
  double opening;    // at which it breaks if it crosses the plane, its critical stretch being 1
  int layers_below;  // its far end is so many layers below
};

// The family of a point inside of the lattice. A bond is longer by Δ |ξ_z|/|ξ| once the halves are Δ apart.
std::vector<LatticeBond> family_of(const PulledLattice& lattice);

// What is dissipated for each m² of the plane between two halves of a lattice, J/m², as they move apart along its
// normal without deformation, by bonds whose critical stretch is 1 and in small strains: of s_c it is s_c² times as
// much. Each break dissipates by how much the energy of the points on both sides falls.
double energy_of_separation(const PulledLattice& lattice);

// The same by quadratic correspondence.
double separation_of_cells(const PulledLattice& lattice);

// The same of an ordinary lattice by bonds whose critical energy w_c is 1 J/m⁶, J/m² for each J/m⁶: of w_c it is w_c
// times as much.
double separation_by_bond_energy(const PulledLattice& lattice);

// Sets the critical stretch or bond energy of the blocks whose fracture energy is given, by the lattice of their
// spacing and horizon.
void set_critical_values(Body& body);

// Sets over which length a crack smears its opening, of the blocks whose points may fail: twice the reach of their
// families, as all points within it on both sides of a jump of places see it in their deformation gradients. The
// block's largest horizon, or 1.75 spacings by quadratic correspondence: a graded block takes less energy where it is
// finer.
void set_crack_lengths(Body& body);

}  // namespace strut
