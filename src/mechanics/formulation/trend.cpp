#include "mechanics/formulation/trend.hpp"

#include <Eigen/Cholesky>

#include "mechanics/formulation/cell_fit.hpp"
#include "mechanics/kernels/over_family.hpp"

namespace strut {

namespace {

// The penalty on the second gradient of μ in its trend over a family, relative to the weight of the family.
constexpr double trend_penalty = 0.01;

using Basis10 = Eigen::Matrix<double, 10, 1>;

Basis10 basis_of_trend(const Vector& xi, double h) {
  Basis10 b;
  b << basis(xi, h), 1;
  return b;
}

}  // namespace

Matrix10 inverse_moments(const Body& body, int i) {
  const double h = body.domain.cloud.spacings[i];
  Matrix10 N = Matrix10::Zero();
  N(9, 9) = body.domain.volume(i);
  over_family(body, i, [&](int, double w, const Vector& xi) {
    const Basis10 b = basis_of_trend(xi, h);
    N += w * b * b.transpose();
  });
  N.diagonal().segment<3>(3).array() += trend_penalty * N(9, 9);
  N.diagonal().segment<3>(6).array() += 2 * trend_penalty * N(9, 9);
  return N.ldlt().solve(Matrix10::Identity());
}

Trend trend(const Body& body, int i, const Eigen::Array4d* mu, const Matrix10& inverse_moments) {
  const double h = body.domain.cloud.spacings[i];
  Eigen::Matrix<double, 10, 3> sums = Eigen::Matrix<double, 10, 3>::Zero();
  sums.row(9) = body.domain.volume(i) * mu[i].head<3>().matrix().transpose();
  over_family(body, i, [&](int j, double w, const Vector& xi) {
    sums += basis_of_trend(xi, h) * (w * mu[j].head<3>().matrix().transpose());
  });
  const Eigen::Matrix<double, 10, 3> fit = inverse_moments * sums;
  return {fit.row(9).transpose(), fit.topRows<3>().transpose() / h, fit.middleRows<6>(3).transpose() / (h * h)};
}

void add_correction(const Trend& trend, double volume, QuadraticFit& fit) {
  for (int b = 0; b < 3; ++b) {
    fit.center[b] = trend.c[b];
    for (int c = 0; c < 3; ++c) fit.linear[3 * c + b] -= volume * trend.C(b, c);
    for (int k = 0; k < 6; ++k) fit.bent[3 * k + b] -= volume * trend.Q(b, k);
  }
}

}  // namespace strut
