// SIMD: several cells, one per lane: from the sums over their families to the deformation gradients at their places,
// and from the stresses there to the states of their bonds.
#pragma once

#include "mechanics/kernels/quadratic_bonds.hpp"

namespace strut {

class QuadraticCells {
  using Lanes = small::Lanes;
  using LaneTensor = small::Tensor3<Lanes>;

 public:
  QuadraticCells(const LaneGroup& group, const QuadraticFits& fits, const std::vector<Site>& sites)
      : numbers_(small::numbers_of<QuadraticFit::size>([&](int l) { return fits[group.i[l]].linear; })),
        volume_(small::lanes_of([&](int l) { return sites[group.i[l]].volume(); })) {
    for (auto& row : moment_) {
      for (Lanes& number : row) number.setZero();
    }
  }

  // F and H of the motion with these sums; zero of cells that carry no stress, whatever the μ of their neighbors.
  void take(const bonds::QuadraticMoments<Lanes>& N) {
    const Lanes volume = (steepness() > 0).select(volume_, Lanes::Zero());
    for (int r = 0; r < 3; ++r) {
      for (int b = 0; b < 3; ++b) {
        Lanes f = volume * (N.correction.c[r][b] - N.sum.c[r] * center(b));
        for (int c = 0; c < 3; ++c) f += N.first.c[r][c] * linear(c, b);
        for (int k = 0; k < 6; ++k) f += N.second[r][k] * bent(k, b);
        F_.c[r][b] = f;
      }
      for (int k = 0; k < 6; ++k) {
        Lanes h = N.first.c[r][0] * mixed(k, 0) + N.first.c[r][1] * mixed(k, 1) + N.first.c[r][2] * mixed(k, 2);
        for (int l = 0; l < 6; ++l) h += N.second[r][l] * second(k, l);
        H_[r][k] = h;
      }
    }
  }

  const LaneTensor& gradient() const { return F_; }  // at the point

  LaneTensor gradient_at(int q) const {
    const std::array<Lanes, 3> s = place(q);
    LaneTensor F = F_;
    for (int r = 0; r < 3; ++r) {
      F.c[r][0] += H_[r][0] * s[0] + H_[r][3] * s[1] + H_[r][5] * s[2];
      F.c[r][1] += H_[r][3] * s[0] + H_[r][1] * s[1] + H_[r][4] * s[2];
      F.c[r][2] += H_[r][5] * s[0] + H_[r][4] * s[1] + H_[r][2] * s[2];
    }
    return F;
  }

  // Adds the Piola–Kirchhoff stress at place q (Pa) with its quarter of the volume.
  void add_stress(int q, const LaneTensor& P) {
    const std::array<Lanes, 3> s = place(q);
    for (int r = 0; r < 3; ++r) {
      const Lanes p[3] = {0.25 * P.c[r][0], 0.25 * P.c[r][1], 0.25 * P.c[r][2]};
      for (int b = 0; b < 3; ++b) mean_.c[r][b] += p[b];
      for (int a = 0; a < 3; ++a) moment_[r][a] += p[a] * s[a];
      moment_[r][3] += p[0] * s[1] + p[1] * s[0];
      moment_[r][4] += p[1] * s[2] + p[2] * s[1];
      moment_[r][5] += p[2] * s[0] + p[0] * s[2];
    }
  }

  // Writes the states of the bonds of the points, times the share of the step, to state_of(lane).
  template <class StateOf>
  void store(const LaneGroup& group, const Lanes& share, const StateOf& state_of) const {
    Lanes first[9], second_state[18], correction[9], offset[3];
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        Lanes a = mean_.c[r][0] * linear(c, 0) + mean_.c[r][1] * linear(c, 1) + mean_.c[r][2] * linear(c, 2);
        for (int k = 0; k < 6; ++k) a += moment_[r][k] * mixed(k, c);
        first[3 * r + c] = share * a;
        correction[3 * r + c] = share * volume_ * mean_.c[r][c];
      }
      for (int l = 0; l < 6; ++l) {
        Lanes b = mean_.c[r][0] * bent(l, 0) + mean_.c[r][1] * bent(l, 1) + mean_.c[r][2] * bent(l, 2);
        for (int k = 0; k < 6; ++k) b += moment_[r][k] * second(k, l);
        second_state[6 * r + l] = share * b;
      }
      offset[r] = correction[3 * r] * center(0) + correction[3 * r + 1] * center(1) + correction[3 * r + 2] * center(2);
    }
    for (int l = 0; l < group.count; ++l) {
      QuadraticState& state = state_of(l);
      for (int n = 0; n < 9; ++n) state.first[n] = first[n][l], state.correction[n] = correction[n][l];
      for (int n = 0; n < 18; ++n) state.second[n] = second_state[n][l];
      for (int n = 0; n < 3; ++n) state.offset[n] = offset[n][l];
    }
  }

  const Lanes& volume() const { return volume_; }
  const Lanes& steepness() const { return numbers_[91]; }

 private:
  const Lanes& linear(int c, int b) const { return numbers_[3 * c + b]; }
  const Lanes& mixed(int k, int b) const { return numbers_[9 + 3 * k + b]; }
  const Lanes& bent(int k, int b) const { return numbers_[27 + 3 * k + b]; }
  const Lanes& second(int k, int l) const {
    const int low = std::min(k, l), high = std::max(k, l);
    return numbers_[45 + low * 6 - low * (low - 1) / 2 + high - low];
  }
  const Lanes& center(int b) const { return numbers_[66 + b]; }
  std::array<Lanes, 3> place(int q) const {
    const double* t = cell_places[q];
    const Lanes* s = &numbers_[82];
    const Lanes* L = &numbers_[85];
    return {Lanes(s[0] + L[0] * t[0]), Lanes(s[1] + L[1] * t[0] + L[2] * t[1]),
            Lanes(s[2] + L[3] * t[0] + L[4] * t[1] + L[5] * t[2])};
  }

  std::array<Lanes, QuadraticFit::size> numbers_;
  Lanes volume_;
  LaneTensor F_, mean_ = bonds::zero_tensor<Lanes>();
  Lanes H_[3][6];
  Lanes moment_[3][6];
};

}  // namespace strut
