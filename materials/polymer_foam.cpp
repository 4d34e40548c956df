// A step of the polymeric foam: trial, return by one equation, state after the flow.
#include "materials/polymer_foam.hpp"

#include <algorithm>
#include <cmath>

#include "materials/spectral.hpp"
#include "materials/step_work.hpp"

namespace strut::materials {

PointStress PolymerFoam::step(const PointStep& step, const Symmetric& stress, State& state) const {
  const Trial trial = this->trial(step, state);
  const Return found = flow(trial, state.compaction);
  const Vector tau = kirchhoff(trial, found);
  const Symmetric next = from_principal(tau / step.J, trial.axes);
  if (!found.converged || !std::isfinite(next[0] + next[1] + next[2] + next[3] + next[4] + next[5])) {
    return {stress, false};
  }
  State reached = state;
  reached.relative_density = initial_density / step.J;
  if (found.deviatoric < 1) {
    store_flow(step, trial, found, reached);
    // Closes the ledger in steps with flow; contains the loss of a foam that stores energy at a higher modulus.
    const double lost = materials::lost(*this, step, determinant(state), stress, state, next, reached);
    if (!std::isfinite(lost)) return {stress, false};
    reached.plastic_work += std::max(0.0, lost);
  }
  state = reached;
  return {next, true};
}

Curve<double> PolymerFoam::hardening(const TableHardening& table, double strain) {
  if (table.strains.empty()) return {0, 0};
  return strain < 0 ? Curve<double>{table.stresses.front(), 0} : table(0, strain);
}

PolymerFoam::Surface PolymerFoam::surface(double compaction) const {
  const double axial = 1 / (1 - 2 * plastic_poisson);  // ε_a/ε_v
  const Curve<double> a = hardening(uniaxial_hardening, axial * compaction);
  const Curve<double> p = hardening(hydrostatic_hardening, compaction);
  const double uniaxial = uniaxial_yield + a.value, hydrostatic = hydrostatic_yield + p.value;
  const double ratio = hydrostatic / uniaxial, ratio_slope = (p.slope - ratio * axial * a.slope) / uniaxial;
  const double compression = ratio - 1.0 / 3, tension = tension_ratio * ratio + 1.0 / 3;
  return {uniaxial, hydrostatic, p.slope, compression * tension, ratio_slope * (tension + tension_ratio * compression)};
}

double PolymerFoam::nearness(double q, double p, const Surface& y) const {
  const double square = y.shape * q * q + p * p, offset = (1 - tension_ratio) * y.hydrostatic * p / 2;
  const double product = tension_ratio * y.hydrostatic * y.hydrostatic;
  const double root = std::sqrt(offset * offset + product * square);
  if (square == 0) return 0;
  return offset > 0 ? square / (root + offset) : (root - offset) / product;
}

Moduli PolymerFoam::kirchhoff_moduli(double J) const {
  const double factor = std::pow(initial_density / J, density_exponent);
  return {factor * solid.bulk, factor * solid.shear};
}

Tensor PolymerFoam::inverse_plastic(const State& state) {
  const Eigen::Map<const Symmetric> P(state.plastic_strain.data());
  return Tensor::Identity() - 2 * to_tensor(P);
}

PolymerFoam::Trial PolymerFoam::trial(const PointStep& step, const State& state) const {
  const Tensor U = to_tensor(step.stretch);
  const auto [squares, axes] = principal(symmetric_part(U * inverse_plastic(state) * U));
  const Moduli now = kirchhoff_moduli(step.J);
  const Vector strain = 0.5 * squares.array().log();
  const double compaction = -strain.sum();
  const Vector deviator = 2 * now.shear * (strain.array() + compaction / 3);
  return {now, strain, axes, deviator, std::sqrt(1.5) * deviator.norm(), compaction, now.bulk * compaction};
}

PolymerFoam::Return PolymerFoam::place(const Trial& trial, double compaction, double z) const {
  const double k = flow_ratio(), divisor = k + (1 - k) * z;
  return {z, z / divisor, k / (divisor * divisor), compaction + (1 - z) * k / divisor * trial.compaction, false};
}

PolymerFoam::Excess PolymerFoam::excess(const Trial& trial, const Return& at, const Surface& y) const {
  const double q = at.deviatoric * trial.mises, p = at.mean * trial.pressure, p_c = y.hydrostatic;
  const double round = y.shape * q * q + p * p, offset = (1 - tension_ratio) * p_c * p,
               product = tension_ratio * p_c * p_c;
  const double by_compaction =
      y.shape_slope * q * q - ((1 - tension_ratio) * p + 2 * tension_ratio * p_c) * y.hydrostatic_slope;
  const double by_pressure = 2 * p - (1 - tension_ratio) * p_c;
  const double by_mean = by_pressure * trial.pressure - by_compaction * trial.compaction;
  return {round - offset - product, std::abs(y.shape) * q * q + p * p + std::abs(offset) + product,
          2 * y.shape * q * trial.mises + by_mean * at.mean_slope, by_compaction, by_pressure};
}

PolymerFoam::Return PolymerFoam::flow(const Trial& trial, double compaction) const {
  const Surface y = surface(compaction);
  const double near = nearness(trial.mises, trial.pressure, y);
  if (near <= 1 + 16 * epsilon) return {1, 1, 0, compaction, y.exists()};
  return solve(trial, compaction, 1 / near);
}

PolymerFoam::Return PolymerFoam::solve(const Trial& trial, double compaction, double guess) const {
  double left = 0, right = 1, z = guess, last_step = 1;
  for (int i = 0; i < most_iterations; ++i) {
    Return at = place(trial, compaction, z);
    const Surface y = surface(at.compaction);
    const Excess f = excess(trial, at, y);
    const double round_off = 2 * epsilon * z;
    if (std::abs(f.value) <= 4 * epsilon * f.size || right - left <= round_off || last_step <= round_off) {
      at.converged = y.exists();
      return at;
    }
    (f.value > 0 ? right : left) = z;
    const double next = z - f.value / f.by_deviatoric;
    const double safe = next > left && next < right ? next : (left + right) / 2;
    last_step = std::abs(safe - z);
    z = safe;
  }
  return {1, 1, 0, compaction, false};
}

Vector PolymerFoam::kirchhoff(const Trial& trial, const Return& found) {
  return (found.deviatoric * trial.deviator).array() - found.mean * trial.pressure;
}

void PolymerFoam::store_flow(const PointStep& step, const Trial& trial, const Return& found, State& state) const {
  const double volume = -found.mean * trial.compaction / 3;
  const Vector strain = (found.deviatoric * trial.deviator / (2 * trial.moduli.shear)).array() + volume;
  const Tensor inverse = to_tensor(step.stretch).inverse();
  const Tensor left = to_tensor(from_principal((2 * strain).array().exp(), trial.axes));  // b_e
  const Symmetric plastic = 0.5 * (spherical(1) - symmetric_part(inverse * left * inverse));
  for (int c = 0; c < 6; ++c) state.plastic_strain[c] = plastic[c];
  state.compaction = found.compaction;
  state.equivalent_plastic_strain += equivalent_increment(trial, found);
}

double PolymerFoam::equivalent_increment(const Trial& trial, const Return& found) const {
  const double beta2 = flow_square(), q = found.deviatoric * trial.mises, p = found.mean * trial.pressure;
  const double x = (1 - found.deviatoric) / (3 * trial.moduli.shear * found.deviatoric);
  return x * std::sqrt((q * q + beta2 * p * p) * (1 + beta2 / 9));
}

void PolymerFoam::move_stress(const Tensor& from, const Tensor& to, State& state) const {
  Eigen::Map<Symmetric> plastic(state.plastic_strain.data());
  const Tensor inverse = Tensor::Identity() - 2 * to_tensor(plastic), change = to.inverse() * from;
  plastic = 0.5 * symmetric_part(Tensor::Identity() - change * inverse * change.transpose());
  state.relative_density = initial_density / to.determinant();
}

}  // namespace strut::materials
