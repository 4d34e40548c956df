// Finite elements on voxels against Hooke's law and their own element matrix.
#include <gtest/gtest.h>

#include <random>

#include "base/errors.hpp"
#include "voxel_elements.hpp"

namespace strut::reference {
namespace {

constexpr double edge = 0.5, young = 3, poisson = 0.3;

// A row of cubes along x, so many that the last side is not full, as io::Mesh has it.
io::Mesh row(int cubes) {
  io::Mesh mesh;
  io::Mesh::Block block{"row", "HEX8", {}, {}};
  for (int i = 0; i <= cubes; ++i) {
    for (const Vector& corner : {Vector(0, 0, 0), Vector(0, 1, 0), Vector(0, 1, 1), Vector(0, 0, 1)}) {
      mesh.nodes.push_back(edge * (corner + i * Vector::UnitX()));
    }
  }
  mesh.nodes.push_back({9, 9, 9});  // that no element has
  for (int i = 0; i < cubes; ++i) {
    for (const int node : {0, 4, 5, 1, 3, 7, 6, 2}) block.nodes.push_back(4 * i + node);
  }
  mesh.blocks.push_back(block);
  return mesh;
}

TEST(VoxelElements, ForcesAreThoseOfTheElementMatrix) {
  const VoxelMesh mesh = voxels_of(row(11));
  ASSERT_EQ(mesh.nodes.size(), 48);
  const VoxelStiffness K = voxel_stiffness(edge, young, poisson);
  const VoxelForces forces(mesh, K);
  NodeField u = forces.field(), f = forces.field(), expected = forces.field();
  std::mt19937 engine(1);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    for (int c = 0; c < 3; ++c) u[n][c] = static_cast<double>(engine()) / 4e9;
  }
  for (const Corners& corners : mesh.voxels) {
    Eigen::Matrix<double, 24, 1> x;
    for (int c = 0; c < 8; ++c) x.segment<3>(3 * c) = u[corners[c]].head<3>();
    const Eigen::Matrix<double, 24, 1> y = K * x;
    for (int c = 0; c < 8; ++c) expected[corners[c]].head<3>() += y.segment<3>(3 * c).array();
  }
  forces.add(u, f);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    EXPECT_LT((f[n] - expected[n]).abs().maxCoeff(), 1e-14 * K.norm());
  }
}

TEST(VoxelElements, HaveHookesEnergyAndSixRigidMotions) {
  const VoxelStiffness K = voxel_stiffness(edge, young, poisson);
  Eigen::VectorXd stretch(24), turn(24);
  for (int c = 0; c < 8; ++c) {
    const Vector x = edge * Vector(c & 1, c >> 1 & 1, c >> 2);
    stretch.segment<3>(3 * c) = Vector(x[0], -poisson * x[1], -poisson * x[2]);
    turn.segment<3>(3 * c) = Vector(1, 2, 3).cross(x);
  }
  EXPECT_NEAR(stretch.dot(K * stretch), young * std::pow(edge, 3), 1e-14);
  EXPECT_LT((K * turn).norm(), 1e-14);
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<VoxelStiffness>(K).eigenvalues();
  EXPECT_LT(values.head(6).cwiseAbs().maxCoeff(), 1e-14 * values[23]);
  EXPECT_GT(values[6], 1e-3 * values[23]);
}

TEST(VoxelElements, OtherMeshesAreRefused) {
  io::Mesh mesh = row(2);
  mesh.nodes[11] += Vector(1e-3, 0, 0);
  EXPECT_THROW(voxels_of(mesh), Error);
  mesh = row(2);
  mesh.blocks[0].type = "TET4";
  EXPECT_THROW(voxels_of(mesh), Error);
}

}  // namespace
}  // namespace strut::reference
