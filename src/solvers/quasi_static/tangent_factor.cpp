#include "solvers/quasi_static/tangent_factor.hpp"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <optional>

#include "mechanics/point_stiffness.hpp"
#include "solvers/quasi_static/block_factors.hpp"

namespace strut {

namespace {

using Sparse = Eigen::SparseMatrix<double>;  // by columns, lower triangle

// Operations of a factorization for each point: as long as some thousand products of the tangent with a field take,
// where multigrid on a strut in flow needs one to two thousand.
constexpr double most_operations = 1e6;

// Of the resembling matrix, from each point to the ground: what nothing holds would have no factors.
constexpr double to_ground = 1e-5;

// Which owned points share a family, each point itself first.
std::vector<std::vector<int>> coupled_points(const Body& body) {
  std::vector<std::vector<int>> coupled(body.owned());
  std::vector<int> seen_by(body.owned(), -1);
  for (int i = 0; i < body.owned(); ++i) {
    const auto take = [&](int j) {
      if (j < body.owned() && seen_by[j] != i) seen_by[j] = i, coupled[i].push_back(j);
    };
    take(i);
    body.domain.families.for_each(i, take);
    for (std::size_t n = 0, near = coupled[i].size(); n < near; ++n) {
      body.domain.families.for_each(coupled[i][n], take);
    }
  }
  return coupled;
}

// Entries at the places of a matrix of points, without values.
Sparse pattern_of(const std::vector<std::vector<int>>& coupled) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < coupled.size(); ++i) {
    for (const int j : coupled[i]) entries.emplace_back(static_cast<int>(i), j, 1);
  }
  Sparse pattern(static_cast<int>(coupled.size()), static_cast<int>(coupled.size()));
  pattern.setFromTriplets(entries.begin(), entries.end());
  return pattern;
}

}  // namespace

// Point i is number place[i].
struct TangentFactor::Matrix {
  std::vector<int> place;
  std::optional<BlockFactors> factors;

  explicit Matrix(const Sparse& pattern) : place(pattern.rows()) {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(pattern, order);
    for (int n = 0; n < pattern.rows(); ++n) place[order.indices()[n]] = n;
    const Sparse ordered = order.inverse() * pattern * order;
    factors.emplace(Sparse(ordered.triangularView<Eigen::Lower>()));
  }

  void add(int i, int j, const Tensor& block) { factors->add(place[i], place[j], block); }
};

TangentFactor::TangentFactor(const Body& body) {
  const Communicator& ranks = body.domain.communicator;
  if (!have_point_stiffness(body)) return;
  matrix_ = std::make_unique<Matrix>(pattern_of(coupled_points(body)));
  operations_ = matrix_->factors->operations();
  worthwhile_ = ranks.max(operations_ > most_operations * body.owned() ? 1.0 : 0.0) == 0;
  if (!worthwhile_) matrix_ = nullptr;
}

TangentFactor::~TangentFactor() = default;

bool TangentFactor::factorize(const Body& body, const std::vector<PointTangent>& tangents, const Constraints& held,
                              const std::vector<Tensor>& extra, const BlockRows& resembling, std::int64_t first) {
  matrix_->factors->clear();
  const auto add = [&](int i, int j, const Tensor& block) {
    matrix_->add(i, j, held.free_projection(i) * block * held.free_projection(j));
  };
  PointStiffness stiffness;
  for (const MaterialBlock& block : body.blocks) {
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      take_point_stiffness(body, block, static_cast<int>(k), tangents, stiffness);
      for (std::size_t a = 0; a < stiffness.points.size(); ++a) {
        for (std::size_t b = 0; b < stiffness.points.size(); ++b) {
          const int i = stiffness.points[a], j = stiffness.points[b];
          if (std::max(i, j) < body.owned()) add(i, j, stiffness.matrix.block<3, 3>(3 * a, 3 * b));
        }
      }
    }
  }
  for (int i = 0; i < body.owned(); ++i) {
    const std::size_t own = resembling.start[i];
    const double spring = resembling.blocks[own].trace() / 3;
    Tensor diagonal = extra[i] + to_ground * spring * Tensor::Identity();
    for (std::size_t e = own + 1; e < resembling.start[i + 1]; ++e) {
      const std::int64_t column = resembling.columns[e] - first;
      if (column < 0 || column >= body.owned()) diagonal -= resembling.blocks[e];
    }
    add(i, i, diagonal);
    matrix_->add(i, i, spring * (Tensor::Identity() - held.free_projection(i)));
  }
  return body.domain.communicator.max(matrix_->factors->factorize() ? 0.0 : 1.0) == 0;
}

void TangentFactor::solve(const Field& right, Field& x) const {
  Field ordered(right.size());
  for (std::size_t i = 0; i < right.size(); ++i) ordered[matrix_->place[i]] = right[i];
  matrix_->factors->solve(ordered);
  for (std::size_t i = 0; i < right.size(); ++i) x[i] = ordered[matrix_->place[i]];
}

}  // namespace strut
