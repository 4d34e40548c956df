#include "voxel_elements.hpp"

#include <bit>
#include <cmath>
#include <unordered_map>

#include "base/errors.hpp"

namespace strut::reference {

namespace {

using small::lane_count;
using small::Lanes;

constexpr int exodus_corner[8] = {0, 1, 3, 2, 4, 5, 7, 6};  // of corner c, in the order of HEX8

int bit(int axis) { return 1 << axis; }
double sign(int corner, int pattern) {
  return std::popcount(static_cast<unsigned>(corner & pattern)) % 2 == 0 ? 1 : -1;
}
Vector place(int corner) { return Eigen::Vector3i(corner & 1, corner >> 1 & 1, corner >> 2).cast<double>(); }

Corners corners_of(const io::Mesh& mesh, const int* element, double edge) {
  Corners corners;
  for (int c = 0; c < 8; ++c) corners[c] = element[exodus_corner[c]];
  for (int c = 1; c < 8; ++c) {
    const Vector off = mesh.nodes[corners[c]] - mesh.nodes[corners[0]] - edge * place(c);
    if (off.norm() > 1e-6 * edge) throw Error("expected a mesh of equal cubes along the axes, as strut-mesh makes it");
  }
  return corners;
}

// ∂N_c/∂x of the trilinear functions, at a place of the cube from −1 to 1.
Vector gradient(int corner, const Vector& at, double edge) {
  const Vector s = 2 * place(corner) - Vector::Ones();
  const Vector factor = (Vector::Ones() + s.cwiseProduct(at)) / 2;
  return Vector(s[0] * factor[1] * factor[2], factor[0] * s[1] * factor[2], factor[0] * factor[1] * s[2]) / edge;
}

// K_cd of two corners at a Gauss point: λ b_c b_dᵀ + μ b_d b_cᵀ + μ (b_c · b_d) 1.
Eigen::Matrix3d stiffness_at(const Vector& b_c, const Vector& b_d, double lambda, double mu) {
  return lambda * b_c * b_d.transpose() + mu * b_d * b_c.transpose() + mu * b_c.dot(b_d) * Eigen::Matrix3d::Identity();
}

// Component a in pattern s ^ bit(a) belongs to block s.
Eigen::Matrix3d block_of(const VoxelStiffness& by_pattern, int s) {
  Eigen::Matrix3d block;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) block(a, b) = by_pattern(3 * (s ^ bit(a)) + a, 3 * (s ^ bit(b)) + b);
  }
  return block;
}

// x̂[pattern] = Σ ± x[corner]; twice is eight times the identity.
void to_patterns(SideVectors& x) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int c = 0; c < 8; ++c) {
      if ((c & bit(axis)) != 0) continue;
      for (int k = 0; k < 3; ++k) {
        const Lanes sum = x[c][k] + x[c | bit(axis)][k], difference = x[c][k] - x[c | bit(axis)][k];
        x[c][k] = sum;
        x[c | bit(axis)][k] = difference;
      }
    }
  }
}

}  // namespace

VoxelMesh voxels_of(const io::Mesh& mesh) {
  VoxelMesh voxels;
  std::vector<int> numbers(mesh.nodes.size(), -1);
  for (const io::Mesh::Block& block : mesh.blocks) {
    if (block.type != "HEX8") throw Error("block " + block.name + " is of " + block.type + "; expected HEX8");
    for (std::size_t n = 0; n < block.nodes.size(); n += 8) {
      const int* element = &block.nodes[n];
      if (voxels.edge == 0) voxels.edge = (mesh.nodes[element[1]] - mesh.nodes[element[0]]).norm();
      voxels.voxels.push_back(corners_of(mesh, element, voxels.edge));
      for (const int node : voxels.voxels.back()) numbers[node] = 0;
    }
  }
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    if (numbers[n] < 0) continue;
    numbers[n] = static_cast<int>(voxels.nodes.size());
    voxels.nodes.push_back(mesh.nodes[n]);
  }
  for (Corners& corners : voxels.voxels) {
    for (int& node : corners) node = numbers[node];
  }
  return voxels;
}

VoxelMesh voxels_of(const PointCloud& elements) {
  VoxelMesh voxels{elements.spacings[0], {}, {}};
  std::unordered_map<std::int64_t, int> numbers;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    Corners corners;
    for (int c = 0; c < 8; ++c) {
      const auto [found, is_new] = numbers.try_emplace(elements.shared_nodes[i][c], static_cast<int>(numbers.size()));
      corners[c] = found->second;
      const Vector from_middle = place(c) - Vector::Constant(0.5);
      if (is_new) voxels.nodes.emplace_back(elements.positions[i] + voxels.edge * from_middle);
    }
    voxels.voxels.push_back(corners);
  }
  return voxels;
}

VoxelStiffness voxel_stiffness(double edge, double young, double poisson) {
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), mu = young / (2 * (1 + poisson));
  const double weight = std::pow(edge / 2, 3);
  VoxelStiffness K = VoxelStiffness::Zero();
  for (int point = 0; point < 8; ++point) {
    const Vector at = (2 * place(point) - Vector::Ones()) / std::sqrt(3.0);
    for (int c = 0; c < 8; ++c) {
      for (int d = 0; d < 8; ++d) {
        K.block<3, 3>(3 * c, 3 * d) += weight * stiffness_at(gradient(c, at, edge), gradient(d, at, edge), lambda, mu);
      }
    }
  }
  return K;
}

Eigen::SparseMatrix<double> matrix_of(const VoxelMesh& mesh, const VoxelStiffness& stiffness) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Corners& corners : mesh.voxels) {
    for (int row = 0; row < 24; ++row) {
      for (int column = 0; column < 24; ++column) {
        entries.emplace_back(3 * corners[row / 3] + row % 3, 3 * corners[column / 3] + column % 3,
                             stiffness(row, column));
      }
    }
  }
  const auto rows = static_cast<int>(3 * mesh.nodes.size());
  Eigen::SparseMatrix<double> matrix(rows, rows);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::VectorXd masses_of(const VoxelMesh& mesh, double density) {
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const Corners& corners : mesh.voxels) {
    for (const int node : corners) masses[node] += density * std::pow(mesh.edge, 3) / 8;
  }
  return masses;
}

SideVectors taken(const NodeField& field, const Side& side) {
  SideVectors x;
  for (int c = 0; c < 8; ++c) {
    const auto record = small::numbers_of<4>([&](int l) { return field[side[c][l]].data(); });
    for (int k = 0; k < 3; ++k) x[c][k] = record[k];
  }
  return x;
}

void add_to_nodes(const SideVectors& values, const Side& side, NodeField& field) {
  for (int c = 0; c < 8; ++c) {
    // Four records to the register's four rows and back is the same exchange.
    const auto rows = small::detail::transposed(
        {small::raw(values[c][0]), small::raw(values[c][1]), small::raw(values[c][2]), small::RawLanes{}});
    for (int l = 0; l < lane_count; ++l) {
      field[side[c][l]] += Eigen::Map<const Eigen::Array4d>(reinterpret_cast<const double*>(&rows[l % 4]) + l / 4 * 4);
    }
  }
}

VoxelForces::VoxelForces(const VoxelMesh& mesh, const VoxelStiffness& stiffness) : nodes_(mesh.nodes.size()) {
  for (std::size_t first = 0; first < mesh.voxels.size(); first += lane_count) {
    Side side;
    for (int c = 0; c < 8; ++c) {
      for (int l = 0; l < lane_count; ++l) {
        const std::size_t voxel = first + l;
        side[c][l] = voxel < mesh.voxels.size() ? mesh.voxels[voxel][c] : static_cast<int>(nodes_);
      }
    }
    sides_.push_back(side);
  }
  VoxelStiffness signs = VoxelStiffness::Zero();
  for (int c = 0; c < 8; ++c) {
    for (int p = 0; p < 8; ++p) signs.block<3, 3>(3 * p, 3 * c) = sign(c, p) * Eigen::Matrix3d::Identity();
  }
  const VoxelStiffness by_pattern = signs * stiffness * signs / 64;
  for (int s = 0; s < 8; ++s) blocks_[s] = block_of(by_pattern, s);
}

void VoxelForces::add(const NodeField& displacement, NodeField& force) const {
  for (const Side& side : sides_) {
    SideVectors x = taken(displacement, side), f;
    to_patterns(x);
    for (int s = 0; s < 8; ++s) {
      const Lanes &x0 = x[s ^ 1][0], &x1 = x[s ^ 2][1], &x2 = x[s ^ 4][2];
      const Eigen::Matrix3d& K = blocks_[s];
      for (int a = 0; a < 3; ++a) f[s ^ bit(a)][a] = K(a, 0) * x0 + K(a, 1) * x1 + K(a, 2) * x2;
    }
    to_patterns(f);
    add_to_nodes(f, side, force);
  }
}

}  // namespace strut::reference
