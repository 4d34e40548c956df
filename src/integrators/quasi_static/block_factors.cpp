#include "integrators/quasi_static/block_factors.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace strut {

namespace {

using Pattern = Eigen::SparseMatrix<double>;

// A block in registers, with its columns padded to four numbers.
struct Padded {
  Eigen::Array4d column[3] = {Eigen::Array4d::Zero(), Eigen::Array4d::Zero(), Eigen::Array4d::Zero()};

  Padded() = default;
  explicit Padded(const Eigen::Matrix3d& block) {
    for (int c = 0; c < 3; ++c) column[c].head<3>() = block.col(c).array();
  }
  Eigen::Matrix3d block() const {
    Eigen::Matrix3d all;
    for (int c = 0; c < 3; ++c) all.col(c) = column[c].head<3>().matrix();
    return all;
  }
  void take_away(const Padded& a, const Eigen::Matrix3d& b) {  // subtracts the product
    for (int c = 0; c < 3; ++c) column[c] -= a.column[0] * b(0, c) + a.column[1] * b(1, c) + a.column[2] * b(2, c);
  }
};

// The present row of L D, and the present column of D U transposed, so that both are multiplied from the right.
struct AtWork {
  Padded lower, upper;
};

}  // namespace

BlockFactors::BlockFactors(const Pattern& pattern) {
  const int size = static_cast<int>(pattern.rows());
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = pattern;
  start_.assign(by_rows.outerIndexPtr(), by_rows.outerIndexPtr() + size + 1);
  columns_.assign(by_rows.innerIndexPtr(), by_rows.innerIndexPtr() + by_rows.nonZeros());
  const std::vector<int> filled = find_parents();
  first_.assign(size + 1, 0);
  for (int k = 0; k < size; ++k) {
    const double count = filled[k];
    first_[k + 1] = first_[k] + filled[k];
    operations_ += 27 * (count + 1) * (count + 1);
  }
}

// Finds the elimination tree from the columns of each row. Returns the fill of each column of L below the diagonal.
std::vector<int> BlockFactors::find_parents() {
  const int size = static_cast<int>(start_.size()) - 1;
  parent_.assign(size, -1);
  std::vector<int> filled(size, 0), seen_by(size, -1);
  for (int k = 0; k < size; ++k) {
    seen_by[k] = k;
    for (int e = start_[k]; e < start_[k + 1]; ++e) {
      for (int j = columns_[e]; seen_by[j] != k; j = parent_[j]) {
        if (parent_[j] < 0) parent_[j] = k;
        seen_by[j] = k;
        ++filled[j];
      }
    }
  }
  return filled;
}

double BlockFactors::bytes() const {
  return static_cast<double>(columns_.size()) * (sizeof(Pair) + sizeof(int)) +
         static_cast<double>(first_.back()) * (sizeof(Factor) + sizeof(int));
}

void BlockFactors::clear() { blocks_.assign(columns_.size(), Pair()); }

void BlockFactors::add(int row, int column, const Eigen::Matrix3d& block) {
  const int low = std::min(row, column), high = std::max(row, column);
  const auto begin = columns_.begin() + start_[high], end = columns_.begin() + start_[high + 1];
  Pair& at = blocks_[std::lower_bound(begin, end, low) - columns_.begin()];
  (row >= column ? at.lower : at.upper) += block;
}

// Columns of row k of L, each before its parent: the paths of the row's entries up the elimination tree.
std::vector<int> BlockFactors::row_of(int k, std::vector<int>& seen_by) const {
  std::vector<int> reversed, path;
  seen_by[k] = k;
  for (int e = start_[k]; e < start_[k + 1]; ++e) {
    path.clear();
    for (int j = columns_[e]; seen_by[j] != k; j = parent_[j]) seen_by[j] = k, path.push_back(j);
    reversed.insert(reversed.end(), path.rbegin(), path.rend());
  }
  std::reverse(reversed.begin(), reversed.end());
  return reversed;
}

bool BlockFactors::factorize() {
  const int size = static_cast<int>(parent_.size());
  factors_.resize(first_[size]), rows_.resize(first_[size]);
  inverse_.resize(size);
  filled_.assign(size, 0);
  std::vector<int> seen_by(size, -1);
  std::vector<AtWork> row(size);
  for (int k = 0; k < size; ++k) {
    for (int e = start_[k]; e < start_[k + 1]; ++e) {
      row[columns_[e]] = {Padded(blocks_[e].lower), Padded(blocks_[e].upper.transpose())};
    }
    for (const int j : row_of(k, seen_by)) {
      const AtWork y = row[j];
      row[j] = AtWork();
      const std::size_t end = first_[j] + filled_[j]++;
      for (std::size_t p = first_[j]; p < end; ++p) {
        row[rows_[p]].lower.take_away(y.lower, factors_[p].upper);
        row[rows_[p]].upper.take_away(y.upper, factors_[p].lower_transposed);
      }
      const Eigen::Matrix3d L = y.lower.block() * inverse_[j], U = inverse_[j] * y.upper.block().transpose();
      factors_[end] = {L.transpose(), U};
      rows_[end] = k;
      row[k].lower.take_away(y.lower, U);
    }
    const Eigen::Matrix3d pivot = row[k].lower.block();
    row[k] = AtWork();
    const double volume = pivot.determinant();
    if (!std::isfinite(volume) || volume == 0) return false;
    inverse_[k] = pivot.inverse();
  }
  return true;
}

void BlockFactors::solve(std::vector<Eigen::Vector3d>& x) const {
  const int size = static_cast<int>(parent_.size());
  for (int j = 0; j < size; ++j) {
    for (std::size_t p = first_[j]; p < first_[j + 1]; ++p) {
      x[rows_[p]] -= factors_[p].lower_transposed.transpose() * x[j];
    }
  }
  for (int j = size; j-- > 0;) {
    x[j] = inverse_[j] * x[j];
    for (std::size_t p = first_[j]; p < first_[j + 1]; ++p) x[j] -= factors_[p].upper * x[rows_[p]];
  }
}

}  // namespace strut
