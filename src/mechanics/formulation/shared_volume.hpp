// Prevents volumetric locking. Plastic flow conserves volume; at the four integration points of a cell, that is four
// conditions on the motion of one point, and pressures of opposite sign would store the mismatch as energy that never
// flows. So in a cell whose metal has flowed, the rate of volume is brought to its mean over the integration points
// (B-bar: Hughes, Int. J. Numer. Methods Eng. 15, 1980), and so is the pressure. Both means have J as weight, so that
// one is the adjoint of the other and the work of the forces equals the work that the integration points take.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/math/lanes.hpp"
#include "base/math/small_tensors.hpp"
#include "mechanics/body.hpp"

namespace strut {

// The fraction of the differences that is kept: almost none if the integration points shrink alike, all if one is about
// to invert, which nothing else would resist.
template <class T>
T kept_part(const T& least, const T& most, const T& mean) {
  const T spread = (most - least) / mean;
  return spread * spread;
}

// By this factor the kept differences of solids that hardly change their volume are smaller, so that they resist as
// those of a metal do (K = 3 G).
inline double resisting_part(const MaterialBlock& block) {
  return block.shares_volume ? 3 / materials::bulk_over_shear(block.material.law) : 1;
}

// Brings the traces of tensors (rates or stresses) at the integration points of cells near their mean, weighted with J.
// `where`: 1 for cells that do so, 0 for others; `resisting`: resisting_part().
inline void share_traces(const std::array<small::Lanes, 4>& J,
                         const std::array<small::Symmetric3<small::Lanes>*, 4>& tensors, const small::Lanes& where,
                         double resisting = 1) {
  using small::Lanes;
  if (!small::any_positive(where)) return;
  Lanes sum = Lanes::Zero(), volume = Lanes::Zero(), least = J[0], most = J[0];
  for (int q = 0; q < 4; ++q) {
    sum += J[q] * small::trace(*tensors[q]);
    volume += J[q];
    least = least.min(J[q]), most = most.max(J[q]);
  }
  const Lanes mean = sum / volume, shared = 1 - (resisting * kept_part<Lanes>(least, most, 0.25 * volume)).min(1);
  for (auto* s : tensors) {
    const Lanes change = shared / 3 * (mean - small::trace(*s));
    for (int c = 0; c < 3; ++c) s->c[c] = small::where_positive(where, s->c[c] + change, s->c[c]);
  }
}

// The same for laws whose energy W follows from the stretch (F-bar: de Souza Neto, Perić, Dutko & Owen, Int. J. Solids
// Struct. 33, 1996): with the mean volume J̄ the cell has the energy Σ ¼ W(F̄_q), F̄_q = (J̄/J_q)^⅓ F_q, whose derivative
// is σ_q = J̄/J_q dev σ̄_q + Σ ¼ tr σ̄_r/3, σ̄ the law's stress at F̄.
class MeanVolume {
  using Lanes = small::Lanes;

 public:
  // `J`: of the integration points. Where one is not positive, nothing is shared.
  explicit MeanVolume(const std::array<Lanes, 4>& J) : least_(J[0]) {
    Lanes mean = Lanes::Zero();
    for (const Lanes& one : J) mean += 0.25 * one, least_ = least_.min(one);
    for (int q = 0; q < 4; ++q) ratio_[q] = small::where_positive(least_, mean / J[q], Lanes::Ones());
  }

  // Brings the stretch and the determinant of integration point q to the mean volume.
  void bring(int q, small::Symmetric3<Lanes>& stretch, Lanes& J) const {
    const Lanes scale = small::lanes_of([&](int l) { return std::cbrt(ratio_[q][l]); });
    for (Lanes& number : stretch.c) number *= scale;
    J *= ratio_[q];
  }

  // From the law's stresses to those of the integration points.
  void distribute(const std::array<small::Symmetric3<Lanes>*, 4>& stresses) const {
    Lanes mean = Lanes::Zero();
    for (const auto* s : stresses) mean += small::trace(*s) / 12;
    for (int q = 0; q < 4; ++q) {
      auto& s = *stresses[q];
      const Lanes own = small::trace(s) / 3, shared = small::where_positive(least_, mean, own);
      for (int c = 0; c < 3; ++c) s.c[c] = ratio_[q] * (s.c[c] - own) + shared, s.c[3 + c] *= ratio_[q];
    }
  }

 private:
  Lanes least_;
  std::array<Lanes, 4> ratio_;  // J̄/J
};

// A tensor at each integration point of a cell.
using CellTensors = std::array<Tensor, 4>;

// The deformation gradients at the integration points of a cell, and what follows from them.
struct CellGradients {
  CellTensors F, inverse_transposed;
  std::array<double, 4> J;
  double volume = 0;  // Σ J

  CellGradients(const MaterialBlock& block, int k) {
    for (int q = 0; q < 4; ++q) {
      F[q] = block.cells[block.index(k, q)].deformation_gradient;
      inverse_transposed[q] = F[q].inverse().transpose();
      J[q] = F[q].determinant();
      volume += J[q];
    }
  }

  // For δF the rates of the volume, F⁻ᵀ : δF, and their mean, weighted with J.
  std::pair<std::array<double, 4>, double> volume_rates(const CellTensors& dF) const {
    std::pair<std::array<double, 4>, double> found{};
    for (int q = 0; q < 4; ++q) {
      found.first[q] = inverse_transposed[q].cwiseProduct(dF[q]).sum();
      found.second += J[q] * found.first[q] / volume;
    }
    return found;
  }
};

// The same for δF, and its adjoint for δP, at fixed deformation: for a tangent.
class SharedVolume {
 public:
  SharedVolume(const MaterialBlock& block, int k) : at_(block, k) {
    const auto [least, most] = std::ranges::minmax(at_.J);
    shared_ = 1 - std::min(1.0, resisting_part(block) * kept_part(least, most, 0.25 * at_.volume));
  }
  void share_gradients(CellTensors& dF) const {
    const auto [rate, mean] = at_.volume_rates(dF);
    for (int q = 0; q < 4; ++q) dF[q] += shared_ / 3 * (mean - rate[q]) * at_.F[q];
  }
  void share_stresses(CellTensors& dP) const {
    double pull[4], mean = 0;  // δP : F
    for (int q = 0; q < 4; ++q) {
      pull[q] = dP[q].cwiseProduct(at_.F[q]).sum();
      mean += pull[q] / at_.volume;
    }
    for (int q = 0; q < 4; ++q) dP[q] += shared_ / 3 * (at_.J[q] * mean - pull[q]) * at_.inverse_transposed[q];
  }

 private:
  CellGradients at_;
  double shared_ = 1;
};

// The derivative of MeanVolume: δP of the integration points for δF, by that of the law at the mean volume.
class MeanVolumeTangent {
 public:
  MeanVolumeTangent(const MaterialBlock& block, int k) : at_(block, k), mean_J_(0.25 * at_.volume) {
    for (int q = 0; q < 4; ++q) {
      const MaterialPoint point = at_mean(block.cells[block.index(k, q)], q);
      const Tensor R = point.rotation.tensor(), U = R.transpose() * point.deformation_gradient;
      P_[q] = mean_J_ * R * to_tensor(point.stress) * U.inverse();
      pull_[q] = P_[q].cwiseProduct(point.deformation_gradient).sum();
      mean_pull_ += 0.25 * pull_[q];
    }
  }

  // Integration point q with the gradient F̄ that its law sees.
  MaterialPoint at_mean(MaterialPoint point, int q) const {
    point.deformation_gradient *= scale(q);
    return point;
  }

  // P_q = a P̄_q + ⅓ (J_q/J̄ p − p_q) F_q⁻ᵀ with a = (J̄/J_q)^⅓, p_q = P̄_q : F̄_q, p = Σ ¼ p_r. `law(q, δF̄)`: δP̄_q.
  template <class Law>
  CellTensors change(const CellTensors& dF, const Law& law) const {
    const auto [rate, mean_rate] = at_.volume_rates(dF);
    double dpull[4], mean_dpull = 0;
    CellTensors dP;
    for (int q = 0; q < 4; ++q) {
      const double a = scale(q), da = (mean_rate - rate[q]) / 3;
      const Tensor shared_dF = a * (dF[q] + da * at_.F[q]), of_law = law(q, shared_dF);
      dpull[q] = of_law.cwiseProduct(a * at_.F[q]).sum() + P_[q].cwiseProduct(shared_dF).sum();
      mean_dpull += 0.25 * dpull[q];
      dP[q] = a * (of_law + da * P_[q]);
    }
    for (int q = 0; q < 4; ++q) {
      const double ratio = at_.J[q] / mean_J_, more = ratio * mean_pull_ - pull_[q];
      const double change = ratio * ((rate[q] - mean_rate) * mean_pull_ + mean_dpull) - dpull[q];
      const Tensor& inverse = at_.inverse_transposed[q];
      dP[q] += change / 3 * inverse - more / 3 * inverse * dF[q].transpose() * inverse;
    }
    return dP;
  }

 private:
  double scale(int q) const { return std::cbrt(mean_J_ / at_.J[q]); }

  CellGradients at_;
  CellTensors P_;
  double pull_[4], mean_J_, mean_pull_ = 0;
};

}  // namespace strut
