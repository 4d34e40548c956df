// A lattice whose two halves are pulled apart: the energy that its breaking bonds dissipate. From it follow the
// critical stretch or bond energy of a block with a given fracture energy. Also the fraction of a strain jump that the
// stress follows when bonds break.
#pragma once

#include <vector>

#include "base/math/tensors.hpp"
#include "materials/law.hpp"
#include "mechanics/body.hpp"

namespace strut {

// A lattice whose halves are to be pulled apart.
struct PulledLattice {
  double spacing, horizon;  // m
  Influence influence;
  Formulation formulation;
  materials::Moduli moduli;
  ResidualKind springs = ResidualKind::none;  // residual that the springs act on
  double coefficient = 0;                     // c of the springs
  int rows = 0;                               // ordinary: of a plate with faces across x; 0: it is without faces
};

struct LatticeBond {
  Vector xi;
  double weight;     // ω V
  double opening;    // at which it breaks if it crosses the plane and its critical stretch is 1
  int layers_below;  // number of layers that its far end is below
};

// The family of an interior point. An opening Δ between the halves lengthens a bond across the plane by Δ |ξ_z|/|ξ|.
std::vector<LatticeBond> family_of(const PulledLattice& lattice);

// The row of a plate in which the far end of a bond from a row lies; −1: beyond a face.
int far_row(const PulledLattice& lattice, const LatticeBond& bond, int row);

// The openings of the bonds across the plane from a point in the layer above it, ascending, and the number of layers
// that have such bonds.
struct Openings {
  std::vector<double> all;
  int layers = 0;
};
Openings openings_of(const std::vector<LatticeBond>& family);

// Energy dissipated per area of the plane between two halves of a lattice, J/m², that move apart along its normal
// without deformation, by bonds whose critical stretch is 1, in small strains; for s_c multiply by s_c². Each break
// dissipates the decrease of the energy of the points on both sides.
double energy_of_separation(const PulledLattice& lattice);

// The same for quadratic correspondence.
double separation_of_cells(const PulledLattice& lattice);

// The same for an ordinary lattice by bonds whose critical energy w_c is 1 J/m⁶, J/m² per J/m⁶; for another w_c
// multiply by it.
double separation_by_bond_energy(const PulledLattice& lattice);

// The constants of the law of a crack that opens gradually (materials/brittle.hpp) follow from its fracture energy,
// J/m².
struct GradualCrack {
  double strength;  // σ_c, Pa
  double width;     // ℓ, m: 1/(h Σ g²) if the layers beside an opening δ across an axis have the gradients g δ
  double critical_stretch;  // root mean square of the stretches of the bonds across the crack at the opening 2 G_c/σ_c
};
GradualCrack gradual_crack(const PulledLattice& lattice, double fracture_energy);

// Limit of the steepness of families with broken bonds, relative to that of an interior point; a steeper point carries
// no stress. A point at a corner, with an eighth of the family, has the ratio 8. The limit has a tolerance: on a
// lattice many points have exactly 8, and neither round-off nor reflection may decide.
inline constexpr double steepness_of_corners = 8 * (1 + 1e-9);

// The fraction of a strain jump that the stress follows, for linear elasticity: the λ from 0 to 1 that minimizes the
// energy W + λ σ:Δε + ½ λ² Δε:C:Δε.
double part_that_releases(const materials::Moduli& moduli, const Tensor& strain, const Tensor& jump);

// Sets the critical stretch or bond energy of the blocks whose fracture energy is given, from a lattice of their
// spacing and horizon.
void set_critical_values(Body& body);

// For a block of ordinary points with a fracture energy: energy that a flat cut across a plate of so many layers
// dissipates, over the fracture energy. The critical value of the block is that of a lattice without faces.
double part_in_plates(const Body& body, std::size_t block, int layers);

// Sets the length over which a crack smears its opening, for blocks whose points may fail: twice the reach of their
// families, because all points within it on both sides of a displacement jump have it in their deformation gradients.
// The reach is the block's largest horizon, or 1.75 spacings by quadratic correspondence, so a graded block takes less
// energy where it is finer.
void set_crack_lengths(Body& body);

}  // namespace strut
