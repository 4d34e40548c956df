// Fine voxels gathered in coarse cells: what of each cell is filled, and which cells the material joins.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/exodus/exodus.hpp"
#include "mesh/voxels.hpp"

namespace strut::mesh {

struct Gathering {
  int factor = 1;         // voxels along an edge of a cell
  double smallest = 0.3;  // of a whole cell's volume: a smaller piece is merged into a neighbor
};

struct Cells {
  VoxelGrid grid;                      // of whole cells; at its upper faces they may reach beyond the voxels
  std::vector<io::PartialCell> parts;  // what each cell holds
  std::vector<int> places;             // of each in the grid, ascending; several pieces may have the same one
  std::vector<std::array<int, 2>>
      contacts;                 // cells whose material has faces in common: each pair once, the lower first
  std::size_t merged = 0;       // pieces that became part of a neighbor
  std::size_t small = 0;        // kept below the limit: they alone join those around them
  std::size_t dropped = 0;      // pieces that were too small and had none
  double dropped_volume = 0;    // m³
  std::size_t cut = 0;          // flat cells (FlatCells) that became two layers
  std::size_t flat_merged = 0;  // flat cells that became part of a neighbor
  std::size_t flat = 0;         // still there: a run by quadratic correspondence leaves them out
  double flat_volume = 0;       // m³, of these
  double volume() const;        // m³, of what is left
};

// `voxels`: indices of the solid ones, ascending. `fills`: the part of each that is solid, > 0 to 1; empty: all of it.
// Voxels of a cell that hang together through faces within it are a piece. The smallest piece that is below the limit
// is merged into one that has a face in common with it, again and again: that with which it has the smallest moments,
// among those where all that hang together have places that touch. A merged piece is where the larger one was, or,
// where only this keeps its neighbors, where the smaller one was. Volume and first and second moments are those of the
// voxels, but for what is dropped. Cells whose neighbors lie in one plane are cut in two layers, or merged, too
// (FlatCells), unless the limit is 0.
Cells gathered(const std::vector<int>& voxels, const std::vector<double>& fills, const VoxelGrid& grid,
               const Gathering& gathering);

// Of each cell those that share a node with it in the mesh of them, ascending.
std::vector<std::vector<int>> neighbors_of(const Cells& cells);

// A whole hexahedron for each cell, with what it holds; node sets as voxel_mesh. Around each corner of the grid, cells
// share a node if contacts lead from one to the other.
io::Mesh cell_mesh(const Cells& cells);

// Lines about them, indented.
std::string summary_of(const Cells& cells, const Gathering& gathering);

}  // namespace strut::mesh
