// SIMD: several cells, one per lane: from the sums over their families to the deformation gradients at their
// integration points, and from the stresses there to the states of their bonds.
#pragma once

#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/kernels/group_tile.hpp"
#include "mechanics/kernels/quadratic_bonds.hpp"

namespace strut {

class QuadraticCells {
  using Lanes = small::Lanes;
  using LaneTensor = small::Tensor3<Lanes>;
  using Row = Eigen::Map<const Lanes, Eigen::AlignedMax>;  // of the numbers of a fit

 public:
  QuadraticCells(const LaneGroup& group, const QuadraticFits& fits, const std::vector<Site>& sites)
      : numbers_(fits.tiles(), places_of(group, fits), group.count),
        volume_(small::lanes_of([&](int l) { return sites[group.i[l]].volume(); })) {
    for (auto& row : moment_) {
      for (Lanes& number : row) number.setZero();
    }
  }

  // Sets F and H of the motion from these sums; zero for cells that carry no stress, whatever μ their neighbors have.
  void take(const bonds::QuadraticMoments<Lanes>& N) {
    const Lanes volume = small::where_positive(steepness(), volume_, Lanes::Zero());
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

  // Adds the Piola–Kirchhoff stress (Pa) at integration point q, weighted with a quarter of the volume.
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

  // The bond states of the points, times the fraction of the step, in the layout of QuadraticState.
  std::array<Lanes, QuadraticState::size> states(const Lanes& force_factor) const {
    std::array<Lanes, QuadraticState::size> numbers;
    Lanes *first = &numbers[0], *second_state = first + 9, *correction = second_state + 18, *offset = correction + 9;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        Lanes a = mean_.c[r][0] * linear(c, 0) + mean_.c[r][1] * linear(c, 1) + mean_.c[r][2] * linear(c, 2);
        for (int k = 0; k < 6; ++k) a += moment_[r][k] * mixed(k, c);
        first[3 * r + c] = force_factor * a;
        correction[3 * r + c] = force_factor * volume_ * mean_.c[r][c];
      }
      for (int l = 0; l < 6; ++l) {
        Lanes b = mean_.c[r][0] * bent(l, 0) + mean_.c[r][1] * bent(l, 1) + mean_.c[r][2] * bent(l, 2);
        for (int k = 0; k < 6; ++k) b += moment_[r][k] * second(k, l);
        second_state[6 * r + l] = force_factor * b;
      }
      offset[r] = correction[3 * r] * center(0) + correction[3 * r + 1] * center(1) + correction[3 * r + 2] * center(2);
    }
    offset[3].setZero();
    return numbers;
  }

  small::Vector3<Lanes> own_force(const std::array<Lanes, QuadraticState::size>& states) const {
    return bonds::quadratic_own_force(states.data(), [this](int n) { return number(69 + n); });
  }

  // Writes the states to state_of(lane).
  template <class StateOf>
  void store(const LaneGroup& group, const Lanes& force_factor, const StateOf& state_of) const {
    small::store_numbers(states(force_factor), group.count, [&](int l) { return state_of(l).first; });
  }

  const Lanes& volume() const { return volume_; }
  Row steepness() const { return number(91); }

 private:
  Row number(int n) const { return small::lanes(numbers_[n]); }
  Row linear(int c, int b) const { return number(3 * c + b); }
  Row mixed(int k, int b) const { return number(9 + 3 * k + b); }
  Row bent(int k, int b) const { return number(27 + 3 * k + b); }
  Row second(int k, int l) const {
    const int low = std::min(k, l), high = std::max(k, l);
    return number(45 + low * 6 - low * (low - 1) / 2 + high - low);
  }
  Row center(int b) const { return number(66 + b); }
  std::array<Lanes, 3> place(int q) const {
    const double* t = cell_places[q];
    const auto s = [this](int n) { return number(82 + n); };
    const auto L = [this](int n) { return number(85 + n); };
    return {Lanes(s(0) + L(0) * t[0]), Lanes(s(1) + L(1) * t[0] + L(2) * t[1]),
            Lanes(s(2) + L(3) * t[0] + L(4) * t[1] + L(5) * t[2])};
  }

  static std::array<int, LaneGroup::width> places_of(const LaneGroup& group, const QuadraticFits& fits) {
    std::array<int, LaneGroup::width> places;
    for (int l = 0; l < LaneGroup::width; ++l) places[l] = static_cast<int>(fits.index(group.i[l]));
    return places;
  }

  GroupTile<QuadraticFit::size, const small::TileRow> numbers_;
  Lanes volume_;
  LaneTensor F_, mean_ = bonds::zero_tensor<Lanes>();
  Lanes H_[3][6];
  Lanes moment_[3][6];
};

}  // namespace strut
