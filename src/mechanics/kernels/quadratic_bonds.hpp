// The sums over a family that quadratic correspondence needs (quadratic_fit.hpp), for one point or a cluster:
//   gather: N = Σ ω V_j (y_j − y_i) ⊗ (ξ, q, μ_j, 1)
//   force:  f_i = Σ ω V_j [ A_i ξ + B_i q + D_i (μ_j − c_i) ] + Σ ω V_j [ A_j ξ − B_j q − D_j (μ_i − c_j) ]
// with the states A, B, D of the ends (QuadraticState: first, second, correction, offset = D c).
#pragma once

#include "mechanics/formulation/quadratic_fit.hpp"
#include "mechanics/kernels/lane_groups.hpp"
#include "mechanics/kernels/prefetch.hpp"

namespace strut::bonds {

// The second-order terms q of a bond.
template <class T>
std::array<T, 6> squares(const Vector3<T>& xi) {
  const auto& [x, y, z] = xi.c;
  return {T(0.5 * x * x), T(0.5 * y * y), T(0.5 * z * z), T(x * y), T(y * z), T(z * x)};
}

template <class T>
struct QuadraticMoments {
  Tensor3<T> first = zero_tensor<T>();
  T second[3][6];
  Tensor3<T> correction = zero_tensor<T>();
  Vector3<T> sum = zero_vector<T>();
};

// Two loops, because all sums at once do not fit into the registers. `ahead`: what is read after them.
template <class Family, class Weight>
inline QuadraticMoments<ScalarOf<Family>> quadratic_gather(const Family& family, const Site* sites,
                                                           const Eigen::Array4d* multipliers, Weight weight,
                                                           Prefetch ahead) {
  using T = ScalarOf<Family>;
  const Vector3<T> y = own_position(family, sites, &Site::current);
  QuadraticMoments<T> N;
  {
    Tensor3<T> first = zero_tensor<T>(), correction = zero_tensor<T>();
    Vector3<T> sum = zero_vector<T>();
    over(
        family, sites, weight,
        [&](int j, const T& w, const Vector3<T>& xi, const auto&) {
          const Vector3<T> eta = apart(sites[j].current, y);
          const Eigen::Array4d& mu = multipliers[j];
          for (int r = 0; r < 3; ++r) {
            const T weighted = w * eta.c[r];
            sum.c[r] += weighted;
            for (int c = 0; c < 3; ++c) first.c[r][c] += weighted * xi.c[c];
            for (int c = 0; c < 3; ++c) correction.c[r][c] += weighted * mu[c];
          }
          ahead.some();
        },
        multipliers);
    N.first = first, N.correction = correction, N.sum = sum;
  }
  T second[3][6];
  for (auto& row : second) {
    for (T& number : row) number = zero_vector<T>().c[0];
  }
  over(family, sites, weight, [&](int j, const T& w, const Vector3<T>& xi, const auto&) {
    const Vector3<T> eta = apart(sites[j].current, y);
    const auto& [x, y, z] = xi.c;
    const std::array<T, 6> q{T(x * x), T(y * y), T(z * z), T(x * y), T(y * z), T(z * x)};  // the first three are 2 q
    for (int r = 0; r < 3; ++r) {
      const T weighted = w * eta.c[r];
      for (int k = 0; k < 6; ++k) second[r][k] += weighted * q[k];
    }
    ahead.some();
  });
  for (int r = 0; r < 3; ++r) {
    for (int k = 0; k < 6; ++k) N.second[r][k] = k < 3 ? T(0.5 * second[r][k]) : second[r][k];
  }
  return N;
}

// The force of the far ends: Σ ω V_j [ A_j ξ − B_j q − D_j (μ_i − c_j) ].
template <class Family, class Weight>
inline Vector3<ScalarOf<Family>> quadratic_far_force(const Family& family, const Site* sites,
                                                     const Eigen::Array4d* multipliers, const QuadraticState* states,
                                                     Weight weight) {
  using T = ScalarOf<Family>;
  const auto mu = family.template own<3>([&](int i) { return multipliers[i].data(); });
  Vector3<T> sum = zero_vector<T>();
  over(
      family, sites, weight,
      [&](int j, const T& w, const Vector3<T>& xi, const auto&) {
        const QuadraticState& there = states[j];
        const auto& [x, y, z] = xi.c;
        const T half[3] = {T(0.5 * x), T(0.5 * y), T(0.5 * z)};
        for (int r = 0; r < 3; ++r) {
          const double *A = there.first + 3 * r, *B = there.second + 6 * r, *D = there.correction + 3 * r;
          T t = there.offset[r] - D[0] * mu[0] - D[1] * mu[1] - D[2] * mu[2];
          t += x * (A[0] - B[0] * half[0] - B[3] * y - B[5] * z);
          t += y * (A[1] - B[1] * half[1] - B[4] * z);
          t += z * (A[2] - B[2] * half[2]);
          sum.c[r] += w * t;
        }
      },
      states);
  return sum;
}

// The force of a point's own state: its numbers (QuadraticState) times the sums over its family, which are constant.
template <class T, class Sum>
inline Vector3<T> quadratic_own_force(const T* numbers, const Sum& sum) {
  const T *first = numbers, *second = first + 9, *correction = second + 18, *offset = correction + 9;
  Vector3<T> force;
  for (int r = 0; r < 3; ++r) {
    T f = -offset[r] * sum(0);
    for (int c = 0; c < 3; ++c) f += first[3 * r + c] * sum(1 + c);
    for (int k = 0; k < 6; ++k) f += second[6 * r + k] * sum(4 + k);
    for (int c = 0; c < 3; ++c) f += correction[3 * r + c] * sum(10 + c);
    force.c[r] = f;
  }
  return force;
}

inline Vector quadratic_own_force(const QuadraticState& state, const QuadraticFit& fit) {
  return to_vector(quadratic_own_force(state.first, [&](int n) { return fit.sums[n]; }));
}

// Sets these sums for one point.
template <class Family, class Weight>
void set_sums(const Family& family, const Site* sites, const Eigen::Array4d* multipliers, Weight weight,
              QuadraticFit& fit) {
  std::fill(std::begin(fit.sums), std::end(fit.sums), 0.0);
  over(family, sites, weight, [&](int j, double w, const Vector3<double>& xi, double) {
    const std::array<double, 6> q = squares(xi);
    fit.sums[0] += w;
    for (int c = 0; c < 3; ++c) fit.sums[1 + c] += w * xi.c[c], fit.sums[10 + c] += w * multipliers[j][c];
    for (int k = 0; k < 6; ++k) fit.sums[4 + k] += w * q[k];
  });
}

}  // namespace strut::bonds
