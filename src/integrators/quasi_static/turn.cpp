#include "integrators/quasi_static/turn.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <span>

namespace strut {

namespace {

constexpr double least_turn = 1e-4;    // rad: less is none
constexpr double on_a_line = 1e-9;     // second over first singular value: round-off
constexpr double most_strained = 0.1;  // of the motion about the center, root of the sum of squares

struct Centers {
  Vector before = Vector::Zero(), after = Vector::Zero();
};

Centers centers_of(const std::vector<HeldPoint>& points, const Communicator& ranks) {
  double sums[7] = {};
  Eigen::Map<Vector> before(sums), after(sums + 3);
  for (const HeldPoint& point : points) before += point.before, after += point.after, ++sums[6];
  ranks.sum(sums);
  if (!(sums[6] > 0)) return {};
  return {before / sums[6], after / sums[6]};
}

// The rotation that takes the points nearest to their new positions, in least squares (Kabsch); the identity if the
// rest of the motion is a large part of it.
Tensor turn_of(const std::vector<HeldPoint>& points, const Centers& centers, const Communicator& ranks) {
  double sums[11] = {};
  Eigen::Map<Tensor> products(sums);
  for (const HeldPoint& point : points) {
    const Vector from = point.before - centers.before, to = point.after - centers.after;
    products += to * from.transpose();
    sums[9] += (to - from).squaredNorm(), sums[10] += from.squaredNorm();
  }
  ranks.sum(sums);
  const double moved = sums[9], size = sums[10];
  if (!(moved > least_turn * least_turn * size)) return Tensor::Identity();
  const Eigen::JacobiSVD<Tensor> parts(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Tensor U = parts.matrixU(), V = parts.matrixV();
  const Vector sizes = parts.singularValues();
  Tensor turn = U * Vector(1, 1, (U * V.transpose()).determinant()).asDiagonal() * V.transpose();
  if (sizes[1] < on_a_line * sizes[0]) {  // a spin about the line moves no point: the shortest turn
    turn = Eigen::Quaterniond::FromTwoVectors(V.col(0), U.col(0)).toRotationMatrix();
  }
  double rest = 0;
  for (const HeldPoint& point : points) {
    rest += (point.after - centers.after - turn * (point.before - centers.before)).squaredNorm();
  }
  if (ranks.sum(rest) > most_strained * most_strained * moved) return Tensor::Identity();
  return turn;
}

}  // namespace

// In the frame that turns with the points, their positions and forces change linearly from x₀ to x₁ and f₀ to f₁; with
// the rotation vector ω of the turn, the work is ∫ f·dx + ω·∫ x × f.
double work_beyond_chords(const std::vector<HeldPoint>& points, const Communicator& ranks) {
  const Centers centers = centers_of(points, ranks);
  const Tensor turn = turn_of(points, centers, ranks);
  const Eigen::AngleAxisd by(turn);
  const Vector omega = by.angle() * by.axis();
  if (!(omega.norm() > least_turn)) return 0;
  double work = 0;
  for (const HeldPoint& point : points) {
    const Vector from = point.before - centers.before, to = point.after - centers.after;
    const Vector x0 = from, x1 = turn.transpose() * to;
    const Vector f0 = point.force_before, f1 = turn.transpose() * point.force_after;
    const Vector moment = (x0.cross(f0) + x1.cross(f1)) / 3 + (x0.cross(f1) + x1.cross(f0)) / 6;
    work += 0.5 * (f0 + f1).dot(x1 - x0) + omega.dot(moment);
    work -= 0.5 * (point.force_before + point.force_after).dot(to - from);
  }
  return work;
}

}  // namespace strut
