#include "mechanics/formulation/cell_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "mechanics/kernels/quadratic_bonds.hpp"

namespace strut {

CellShape cube_of(double volume) {
  CellShape cube;
  cube.moments.head<3>().setConstant(std::pow(volume, 2.0 / 3) / 12);
  return cube;
}

CellShape shape_of(const Body& body, int i) {
  return body.domain.cloud.shapes.empty() ? cube_of(body.domain.volume(i)) : body.domain.cloud.shapes[i];
}

Basis basis(const Vector& xi, double h) {
  const bonds::Vector3<double> x{{xi[0] / h, xi[1] / h, xi[2] / h}};
  const std::array<double, 6> q = bonds::squares(x);
  Basis b;
  b << x.c[0], x.c[1], x.c[2], q[0], q[1], q[2], q[3], q[4], q[5];
  return b;
}

double least_square(const Tensor& spread) {
  return Eigen::SelfAdjointEigenSolver<Tensor>(spread, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

void set_cell(const CellShape& shape, QuadraticFit& fit) {
  Tensor moments = to_tensor(shape.moments);
  moments.diagonal().array() += 1e-9 * moments.trace();  // so that a flat cell has a Cholesky factor, too
  const Tensor L = moments.llt().matrixL();
  Eigen::Map<Vector>{fit.offset} = shape.offset;
  const double factor[] = {L(0, 0), L(1, 0), L(1, 1), L(2, 0), L(2, 1), L(2, 2)};
  std::copy_n(factor, 6, fit.factor);
}

Vector place_of(const QuadraticFit& fit, int q) {
  const double *t = cell_places[q], *s = fit.offset, *L = fit.factor;
  return {s[0] + L[0] * t[0], s[1] + L[1] * t[0] + L[2] * t[1], s[2] + L[3] * t[0] + L[4] * t[1] + L[5] * t[2]};
}

namespace {

// The penalty on H decides where a family cannot tell F from H (its bonds across a surface all have one length), and
// has little effect elsewhere. A smaller penalty is more accurate but requires a shorter time step; so each point has
// the smallest penalty for which V h² κ is at most the bound, with the spacing h and the steepness κ. Inside a body,
// 1.2 to 3 are usual.
constexpr double largest_penalty = 0.1, steepness_bound = 8;

// (M + penalty)⁻¹. The penalty acts on |H|², which contains xy and yx, so it is isotropic.
Matrix9 inverse_with(const FamilySums& sums, double penalty) {
  Matrix9 M = sums.moments;
  M.diagonal().segment<3>(3).array() += penalty * sums.weight;
  M.diagonal().tail<3>().array() += 2 * penalty * sums.weight;
  return M.ldlt().solve(Matrix9::Identity());
}

// V h² κ of a point with this volume (m³) and inverse: V Σ |∂F_q/∂y_j|²/V_j over the family and the point itself, mean
// over the integration points.
double steepness_with(const FamilySums& sums, const Matrix9& inverse, double volume, const QuadraticFit& fit,
                      double h) {
  const Matrix9 squares = inverse * sums.squares * inverse;
  double sum = 0;
  for (int q = 0; q < 4; ++q) {
    const Vector s = place_of(fit, q) / h;
    Eigen::Matrix<double, 3, 9> at = Eigen::Matrix<double, 3, 9>::Zero();  // F at s, of (F, H)
    at.leftCols<3>().setIdentity();
    at(0, 3) = at(1, 6) = at(2, 8) = s[0];
    at(1, 4) = at(0, 6) = at(2, 7) = s[1];
    at(2, 5) = at(1, 7) = at(0, 8) = s[2];
    sum += (at * squares * at.transpose()).trace();
  }
  return volume * sum / 4;
}

}  // namespace

bool fit_motion(const FamilySums& sums, double h, double volume, double least, QuadraticFit& fit) {
  if (!(sums.weight > 0) || least_square(sums.moments.topLeftCorner<3, 3>() / sums.weight) < least_for_stress) {
    return false;
  }
  double penalty = least;
  Matrix9 inverse = inverse_with(sums, penalty);
  while (penalty < largest_penalty && steepness_with(sums, inverse, volume, fit, h) > steepness_bound) {
    penalty *= 2;
    inverse = inverse_with(sums, penalty);
  }
  for (int c = 0; c < 3; ++c) {
    for (int b = 0; b < 3; ++b) fit.linear[3 * c + b] = 0.5 * (inverse(c, b) + inverse(b, c)) / (h * h);
  }
  double* second = fit.second;
  for (int k = 0; k < 6; ++k) {
    for (int b = 0; b < 3; ++b) {
      fit.mixed[3 * k + b] = fit.bent[3 * k + b] = 0.5 * (inverse(3 + k, b) + inverse(b, 3 + k)) / (h * h * h);
    }
    for (int l = k; l < 6; ++l) *second++ = 0.5 * (inverse(3 + k, 3 + l) + inverse(3 + l, 3 + k)) / (h * h * h * h);
  }
  return true;
}

bool fit_motion(const Body& body, int i, double least, QuadraticFit& fit) {
  const double h = body.domain.cloud.spacings[i], volume = body.domain.volume(i);
  const auto over = [&](const auto& visit) {
    over_family(body, i, [&](int j, double w, const Vector& xi) { visit(w, body.domain.volume(j), xi); });
  };
  return fit_motion(sums_of_family(h, volume, over), h, volume, least, fit);
}

Vector weight_of_bond(const QuadraticFit& fit, double volume, double w, const Vector& xi, const Eigen::Array4d& mu,
                      const Vector& place) {
  const std::array<double, 6> q = bonds::squares(bonds::Vector3<double>{{xi[0], xi[1], xi[2]}});
  Vector g;
  for (int b = 0; b < 3; ++b) {
    g[b] = volume * (mu[b] - fit.center[b]);
    for (int c = 0; c < 3; ++c) g[b] += xi[c] * fit.linear[3 * c + b];
    for (int k = 0; k < 6; ++k) g[b] += q[k] * fit.bent[3 * k + b];
  }
  double second[6] = {};
  const double* number = fit.second;
  for (int k = 0; k < 6; ++k) {
    for (int b = 0; b < 3; ++b) second[k] += xi[b] * fit.mixed[3 * k + b];
    for (int l = k; l < 6; ++l, ++number) {
      second[k] += *number * q[l];
      if (l > k) second[l] += *number * q[k];
    }
  }
  g[0] += second[0] * place[0] + second[3] * place[1] + second[5] * place[2];
  g[1] += second[3] * place[0] + second[1] * place[1] + second[4] * place[2];
  g[2] += second[5] * place[0] + second[4] * place[1] + second[2] * place[2];
  return w * g;
}

CellWeights lattice_cell(double spacing, const std::vector<FitBond>& family) {
  const double volume = spacing * spacing * spacing;
  QuadraticFit fit;
  set_cell(cube_of(volume), fit);
  const auto over = [&](const auto& visit) {
    for (const FitBond& bond : family) visit(bond.weight, volume, bond.xi);
  };
  CellWeights weights;
  if (!fit_motion(sums_of_family(spacing, volume, over), spacing, volume, least_penalty, fit)) return weights;
  std::array<Vector, 4> own;
  own.fill(Vector::Zero());
  for (const FitBond& bond : family) {
    std::array<Vector, 4>& of_bond = weights.bonds.emplace_back();
    for (int q = 0; q < 4; ++q) {
      of_bond[q] = weight_of_bond(fit, volume, bond.weight, bond.xi, Eigen::Array4d::Zero(), place_of(fit, q));
      weights.steepness += of_bond[q].squaredNorm() / 4;
      own[q] -= of_bond[q];
    }
  }
  for (const Vector& g : own) weights.steepness += g.squaredNorm() / 4;
  return weights;
}

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
