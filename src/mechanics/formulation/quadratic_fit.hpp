// Quadratic correspondence: a point is a cell with a linear strain in it.
//
// Over the family of a point the motion is fitted by y_j − y_i = F ξ + ½ H : ξ⊗ξ, by least squares weighted with ω V_j.
// The law stresses at four places s_q of the cell, a quarter of its volume each, which integrate quadratic functions
// over the cell exactly: F_q = F + H s_q. The forces are the exact adjoint of this, so momenta and energy are conserved
// as by correspondence. A motion that F does not see, H does: no stabilization.
//
// A family at the surface is one-sided, and so its forces do not balance a stress that leaves the surface free. What is
// missing is shared out once, at set-up, among the bonds (variational consistency: Chen, Hillman & Rueter, Int. J.
// Numer. Methods Eng. 95, 2013): with a number μ_j for each axis and point,
//   ∂F_i/∂y_j = ω V_j [ ξ P + q B + V_i (μ_j − c_i − C_i ξ − Q_i q) ],
// where c_i + C_i ξ + Q_i q is the trend of μ over the family, fitted with a small penalty on Q, so that linear motions
// stay exact and quadratic ones nearly.
#pragma once

#include <array>
#include <bit>
#include <functional>
#include <vector>

#include "mechanics/kernels/bonds.hpp"

namespace strut {

// The constants of one point. With N = Σ ω V_j (y_j − y_i) ⊗ (ξ, q, μ_j) and q = (ξx²/2, ξy²/2, ξz²/2, ξx ξy, ξy ξz,
// ξz ξx): F = N_ξ P + N_q B + V (N_μ − Σ ω V_j (y_j − y_i) ⊗ c), H = N_ξ Bᵀ + N_q Q,
// with C and Q_i of the correction in P and in the B of F.
struct QuadraticFit {
  double linear[9] = {};   // P, rows of ξ: [3 ξ + F], 1/m⁵
  double mixed[18] = {};   // B, rows of q: [3 q + F], 1/m⁶: its transpose gives H from ξ
  double bent[18] = {};    // the same with the correction: it gives F from q
  double second[21] = {};  // Q, the upper triangle by rows, 1/m⁷
  double center[3] = {};   // c, as μ
  double sums[13] = {};    // Σ ω V_j (1, ξ, q, μ_j) over the family
  double offset[3] = {};   // from the point to the centroid of its cell, m
  double factor[6] = {};   // L: the cell's second moments per volume are L Lᵀ; rows of the lower triangle, m
  double steepness = 0;  // mean over the places of Σ |∂F_q/∂y_j|²/V_j, the point itself counted: as tr K⁻¹, 1/m⁵
  static constexpr int size = 92;

  bool carries_stress() const { return steepness > 0; }
};
static_assert(sizeof(QuadraticFit) == QuadraticFit::size * sizeof(double));

// Place q of a cell is offset + L t_q.
inline constexpr double cell_places[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};

// Whether the neighbors of an owned point span space well enough for a deformation gradient over its cell.
bool spans_cell(const Domain& domain, int i);

class QuadraticFits {
 public:
  // Collective. Of all owned points of the blocks by quadratic correspondence.
  explicit QuadraticFits(Body& body);

  // Fits an owned point that has lost bonds anew; its μ and those of its neighbors stay. `flows`: whether its metal has
  // flowed. False where the bonds that are left do not span space, or only with a steepness times volume (1/m²) above
  // `most`: the point carries no stress.
  bool refit(const Body& body, int i, bool flows, double most);
  // Fits an owned point that carries stress and whose metal has flowed anew, to the bonds that it has.
  void refit_in_flow(const Body& body, int i);
  void drop(int i) { set(i, {}); }  // it carries no stress

  // What the family of an owned point that carries stress gives to F at a place of its cell: calls visit(j, g) with
  // F = Σ (y_j − y_i) ⊗ g, g in 1/m.
  void for_each_weight(const Body& body, int i, int q, const std::function<void(int j, const Vector& g)>& visit) const;
  // F at such a place, of points at place(j).
  Tensor gradient_at(const Body& body, int i, int q, const std::function<Vector(int j)>& place) const;

  QuadraticFit operator[](int i) const {
    std::array<double, QuadraticFit::size> numbers;
    for (int n = 0; n < QuadraticFit::size; ++n) numbers[n] = fits_.at(number_[i], n);
    return std::bit_cast<QuadraticFit>(numbers);
  }
  bool carries_stress(int i) const { return steepness(i) > 0; }
  double steepness(int i) const { return fits_.at(number_[i], QuadraticFit::size - 1); }
  // In tiles, as QuadraticFit has its numbers, and where a point's are.
  const small::Tiles& tiles() const { return fits_; }
  std::size_t place(int i) const { return number_[i]; }
  // μ of owned points and ghosts, zero of other formulations.
  const Eigen::Array4d* multipliers() const { return multipliers_.data(); }
  double bytes() const;

 private:
  friend class ConsistencyCorrection;
  void set(int i, const QuadraticFit& fit) {
    const auto numbers = std::bit_cast<std::array<double, QuadraticFit::size>>(fit);
    for (int n = 0; n < QuadraticFit::size; ++n) fits_.at(number_[i], n) = numbers[n];
  }

  std::vector<int> number_;  // of owned points, in fits_; −1 of other formulations
  small::Tiles fits_;        // as the cells of blocks (MaterialBlock::slot_of_cell), one block after the other
  std::vector<double> penalties_in_flow_;  // of owned points: the least that a cell has once its metal has flowed
  std::vector<Eigen::Array4d> multipliers_;
};

}  // namespace strut
