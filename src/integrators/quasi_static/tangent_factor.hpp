// A factorization of the tangent of this rank's points, as a preconditioner: the points of other ranks are taken as
// held (block Jacobi over the ranks). Struts, bars and shells fill in so little that it takes as long as some
// tens of products; solid bodies fill in too much, and stay with multigrid (krylov.hpp).
#pragma once

#include <memory>

#include "integrators/quasi_static/constraints.hpp"
#include "mechanics/formulation/tangent.hpp"

namespace strut {

class TangentFactor {
 public:
  // Collective. Orders the points so that they fill in little (approximate minimum degree: Amestoy, Davis & Duff, SIAM
  // J. Matrix Anal. Appl. 17, 1996).
  explicit TangentFactor(const Body& body);
  ~TangentFactor();

  // Whether it is worth its time on all ranks: every block has a stiffness (mechanics/point_stiffness.hpp), and the
  // factorization takes few enough operations.
  bool is_worthwhile() const { return worthwhile_; }
  // How many products of the tangent with a field take as long as the factors, roughly, on all ranks.
  double products_worth() const { return products_worth_; }
  double bytes() const;  // on this rank, where it is

  // Collective. The sum of the points' stiffnesses and `extra` stiffness of each point, N/m; `resembling`: rows that
  // resemble it, which are taken for bonds to other ranks. False where a rank finds no factors.
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
