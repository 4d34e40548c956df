// Inside mechanics: the trend of the correction μ over a family (quadratic_fit.hpp).
#pragma once

#include <Eigen/Core>

#include "mechanics/body.hpp"
#include "mechanics/formulation/quadratic_fit.hpp"

namespace strut {

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
