// Builds the objects of a run from a deck: the only place that knows both.
#pragma once

#include "deck/deck.hpp"
#include "deck/problems.hpp"
#include "io/exodus/exodus.hpp"
#include "setup/scene.hpp"
#include "topology/cloud.hpp"

namespace strut {

// Collective. The mesh with the node sets of the deck. Reports errors that only deck and mesh together show:
// blocks and node sets that do not exist, are ambiguous or contain no point, coincident points, horizons that do
// not fit the spacing. The deck may already have problems; if its section on the mesh is wrong, the cloud is
// empty. `in_memory`: the mesh of a deck of Type Memory, on rank 0.
PointCloud mesh_of(const deck::Deck& deck, const Communicator& communicator, deck::Problems& problems,
                   const io::Mesh* in_memory = nullptr);

// Collective. Partition, families, body, initial velocities and conditions, for a mesh and a deck without problems.
// Throws one Error on all ranks for points with too few neighbors.
Scene set_up(const deck::Deck& deck, PointCloud cloud, const Communicator& communicator);
// Reads and builds; throws one Error for all problems.
Scene set_up(const deck::Deck& deck, const Communicator& communicator);

// Migration state: the part of a scene that survives it, to rebuild the scene on another partition.
struct MigrationState {
  PointCloud cloud;  // of this rank in the new partition
  PartitionWeights weights;
  Dropped dropped;
  std::int64_t points = 0, bonds = 0, pieces = 0;
  std::vector<ToolOfScene> tools;
  double highest_frequency = 0;
  bool has_expanded = false;  // on any rank
};

// Keeps the thermal strains that a checkpoint has (`has_expanded`), also if no condition of this deck heats a point.
void keep_expansion(bool has_expanded, Body& body);

// Collective.
MigrationState migration_state_of(const Scene& scene, PointCloud cloud);

// Collective. The same scene on another partition, at its initial time, without its messages.
Scene set_up_again(const deck::Deck& deck, MigrationState migrated, const Communicator& communicator);

// Collective. Prepares a scene whose equilibria are over for the explicit steps of the deck's second solver: keeps the
// body in its present state, and makes the conditions and the fracture of these steps. `held`: the conditions of the
// equilibria, whose tools keep their reaches; `contact`, `fracture`: of the equilibria, with their touching distances
// and broken bonds. Returns the deck of the explicit steps; scene.warnings are those of the explicit steps.
deck::Deck set_up_next(const deck::Deck& deck, const Conditions& held, contact::Contact contact,
                       std::optional<Fracture> fracture, Scene& scene);

}  // namespace strut
