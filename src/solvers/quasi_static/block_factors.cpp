#include "solvers/quasi_static/block_factors.hpp"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace strut {

namespace {

using Pattern = Eigen::SparseMatrix<double>;

// What Eigen finds out of a pattern.
class Symbolic : public Eigen::SimplicialLDLT<Pattern, Eigen::Lower, Eigen::NaturalOrdering<int>> {
 public:
  const Eigen::VectorXi& parent() const { return m_parent; }
  const Eigen::VectorXi& filled() const { return m_nonZerosPerCol; }
};

// A block of the row at work: its columns in registers, of four numbers each.
struct Padded {
  Eigen::Array4d column[3] = {Eigen::Array4d::Zero(), Eigen::Array4d::Zero(), Eigen::Array4d::Zero()};

  explicit Padded(const Eigen::Matrix3d& block = Eigen::Matrix3d::Zero()) {
    for (int c = 0; c < 3; ++c) column[c].head<3>() = block.col(c).array();
  }
  Eigen::Matrix3d block() const {
    Eigen::Matrix3d all;
    for (int c = 0; c < 3; ++c) all.col(c) = column[c].head<3>().matrix();
    return all;
  }
  // Takes y Lᵀ away.
  void take_away(const Padded& y, const double* L) {
    for (int c = 0; c < 3; ++c) column[c] -= y.column[0] * L[c] + y.column[1] * L[3 + c] + y.column[2] * L[6 + c];
  }
};

}  // namespace

BlockFactors::BlockFactors(const Pattern& pattern) {
  const int size = static_cast<int>(pattern.rows());
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = pattern;
  start_.assign(by_rows.outerIndexPtr(), by_rows.outerIndexPtr() + size + 1);
  columns_.assign(by_rows.innerIndexPtr(), by_rows.innerIndexPtr() + by_rows.nonZeros());
  blocks_.resize(columns_.size());
  Symbolic symbolic;
  symbolic.analyzePattern(pattern);
  parent_.assign(symbolic.parent().begin(), symbolic.parent().end());
  first_.assign(size + 1, 0);
  for (int k = 0; k < size; ++k) {
    const double count = symbolic.filled()[k];
    first_[k + 1] = first_[k] + symbolic.filled()[k];
    operations_ += 27 * (count + 1) * (count + 1);
  }
}

void BlockFactors::clear() { std::fill(blocks_.begin(), blocks_.end(), Eigen::Matrix3d::Zero()); }

void BlockFactors::add(int row, int column, const Eigen::Matrix3d& block) {
  const auto begin = columns_.begin() + start_[row], end = columns_.begin() + start_[row + 1];
  blocks_[std::lower_bound(begin, end, column) - columns_.begin()] += block;
}

// The columns of row k of L, each before its parent: the ways of the entries of the matrix up the elimination tree.
std::vector<int> BlockFactors::row_of(int k, std::vector<int>& seen_by) const {
  std::vector<int> reversed, way;
  seen_by[k] = k;
  for (int e = start_[k]; e < start_[k + 1]; ++e) {
    way.clear();
    for (int j = columns_[e]; seen_by[j] != k; j = parent_[j]) seen_by[j] = k, way.push_back(j);
    reversed.insert(reversed.end(), way.rbegin(), way.rend());
  }
  std::reverse(reversed.begin(), reversed.end());
  return reversed;
}

bool BlockFactors::factorize() {
  const int size = static_cast<int>(parent_.size());
  below_.resize(first_[size]), rows_.resize(first_[size]);
  diagonal_.resize(size), inverse_.resize(size);
  filled_.assign(size, 0);
  std::vector<int> seen_by(size, -1);
  std::vector<Padded> row(size);
  for (int k = 0; k < size; ++k) {
    for (int e = start_[k]; e < start_[k + 1]; ++e) row[columns_[e]] = Padded(blocks_[e]);
    for (const int j : row_of(k, seen_by)) {
      const Padded y = row[j];  // L_kj D_j
      row[j] = Padded();
      const std::size_t end = first_[j] + filled_[j]++;
      for (std::size_t p = first_[j]; p < end; ++p) row[rows_[p]].take_away(y, below_[p].data());
      below_[end] = y.block() * inverse_[j];
      rows_[end] = k;
      row[k].take_away(y, below_[end].data());
    }
    diagonal_[k] = row[k].block();
    row[k] = Padded();
    const double pivot = diagonal_[k].determinant();
    if (!std::isfinite(pivot) || pivot == 0) return false;
    inverse_[k] = diagonal_[k].inverse();
  }
  return true;
}

void BlockFactors::solve(std::vector<Eigen::Vector3d>& x) const {
  const int size = static_cast<int>(parent_.size());
  for (int j = 0; j < size; ++j) {
    for (std::size_t p = first_[j]; p < first_[j + 1]; ++p) x[rows_[p]] -= below_[p] * x[j];
  }
  for (int j = size; j-- > 0;) {
    x[j] = inverse_[j] * x[j];
    for (std::size_t p = first_[j]; p < first_[j + 1]; ++p) x[j] -= below_[p].transpose() * x[rows_[p]];
  }
}

}  // namespace strut
