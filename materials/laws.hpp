// Public header of materials: all laws, and the variant that a block holds.
#pragma once

#include <optional>
#include <variant>

#include "materials/brittle.hpp"
#include "materials/deshpande_fleck.hpp"
#include "materials/ductile.hpp"
#include "materials/elastic.hpp"
#include "materials/hyperelastic.hpp"
#include "materials/j2.hpp"
#include "materials/law.hpp"
#include "materials/polymer_foam.hpp"
#include "materials/shock_j2.hpp"
#include "materials/thermal_j2.hpp"
#include "materials/user_law.hpp"

namespace strut::materials {

using AnyLaw = std::variant<Elastic, Brittle, J2, ThermalJ2, ShockJ2, Ductile, ThermalDuctile, DeshpandeFleck,
                            PolymerFoam, Hyperelastic, UserLaw>;

// The elastic moduli of the undeformed solid.
Moduli moduli_of(const AnyLaw& law);

// K/G of the undeformed solid.
double bulk_over_shear(const AnyLaw& law);

// True if a law has follows_stretch.
bool law_follows_stretch(const AnyLaw& law);

// From this K/G on a body in which each cell must keep its volume is much too stiff.
constexpr double hardly_compressible = 10;

// True for such elastic solids, elastomers and metals: the integration points of their quadratic cells share their
// change of volume from the start (src/mechanics/formulation/shared_volume.hpp). A library's law is not known well
// enough.
bool shares_volume(const AnyLaw& law);

// True if the stress depends on how fast the strain changes, or may, as that of a library.
bool depends_on_rate(const AnyLaw& law);

// The law of a metal whose points may fail; nullopt if there is none.
std::optional<AnyLaw> failing(const AnyLaw& metal, const Ductility& ductility);

// The law of an elastic solid that cracks gradually, G_c in J/m²; nullopt for other laws. Its strength and the widths
// of its cracks depend on the lattice.
std::optional<AnyLaw> cracking(const AnyLaw& solid, double fracture_energy);

}  // namespace strut::materials
