// A box of voxels of which some are kept: those around the edges of a skeleton, and the mesh of them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/exodus/exodus.hpp"
#include "mesh/recipe.hpp"
#include "mesh/tessellation.hpp"

namespace strut::mesh {

// The lower corner at the origin.
struct VoxelGrid {
  Vector size;           // m, of the box
  Eigen::Array3i cells;  // along each axis

  Vector spacing() const { return size.array() / cells.cast<double>(); }
  std::size_t count() const { return cells.cast<std::size_t>().prod(); }
  int index(int i, int j, int k) const { return (k * cells[1] + j) * cells[0] + i; }
  Eigen::Array3i cell(int index) const {
    return {index % cells[0], index / cells[0] % cells[1], index / cells[0] / cells[1]};
  }
};

// As many cells as come nearest to the spacing, each divided in `factor` voxels along each axis.
VoxelGrid grid_of(const Vector& size, double spacing, int factor);

struct Struts {
  std::vector<int> voxels;         // indices, ascending: one piece, voxels that share faces
  double radius = 0;               // m
  std::size_t dropped_pieces = 0;  // smaller ones within the same radius
  std::size_t dropped_voxels = 0;
};

// The voxels whose center lies within a radius of an edge, the radius such that the largest piece has at least `wanted`
// voxels. Voxels at the same distance are kept or left out together, so that symmetry is kept, too.
Struts struts_around(const std::vector<Edge>& edges, const VoxelGrid& grid, std::size_t wanted);

// One empty block of this type, and empty node sets zmin, zmax, xmin, xmax, ymin, ymax. No names yet.
io::Mesh empty_mesh(const std::string& type);

// Puts node `number` at the place `at` (0 to `last` along each axis) into the sets of the faces that it lies on.
void add_to_sets(io::Mesh& mesh, int number, const Eigen::Array3i& at, const Eigen::Array3i& last);

// The corners of a hexahedron from its lower one, in the order of Exodus.
inline const std::array<Eigen::Array3i, 8> hexahedron_corners = {
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

// Hexahedra or spheres; node sets zmin, zmax, xmin, xmax, ymin, ymax on the faces of the box. No names yet.
io::Mesh voxel_mesh(const std::vector<int>& voxels, const VoxelGrid& grid, Body::Elements elements);

}  // namespace strut::mesh
