// The sums over a family that correspondence peridynamics needs, and the choice of ω outside of them.
//   gather:  N = Σ ω V_j (y_j − y_i) ⊗ ξ                                              (F = N K⁻¹)
//   pull:    Σ ω V_j (y_j − y_i)
//   force:   f_i = Σ ω V_j [ (A_i + A_j) ξ + (C_i + C_j)(y_j − y_i) ],  ξ = X_j − X_i
// and, between them, the one of the stabilization by the mean gradient:
//   residual: Σ ω V_j C_ij z and M = Σ ω V_j C_ij z ⊗ ξ,  z = (y_j − y_i) − ½ (F_i + F_j) ξ
// Each is written once for any kind of family: that of one point (OfPoint), or those of the points of a cluster side by
// side (OfBundle), where a far end is read once for all of them and 0 stands for those who do not have it in their
// family. Terms are added in the order of the family, so that a sum does not depend on who else is in a cluster.
// The sums of ordinary points: ordinary_bonds.hpp.
#pragma once

#include <type_traits>

#include "base/math/small_tensors.hpp"
#include "mechanics/body.hpp"

namespace strut::bonds {

using small::Lanes;
using small::Tensor3;
using small::Vector3;

// ---- ω(r), of one number or of several side by side ----------------------------------------------------------------

struct One {
  template <class T>
  static double of(const T&) {
    return 1;
  }
};

struct LinearDecay {
  template <class T>
  static T of(const T& r) {
    return 1 - r;
  }
};

struct CubicDecay {
  template <class T>
  static T of(const T& r) {
    return 1 - r * r * (3 - 2 * r);
  }
};

// Calls work(ω) with the influence function as a type, so that a constant one costs nothing.
template <class Work>
void with_influence(Influence influence, Work&& work) {
  switch (influence) {
    case Influence::one:
      return work(One{});
    case Influence::linear_decay:
      return work(LinearDecay{});
    case Influence::cubic_decay:
      return work(CubicDecay{});
  }
}

// ---- Whose family --------------------------------------------------------------------------------------------------

// Of one point.
struct OfPoint {
  using Scalar = double;
  const Families& families;
  int i;

  // The `count` numbers that stand at of(local index).
  template <int count, class Of>
  std::array<double, count> own(Of of) const {
    std::array<double, count> numbers;
    std::copy_n(of(i), count, numbers.begin());
    return numbers;
  }
  template <class Visit>
  void for_each(Visit&& visit) const {  // visit(j, 1)
    families.for_each(i, [&](int j) { visit(j, 1.0); });
  }
};

// Of the points of a cluster; the first one stands in for those that it lacks.
struct OfCluster {
  using Scalar = Lanes;
  Cluster cluster;

  template <int count, class Of>
  std::array<Lanes, count> own(Of of) const {
    std::array<Lanes, count> numbers;
    for (int l = 0; l < Cluster::width; ++l) {
      const double* from = of(cluster.points[l < static_cast<int>(cluster.points.size()) ? l : 0]);
      for (int n = 0; n < count; ++n) numbers[n][l] = from[n];
    }
    return numbers;
  }
  template <class Visit>
  void for_each(Visit&& visit) const {  // visit(j, 1 in the lanes of those who have j in their family, else 0)
    for (std::size_t n = 0; n < cluster.near.size(); ++n) {
      visit(cluster.near[n], Eigen::Map<const Lanes, Eigen::AlignedMax>(presence[cluster.mask[n]].lanes));
    }
  }

 private:
  struct alignas(Lanes) Presence {
    double lanes[Cluster::width];
  };
  static constexpr std::array<Presence, 1 << Cluster::width> presence = [] {
    std::array<Presence, 1 << Cluster::width> table{};
    for (unsigned mask = 0; mask < table.size(); ++mask) {
      for (int l = 0; l < Cluster::width; ++l) table[mask].lanes[l] = mask >> l & 1;
    }
    return table;
  }();
};

template <class Family>
using ScalarOf = typename Family::Scalar;

template <class Family>
Vector3<ScalarOf<Family>> own_place(const Family& family, const Site* sites, Eigen::Array4d Site::*place) {
  const auto X = family.template own<3>([&](int i) { return (sites[i].*place).data(); });
  return {{X[0], X[1], X[2]}};
}

template <class T>
Vector3<T> zero_vector() {
  const T zero = T{} * 0;
  return {{zero, zero, zero}};
}
template <>
inline Vector3<Lanes> zero_vector() {
  return {{Lanes::Zero(), Lanes::Zero(), Lanes::Zero()}};
}
template <class T>
Tensor3<T> zero_tensor() {
  const Vector3<T> v = zero_vector<T>();
  return {{{v.c[0], v.c[1], v.c[2]}, {v.c[0], v.c[1], v.c[2]}, {v.c[0], v.c[1], v.c[2]}}};
}

// u − v, of a far end and of the points.
template <class T>
Vector3<T> apart(const Eigen::Array4d& far, const Vector3<T>& own) {
  return {{far[0] - own.c[0], far[1] - own.c[1], far[2] - own.c[2]}};
}

template <class T>
T dot(const Vector3<T>& u, const Vector3<T>& v) {
  return u.c[0] * v.c[0] + u.c[1] * v.c[1] + u.c[2] * v.c[2];
}

// Calls visit(j, ω V_j, ξ, presence) over a family.
template <class Family, class Weight, class Visit>
inline void over(const Family& family, const Site* sites, Weight, Visit&& visit) {
  using T = ScalarOf<Family>;
  using std::sqrt;
  const Vector3<T> X = own_place(family, sites, &Site::reference);
  const T horizon = family.template own<1>([&](int i) { return sites[i].current.data() + 3; })[0];
  family.for_each([&](int j, const auto& present) {
    const Site& there = sites[j];
    const Vector3<T> xi = apart(there.reference, X);
    T weight = there.reference[3] * present;
    if constexpr (!std::is_same_v<Weight, One>) {
      const T length = sqrt(dot(xi, xi)), ratio = 2 * length / (horizon + there.current[3]);
      weight *= Weight::of(ratio);
    }
    visit(j, weight, xi, present);
  });
}

// ---- The sums ------------------------------------------------------------------------------------------------------

template <class Family, class Weight>
inline Tensor3<ScalarOf<Family>> gather(const Family& family, const Site* sites, Weight weight) {
  using T = ScalarOf<Family>;
  const Vector3<T> y = own_place(family, sites, &Site::current);
  Tensor3<T> N = zero_tensor<T>();
  over(family, sites, weight, [&](int j, const T& w, const Vector3<T>& xi, const auto&) {
    const Vector3<T> eta = apart(sites[j].current, y);
    for (int r = 0; r < 3; ++r) {
      const T weighted = w * eta.c[r];
      for (int c = 0; c < 3; ++c) N.c[r][c] += weighted * xi.c[c];
    }
  });
  return Tensor3<T>(N);  // a copy: kept in registers while it is added up
}

// Σ ω V_j (y_j − y_i), the pull on a point of its own springs, less C_i.
template <class Family, class Weight>
inline Vector3<ScalarOf<Family>> pull(const Family& family, const Site* sites, Weight weight) {
  using T = ScalarOf<Family>;
  const Vector3<T> y = own_place(family, sites, &Site::current);
  Vector3<T> sum = zero_vector<T>();
  over(family, sites, weight, [&](int j, const T& w, const Vector3<T>&, const auto&) {
    const Vector3<T> eta = apart(sites[j].current, y);
    for (int c = 0; c < 3; ++c) sum.c[c] += w * eta.c[c];
  });
  return Vector3<T>(sum);  // a copy: kept in registers while it is added up
}

// A and C, or F, C̄ and the share of the step, of the points.
template <class T>
struct OwnState {
  Tensor3<T> tensor;
  T scalar, share;
};

template <class Family>
OwnState<ScalarOf<Family>> own_state(const Family& family, const ForceState* states) {
  const auto numbers = family.template own<12>([&](int i) { return states[i].column[0].data(); });
  OwnState<ScalarOf<Family>> state;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) state.tensor.c[r][c] = numbers[4 * c + r];
  }
  state.scalar = numbers[3], state.share = numbers[7];
  return state;
}

// with_springs: whether any point of the scene has C. `own`: of the points, or zero for what the far ends give.
template <bool with_springs, class Family, class Weight>
inline Vector3<ScalarOf<Family>> force(const Family& family, const Site* sites, const ForceState* states,
                                       const OwnState<ScalarOf<Family>>& own, Weight weight) {
  using T = ScalarOf<Family>;
  const Vector3<T> y = own_place(family, sites, &Site::current);
  const OwnState<T> here = own;
  Tensor3<T> by_axis = zero_tensor<T>();  // by the component of ξ: so many chains of additions are under way
  Vector3<T> springs = zero_vector<T>();
  over(family, sites, weight, [&](int j, const T& w, const Vector3<T>& xi, const auto&) {
    const ForceState& there = states[j];
    for (int c = 0; c < 3; ++c) {
      const T weighted = w * xi.c[c];
      for (int r = 0; r < 3; ++r) by_axis.c[r][c] += (here.tensor.c[r][c] + there.column[c][r]) * weighted;
    }
    if constexpr (with_springs) {
      const Vector3<T> eta = apart(sites[j].current, y);
      const T stiffness = w * (here.scalar + there.column[0][3]);
      for (int c = 0; c < 3; ++c) springs.c[c] += stiffness * eta.c[c];
    }
  });
  Vector3<T> sum;
  for (int r = 0; r < 3; ++r) sum.c[r] = by_axis.c[r][0] + by_axis.c[r][1] + by_axis.c[r][2] + springs.c[r];
  return sum;
}

// Σ ω V |y_j − y_i − F ξ|², the least-squares residual of F.
template <class Family, class Weight>
inline ScalarOf<Family> squared_residual(const Family& family, const Site* sites, const MaterialPoint* points,
                                         Weight weight) {
  using T = ScalarOf<Family>;
  const Vector3<T> y = own_place(family, sites, &Site::current);
  const auto F = family.template own<9>([&](int i) { return points[i].deformation_gradient.data(); });  // by columns
  T sum = zero_vector<T>().c[0];
  over(family, sites, weight, [&](int j, const T& w, const Vector3<T>& xi, const auto&) {
    Vector3<T> z = apart(sites[j].current, y);
    for (int r = 0; r < 3; ++r) z.c[r] -= F[r] * xi.c[0] + F[3 + r] * xi.c[1] + F[6 + r] * xi.c[2];
    sum += w * dot(z, z);
  });
  return sum;
}

// ---- The mean gradient's residual ----------------------------------------------------------------------------------

// Calls visit(ω V_j C_ij less the share, z, ξ, share) over a family: what the mean gradient of both ends does not see
// of their bond, z = (y_j − y_i) − ½ (F_i + F_j) ξ. A bond is as stiff as its softer end: C_ij = 2 min(C̄_i, C̄_j), none
// to a point that has none. It acts at the steps of the end whose step is halved less often, so with the greater share
// of a step.
template <class Family, class Weight, class Visit>
inline void over_residuals(const Family& family, const Site* places, const ForceState* gradients, Weight weight,
                           Visit&& visit) {
  using T = ScalarOf<Family>;
  const Vector3<T> y = own_place(family, places, &Site::current);
  const OwnState<T> here = own_state(family, gradients);
  const Tensor3<T>& F = here.tensor;
  over(family, places, weight, [&](int j, const T& w, const Vector3<T>& xi, const auto&) {
    const ForceState& there = gradients[j];
    Vector3<T> z = apart(places[j].current, y);
    for (int r = 0; r < 3; ++r) {
      const T fitted = (F.c[r][0] + there.column[0][r]) * xi.c[0] + (F.c[r][1] + there.column[1][r]) * xi.c[1] +
                       (F.c[r][2] + there.column[2][r]) * xi.c[2];
      z.c[r] -= 0.5 * fitted;
    }
    const double far_C = there.column[0][3], far_share = there.column[1][3];
    if constexpr (std::is_same_v<T, double>) {
      visit(2 * w * std::min(here.scalar, far_C), z, xi, std::max(here.share, far_share));
    } else {
      visit(T(2 * w * here.scalar.min(far_C)), z, xi, T(here.share.max(far_share)));
    }
  });
}

template <class T>
struct Residual {
  Vector3<T> force;   // Σ ω V_j C_ij z, N/m³
  Tensor3<T> moment;  // M = Σ ω V_j C_ij z ⊗ ξ, Pa
};

template <class Family, class Weight>
inline Residual<ScalarOf<Family>> residual(const Family& family, const Site* places, const ForceState* gradients,
                                           Weight weight) {
  using T = ScalarOf<Family>;
  Residual<T> sums{zero_vector<T>(), zero_tensor<T>()};
  over_residuals(family, places, gradients, weight,
                 [&](const T& stiffness, const Vector3<T>& z, const Vector3<T>& xi, const T& share) {
                   for (int r = 0; r < 3; ++r) {
                     const T t = share * stiffness * z.c[r];
                     sums.force.c[r] += t;
                     for (int c = 0; c < 3; ++c) sums.moment.c[r][c] += t * xi.c[c];
                   }
                 });
  return Residual<T>(sums);  // a copy: kept in registers while it is added up
}

// ½ Σ ω V_j ½ C_ij |z|², a point's half of the energy, J/m³.
template <class Family, class Weight>
inline ScalarOf<Family> residual_energy(const Family& family, const Site* places, const ForceState* gradients,
                                        Weight weight) {
  using T = ScalarOf<Family>;
  T sum = zero_vector<T>().c[0];
  over_residuals(
      family, places, gradients, weight,
      [&](const T& stiffness, const Vector3<T>& z, const Vector3<T>&, const T&) { sum += stiffness * dot(z, z); });
  return 0.25 * sum;
}

// ---- Force states --------------------------------------------------------------------------------------------------

inline ForceState packed(const Tensor& A, double stabilization, double share = 0) {
  ForceState state;
  for (int c = 0; c < 3; ++c) state.column[c] << A.col(c).array(), 0;
  state.column[0][3] = stabilization;
  state.column[1][3] = share;
  return state;
}

}  // namespace strut::bonds
