// Against volumetric locking. Plastic flow keeps the volume, and at the four law points of a cell that would be four
// conditions on the motion of one point: what it cannot meet, pressures of opposite sign would take up, as energy that
// never flows. So in a cell whose metal has flowed the rate of the volume is the mean over its places (B-bar: Hughes,
// Int. J. Numer. Methods Eng. 15, 1980), and so is the pressure in its forces. Both with J as weight: the one is the
// other's adjoint, and the work of the forces stays what the law points take.
#pragma once

#include <algorithm>
#include <array>

#include "mechanics/law_points.hpp"

namespace strut {

// The part of the differences that is kept: none to speak of where the places shrink alike, all where one of them is
// about to be turned inside out, which nothing else would hinder.
template <class T>
T kept_part(const T& least, const T& most, const T& mean) {
  const T spread = (most - least) / mean;
  return spread * spread;
}

// Brings the traces of the rates, or of the stresses, at the places of a cell to their mean.
inline void share_traces(std::array<Deformed, 4>& at, LaneSymmetric Deformed::*what, const Lanes& where) {
  if (!(where > 0).any()) return;
  Lanes sum = Lanes::Zero(), volume = Lanes::Zero(), least = at[0].J, most = at[0].J;
  for (const Deformed& now : at) {
    sum += now.J * small::trace(now.*what);
    volume += now.J;
    least = least.min(now.J), most = most.max(now.J);
  }
  const Lanes mean = sum / volume, shared = 1 - kept_part<Lanes>(least, most, 0.25 * volume).min(1);
  for (Deformed& now : at) {
    LaneSymmetric& s = now.*what;
    const Lanes change = shared / 3 * (mean - small::trace(s));
    for (int c = 0; c < 3; ++c) s.c[c] = (where > 0).select(s.c[c] + change, s.c[c]);
  }
}

// A tensor at each place of a cell.
using CellTensors = std::array<Tensor, 4>;

// The same for δF, and its adjoint for δP, with the deformation as it is: of a tangent.
class SharedVolume {
 public:
  SharedVolume(const MaterialBlock& block, int k) {
    for (int q = 0; q < 4; ++q) {
      F_[q] = block.cells[block.place(k, q)].deformation_gradient;
      inverse_[q] = F_[q].inverse();
      J_[q] = F_[q].determinant();
      volume_ += J_[q];
    }
    const auto [least, most] = std::minmax_element(J_, J_ + 4);
    shared_ = 1 - std::min(1.0, kept_part(*least, *most, 0.25 * volume_));
  }
  void share_gradients(CellTensors& dF) const {
    double mean = 0;
    for (int q = 0; q < 4; ++q) mean += J_[q] * (dF[q] * inverse_[q]).trace() / volume_;
    for (int q = 0; q < 4; ++q) dF[q] += shared_ / 3 * (mean - (dF[q] * inverse_[q]).trace()) * F_[q];
  }
  void share_stresses(CellTensors& dP) const {
    double mean = 0;
    for (int q = 0; q < 4; ++q) mean += dP[q].cwiseProduct(F_[q]).sum() / volume_;
    for (int q = 0; q < 4; ++q) {
      dP[q] += shared_ / 3 * (J_[q] * mean - dP[q].cwiseProduct(F_[q]).sum()) * inverse_[q].transpose();
    }
  }

 private:
  CellTensors F_, inverse_;
  double J_[4], volume_ = 0, shared_ = 1;
};

}  // namespace strut
