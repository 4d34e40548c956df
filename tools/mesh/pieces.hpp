// Pieces: the connected voxels of a cell, before cells are final.
#pragma once

#include <set>
#include <vector>

#include "mesh/cells.hpp"

namespace strut::mesh {

using Upper = std::array<int, 3>;  // a voxel's neighbors along x, y, z as indices in the list, -1: void

// The solid voxels, by their indices in a list.
struct Material {
  const std::vector<int>& voxels;
  const std::vector<double>& fills;
  const VoxelGrid& grid;
  std::vector<Upper> upper;
  std::vector<Upper> joined;  // the same, if connected

  // The upper neighbor, also behind a side of a box that repeats.
  int beyond(int v, int axis) const;
  double fill(int voxel) const { return fills.empty() ? 1 : fills[voxel]; }
  int size() const { return static_cast<int>(voxels.size()); }
};

Material material_of(const std::vector<int>& voxels, const std::vector<double>& fills, const VoxelGrid& grid);

// A cell before merging is complete.
struct Piece {
  int place;
  double filled = 0;  // in voxels: integers except for grey ones, so that sizes compare exactly
  io::PartialCell part;
};

// The pieces by position, and the piece of each voxel, -1: dropped.
struct Pieces {
  std::vector<Piece> list;
  std::vector<int> of;
};

// The voxels of each cell of the coarse grid that are connected within it.
Pieces connected_within(const Material& material, const VoxelGrid& coarse, int factor);

// Sets volume, centroid, moments and surface of the pieces from their voxels.
void measure(const Material& material, const VoxelGrid& coarse, int factor, Pieces& pieces);

// For each piece, those with a common face.
std::vector<std::set<int>> links_of(const Material& material, const Pieces& pieces);

// Sorts the pieces by position and removes those without voxels.
void renumber(Pieces& pieces);

// Merges two cells: volume, moments and surface of both.
void absorb(io::PartialCell& part, const io::PartialCell& other);

}  // namespace strut::mesh
