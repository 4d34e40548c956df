// Blocks of the mesh and the sections of the deck that name them: materials, bonds, and what of them does not fit.
#pragma once

#include <string>
#include <vector>

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "mechanics/body.hpp"
#include "topology/domain.hpp"

namespace strut {

bool is_quadratic(const deck::Material& material);

// The Blocks section that names a block of the mesh; "all" and "default" are for those that no section names.
const deck::Block* section_of(const deck::Deck& deck, const std::string& block);

void check_blocks(const deck::Deck& deck, const PointCloud& cloud, deck::Problems& problems);

// The mean spacing of each block's points over all ranks, m; 0 where it has none.
std::vector<double> mean_spacings(const PointCloud& cloud, const Communicator& communicator);

// A horizon in m that is smaller than the spacing, or a hundred times as large, is a slip of units.
void check_horizons(const deck::Deck& deck, const PointCloud& cloud, const std::vector<double>& spacings,
                    deck::Problems& problems);

// One for each block of the mesh.
std::vector<BlockMaterial> block_materials(const deck::Deck& deck, const PointCloud& cloud);
std::vector<BlockBonds> block_bonds(const deck::Deck& deck, const PointCloud& cloud);

// Collective. A warning where the mass of points at nodes is not that of the mesh: a node that blocks of two densities
// share has the density of the first of them. `taken`: PointCloud::taken_volumes.
std::string mass_of_shared_nodes(const Body& body, const std::vector<double>& taken);

}  // namespace strut
