// Cells in the making: which voxels belong together, and what each of these pieces is.
#pragma once

#include <set>
#include <vector>

#include "mesh/cells.hpp"

namespace strut::mesh {

using Upper = std::array<int, 3>;  // a voxel's neighbors along x, y, z as places in the list, -1: void

// What is solid: voxels by their places in a list.
struct Material {
  const std::vector<int>& voxels;
  const std::vector<double>& fills;
  const VoxelGrid& grid;
  std::vector<Upper> upper;
  std::vector<Upper> joined;  // the same, where they hang together

  double fill(int voxel) const { return fills.empty() ? 1 : fills[voxel]; }
  int size() const { return static_cast<int>(voxels.size()); }
};

Material material_of(const std::vector<int>& voxels, const std::vector<double>& fills, const VoxelGrid& grid);

// A cell in the making.
struct Piece {
  int place;
  double filled = 0;  // voxels: whole numbers but for grey ones, so that sizes compare exactly
  io::PartialCell part;
};

// The pieces by place, and for each voxel the one that it is in, -1: none, it is dropped.
struct Pieces {
  std::vector<Piece> list;
  std::vector<int> of;
};

// The voxels of each cell of the coarse grid that hang together within it.
Pieces connected_within(const Material& material, const VoxelGrid& coarse, int factor);

// What the pieces hold, from their voxels.
void measure(const Material& material, const VoxelGrid& coarse, int factor, Pieces& pieces);

// For each piece those that have a face in common with it.
std::vector<std::set<int>> links_of(const Material& material, const Pieces& pieces);

// Orders the pieces by their places; those without voxels are left out.
void renumber(Pieces& pieces);

// Makes one cell of two: volume, moments and surface of both.
void absorb(io::PartialCell& part, const io::PartialCell& other);

}  // namespace strut::mesh
