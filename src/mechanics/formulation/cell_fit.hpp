// Inside mechanics: the fit of y_j − y_i = F ξ + ½ H : ξ⊗ξ over the family of one point, for its cell.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mechanics/body.hpp"
#include "mechanics/formulation/quadratic_fit.hpp"

namespace strut {

// The penalty on H before plastic flow, relative to the mean square of the bonds, in spacings.
inline constexpr double least_penalty = 1e-4;

// The least mean square of a family's bonds in any direction, in spacings². Below it F is undetermined, and the point
// carries no stress.
inline constexpr double least_for_stress = 0.02;

using Basis = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

CellShape cube_of(double volume);  // m³
CellShape shape_of(const Body& body, int i);
Basis basis(const Vector& xi, double h);    // ξ and q, in spacings h
double least_square(const Tensor& spread);  // the least eigenvalue

void set_cell(const CellShape& shape, QuadraticFit& fit);
Vector place_of(const QuadraticFit& fit, int q);  // position of integration point q relative to the point, m

// Sums over a family, in spacings: weight = Σ ω V_j, moments = Σ ω V_j b bᵀ, squares = Σ g gᵀ/V_j, where g = ω V_j b is
// the weight of y_j in the fit. squares includes the point itself, whose weight is −Σ g.
struct FamilySums {
  double weight = 0;
  Matrix9 moments = Matrix9::Zero(), squares = Matrix9::Zero();
};

// `h`: spacing of the point, m; over(visit) calls visit(ω V_j, V_j, ξ) for each bond.
template <class Over>
FamilySums sums_of_family(double h, double volume, const Over& over) {
  FamilySums sums;
  Basis first = Basis::Zero();
  over([&](double w, double far_volume, const Vector& xi) {
    const Basis b = basis(xi, h);
    const Matrix9 product = b * b.transpose();
    sums.weight += w;
    sums.moments += w * product;
    sums.squares += w * w / far_volume * product;
    first += w * b;
  });
  sums.squares += first * first.transpose() / volume;
  return sums;
}

// Sets P, B, Q of a point with the spacing h (m) and a volume (m³), whose cell is set; the penalty is `least` or
// larger. Returns false if its neighbors do not span space.
bool fit_motion(const FamilySums& sums, double h, double volume, double least, QuadraticFit& fit);
bool fit_motion(const Body& body, int i, double least, QuadraticFit& fit);

// Derivative of F, at a position in the cell of i, by y_j as a vector, 1/m: ∂F_rb/∂y_jr. `w`: ω V_j; `mu`: μ_j.
Vector weight_of_bond(const QuadraticFit& fit, double volume, double w, const Vector& xi, const Eigen::Array4d& mu,
                      const Vector& place);

// ---- The cell of a point on a lattice, for any set of bonds ----

struct FitBond {
  Vector xi;      // m
  double weight;  // ω V, m³
};

// Weights of the far ends of a point's bonds in F at the integration points of its cell, ∂F_rb/∂y_jr, 1/m; and its
// steepness times its volume, 1/m². No bonds if the point carries no stress.
struct CellWeights {
  std::vector<std::array<Vector, 4>> bonds;
  double steepness = 0;
};

// The weights of a cubic cell of edge `spacing` (m), without correction at surfaces.
CellWeights lattice_cell(double spacing, const std::vector<FitBond>& family);

// ---- The trend of the correction μ over a family ----

// The function c + C ξ + Q q, fitted to values at the family and at the point itself.
struct Trend {
  Vector c = Vector::Zero();
  Tensor C = Tensor::Zero();
  Eigen::Matrix<double, 3, 6> Q = Eigen::Matrix<double, 3, 6>::Zero();
};

// Moments of (ξ, q, 1), in spacings.
using Matrix10 = Eigen::Matrix<double, 10, 10>;

// The inverse of the moments over the family and the point.
Matrix10 inverse_moments(const Body& body, int i);

// `mu`: values at owned points and ghosts.
Trend trend(const Body& body, int i, const Eigen::Array4d* mu, const Matrix10& inverse_moments);

// Adds V (μ_j − c − C ξ − Q q) to the weight of a bond in F; V: m³.
void add_correction(const Trend& trend, double volume, QuadraticFit& fit);

}  // namespace strut
