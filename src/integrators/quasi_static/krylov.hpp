// The linear systems of implicit steps: GMRES (Belos), preconditioned by algebraic multigrid (MueLu) or by
// another approximate solver. Written in C++17, as its .cpp must be, because Trilinos' parameter validators are
// not C++20.
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

// A field: one vector for each point that this rank owns.
using Field = std::vector<Eigen::Vector3d>;

// Rows of 3×3 blocks, one for each point that this rank owns.
struct BlockRows {
  std::vector<std::size_t> start{0};  // row i: entries start[i] … start[i + 1] − 1, its own column first
  std::vector<std::int64_t> columns;  // global point numbers, as counted by Krylov::first()
  std::vector<Eigen::Matrix3d> blocks;
  std::vector<Eigen::Matrix3d>
      elsewhere;  // of each row: stiffness of the springs to points of other ranks, for factors on each rank
};

class Krylov {
 public:
  // Collective. For fields of `owned` points on this rank.
  Krylov(const Teuchos::RCP<const Teuchos::Comm<int>>& ranks, int owned);
  ~Krylov();

  std::int64_t first() const;  // the global number of this rank's first point

  // Collective. Makes a multigrid hierarchy for a matrix that resembles the system. `kernel`: rigid motions, which have
  // no stiffness where nothing holds the body. If the coarsest grid cannot be factorized (an aggregate with fewer
  // unknowns than rigid motions makes it singular), it is smoothed, too; if no hierarchy can be made, or points are
  // uncoupled, there is none. Returns an error message, or nothing, on all ranks.
  std::string precondition(const BlockRows& matrix, const std::vector<Field>& kernel);
  // Preconditions by a given solver of a similar system, for each rank by itself or for all together.
  using Product = std::function<void(const Field&, Field&)>;
  void precondition_by(Product inverse);
  bool is_preconditioned() const;

  struct Outcome {
    int iterations;
    bool converged;
  };
  // The quantity that must fall to `tolerance` times its value at x = 0: the residual, or an estimate of the error, the
  // preconditioned residual. With a few springs far stiffer than the rest the residual is no measure.
  enum class Measure { residual, error };
  // Collective. Solves K x = right from x = 0. x is the best one found, even if `most` iterations did not converge.
  Outcome solve(const Product& K, const Field& right, Measure measure, double tolerance, int most, Field& x);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace strut
