#include <Eigen/Cholesky>

#include "mechanics/formulation/cell_fit.hpp"
#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/kernels/quadratic_bonds.hpp"
#include "mechanics/reflected.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

namespace {

using RowsOfSix = Eigen::Matrix<double, 3, 6, Eigen::RowMajor>;

// The regularization limits the correction where full consistency would cost more than this, in units of the operator's
// diagonal inside a body. The iterations bring the solution within 1e-4 at this regularization.
constexpr double regularization = 0.05, inner_diagonal = 23;
constexpr int iterations = 28;

// The state of a point whose stress changes the energy by V (mean : ∂F + moments : ∂H).
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

// The moments of a uniform unit stress along each axis: `offset` is the mean position s of the integration points.
Eigen::Matrix<double, 3, 6> moments_of_unit_stress(const Vector& offset) {
  Eigen::Matrix<double, 3, 6> m = Eigen::Matrix<double, 3, 6>::Zero();
  for (int a = 0; a < 3; ++a) m(a, a) = offset[a];
  m(0, 3) = offset[1], m(1, 3) = offset[0];
  m(1, 4) = offset[2], m(2, 4) = offset[1];
  m(2, 5) = offset[0], m(0, 5) = offset[2];
  return m;
}

}  // namespace

// Finds μ: close to the smallest correction by which the forces of a uniform stress equal its tractions on the surface.
// With r_j = ∂/∂y_j of Σ ∫ div u dV − ∮ n·u dA, which must vanish, K μ = −r; K = Σ_i V_i² R_iᵀ W R_i, where R_i is the
// residual of the fits of the trend. Chebyshev's iteration with a fixed number of steps gives the same bits on any
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

  // The trend of a point, as its neighbors need it: c, C, Q, and V² of the point; zero for points that carry no stress.
  struct TrendRecord {
    double c[3], C[9], Q[18], weight;

    friend void reflect(const Reflection& by, TrendRecord& record) {
      turn(by, record.c);
      reflect_rows(by, record.C);  // C is stored by columns; the reflection is the same
      reflect_second(by, record.Q);
    }
  };

  Body& body_;
  QuadraticFits& fits_;
  std::vector<int> points_;        // owned, by quadratic correspondence
  std::vector<Vector> missing_;    // −r, of owned points, m²
  std::vector<Matrix10> moments_;  // inverse moments of (ξ, q, 1) over the family and the point, of owned points
  std::vector<double> diagonal_, ridge_;  // a bound of K's diagonal; the regularization, m⁹
  std::vector<TrendRecord> records_;      // of owned points and ghosts
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
    states[i].failed = 1;  // here a mark of points by quadratic correspondence
  }
  halo().exchange(states);
  missing_.assign(body_.owned(), Vector::Zero());
  bonds::with_influence(body_.influence, [&](auto weight) {
    for_each_point(0, count(), [&, weight](int p) {
      const int i = points_[p];
      const bonds::OfPoint family{{i}, body_.domain.families};
      const auto far =
          bonds::quadratic_far_force(family, body_.domain.sites.data(), fits_.multipliers(), states.data(), weight);
      const Vector force = bonds::to_vector(far) + bonds::quadratic_own_force(states[i], fits_[i]);
      bool all = true;  // next to a block of another formulation the surface is incomplete
      body_.domain.families.for_each(i, [&](int j) { all = all && states[j].failed > 0; });
      if (all) missing_[i] = shapes[i].surface + body_.domain.volume(i) * force;
    });
  });
}

void ConsistencyCorrection::set_operator() {
  moments_.assign(body_.owned(), Matrix10::Zero());
  records_.assign(body_.domain.sites.size(), TrendRecord{});
  diagonal_.assign(body_.owned(), 0), ridge_.assign(body_.owned(), 0);
  for (const int i : points_) {
    const QuadraticFit fit = fits_[i];
    if (!fit.carries_stress()) continue;
    const double volume = body_.domain.volume(i);
    moments_[i] = inverse_moments(body_, i);
    records_[i].weight = volume * volume;
  }
  halo().exchange(records_);
  for (const int i : points_) {
    const double volume = body_.domain.volume(i);
    double sum = records_[i].weight;
    over_family(body_, i,
                [&](int j, double w, const Vector&) { sum += records_[j].weight * w / body_.domain.volume(j); });
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
    Eigen::Map<Vector>{records_[i].c} = trend.c;
    Eigen::Map<Tensor>{records_[i].C} = trend.C;
    Eigen::Map<RowsOfSix>{records_[i].Q} = trend.Q;
  });
  halo().exchange(records_);
  for_each_point(0, count(), [&](int p) {
    const int i = points_[p];
    const Vector mu = fits_.multipliers_[i].head<3>().matrix();
    const auto left = [&](int j, const Vector& xi) -> Vector {
      const TrendRecord& there = records_[j];
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

// Solves (K + ridge) μ = missing, preconditioned by diagonal + ridge; the eigenvalues then lie between `low` and 1.
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

void make_consistent(Body& body, QuadraticFits& fits) {
  const double known = body.domain.cloud.shapes.empty() ? 0 : 1;
  if (body.domain.communicator.max(known) > 0) ConsistencyCorrection(body, fits).apply();
  fits.complete(body);
}

}  // namespace strut
