#include "vibration.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <random>

#include "base/errors.hpp"

namespace strut::reference {

namespace {

// Zero, relative to the highest of the squares of frequencies: round-off of a sum over some hundred bonds leaves 1e-14
// to a rigid motion, and the first bending of a strut six points thick has 1e-4.
constexpr double zero = 1e-9;

constexpr int room = 30;  // modes besides the wanted ones that the search keeps: rigid ones, and what has no stiffness

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 engine(1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return static_cast<double>(engine()) / 2147483648.0 - 1; });
}

// ---- The matrix ----------------------------------------------------------------------------------------------------

// Points so far from each other that no point feels two of a group.
std::vector<std::vector<int>> far_groups(const Body& body, double distance) {
  const auto far = [&](int i, int j) {
    return (body.domain.reference(i) - body.domain.reference(j)).squaredNorm() > distance * distance;
  };
  std::vector<std::vector<int>> groups;
  for (int i = 0; i < body.owned(); ++i) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const std::vector<int>& members) {
      return std::all_of(members.begin(), members.end(), [&](int j) { return far(i, j); });
    });
    if (group == groups.end())
      groups.push_back({i});
    else
      group->push_back(i);
  }
  return groups;
}

int nearest(const Body& body, const std::vector<int>& members, int i) {
  return *std::min_element(members.begin(), members.end(), [&](int a, int b) {
    const Vector X = body.domain.reference(i);
    return (body.domain.reference(a) - X).squaredNorm() < (body.domain.reference(b) - X).squaredNorm();
  });
}

void check_symmetry(const SparseMatrix& matrix) {
  const SparseMatrix transpose = matrix.transpose();
  if ((matrix - transpose).norm() < 1e-10 * matrix.norm()) return;
  throw Error("the stiffness matrix is not symmetric: expected forces that reach less far, or that have an energy");
}

// ---- The lowest modes ----------------------------------------------------------------------------------------------

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(columns).householderQ() *
         Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
}

// The lowest eigenvalues by iteration of a subspace with the inverse of A + σ, until the `count` lowest stand still.
Eigen::VectorXd lowest(const SparseMatrix& A, int size, int count, double shift) {
  SparseMatrix identity(A.rows(), A.cols());
  identity.setIdentity();
  const SparseMatrix shifted = A + shift * identity;
  const Eigen::SimplicialLDLT<SparseMatrix> inverse(shifted);
  Eigen::MatrixXd space = orthonormal(random_matrix(A.rows(), size));
  Eigen::VectorXd values = Eigen::VectorXd::Zero(size);
  for (int n = 0; n < 200; ++n) {
    space = orthonormal(inverse.solve(space));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small(space.transpose() * (A * space));
    const Eigen::VectorXd& now = small.eigenvalues();
    const double change = (now - values).head(count).cwiseAbs().maxCoeff();
    values = now;
    space = space * small.eigenvectors();
    if (change < 1e-7 * values[count - 1]) return values;
  }
  throw Error("the lowest frequencies were not found");
}

// ---- The highest mode ----------------------------------------------------------------------------------------------

// By Lanczos, from below: to some 1e-4 after so many steps.
double largest_eigenvalue(const SparseMatrix& A) {
  const int steps = static_cast<int>(std::min<Eigen::Index>(A.rows(), 80));
  Eigen::MatrixXd space(A.rows(), steps);
  Eigen::VectorXd next = random_matrix(A.rows(), 1);
  for (int n = 0; n < steps; ++n) {
    for (int again = 0; again < 2; ++again) next -= space.leftCols(n) * (space.leftCols(n).transpose() * next);
    space.col(n) = next.normalized();
    next = A * space.col(n);
  }
  const Eigen::MatrixXd small = space.transpose() * (A * space);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(small, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace

SparseMatrix stiffness_matrix(Body& body, double reach) {
  advance_stress_and_force(body, 0, false);
  double horizon = 0;
  for (const BlockHorizons& block : body.domain.blocks) horizon = std::max(horizon, block.largest);
  std::vector<Site> directions = body.domain.sites;
  for (Site& site : directions) site.current.head<3>() = 0;
  ForceStates scratch = body.force_states;
  std::vector<Vector> result(body.owned());
  std::vector<Eigen::Triplet<double>> entries;
  // Two members of a group are twice the reach apart, so that what a point feels is of the one nearest to it.
  for (const std::vector<int>& group : far_groups(body, 2.001 * reach * horizon)) {
    for (int component = 0; component < 3; ++component) {
      for (const int j : group) directions[j].current[component] = 1;
      apply_tangent(body, body.domain.halo, directions, nullptr, scratch, result);
      for (const int j : group) directions[j].current[component] = 0;
      for (int i = 0; i < body.owned(); ++i) {
        if (result[i].isZero(0)) continue;
        const int column = 3 * nearest(body, group, i) + component;
        for (int c = 0; c < 3; ++c) entries.emplace_back(3 * i + c, column, body.domain.volume(i) * result[i][c]);
      }
    }
  }
  SparseMatrix matrix(3 * body.owned(), 3 * body.owned());
  matrix.setFromTriplets(entries.begin(), entries.end());
  check_symmetry(matrix);
  return matrix;
}

Eigen::VectorXd masses_of(const Body& body) {
  Eigen::VectorXd masses(body.owned());
  for (int i = 0; i < body.owned(); ++i) masses[i] = body.mass(i);
  return masses;
}

SparseMatrix by_mass(const SparseMatrix& stiffness, const Eigen::VectorXd& masses) {
  Eigen::VectorXd scale(stiffness.rows());
  for (Eigen::Index i = 0; i < masses.size(); ++i) scale.segment<3>(3 * i).setConstant(1 / std::sqrt(masses[i]));
  const SparseMatrix transpose = stiffness.transpose();
  return scale.asDiagonal() * SparseMatrix(0.5 * (stiffness + transpose)) * scale.asDiagonal();
}

Vibration vibration_of(const SparseMatrix& by_mass, int count) {
  const double most = largest_eigenvalue(by_mass);
  const int size = static_cast<int>(std::min<Eigen::Index>(by_mass.rows(), 6 + count + room));
  // So small a shift that modes without stiffness are told from the others at once, so large that its inverse is exact.
  const Eigen::VectorXd values = lowest(by_mass, size, 6 + count, 1e-6 * most);
  Vibration vibration{static_cast<int>((values.array() < zero * most).count()), {}, std::sqrt(most)};
  if (vibration.zeros + count > size) throw Error("more modes without stiffness than expected");
  for (int n = 0; n < count; ++n) vibration.frequencies.push_back(std::sqrt(values[vibration.zeros + n]));
  return vibration;
}

}  // namespace strut::reference
