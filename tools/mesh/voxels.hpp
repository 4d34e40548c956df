// A box of voxels of which some are kept, namely those around the edges of a skeleton, and their mesh.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "io/exodus/exodus.hpp"
#include "mesh/levels.hpp"
#include "mesh/recipe.hpp"
#include "mesh/tessellation.hpp"

namespace strut::mesh {

// A grid with its lower corner at the origin.
struct VoxelGrid {
  Vector size;                        // m, of the box
  Eigen::Array3i cells;               // along each axis
  std::array<bool, 3> periodic = {};  // the box repeats along these axes

  Vector spacing() const { return size.array() / cells.cast<double>(); }
  std::size_t count() const { return cells.cast<std::size_t>().prod(); }
  int index(int i, int j, int k) const { return (k * cells[1] + j) * cells[0] + i; }
  Eigen::Array3i cell(int index) const {
    return {index % cells[0], index / cells[0] % cells[1], index / cells[0] / cells[1]};
  }
};

// The number of cells closest to the spacing, each divided into `factor` voxels along each axis.
VoxelGrid grid_of(const Vector& size, double spacing, int factor);

struct Struts {
  std::vector<int> voxels;         // indices, ascending: one piece, connected through faces
  std::vector<double> fills;       // the solid fraction of each; empty: 1
  double radius = 0;               // m
  std::size_t dropped_pieces = 0;  // smaller ones within the same radius
  std::size_t dropped_voxels = 0;
};

// The voxels whose center is within a radius of an edge; the radius is the one for which the largest piece has at least
// `wanted` voxels. Voxels at equal distances are kept or left out together, which preserves symmetry.
// If there are more of them than wanted, `fills` shares the rest of the volume among them.
Struts struts_around(const std::vector<Edge>& edges, const VoxelGrid& grid, std::size_t wanted,
                     const StrutShape& shape = {});

// The same of voxels with these levels; `scale`: of a difference of levels.
Struts largest_piece(std::vector<Level> levels, const VoxelGrid& grid, std::size_t wanted, double scale);
Struts largest_piece_below(std::vector<Level> levels, const VoxelGrid& grid, double most);

// One empty block of hexahedra, and empty node sets zmin, zmax, xmin, xmax, ymin, ymax, all without names.
io::Mesh empty_mesh();

// Adds node `number` at the position `at` (0 to `last` along each axis) to the sets of the faces that it is on.
void add_to_sets(io::Mesh& mesh, int number, const Eigen::Array3i& at, const Eigen::Array3i& last);

// The corners of a hexahedron, relative to its lower one, in the order of Exodus.
inline const std::array<Eigen::Array3i, 8> hexahedron_corners = {
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

// Hexahedra of voxels, whose indices ascend; node sets zmin, zmax, xmin, xmax, ymin, ymax on the faces of the box, all
// without names. `place` returns the position, m, of a corner (0 to grid.cells along each axis).
io::Mesh voxel_mesh(const std::vector<int>& voxels, const VoxelGrid& grid,
                    const std::function<Vector(const Eigen::Array3i&)>& place);
io::Mesh voxel_mesh(const std::vector<int>& voxels, const VoxelGrid& grid);

}  // namespace strut::mesh
