// LDU of a sparse matrix of 3×3 blocks whose pattern is symmetric, while its numbers need not be: row by row without
// pivoting, as Eigen::SimplicialLDLT does with symmetric matrices of numbers (the algorithm: Davis, Algorithm 849, ACM
// Trans. Math. Softw. 31, 2005). Each index is read once for eighteen numbers.
#pragma once

#include <Eigen/Sparse>
#include <vector>

namespace strut {

class BlockFactors {
 public:
  // `pattern`: the lower triangle of the matrix of blocks, the diagonal too, in the order of elimination.
  explicit BlockFactors(const Eigen::SparseMatrix<double>& pattern);

  double operations() const { return operations_; }  // of one factorization
  double bytes() const;                              // of the matrix and its factors

  // The matrix: zero (first of all), then what is added.
  void clear();
  void add(int row, int column, const Eigen::Matrix3d& block);

  // False where a pivot is none: nothing can be solved then.
  bool factorize();
  void solve(std::vector<Eigen::Vector3d>& x) const;  // in place

 private:
  std::vector<int> find_parents();
  std::vector<int> row_of(int k, std::vector<int>& seen_by) const;

  // One below the diagonal and the one across from it.
  struct Pair {
    Eigen::Matrix3d lower = Eigen::Matrix3d::Zero(), upper = Eigen::Matrix3d::Zero();
  };

  std::vector<int> start_, columns_;  // of the matrix, by rows to the diagonal
  std::vector<Pair> blocks_;          // the diagonal's are `lower`
  std::vector<int> parent_;           // in the elimination tree; -1: a root
  std::vector<std::size_t> first_;    // of the columns of L and rows of U
  std::vector<int> filled_, rows_;    // their numbers of entries so far, and rows (of U: columns)
  struct Factor {
    Eigen::Matrix3d lower_transposed, upper;  // of L, of U
  };
  std::vector<Factor> factors_;
  std::vector<Eigen::Matrix3d> inverse_;  // D⁻¹
  double operations_ = 0;
};

}  // namespace strut
