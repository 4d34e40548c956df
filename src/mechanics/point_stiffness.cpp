#include "mechanics/point_stiffness.hpp"

#include <algorithm>

#include "mechanics/formulation/cell_tangent.hpp"
#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/kernels/bonds.hpp"

namespace strut {

namespace {

// Weights of the points' positions in F at one integration point, columns as `points`: F = Σ y_a ⊗ g_a.
using Weights = Eigen::Matrix<double, 3, Eigen::Dynamic>;

// Adds V Σ_q (1/Q) G_qᵀ (∂P_q/∂F) G_q over Q integration points; change(δF there) returns δP.
template <std::size_t Q, class Change>
void add_gradients(const std::array<Weights, Q>& weights, double volume, const Change& change,
                   Eigen::MatrixXd& matrix) {
  const int points = static_cast<int>(weights[0].cols());
  for (int b = 0; b < points; ++b) {
    for (int c = 0; c < 3; ++c) {
      std::array<Tensor, Q> dF;
      for (std::size_t q = 0; q < Q; ++q) dF[q].setZero(), dF[q].row(c) = weights[q].col(b).transpose();
      const std::array<Tensor, Q> dP = change(dF);
      for (std::size_t q = 0; q < Q; ++q) {
        const Tensor scaled = volume / Q * dP[q];
        for (int a = 0; a < points; ++a) matrix.block<3, 1>(3 * a, 3 * b + c) += scaled * weights[q].col(a);
      }
    }
  }
}

void add_cell(const Body& body, const MaterialBlock& block, int k, const std::vector<PointTangent>& tangents,
              PointStiffness& result) {
  const int i = block.points[k], points = static_cast<int>(result.points.size());
  std::array<Weights, 4> weights;
  for (int q = 0; q < 4; ++q) {
    weights[q] = Weights::Zero(3, points);
    int a = 1;
    body.fits->for_each_weight(body, i, q, [&](int, const Vector& g) { weights[q].col(a++) = g; });
    weights[q].col(0) = -weights[q].rowwise().sum();
  }
  const CellTangent tangent(body, block, k, &tangents);
  add_gradients(
      weights, body.domain.volume(i), [&](const CellTensors& dF) { return tangent.change(dF); }, result.matrix);
}

// Adds the springs of a point on the residuals z = η − F ξ of its own gradient: the second derivative of their energy,
// ½ V C Σ ω V_j |z_j|². `weighted_volumes`: ω V_j by point; `stiffness`: V C.
void add_springs(const Weights& weights, const Weights& bonds, const Eigen::VectorXd& weighted_volumes,
                 double stiffness, Eigen::MatrixXd& matrix) {
  Eigen::MatrixXd residuals = -bonds.transpose() * weights;  // row j: derivative by the positions of the points
  for (int a = 1; a < residuals.rows(); ++a) residuals(a, a) += 1, residuals(a, 0) -= 1;
  const Eigen::MatrixXd springs = stiffness * residuals.transpose() * weighted_volumes.asDiagonal() * residuals;
  for (int a = 0; a < springs.rows(); ++a) {
    for (int b = 0; b < springs.cols(); ++b) matrix.block<3, 3>(3 * a, 3 * b).diagonal().array() += springs(a, b);
  }
}

void add_point(const Body& body, const MaterialBlock& block, int k, const std::vector<PointTangent>& tangents,
               PointStiffness& result) {
  const int i = block.points[k], points = static_cast<int>(result.points.size());
  Weights bonds = Weights::Zero(3, points);
  Eigen::VectorXd weighted_volumes = Eigen::VectorXd::Zero(points);
  int a = 1;
  over_family(body, i, [&](int, double w, const Vector& xi) { bonds.col(a) = xi, weighted_volumes[a++] = w; });
  std::array<Weights, 1> weights{to_tensor(body.shape_inverse[i]) * bonds * weighted_volumes.asDiagonal()};
  weights[0].col(0) = -weights[0].rowwise().sum();
  const auto change = [&](const std::array<Tensor, 1>& dF) { return std::array{tangents[i].times(dF[0])}; };
  add_gradients(weights, body.domain.volume(i), change, result.matrix);
  const double C = body.points[i].stabilization;
  if (C > 0) add_springs(weights[0], bonds, weighted_volumes, body.domain.volume(i) * C, result.matrix);
}

}  // namespace

bool have_point_stiffness(const Body& body) {
  return std::none_of(body.blocks.begin(), body.blocks.end(), [](const auto& block) { return block.is_ordinary(); });
}

void take_point_stiffness(const Body& body, const MaterialBlock& block, int k,
                          const std::vector<PointTangent>& tangents, PointStiffness& result) {
  const int i = block.points[k];
  result.points.clear();
  if (block.is_quadratic() && !body.fits->carries_stress(i)) return;
  result.points.push_back(i);
  over_family(body, i, [&](int j, double, const Vector&) { result.points.push_back(j); });
  const auto size = static_cast<Eigen::Index>(3 * result.points.size());
  result.matrix.setZero(size, size);
  block.is_quadratic() ? add_cell(body, block, k, tangents, result) : add_point(body, block, k, tangents, result);
}

}  // namespace strut
