// Equilibrium by Newton's method: consistent tangent, GMRES, line search, and damping where the tangent gives no useful
// direction.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "integrators/quasi_static/equilibrium.hpp"
#include "integrators/quasi_static/krylov.hpp"
#include "integrators/quasi_static/tangent_factor.hpp"

namespace strut {

class Newton {
 public:
  Newton(Equilibrium& equilibrium, const Observer& observer);

  // Makes the next search independent of earlier ones.
  void begin_anew() { preconditioner_pending_ = true; }

  void serialize(Archive& archive);  // state of the earlier systems that a resumed run needs

  // Collective. Starts from the present positions, within the step that the equilibrium has begun.
  EquilibriumSearch solve(const Tolerance& tolerance);

 private:
  int correct(const Field& remaining, bool moves, double accuracy, Field& step);
  Imbalance advance(const Imbalance& now, const Field& step, bool moves);
  void warn_once(const std::string& trouble);
  Krylov::Outcome with_another_preconditioner(const std::function<Krylov::Outcome()>& solve);
  void renew_preconditioner();
  void precondition(const BlockRows& matrix, const std::vector<Tensor>& extra);
  double mean_spring(const BlockRows& matrix) const;
  void renew_drag(const BlockRows& matrix, const std::vector<Tensor>& extra);
  void damp_less(double factor);
  void damp_more(double factor);
  void report(const EquilibriumSearch& search, int products) const;

  Equilibrium& equilibrium_;
  const Observer& observer_;
  Krylov krylov_;
  std::optional<TangentFactor> factor_;  // made once multigrid takes too many products (wants_factors_)
  double spring_ = 1;                    // N/m, diagonal of the linear systems in held directions: as stiff as others
  int products_when_new_ = 0;
  bool preconditioner_pending_ = true, wants_factors_ = false, is_factorized_ = false;
  bool has_warned_ = false;

  // Damping adds a spring of stiffness damping_ · drag_ (N/m) to each point in the linear systems, not in the residual.
  double damping_ = 0, damping_when_new_ = 0;
  std::vector<double> drag_;  // N/m: stiffness of a point by its near neighbors
  int damped_ = 0;            // iterations with damping in this search
};

}  // namespace strut
