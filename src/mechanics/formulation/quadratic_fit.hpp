// Quadratic correspondence: each point represents a cell with a linear strain.
//
// Least squares with the weights ω V_j fit the motion over the family of a point by y_j − y_i = F ξ + ½ H : ξ⊗ξ. The
// law gives the stress at four integration points s_q of the cell, where F_q = F + H s_q. Each has a quarter of the
// volume; they integrate quadratic functions over the cell exactly. The forces are the exact adjoint, so momenta and
// energy are conserved as by correspondence. H resists the motions that F does not see: there is no stabilization.
//
// The family of a point at the surface is one-sided, so its forces do not balance a stress that leaves the surface
// free. At set-up the deficit is distributed once over the bonds (variational consistency: Chen, Hillman & Rueter, Int.
// J. Numer. Methods Eng. 95, 2013), with a multiplier μ_j for each axis and point:
//   ∂F_i/∂y_j = ω V_j [ ξ P + q B + V_i (μ_j − c_i − C_i ξ − Q_i q) ],
// where c_i + C_i ξ + Q_i q is the trend of μ over the family, fitted with a small penalty on Q, so that linear motions
// stay exact and quadratic ones nearly so.
#pragma once

namespace strut {

// The fit of one point. With N = Σ ω V_j (y_j − y_i) ⊗ (ξ, q, μ_j) and q = (ξx²/2, ξy²/2, ξz²/2, ξx ξy, ξy ξz,
// ξz ξx): F = N_ξ P + N_q B + V (N_μ − Σ ω V_j (y_j − y_i) ⊗ c), H = N_ξ Bᵀ + N_q Q,
// where P and the B of F include C and Q_i of the correction.
struct QuadraticFit {
  double linear[9] = {};   // P, rows of ξ: [3 ξ + F], 1/m⁵
  double mixed[18] = {};   // B, rows of q: [3 q + F], 1/m⁶: its transpose gives H from ξ
  double bent[18] = {};    // B with the correction: it gives F from q
  double second[21] = {};  // Q, the upper triangle by rows, 1/m⁷
  double center[3] = {};   // c, in the unit of μ
  double sums[13] = {};    // Σ ω V_j (1, ξ, q, μ_j) over the family
  double offset[3] = {};   // from the point to the centroid of its cell, m
  double factor[6] = {};   // L: the cell's second moments per volume are L Lᵀ; rows of the lower triangle, m
  double steepness = 0;  // mean over integration points of Σ |∂F_q/∂y_j|²/V_j with the point itself; like tr K⁻¹, 1/m⁵
  static constexpr int size = 92;

  bool carries_stress() const { return steepness > 0; }
};
static_assert(sizeof(QuadraticFit) == QuadraticFit::size * sizeof(double));

// Integration point q of a cell is at offset + L t_q.
inline constexpr double cell_places[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};

}  // namespace strut
