// Finite elements on voxels, without a matrix: cubes with eight nodes, linear elastic, fully integrated. All cubes have
// the same stiffness and differ only in their nodes.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "base/math/lanes.hpp"
#include "io/exodus/exodus.hpp"

namespace strut::reference {

// Corner c of a cube lies at bit 0 of c along x, bit 1 along y, bit 2 along z.
using Corners = std::array<int, 8>;

struct VoxelMesh {
  double edge = 0;            // m
  std::vector<Vector> nodes;  // those that a voxel has
  std::vector<Corners> voxels;
};

// The voxels of all blocks. Throws Error where an element is not a cube along the axes, as large as the others.
VoxelMesh voxels_of(const io::Mesh& mesh);
// The whole cells that these points at elements stand for, with their shared nodes for corners (thin_members.hpp).
VoxelMesh voxels_of(const PointCloud& elements);

// N/m; component c of corner n is number 3 n + c.
using VoxelStiffness = Eigen::Matrix<double, 24, 24>;
VoxelStiffness voxel_stiffness(double edge, double young, double poisson);
// The stiffness matrix of all nodes.
Eigen::SparseMatrix<double> matrix_of(const VoxelMesh& mesh, const VoxelStiffness& stiffness);
// Masses of the nodes, an eighth of each voxel around them; kg.
Eigen::VectorXd masses_of(const VoxelMesh& mesh, double density);

// A vector of each node and an unused number; the last entry belongs to no node.
using NodeField = std::vector<Eigen::Array4d>;

// As many voxels side by side as a register has lanes: their nodes, [corner][lane], and a vector at each corner (or of
// each pattern of corners), [corner][axis].
using Side = std::array<small::Indices, 8>;
using SideVectors = std::array<std::array<small::Lanes, 3>, 8>;
SideVectors taken(const NodeField& field, const Side& side);
void add_to_nodes(const SideVectors& values, const Side& side, NodeField& field);

// Forces of displacements. A cube is its own mirror image across three planes: in sums and differences of its corners'
// displacements, its stiffness falls into eight blocks of three rows, 72 products instead of 576.
class VoxelForces {
 public:
  VoxelForces(const VoxelMesh& mesh, const VoxelStiffness& stiffness);

  NodeField field() const { return NodeField(nodes_ + 1, Eigen::Array4d::Zero()); }
  // force += K displacement
  void add(const NodeField& displacement, NodeField& force) const;

 private:
  std::size_t nodes_;
  std::vector<Side> sides_;  // lanes without a voxel take the last number of a field
  std::array<Eigen::Matrix3d, 8> blocks_;
};

}  // namespace strut::reference
