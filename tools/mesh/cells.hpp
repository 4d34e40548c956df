// Gathers fine voxels in coarse cells: the filled part of each cell, and the cells that the material joins.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/exodus/exodus.hpp"
#include "mesh/voxels.hpp"

namespace strut::mesh {

struct Gathering {
  int factor = 1;         // voxels along an edge of a cell
  double smallest = 0.3;  // of a whole cell's volume: smaller pieces are merged into a neighbor
};

struct Cells {
  VoxelGrid grid;                      // of whole cells; at its upper faces they may extend beyond the voxels
  std::vector<io::PartialCell> parts;  // the material of each cell
  std::vector<int> places;             // of each cell in the grid, ascending; several pieces may share one
  std::vector<std::array<int, 2>>
      contacts;                 // cells whose material has common faces: each pair of indices once, the lower one first
  std::size_t merged = 0;       // pieces that became part of a neighbor
  std::size_t small = 0;        // kept below the limit: only they connect their neighbors
  std::size_t dropped = 0;      // pieces that were too small and had no neighbor
  double dropped_volume = 0;    // m³
  std::size_t cut = 0;          // flat cells (FlatCells) that were cut into two layers
  std::size_t flat_merged = 0;  // flat cells that became part of a neighbor
  std::size_t flat = 0;         // still there: a run by quadratic correspondence drops them
  double flat_volume = 0;       // m³, of these
  double volume() const;        // m³, of the remaining material
};

// `voxels`: indices of the solid ones, ascending. `fills`: the solid fraction of each, > 0 to 1; empty: 1. A piece
// consists of the voxels of a cell that are connected through faces within it. Repeatedly, the smallest piece below the
// limit is merged into one that has a common face with it: among those for which all connected pieces are at touching
// positions, the one with the smallest joint moments. A merged piece is at the position of the larger one or, if only
// that keeps its neighbors, of the smaller one. Volume and first and second moments are those of the voxels, without
// dropped ones. Cells whose neighbors are in one plane are cut into two layers, or merged (FlatCells), unless the
// limit is 0.
Cells gathered(const std::vector<int>& voxels, const std::vector<double>& fills, const VoxelGrid& grid,
               const Gathering& gathering);

// For each cell, those that share a node with it in their mesh, ascending.
std::vector<std::vector<int>> neighbors_of(const Cells& cells);

// A whole hexahedron for each cell, with its material; node sets as in voxel_mesh. Around each corner of the grid,
// cells share a node if a chain of contacts connects them.
io::Mesh cell_mesh(const Cells& cells);

// A summary, as indented lines.
std::string summary_of(const Cells& cells, const Gathering& gathering);

}  // namespace strut::mesh
