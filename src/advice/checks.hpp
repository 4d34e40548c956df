// The checks of a scene before its first step. All are collective; each returns its warnings, a line each, or "".
#pragma once

#include <string>
#include <vector>

#include "advice/trajectories.hpp"
#include "contact/contact.hpp"
#include "deck/deck.hpp"
#include "setup/scene.hpp"

namespace strut {

// The input of the checks.
struct Situation {
  const deck::Deck& deck;
  const Scene& scene;
  double start, duration;                          // of the run, s
  std::vector<contact::Interaction> interactions;  // as contact uses them
  std::vector<double> spacings;                    // mean spacing of each block, m
  std::vector<Trajectory> trajectories;            // of blocks
  std::vector<double> members;     // thickness of the members of each block, spacings (mechanics/thin_members.hpp)
  std::vector<double> unevenness;  // of the lattice of each block (lattice_axes.hpp)
};

// ---- without_effect.cpp

// A warning, a line each, of materials and damage models that no block names, models of contact that no interaction
// names, cracks that cut no bond or run through points, and node sets of the deck that hold all points.
std::string without_effect(const Situation& situation);

// ---- doubled_numbers.cpp

// A warning with the lowest number that several points have, and how many points repeat a number; "" if none does.
std::string doubled_numbers(const Situation& situation);

// ---- lattice_volumes.cpp

// A warning for points of text meshes and spheres whose volume is not the product of the spacings of their lattice.
std::string volumes_off_lattices(const Situation& situation);

// ---- outline.cpp

// Lines for the start of a run: box and mass of the reference state; wave speed √((K + 4μ/3)/ρ), and the
// largest difference of the speeds that conditions impose at the start, relative to it.
std::string outline(const Situation& situation);

// A warning for each block with a density, a wave speed, or a ratio of yield stress to Young's modulus that no solid
// has; it names the units.
std::string improbable_materials(const Situation& situation);

// A warning for each block of an elastomer whose springs have less than half the default stiffness, or which relaxes
// while they do not.
std::string springs_of_elastomers(const Situation& situation);

// A warning for each block of a metal that is initially molten, or so cold that its temperature may be in °C, and for
// each prescribed temperature below 0 K.
std::string improbable_temperatures(const Situation& situation);

// Warnings for a body that is improbably large or small, by itself or for the duration of the run, and for
// bodies that meet faster than waves travel.
std::string improbable_scales(const Situation& situation);

// A line for each elastic block by correspondence in an explicit run whose initial speeds differ so much
// that its energy will not be conserved: at strains of some percent its rate form is inaccurate, and the time step
// decreases while it vibrates.
std::string large_elastic_strains(const Situation& situation);

// A warning for each pair of periodic sides in an explicit run whose Stretch begins suddenly while the points have no
// such velocity.
std::string sudden_stretches(const Situation& situation);

// ---- overlaps.cpp

// Warnings for points around which a body has more material than fits, for parts of its mesh that are in or beside each
// other, and for blocks of different bodies inside each other. Coincident points are an error earlier
// (topology/coincident.hpp).
std::string overlaps(const Situation& situation);

// ---- cracks.cpp

// A line for each block whose points fail without softening, because its fracture energy is too small for its spacing.
std::string sudden_failure(const Situation& situation);

// A line for each block of ordinary points in plates so thin that a crack dissipates another energy than is given.
std::string cracks_of_plates(const Situation& situation);

// A warning for each block whose spacing is too large for the Averaging Radius of its criterion.
std::string coarse_averages(const Situation& situation);

// A warning for each block by quadratic correspondence whose bonds break.
std::string noisy_cracks(const Situation& situation);

// A line for equilibria before other steps, if bonds that could break in them do not, with the reason.
std::string late_breaks(const Situation& situation);

// A warning for each block whose gradual cracks have contact.
std::string soft_faces(const Situation& situation);

// A line for each block whose bonds break by their energy, if several breaks in one step may create energy.
std::string breaks_under_pressure(const Situation& situation);

// A warning for each damage model whose bonds must more than double their length to break: percent taken for a
// fraction.
std::string improbable_stretches(const Situation& situation);

// ---- resolution.cpp

// A line for each block whose members are so thin that correspondence loses a tenth of their bending stiffness,
// ordinary points have an error of a tenth in tension, or quadratic correspondence may have one of a twentieth.
std::string thin_members(const Situation& situation);

// A line for each body and axis along which outer layers of cells are held or pressed by a plane, if what does not
// strain there adds a twentieth to the stiffness.
std::string unstrained_ends(const Situation& situation);

// The warnings of blocks with points whose families nearly lie in a plane.
std::string flat_families(const Situation& situation);

// A warning for each block with ordinary points whose neighbors lie in a plane, if the deck asks for a variable of F.
std::string unknown_gradients(const Situation& situation);

// The warnings of blocks whose points are not in equilibrium under a uniform stress: those at the centers of tetrahedra
// by the mean gradient, and those that are bonded to others of other horizons.
std::string unequal_horizons(const Situation& situation);

// A warning for each block, not by quadratic correspondence, with points whose neighbors are off a lattice.
std::string points_off_lattices(const Situation& situation);

// A warning for the blocks with points at nodes that touch by surfaces and are so narrow that the contact
// is weak everywhere.
std::string narrow_surfaces_of_nodes(const Situation& situation);

// ---- oblong_cells.cpp

// A warning for each block of ordinary points on a lattice that is not cubic, whose dilatation depends on the
// direction: by how much only where no surface is near.
std::string uneven_dilatation(const Situation& situation);

// A warning for each block with cells that are no cubes, if it has contact by surfaces or a fracture energy; and for
// each with contact or a fracture energy whose cells differ in size.
std::string oblong_cells(const Situation& situation);

// ---- declared_contact.cpp

// A warning for every two blocks without an interaction whose bounding boxes, moved with the initial and prescribed
// velocities of the start, overlap before the run ends; not for blocks that are bonded to each other. It is a forecast:
// bodies thrown at each other later are not found.
std::string undeclared_contacts(const Situation& situation);

// A warning for every two blocks of an interaction that are bonded to each other, because contact ignores
// bonded points; for interactions of all blocks, only if all these bonds bridge a gap; for a block and itself, if bonds
// bridge a gap between parts of its mesh.
std::string bonded_contacts(const Situation& situation);

// A warning for every two blocks without an interaction whose bonds all bridge a gap, unless other blocks join them.
std::string bonded_gaps(const Situation& situation);

// A warning for every two bonded blocks that meet others by surfaces: each senses, and is sensed, as if it ended at the
// other.
std::string surfaces_at_seams(const Situation& situation);

// A warning for each symmetry plane behind which a body with contact continues as its mirror image.
std::string contact_at_mirrors(const Situation& situation);

// ---- weak_contact.cpp

// Warnings, a line each, for points that slip between those of the other body; for two bodies whose
// impact, by their initial velocities, exceeds the pressure that contact withstands before points pass each other;
// for parts of one body whose contact withstands less than the flow stress. Throws Error on all ranks if contact
// could not take the energy of the impact even if all points pressed on all others within reach, and no tool or
// third block may stop them, and no prescribed motion or load moves them; that is only a warning if the deck continues
// beyond its limits (Watch > Beyond Limits).
std::string weak_contacts(const Situation& situation);

// ---- unheld_bodies.cpp

// A warning for each piece of a scene of equilibria that contact may push along, because neither conditions
// nor bonds prevent its rigid motion, or that nothing holds while loads act on it. Tools that touch it at the start
// hold it along their normals.
std::string unheld_bodies(const Situation& situation);

// ---- filled_tools.cpp

// A warning for each tool with points inside it at the start by more than a hundredth of their spacing;
// points on its surface, such as nodes of a matching mesh, do not count. Else for each tool that stands in whole cubic
// cells by more than a fiftieth of a spacing, where they end; not in a run from the state of another one.
std::string filled_tools(const Situation& situation);

// ---- tool_paths.cpp

// A line for each tool that is initially more than a spacing away from all of its points: when it first
// touches one, or the warning that it touches none; no warning if a prescribed motion changes later. It is a forecast:
// motion by loads and impacts is not considered.
std::string apart_tools(const Situation& situation);

// A warning for every two tools, one of them with a mass, that meet by their paths and initial velocities
// before a point stops one: tools do not interact.
std::string meeting_tools(const Situation& situation);

// A warning for each tool thinner than 1.5 spacings where it meets a block: a roll by its diameter, a box
// by the edges of the face that meets the block, unless they extend across it. Tools stop points only.
std::string thin_tools(const Situation& situation);

// ---- overruled.cpp

// A warning for each tool and condition if the tool's path meets points whose motion the condition
// prescribes, or that it keeps at a symmetry plane, along the tool's normal, because tools act last. It is a forecast:
// other motions of such points, and tools driven by forces, are not considered.
std::string overruled_motions(const Situation& situation);

// A warning for each block and Stretch of periodic sides that changes while conditions hold all points of the body,
// which goes on across the sides, along their axis.
std::string held_stretches(const Situation& situation);

// A warning for each non-reflecting end whose points a condition holds along its normal.
std::string held_ends(const Situation& situation);

}  // namespace strut
