// The consistent tangent of the polymeric foam: the return in principal values, and the spectral derivative of the
// trial. Only equilibrium solvers call it.
#include <cmath>
#include <limits>
#include <utility>

#include "materials/polymer_foam.hpp"
#include "materials/spectral.hpp"

namespace strut::materials {

namespace {

// ln(a/b)/(a − b), accurate to round-off also if a and b are nearly or exactly equal.
double log_slope(double a, double b) {
  const double r = (a - b) / b;
  return (r == 0 ? 1 : std::log1p(r) / r) / b;
}

}  // namespace

// τ_i = z s*_i − w p*, where the excess f(z; q*, p*, ε_v) remains zero: dz = −(∂f at constant z)/(∂f/∂z). The moduli
// are multiplied by J^−γ.
PolymerFoam::PrincipalTangent PolymerFoam::principal_tangent(const Trial& trial, const Return& found) const {
  const auto [K, G] = trial.moduli;
  const double z = found.deviatoric, w = found.mean;
  const Vector one = Vector::Ones();
  // τ at constant z.
  PrincipalTangent result;
  result.by_strain = 2 * G * z * Tensor::Identity() + (K * w - 2 * G * z / 3) * one * one.transpose();
  result.by_volume = -density_exponent * kirchhoff(trial, found);
  if (z == 1) return result;
  const Surface y = surface(found.compaction);
  const Excess f = excess(trial, found, y);
  const double per_square = y.shape * z * z, per_pressure = f.by_pressure * w;  // ∂f/∂q*², ∂f/∂p*
  const double per_compaction = f.by_compaction * (1 - w);                      // ∂f/∂(−tr ε)
  const Vector f_by_strain =
      per_square * 6 * G * trial.deviator - (per_pressure * K + per_compaction) * one;  // dq*² = 6G s* · dε
  const double f_by_volume =
      -density_exponent * (2 * per_square * trial.mises * trial.mises + per_pressure * trial.pressure);
  const Vector by_z = trial.deviator - found.mean_slope * trial.pressure * one;
  result.by_strain -= by_z * f_by_strain.transpose() / f.by_deviatoric;
  result.by_volume -= by_z * f_by_volume / f.by_deviatoric;
  return result;
}

// With b = U C_p⁻¹ U, in its axes: dε_i = db_ii/(2 b_i), and dτ_ij = (τ_i − τ_j)/(b_i − b_j) db_ij, where
// τ_i − τ_j = 2G z (ε_i − ε_j). σ = τ/J.
StretchTangent PolymerFoam::tangent(const PointStep& step, const Symmetric&, const State& old_state) const {
  const Trial trial = this->trial(step, old_state);
  const Return found = flow(trial, old_state.compaction);
  if (!found.converged) return StretchTangent::Constant(std::numeric_limits<double>::quiet_NaN());
  const PrincipalTangent tangent = principal_tangent(trial, found);
  const Symmetric sigma = from_principal(kirchhoff(trial, found) / step.J, trial.axes);
  const Tensor U = to_tensor(step.stretch);
  const Tensor half = inverse_plastic(old_state) * U * trial.axes;
  const Symmetric volume = symmetric_part(U.inverse());
  const Vector squares = (2 * trial.strain).array().exp();
  StretchTangent result;
  for (int d = 0; d < 6; ++d) {
    Symmetric change = Symmetric::Zero();
    change[d] = 1;
    const Tensor part = trial.axes.transpose() * to_tensor(change) * half;
    const Tensor db = part + part.transpose();
    const double dlnJ = double_dot(volume, change);
    const Vector strain = db.diagonal().array() / (2 * squares.array());
    const Vector diagonal = tangent.by_strain * strain + tangent.by_volume * dlnJ;
    Tensor dtau = diagonal.asDiagonal();
    for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 0}}) {
      dtau(i, j) = dtau(j, i) = trial.moduli.shear * found.deviatoric * log_slope(squares[i], squares[j]) * db(i, j);
    }
    result.col(d) = symmetric_part(trial.axes * dtau * trial.axes.transpose()) / step.J - sigma * dlnJ;
  }
  return result;
}

}  // namespace strut::materials
