// The linear systems of implicit steps: GMRES (Belos), with algebraic multigrid (MueLu) or what else solves them
// roughly as its preconditioner.
// Written in C++17, as its .cpp must be: Trilinos' parameter validators are not C++20.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Teuchos {
template <class Ordinal>
class Comm;
template <class T>
class RCP;
}  // namespace Teuchos

namespace strut {

// One vector a point that this rank owns.
using Field = std::vector<Eigen::Vector3d>;

// Rows of 3×3 blocks, one for each point that this rank owns.
struct BlockRows {
  std::vector<std::size_t> start{0};  // row i: entries start[i] … start[i + 1] − 1, its own column first
  std::vector<std::int64_t> columns;  // points as Krylov::first() counts them
  std::vector<Eigen::Matrix3d> blocks;
  std::vector<Eigen::Matrix3d>
      elsewhere;  // of each row: of the springs to points of other ranks; for factors on each rank
};

class Krylov {
 public:
  // Collective. For fields of `owned` points on this rank.
  Krylov(const Teuchos::RCP<const Teuchos::Comm<int>>& ranks, int owned);
  ~Krylov();

  std::int64_t first() const;  // of all points, the number of the first one here

  // Collective. A hierarchy of grids for a matrix that resembles the system. `kernel`: the fields that its stiffness
  // does not see where nothing holds it, the rigid motions. Where its coarsest grid cannot be factorized (an aggregate
  // with fewer unknowns than rigid motions makes it singular), that one is smoothed too; where no hierarchy can be
  // made, or no point depends on another, there is none. Returns what went wrong, or nothing, on all ranks.
  std::string precondition(const BlockRows& matrix, const std::vector<Field>& kernel);
  // The same by what solves a system that resembles it, on each rank by itself or together.
  using Product = std::function<void(const Field&, Field&)>;
  void precondition_by(Product inverse);
  bool is_preconditioned() const;

  struct Outcome {
    int iterations;
    bool converged;
  };
  // What is to become `tolerance` times what it is at x = 0: the residual, or roughly the error, which is the
  // preconditioned residual. Beside a few springs far stiffer than the rest the residual says nothing.
  enum class Measure { residual, error };
  // Collective. K x = right from x = 0. The best x found, also where it did not converge in `most` iterations.
  Outcome solve(const Product& K, const Field& right, Measure measure, double tolerance, int most, Field& x);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace strut
