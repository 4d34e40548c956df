// Blocks of the mesh with their sections of the deck: materials, bonds, and checks of both.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "mechanics/body.hpp"
#include "topology/domain.hpp"

namespace strut {

bool is_quadratic(const deck::Material& material);

// The section of Blocks that names a block of the mesh; "all" and "default" apply to blocks that no section names,
// and the first section to blocks without points, which need no name.
const deck::Block* section_of(const deck::Deck& deck, const std::string& block);

// `spacings`: mean_spacings.
void check_blocks(const deck::Deck& deck, const PointCloud& cloud, const std::vector<double>& spacings,
                  deck::Problems& problems);

// The mean spacing of each block's points over all ranks, m; 0 if it has none.
std::vector<double> mean_spacings(const PointCloud& cloud, const Communicator& communicator);

// Reports horizons in m that are smaller than the spacing or very much larger: an error of units.
void check_horizons(const deck::Deck& deck, const PointCloud& cloud, const std::vector<double>& spacings,
                    deck::Problems& problems);

// The Stabilization Coefficient of a material whose section has none, as documented for the key
// (deck/sections/materials.cpp).
double usual_coefficient(const materials::AnyLaw& law, const Stabilization& stabilization, bool breaks_by_stretch,
                         PointsAt at);

// One entry for each block of the mesh.
std::vector<BlockMaterial> block_materials(const deck::Deck& deck, const PointCloud& cloud);
// In explicit steps, where a Critical Stretch is given as a fracture energy: makes cracks gradual (DamageModel) in
// blocks that can soften.
void soften_cracks(const deck::Deck& deck, const Domain& domain, std::vector<BlockMaterial>& materials);
std::vector<BlockBonds> block_bonds(const deck::Deck& deck, const PointCloud& cloud);

// The number of cells that a family that is a box reaches to either side along each axis: the horizon rounded to whole
// cells, as in Peridigm.
std::array<int, 3> box_reach(const deck::Grid& grid, const deck::Block& section);

double wave_speed(const BlockMaterial& material);  // of longitudinal waves in the undeformed material, m/s
double mass_of(const Body& body);                  // collective; kg, without scaling

// Collective. A warning if the mass of points at nodes differs from that of the mesh: a node shared by blocks of two
// densities has the density of the first one. `taken`: PointCloud::taken_volumes.
std::string mass_of_shared_nodes(const Body& body, const std::vector<double>& taken);

// The same where they have another material, damage model or initial temperature, where a condition of one block acts
// on them or not, and where the blocks are separate bodies.
std::string conditions_at_shared_nodes(const deck::Deck& deck, const Body& body, const std::vector<double>& taken);

}  // namespace strut
