#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <set>

#include "mechanics/formulation/lattice_cell.hpp"
#include "mechanics/formulation/quadratic_fit.hpp"
#include "mechanics/kernels/over_family.hpp"
#include "mechanics/kernels/quadratic_bonds.hpp"
#include "mechanics/reflected.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

namespace {

using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Basis = Eigen::Matrix<double, 9, 1>;
using RowsOfSix = Eigen::Matrix<double, 3, 6, Eigen::RowMajor>;

// The penalty on H beside the mean square of the bonds, in spacings. It decides where a family cannot tell F from H
// (its bonds across a surface are all of one length), and fades where it can. Smaller is more accurate and stiffer to
// the step; so each point has the smallest of these with which it does not ask for more than the bound: of
// V h² κ, h spacing and κ the steepness, where 1.2 to 3 are usual inside of a body.
constexpr double least_penalty = 1e-4, largest_penalty = 0.1, steepness_bound = 8;

// The least one of a cell whose metal has flowed, in material so many spacings thick (quadratic.md, flow), as
// thickness_of_family() finds it: 2.0 and 2.8 in round bars of two and three spacings, 2.3 in a square one of two.
double penalty_in_flow(double thickness) { return 0.025 * std::clamp(1 + 2.2 * (2.75 - thickness), 1.0, 2.0); }

// The least mean square of a family's bonds in any direction, in spacings²: below it F is not known, and the point
// carries no stress.
constexpr double least_for_stress = 0.02;

// Of the consistency correction: what is asked for is met as far as it does not cost more than this, in units of the
// operator's diagonal inside of a body; the iterations that bring the solution within 1e-4 at this regularization.
constexpr double regularization = 0.05, inner_diagonal = 23;
constexpr int iterations = 28;

// The penalty on the second gradient of μ where its trend over a family is found, beside the weight of the family.
constexpr double trend_penalty = 0.01;

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

// In the direction in which it is the least.
double least_square(const Tensor& spread) {
  return Eigen::SelfAdjointEigenSolver<Tensor>(spread, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

void set_cell(const CellShape& shape, QuadraticFit& fit) {
  Tensor moments = to_tensor(shape.moments);
  moments.diagonal().array() += 1e-9 * moments.trace();  // a flat cell has a square root, too
  const Tensor L = moments.llt().matrixL();
  Eigen::Map<Vector>{fit.offset} = shape.offset;
  const double factor[] = {L(0, 0), L(1, 0), L(1, 1), L(2, 0), L(2, 1), L(2, 2)};
  std::copy_n(factor, 6, fit.factor);
}

Vector place_of(const QuadraticFit& fit, int q) {
  const double *t = cell_places[q], *s = fit.offset, *L = fit.factor;
  return {s[0] + L[0] * t[0], s[1] + L[1] * t[0] + L[2] * t[1], s[2] + L[3] * t[0] + L[4] * t[1] + L[5] * t[2]};
}

// Sums over a family, in spacings: of (1, b bᵀ) with ω V_j, and of g gᵀ/V_j, g = ω V_j b being what y_j gives to the
// fit; the point itself, which gives −Σ g, is counted.
struct FamilySums {
  double weight = 0;
  Matrix9 moments = Matrix9::Zero(), squares = Matrix9::Zero();
};

// Of a point with the spacing h; over(visit) calls visit(ω V_j, V_j, ξ).
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

// (M + penalty)⁻¹. The penalty is on |H|², in which xy counts as yx does, too: alike in all directions.
Matrix9 inverse_with(const FamilySums& sums, double penalty) {
  Matrix9 M = sums.moments;
  M.diagonal().segment<3>(3).array() += penalty * sums.weight;
  M.diagonal().tail<3>().array() += 2 * penalty * sums.weight;
  return M.ldlt().solve(Matrix9::Identity());
}

// V h² κ of a point of so much volume whose fit has this inverse: V Σ |∂F_q/∂y_j|²/V_j, the point itself counted, mean
// over the places.
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

// P, B, Q of a point, whose cell is set, by the least penalty or a larger one. False where its neighbors do not span
// space.
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

// The state of a point under a stress that gives V (mean : ∂F + moments : ∂H) to the energy's change.
QuadraticState state_of(const QuadraticFit& fit, const Tensor& mean, const Eigen::Matrix<double, 3, 6>& moments) {
  constexpr int by_rows = Eigen::RowMajor;
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, by_rows>> P(fit.linear);
  const Eigen::Map<const Eigen::Matrix<double, 6, 3, by_rows>> B(fit.mixed);
  Eigen::Matrix<double, 6, 6> Q;
  const double* number = fit.second;
  for (int k = 0; k < 6; ++k) {
    for (int l = k; l < 6; ++l) Q(k, l) = Q(l, k) = *number++;
  }
  QuadraticState state;
  Eigen::Map<Eigen::Matrix<double, 3, 3, by_rows>>{state.first} = mean * P.transpose() + moments * B;
  Eigen::Map<Eigen::Matrix<double, 3, 6, by_rows>>{state.second} = mean * B.transpose() + moments * Q;
  return state;
}

// What a stress of 1 in all of a cell gives, by way of the second gradient: Σ over the places, s for each axis.
Eigen::Matrix<double, 3, 6> moments_of_unit_stress(const Vector& offset) {
  Eigen::Matrix<double, 3, 6> m = Eigen::Matrix<double, 3, 6>::Zero();
  for (int a = 0; a < 3; ++a) m(a, a) = offset[a];
  m(0, 3) = offset[1], m(1, 3) = offset[0];
  m(1, 4) = offset[2], m(2, 4) = offset[1];
  m(2, 5) = offset[0], m(0, 5) = offset[2];
  return m;
}

// The function c + C ξ + Q q that fits numbers of the family and of the point itself.
struct Trend {
  Vector c = Vector::Zero();
  Tensor C = Tensor::Zero();
  Eigen::Matrix<double, 3, 6> Q = Eigen::Matrix<double, 3, 6>::Zero();
};

// Of (ξ, q, 1), in spacings.
using Matrix10 = Eigen::Matrix<double, 10, 10>;
using Basis10 = Eigen::Matrix<double, 10, 1>;

Basis10 basis_of_trend(const Vector& xi, double h) {
  Basis10 b;
  b << basis(xi, h), 1;
  return b;
}

// Over the family and the point: the inverse of their moments.
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

// V (μ_j − c − C ξ − Q q) is added to what a bond gives to F.
void add_correction(const Trend& trend, double volume, QuadraticFit& fit) {
  for (int b = 0; b < 3; ++b) {
    fit.center[b] = trend.c[b];
    for (int c = 0; c < 3; ++c) fit.linear[3 * c + b] -= volume * trend.C(b, c);
    for (int k = 0; k < 6; ++k) fit.bent[3 * k + b] -= volume * trend.Q(b, k);
  }
}

}  // namespace

// Finds μ: of all corrections that make the forces of a uniform stress those on the surface, about the smallest one.
// With r_j = ∂/∂y_j of Σ ∫ div u dV − ∮ n·u dA, which is to be zero, K μ = −r; K = Σ_i V_i² R_iᵀ W R_i with what is
// left over by the linear fits, R_i. It is solved by Chebyshev's iteration: so many steps give the same bits on any
// number of ranks.
class ConsistencyCorrection {
 public:
  ConsistencyCorrection(Body& body, QuadraticFits& fits) : body_(body), fits_(fits) {
    for (const MaterialBlock& block : body.blocks) {
      if (block.is_quadratic()) points_.insert(points_.end(), block.points.begin(), block.points.end());
    }
  }

  void apply() {
    set_missing();
    set_operator();
    solve();
    exchange_multipliers();
    for_each_point(0, count(), [&](int p) {
      const int i = points_[p];
      if (!carries_stress(i)) return;
      QuadraticFit corrected = fits_[i];
      add_correction(trend_of(i), body_.domain.volume(i), corrected);
      fits_.set(i, corrected);
    });
  }

 private:
  int count() const { return static_cast<int>(points_.size()); }
  bool carries_stress(int i) const { return moments_[i](9, 9) > 0; }
  Halo& halo() const { return body_.domain.halo; }
  void exchange_multipliers() { halo().exchange<reflect_multiplier>(fits_.multipliers_); }

  void set_missing();
  void set_operator();
  Trend trend_of(int i) const { return trend(body_, i, fits_.multipliers(), moments_[i]); }
  void apply_operator();
  void solve();

  // A trend as others need it: c, C, Q, and V² of the point; nothing of points that carry no stress.
  struct Share {
    double c[3], C[9], Q[18], weight;

    friend void reflect(const Reflection& by, Share& share) {
      turn(by, share.c);
      reflect_rows(by, share.C);  // columns do as well
      reflect_second(by, share.Q);
    }
  };

  Body& body_;
  QuadraticFits& fits_;
  std::vector<int> points_;               // owned, by quadratic correspondence
  std::vector<Vector> missing_;           // −r, of owned points, m²
  std::vector<Matrix10> moments_;         // of (ξ, q, 1) over the family and the point, of owned points; its inverse
  std::vector<double> diagonal_, ridge_;  // a bound of K's diagonal; the regularization, m⁹
  std::vector<Share> shares_;             // of owned points and ghosts
  std::vector<Vector> image_;             // K μ, of owned points
};

void ConsistencyCorrection::set_missing() {
  std::vector<QuadraticState> states(body_.domain.sites.size());
  std::vector<CellShape> shapes(body_.owned());
  for (const int i : points_) {
    shapes[i] = shape_of(body_, i);
    const Tensor mean = Tensor::Identity() - shapes[i].surface_moments / body_.domain.volume(i);
    const QuadraticFit fit = fits_[i];
    states[i] = state_of(fit, mean, moments_of_unit_stress(shapes[i].offset));
    states[i].failed = 1;  // a mark, here of points by quadratic correspondence
  }
  halo().exchange(states);
  missing_.assign(body_.owned(), Vector::Zero());
  bonds::with_influence(body_.influence, [&](auto weight) {
    for_each_point(0, count(), [&, weight](int p) {
      const int i = points_[p];
      const bonds::OfPoint family{body_.domain.families, i};
      const auto far =
          bonds::quadratic_far_force(family, body_.domain.sites.data(), fits_.multipliers(), states.data(), weight);
      const Vector force = Vector(far.c[0], far.c[1], far.c[2]) + bonds::quadratic_own_force(states[i], fits_[i]);
      bool all = true;  // beside a block of another formulation the surface is not all of it
      body_.domain.families.for_each(i, [&](int j) { all = all && states[j].failed > 0; });
      if (all) missing_[i] = shapes[i].surface + body_.domain.volume(i) * force;
    });
  });
}

void ConsistencyCorrection::set_operator() {
  moments_.assign(body_.owned(), Matrix10::Zero());
  shares_.assign(body_.domain.sites.size(), Share{});
  diagonal_.assign(body_.owned(), 0), ridge_.assign(body_.owned(), 0);
  for (const int i : points_) {
    const QuadraticFit fit = fits_[i];
    if (!fit.carries_stress()) continue;
    const double volume = body_.domain.volume(i);
    moments_[i] = inverse_moments(body_, i);
    shares_[i].weight = volume * volume;
  }
  halo().exchange(shares_);
  for (const int i : points_) {
    const double volume = body_.domain.volume(i);
    double sum = shares_[i].weight;
    over_family(body_, i,
                [&](int j, double w, const Vector&) { sum += shares_[j].weight * w / body_.domain.volume(j); });
    diagonal_[i] = volume * sum;
    ridge_[i] = regularization * inner_diagonal * std::pow(body_.domain.cloud.spacings[i], 9);
  }
}

void ConsistencyCorrection::apply_operator() {
  exchange_multipliers();
  for_each_point(0, count(), [&](int p) {
    const int i = points_[p];
    if (!carries_stress(i)) return;
    const Trend trend = trend_of(i);
    Eigen::Map<Vector>{shares_[i].c} = trend.c;
    Eigen::Map<Tensor>{shares_[i].C} = trend.C;
    Eigen::Map<RowsOfSix>{shares_[i].Q} = trend.Q;
  });
  halo().exchange(shares_);
  for_each_point(0, count(), [&](int p) {
    const int i = points_[p];
    const Vector mu = fits_.multipliers_[i].head<3>().matrix();
    const auto left = [&](int j, const Vector& xi) -> Vector {
      const Share& there = shares_[j];
      const std::array<double, 6> q = bonds::squares(bonds::Vector3<double>{{xi[0], xi[1], xi[2]}});
      return there.weight *
             (mu - Eigen::Map<const Vector>(there.c) - Eigen::Map<const Tensor>(there.C) * xi -
              Eigen::Map<const RowsOfSix>(there.Q) * Eigen::Map<const Eigen::Matrix<double, 6, 1>>(q.data()));
    };
    Vector sum = left(i, Vector::Zero());
    over_family(body_, i, [&](int j, double w, const Vector& xi) { sum += w / body_.domain.volume(j) * left(j, -xi); });
    image_[i] = body_.domain.volume(i) * sum;
  });
}

// (K + ridge) μ = missing, preconditioned by diagonal + ridge: its eigenvalues lie between a share of the ridge and 1.
void ConsistencyCorrection::solve() {
  constexpr double ridge = regularization * inner_diagonal, largest_diagonal = 40;
  constexpr double low = ridge / (ridge + largest_diagonal), middle = 0.5 * (1 + low), half = 0.5 * (1 - low);
  image_.assign(body_.owned(), Vector::Zero());
  std::vector<Vector> step(body_.owned(), Vector::Zero());
  double rho = half / middle;
  for (int n = 0; n < iterations; ++n) {
    if (n > 0) apply_operator();
    const double next = n == 0 ? rho : 1 / (2 * middle / half - rho);
    for (const int i : points_) {
      Eigen::Array4d& mu = fits_.multipliers_[i];
      const Vector rest = (missing_[i] - image_[i] - ridge_[i] * mu.head<3>().matrix()) / (diagonal_[i] + ridge_[i]);
      step[i] = n == 0 ? Vector(rest / middle) : Vector(next * rho * step[i] + 2 * next / half * rest);
      mu.head<3>() += step[i].array();
    }
    rho = next;
  }
}

namespace {

// What y_j gives to F at a place of the cell of i, as a vector: ∂F_rb/∂y_jr.
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

void set_sums(const Body& body, int i, const Eigen::Array4d* multipliers, QuadraticFit& fit) {
  std::fill(std::begin(fit.sums), std::end(fit.sums), 0.0);
  over_family(body, i, [&](int j, double w, const Vector& xi) {
    const std::array<double, 6> q = bonds::squares(bonds::Vector3<double>{{xi[0], xi[1], xi[2]}});
    fit.sums[0] += w;
    for (int c = 0; c < 3; ++c) fit.sums[1 + c] += w * xi[c], fit.sums[10 + c] += w * multipliers[j][c];
    for (int k = 0; k < 6; ++k) fit.sums[4 + k] += w * q[k];
  });
}

double steepness_of(const Body& body, int i, const Eigen::Array4d* multipliers, const QuadraticFit& fit) {
  const double volume = body.domain.volume(i);
  double sum = 0;
  for (int p = 0; p < 4; ++p) {
    Vector own = Vector::Zero();
    over_family(body, i, [&](int j, double w, const Vector& xi) {
      const Vector g = weight_of_bond(fit, volume, w, xi, multipliers[j], place_of(fit, p));
      sum += g.squaredNorm() / body.domain.volume(j);
      own -= g;
    });
    sum += own.squaredNorm() / volume;
  }
  return sum / 4;
}

}  // namespace

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

bool spans_cell(const Domain& domain, int i) {
  const double volume = family_volume(domain, i), h = domain.cloud.spacings[i];
  return volume > 0 && least_square(family_spread(domain, i) / (volume * h * h)) >= least_for_stress;
}

namespace {

// Four standard deviations of the family's material in the direction in which it is the least: of a round bar its
// diameter, as far as families reach (spacings).
double thickness_of_family(const Body& body, int i) {
  const double h = body.domain.cloud.spacings[i];
  double volume = 0;
  Vector first = Vector::Zero();
  Tensor second = Tensor::Zero();
  const auto take = [&](double v, const Vector& xi) {
    volume += v;
    first += v * xi;
    second += v * xi * xi.transpose() + v * to_tensor(cube_of(v).moments);
  };
  take(body.domain.volume(i), Vector::Zero());
  over_family(body, i, [&](int j, double, const Vector& xi) { take(body.domain.volume(j), xi); });
  return 4 * std::sqrt(least_square(second / volume - first * first.transpose() / (volume * volume))) / h;
}

// The largest thickness in the family of each owned point of a body that has cells, spacings, since a point at a
// surface sees two layers in a thick body, too.
std::vector<double> thicknesses(const Body& body) {
  std::set<int> with_cells;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (body.blocks[b].is_quadratic()) with_cells.insert(body.domain.blocks[b].body);
  }
  std::vector<double> own(body.domain.sites.size(), 0.0);
  for_each_point(0, body.owned(), [&](int i) {
    if (with_cells.contains(body.domain.blocks[body.domain.cloud.blocks[i]].body))
      own[i] = thickness_of_family(body, i);
  });
  body.domain.halo.exchange(own);
  std::vector<double> largest(own.begin(), own.begin() + body.owned());
  for_each_point(0, body.owned(), [&](int i) {
    body.domain.families.for_each(i, [&](int j) { largest[i] = std::max(largest[i], own[j]); });
  });
  return largest;
}

}  // namespace

QuadraticFits::QuadraticFits(Body& body)
    : number_(body.owned(), -1), multipliers_(body.domain.sites.size(), Eigen::Array4d::Zero()) {
  const std::vector<double> thickness = thicknesses(body);
  penalties_in_flow_.assign(body.owned(), least_penalty);
  std::size_t cells = 0;
  for (const MaterialBlock& block : body.blocks) {
    if (!block.is_quadratic()) continue;
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      number_[block.points[k]] = static_cast<int>(cells + block.slot_of_cell(k));
    }
    cells += block.law_points() / block.places_a_point();
  }
  fits_.assign(cells, std::array<double, QuadraticFit::size>{});
  for (const MaterialBlock& block : body.blocks) {
    if (!block.is_quadratic()) continue;
    for (const int i : block.points) {
      penalties_in_flow_[i] = penalty_in_flow(thickness[i]);
      QuadraticFit fit;
      set_cell(shape_of(body, i), fit);
      if (fit_motion(body, i, least_penalty, fit)) {
        fit.steepness = 1;
      } else {
        fit = QuadraticFit{};  // carries no stress, and moves with the others
      }
      set(i, fit);
    }
  }
  const auto complete = [&](const auto& set_numbers) {
    for_each_point(0, body.owned(), [&](int i) {
      if (number_[i] < 0 || !carries_stress(i)) return;
      QuadraticFit fit = (*this)[i];
      set_numbers(i, fit);
      set(i, fit);
    });
  };
  const auto set_all_sums = [&] { complete([&](int i, QuadraticFit& fit) { set_sums(body, i, multipliers(), fit); }); };
  set_all_sums();  // the correction looks at forces
  const double known = body.domain.cloud.shapes.empty() ? 0 : 1;
  if (body.domain.communicator.max(known) > 0) {
    ConsistencyCorrection(body, *this).apply();
    set_all_sums();  // of μ
  }
  complete([&](int i, QuadraticFit& fit) { fit.steepness = steepness_of(body, i, multipliers(), fit); });
}

bool QuadraticFits::refit(const Body& body, int i, bool flows, double most) {
  QuadraticFit fresh;
  set_cell(shape_of(body, i), fresh);
  bool spans = fit_motion(body, i, flows ? penalties_in_flow_[i] : least_penalty, fresh);
  if (spans) {
    add_correction(trend(body, i, multipliers(), inverse_moments(body, i)), body.domain.volume(i), fresh);
    set_sums(body, i, multipliers(), fresh);
    fresh.steepness = steepness_of(body, i, multipliers(), fresh);
    spans = body.domain.volume(i) * fresh.steepness <= most;
  }
  if (spans) set(i, fresh);
  return spans;
}

void QuadraticFits::refit_in_flow(const Body& body, int i) {
  refit(body, i, true, std::numeric_limits<double>::infinity());
}

void QuadraticFits::for_each_weight(const Body& body, int i, int q,
                                    const std::function<void(int j, const Vector& g)>& visit) const {
  const QuadraticFit& fit = (*this)[i];
  const Vector at = place_of(fit, q);
  over_family(body, i, [&](int j, double w, const Vector& xi) {
    visit(j, weight_of_bond(fit, body.domain.volume(i), w, xi, multipliers_[j], at));
  });
}

Tensor QuadraticFits::gradient_at(const Body& body, int i, int q, const std::function<Vector(int j)>& place) const {
  const Vector here = place(i);
  Tensor F = Tensor::Zero();
  for_each_weight(body, i, q, [&](int j, const Vector& g) { F += (place(j) - here) * g.transpose(); });
  return F;
}

double QuadraticFits::bytes() const {
  const std::size_t numbers = penalties_in_flow_.size() * sizeof(double) + number_.size() * sizeof(int);
  return static_cast<double>(numbers + multipliers_.size() * sizeof(Eigen::Array4d)) + fits_.bytes();
}

}  // namespace strut
