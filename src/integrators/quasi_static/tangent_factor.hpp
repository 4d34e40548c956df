// A factorization of the tangent of this rank's points, as a preconditioner: points of other ranks count as held (block
// Jacobi over the ranks). Struts, bars and shells have so little fill-in that it takes as long as some tens of
// products; solid bodies have too much, and use multigrid (krylov.hpp).
#pragma once

#include <memory>

#include "integrators/quasi_static/constraints.hpp"
#include "mechanics/formulation/tangent.hpp"

namespace strut {

// A sparse matrix that resembles the tangent of a body, for the preconditioner: springs between near neighbors, with
// the present stiffness of their ends' material. The tangent couples points over two horizons and is never assembled.

// Collective. The rows of this rank's points; `first`: global number of the first of them. `extra`: stiffness of each
// point besides that of its bonds, N/m.
BlockRows preconditioner_matrix(Body& body, const std::vector<PointTangent>& tangents, const Constraints& held,
                                const std::vector<Tensor>& extra, std::int64_t first);

// Collective. Translations, and small rotations about the center of the present positions.
std::vector<Field> rigid_motions(const Body& body);

class TangentFactor {
 public:
  // Collective. Orders the points for little fill-in (approximate minimum degree: Amestoy, Davis & Duff, SIAM J. Matrix
  // Anal. Appl. 17, 1996).
  explicit TangentFactor(const Body& body);
  ~TangentFactor();

  // True if it is worthwhile on all ranks: every block has a stiffness (mechanics/point_stiffness.hpp), and the
  // factorization takes few enough operations.
  bool is_worthwhile() const { return worthwhile_; }
  // Number of products of the tangent with a field that take as long as the factorization on the slowest rank.
  double products_worth() const { return products_worth_; }
  double bytes() const;  // on this rank, if there are factors

  // Collective. Factorizes the sum of the points' stiffnesses and the `extra` stiffness of each point, N/m;
  // `resembling`: rows of a similar matrix, used for bonds to other ranks. Returns false if a rank finds no factors.
  bool factorize(const Body& body, const std::vector<PointTangent>& tangents, const Constraints& held,
                 const std::vector<Tensor>& extra, const BlockRows& resembling);
  void solve(const Field& right, Field& x) const;

 private:
  struct Matrix;
  std::unique_ptr<Matrix> matrix_;
  bool worthwhile_ = false;
  double products_worth_ = 0;
};

}  // namespace strut
