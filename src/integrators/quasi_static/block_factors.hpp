// LDU factors of a sparse matrix of 3×3 blocks with a symmetric pattern and possibly unsymmetric values, row by row
// without pivoting, as Eigen::SimplicialLDLT does for symmetric scalar matrices (algorithm: Davis, Algorithm 849, ACM
// Trans. Math. Softw. 31, 2005). Each index is read once for eighteen numbers.
#pragma once

#include <Eigen/Sparse>
#include <vector>

namespace strut {

class BlockFactors {
 public:
  // `pattern`: the lower triangle of the block matrix with its diagonal, in the order of elimination.
  explicit BlockFactors(const Eigen::SparseMatrix<double>& pattern);

  double operations() const { return operations_; }  // of one factorization
  double bytes() const;                              // of the matrix and its factors

  // The matrix: clear() first sets it to zero, then add() adds blocks.
  void clear();
  void add(int row, int column, const Eigen::Matrix3d& block);

  // Returns false if a pivot is zero or not finite; solve() must not be called then.
  bool factorize();
  void solve(std::vector<Eigen::Vector3d>& x) const;  // in place

 private:
  std::vector<int> find_parents();
  std::vector<int> row_of(int k, std::vector<int>& seen_by) const;

  // A block below the diagonal and its counterpart above.
  struct Pair {
    Eigen::Matrix3d lower = Eigen::Matrix3d::Zero(), upper = Eigen::Matrix3d::Zero();
  };

  std::vector<int> start_, columns_;  // of the matrix, by rows to the diagonal
  std::vector<Pair> blocks_;          // diagonal blocks are in `lower`
  std::vector<int> parent_;           // in the elimination tree; -1: a root
  std::vector<std::size_t> first_;    // first entries of the columns of L and rows of U
  std::vector<int> filled_, rows_;    // their numbers of entries so far; their rows (for U: columns)
  struct Factor {
    Eigen::Matrix3d lower_transposed, upper;  // of L, of U
  };
  std::vector<Factor> factors_;
  std::vector<Eigen::Matrix3d> inverse_;  // D⁻¹
  double operations_ = 0;
};

}  // namespace strut
