// The checks of a scene before its first step, and the shapes that several of them have.
#pragma once

#include <limits>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "advice/trajectories.hpp"
#include "contact/contact.hpp"
#include "deck/deck.hpp"
#include "setup/found_points.hpp"
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

// Collective; returns its warnings, a line each, or "".
using Check = std::string(const Situation&);

// The lines of all blocks: line(block, its index) gives one, or "".
std::string lines_of_blocks(const Situation& situation, const auto& line) {
  std::string text;
  std::size_t b = 0;
  for (const MaterialBlock& block : situation.scene.body.blocks) text += line(block, b++);
  return text;
}

// Collective. line(block, points, largest measure) for each block with points whose measure(block, point) is not 0.
// With a limit, only about so many points of a block and rank are measured.
std::string lines_of_points(const Situation& situation, const auto& measure, const auto& line,
                            std::size_t limit = std::numeric_limits<std::size_t>::max()) {
  const Body& body = situation.scene.body;
  std::vector<std::vector<int>> points(body.blocks.size());
  std::vector<double> largest(body.blocks.size(), 0);
  for (std::size_t b = 0; b < points.size(); ++b) {
    const std::vector<int>& all = body.blocks[b].points;
    for (std::size_t k = 0; k < all.size(); k += 1 + all.size() / limit) {
      const double measured = measure(body.blocks[b], all[k]);
      if (measured != 0) points[b].push_back(all[k]);
      largest[b] = std::max(largest[b], measured);
    }
  }
  body.domain.communicator.max(largest);
  const std::vector<FoundPoints> found = found_points(body, points);
  return lines_of_blocks(situation, [&](const MaterialBlock& block, std::size_t b) {
    return found[b].count > 0 ? line(block, found[b], largest[b]) : std::string();
  });
}

// Collective. The block of each owned point and ghost.
inline std::vector<int> blocks_of(const Domain& domain) {
  std::vector<int> blocks(domain.cloud.blocks.begin(), domain.cloud.blocks.end());
  blocks.resize(domain.owned + domain.ghosts, -1);
  domain.halo.exchange(blocks);
  return blocks;
}

// The blocks that meet others, or themselves, by a kind of contact.
template <class Law>
std::set<int> blocks_that_meet_by(const Situation& situation) {
  std::set<int> blocks;
  for (const auto& [first, second, model] : situation.interactions) {
    if (std::holds_alternative<Law>(model.law)) blocks.insert({first, second});
  }
  return blocks;
}

// ---- without_effect.cpp
// Materials and damage models that no block names, models of contact that no interaction
// names, cracks that cut no bond or run through points, and node sets of the deck that hold all points.
Check without_effect;

// ---- doubled_numbers.cpp
// A warning with the lowest number that several points have, and how many points repeat a number; "" if none does.
Check doubled_numbers;

// ---- lattice_volumes.cpp
// A warning for points of text meshes and spheres whose volume is not the product of the spacings of their lattice.
Check volumes_off_lattices;

// ---- outline.cpp
// Lines for the start of a run: box and mass of the reference state; wave speed √((K + 4μ/3)/ρ), and the
// largest difference of the speeds that conditions impose at the start, relative to it.
Check outline;
// A warning for each block with a density, a wave speed, a thermal expansion, or a ratio of yield stress to Young's
// modulus that no solid has; it names the units.
Check improbable_materials;
// A warning for each block of an elastomer or a foam whose springs have less than half the default stiffness, and of an
// elastomer that relaxes while they do not.
Check unusual_springs;
// A warning for each block of a metal that is initially molten, or so cold that its temperature may be in °C, and for
// each prescribed temperature below 0 K.
Check improbable_temperatures;
// Warnings for a body that is improbably large or small, by itself or for the duration of the run, for bodies that meet
// faster than waves travel, and for frictions and weights that look like another unit's.
Check improbable_scales;
// A line for each elastic block by correspondence in an explicit run whose initial speeds differ so much
// that its energy will not be conserved: at strains of some percent its rate form is inaccurate, and the time step
// decreases while it vibrates.
Check large_elastic_strains;
// A warning for each pair of periodic sides in an explicit run whose Stretch begins suddenly while the points have no
// such velocity.
Check sudden_stretches;

// ---- overlaps.cpp
// Warnings for points around which a body has more material than fits, for parts of its mesh that are in or beside each
// other, and for blocks of different bodies inside each other. Coincident points are an error earlier
// (topology/coincident.hpp).
Check overlaps;

// ---- cracks.cpp
// A line for each block whose points fail without softening, because its fracture energy is too small for its spacing.
Check sudden_failure;
// A line for each block of ordinary points in plates so thin that a crack dissipates another energy than is given.
Check cracks_of_plates;
// A warning for each block whose spacing is too large for the Averaging Radius of its criterion.
Check coarse_averages;
// A warning for each block by correspondence whose cracks by one critical stretch take another energy than is given.
Check noisy_cracks;
// A line for each block whose Critical Stretch, given as a Fracture Energy, has become a gradual crack.
Check gradual_cracks;
// A line for equilibria before other steps, if bonds that could break in them do not, with the reason.
Check late_breaks;
// A warning for each block whose gradual cracks have contact.
Check soft_faces;
// A line for each block whose bonds break by their energy, if several breaks in one step may create energy.
Check breaks_under_pressure;
// A warning for each damage model whose bonds must more than double their length to break: percent taken for a
// fraction.
Check improbable_stretches;

// ---- resolution.cpp
// A line for each block whose members are so thin that correspondence loses a tenth of their bending stiffness,
// ordinary points have an error of a tenth in tension, or quadratic correspondence may have one of a twentieth.
Check thin_members;
// A line for each block of quadratic cells that is bonded to another one, at least twice as stiff.
Check unlike_layers;
// The warnings of blocks with points whose families nearly lie in a plane.
Check flat_families;
// A warning for each block with ordinary points whose neighbors lie in a plane, if the deck asks for a variable of F.
Check unknown_gradients;
// The warnings of blocks whose points are not in equilibrium under a uniform stress: those at the centers of tetrahedra
// by the mean gradient, and those that are bonded to others of other horizons.
Check unequal_horizons;
// A warning for each block, not by quadratic correspondence, with points whose neighbors are off a lattice.
Check points_off_lattices;
// A warning for the blocks with points at nodes that touch by surfaces and are so narrow that the contact
// is weak everywhere.
Check narrow_surfaces_of_nodes;

// ---- oblong_cells.cpp
// A warning for each block of ordinary points on a lattice that is not cubic, whose dilatation depends on the
// direction: by how much only where no surface is near.
Check uneven_dilatation;
// A warning for each block with cells that are no cubes, if it has contact by surfaces or a fracture energy; and for
// each with contact or a fracture energy whose cells differ in size.
Check oblong_cells;

// ---- declared_contact.cpp
// A warning for every two blocks without an interaction whose bounding boxes, moved with the initial and prescribed
// velocities of the start, overlap before the run ends; not for blocks that are bonded to each other. It is a forecast:
// bodies thrown at each other later are not found.
Check undeclared_contacts;
// A warning for every two blocks of an interaction that are bonded to each other, because contact ignores
// bonded points; for interactions of all blocks, only if all these bonds bridge a gap; for a block and itself, if bonds
// bridge a gap between parts of its mesh.
Check bonded_contacts;
// A warning for every two blocks without an interaction whose bonds all bridge a gap, unless other blocks join them, and
// for every block without one with itself whose parts are bonded across a gap.
Check bonded_gaps;
// A warning for every two bonded blocks that meet others by surfaces: each senses, and is sensed, as if it ended at the
// other.
Check surfaces_at_seams;
// A warning for each symmetry plane behind which a body with contact continues as its mirror image.
Check contact_at_mirrors;

// ---- weak_contact.cpp
// Warnings, a line each, for points that slip between those of the other body; for two bodies whose
// impact, by their initial velocities, exceeds the pressure that contact withstands before points pass each other;
// for parts of one body whose contact withstands less than the flow stress. Throws Error on all ranks if contact
// could not take the energy of the impact even if all points pressed on all others within reach, and no tool or
// third block may stop them, and no prescribed motion or load moves them; that is only a warning if the deck continues
// beyond its limits (Watch > Beyond Limits).
Check weak_contacts;

// ---- unheld_bodies.cpp
// A warning for each piece of a scene of equilibria that contact may push along, because neither conditions
// nor bonds prevent its rigid motion, or that nothing holds while loads act on it. Tools that touch it at the start
// hold it along their normals.
Check unheld_bodies;

// ---- filled_tools.cpp
// A warning for each tool with points inside it at the start by more than a hundredth of their spacing;
// points on its surface, such as nodes of a matching mesh, do not count. Else for each tool that stands in whole cubic
// cells by more than a fiftieth of a spacing, where they end; not in a run from the state of another one.
Check filled_tools;

// ---- unstrained_ends.cpp
// A line for each body and axis along which outer layers are held or pressed by a plane, if cells that do not strain
// there add a twentieth to the stiffness, or nodes that give way take a twentieth.
Check unstrained_ends;

// ---- tool_paths.cpp
// A line for each tool that is initially more than a spacing away from all of its points: when it first
// touches one, or the warning that it touches none; no warning if a prescribed motion changes later. It is a forecast:
// motion by loads and impacts is not considered.
Check apart_tools;
// A warning for every two tools, one of them with a mass, that meet by their paths and initial velocities
// before a point stops one: tools do not interact.
Check meeting_tools;
// A warning for each tool thinner than 1.5 spacings where it meets a block: a roll by its diameter, a box
// by the edges of the face that meets the block, unless they extend across it. Tools stop points only.
Check thin_tools;
// A line for each block that is thrown at a flat tool, with the part of its kinetic energy that is lost there.
Check stopped_layers;

// ---- overruled.cpp
// A warning for each tool and condition if the tool's path meets points whose motion the condition
// prescribes, or that it keeps at a symmetry plane, along the tool's normal, because tools act last. It is a forecast:
// other motions of such points, and tools driven by forces, are not considered.
Check overruled_motions;
// A warning for each block and Stretch of periodic sides that changes while conditions hold all points of the body,
// which goes on across the sides, along their axis.
Check held_stretches;
// A warning for each non-reflecting end whose points a condition holds along its normal, whose inertia is scaled, or
// which lets go of stress that the run starts from.
Check held_ends;

}  // namespace strut
