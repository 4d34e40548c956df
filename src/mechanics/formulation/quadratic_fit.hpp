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

}  // namespace strut
