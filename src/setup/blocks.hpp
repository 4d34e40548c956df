// Blocks of the mesh and the sections of the deck that name them: materials, bonds, and what of them does not fit.
#pragma once

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

// Collective. A line for each block whose members are so thin that they lose a tenth of their bending stiffness, of
// ordinary points are off by a tenth in tension, or by quadratic correspondence may be off by a twentieth.
std::string thin_members(const Body& body);

// A line for each block whose points fail without softening, as its fracture energy is too small for its spacing.
std::string sudden_failure(const Body& body);

// A warning for each block whose bonds break by quadratic correspondence.
std::string noisy_cracks(const Body& body);

// A line for each block whose bonds break by their energy and, several in a step, may give some.
std::string breaks_under_pressure(const Body& body);

}  // namespace strut
