// The sums over a family that correspondence peridynamics needs, and the choice of the influence function ω. The
// formulas of a bond stand here, for the neighbor lists of whole steps and of substeps; on lattices the same sums are
// convolutions (lattice_sums.hpp).
// clang-format off
//   gather:    N = Σ ω V_j (y_j − y_i) ⊗ ξ,  ξ = X_j − X_i                            (F = N K⁻¹)
//              and Σ ω V_j (y_j − y_i), the pull of a point's springs on its own gradient
//   far force: Σ ω V_j [ A_j ξ + C_j (y_j − y_i) ]
//   residual:  Σ ω V_j t and M = Σ ω V_j t ⊗ ξ, with the force t of a stabilization on
//              z = (y_j − y_i) − ½ (F_i + F_j) ξ
// clang-format on
// The force of a bond is (A_i + A_j) ξ + (C_i + C_j)(y_j − y_i). The part of the point's own state, A_i Σ ω V_j ξ
// and C_i Σ ω V_j (y_j − y_i), needs no loop over bonds (own_force). Each sum is written once for any family: of
// one point (OfPoint), or of the points of a cluster in SIMD lanes (OfCluster), which reads a far end once for all
// its points; its weight is 0 in lanes whose point does not have it in the family. Terms are added in the order of
// the family, so that a sum does not depend on the rest of the cluster. The sums of ordinary points:
// ordinary_bonds.hpp.
#pragma once

#include <algorithm>
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

// Calls work(ω) with the influence function as a type, so that a constant one costs nothing; returns its result.
template <class Work>
auto with_influence(Influence influence, Work&& work) {
  switch (influence) {
    case Influence::one:
      return work(One{});
    case Influence::linear_decay:
      return work(LinearDecay{});
    case Influence::cubic_decay:
      break;
  }
  return work(CubicDecay{});
}

// ---- Families ------------------------------------------------------------------------------------------------------

// The near end of the bonds of one point.
struct NearPoint {
  using Scalar = double;
  int i;

  // The `count` numbers of point i that start at of(i).
  template <int count, class Of>
  std::array<double, count> own(Of of) const {
    std::array<double, count> numbers;
    std::copy_n(of(i), count, numbers.begin());
    return numbers;
  }
};

// The family of one point.
struct OfPoint : NearPoint {
  const Families& families;

  template <class Visit>
  void for_each(Visit&& visit) const {  // visit(j, 1)
    families.for_each(i, [&](int j) { visit(j, 1.0); });
  }
};

// The families of the points of a cluster; its first point fills the lanes that have none.
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
  void for_each(Visit&& visit) const {  // visit(j, 1 in the lanes that have j in their family, else 0)
    for_each(visit, [](int) {});
  }
  // fetch(j) is called some entries ahead of visit(j), also for the first entries of the next list: far ends are
  // scattered in memory, and waiting for them would take half of the time.
  template <class Visit, class Fetch>
  void for_each(Visit&& visit, const Fetch& fetch) const {
    constexpr std::size_t ahead = 32;
    const int* near = cluster.near.data();
    for (std::size_t n = 0; n < cluster.near.size(); ++n) {
      fetch(near[std::min(n + ahead, cluster.to_end - 1)]);
      visit(near[n], small::ones_in(cluster.mask[n]));
    }
  }
};

template <class Family>
using ScalarOf = typename Family::Scalar;

template <class Family>
Vector3<ScalarOf<Family>> own_position(const Family& family, const Site* sites, Eigen::Array4d Site::*place) {
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

inline Vector to_vector(const Vector3<double>& v) { return {v.c[0], v.c[1], v.c[2]}; }

// u − v, with u of a far end and v of the points.
template <class T>
Vector3<T> apart(const Eigen::Array4d& far, const Vector3<T>& own) {
  return {{far[0] - own.c[0], far[1] - own.c[1], far[2] - own.c[2]}};
}

template <class T>
T dot(const Vector3<T>& u, const Vector3<T>& v) {
  return u.c[0] * v.c[0] + u.c[1] * v.c[1] + u.c[2] * v.c[2];
}

template <class Record>
inline void fetch_record(const Record* record) {
  const char* first = reinterpret_cast<const char*>(record);
  for (std::size_t line = 0; line < sizeof(Record); line += 64) __builtin_prefetch(first + line);
}

// Calls visit(j, ω V_j, ξ, presence) for each bond of a family. `read`: records by j that the visits read besides, to
// be prefetched.
template <class Family, class Weight, class Visit, class... Record>
inline void over(const Family& family, const Site* sites, Weight, Visit&& visit,
                 [[maybe_unused]] const Record*... read) {
  using T = ScalarOf<Family>;
  using std::sqrt;
  const Vector3<T> X = own_position(family, sites, &Site::reference);
  const T horizon = family.template own<1>([&](int i) { return sites[i].current.data() + 3; })[0];
  const auto at_bond = [&](int j, const auto& present) {
    const Site& there = sites[j];
    const Vector3<T> xi = apart(there.reference, X);
    T weight = there.volume() * present;
    if constexpr (!std::is_same_v<Weight, One>) {
      const T length = sqrt(dot(xi, xi)), ratio = 2 * length / (horizon + there.horizon());
      weight *= Weight::of(ratio);
    }
    visit(j, weight, xi, present);
  };
  if constexpr (std::is_same_v<Family, OfCluster>) {
    family.for_each(at_bond, [&](int j) { fetch_record(sites + j), (fetch_record(read + j), ...); });
  } else {
    family.for_each(at_bond);
  }
}

// ---- The sums ------------------------------------------------------------------------------------------------------

template <class T>
struct Moments {
  Tensor3<T> tensor = zero_tensor<T>();  // N
  Vector3<T> pull = zero_vector<T>();    // Σ ω V_j (y_j − y_i), if asked for
};

template <bool with_pull, class Family, class Weight>
inline Moments<ScalarOf<Family>> gather(const Family& family, const Site* sites, Weight weight) {
  using T = ScalarOf<Family>;
  const Vector3<T> y = own_position(family, sites, &Site::current);
  Moments<T> sums;
  over(family, sites, weight, [&](int j, const T& w, const Vector3<T>& xi, const auto&) {
    const Vector3<T> eta = apart(sites[j].current, y);
    for (int r = 0; r < 3; ++r) {
      const T weighted = w * eta.c[r];
      if constexpr (with_pull) sums.pull.c[r] += weighted;
      for (int c = 0; c < 3; ++c) sums.tensor.c[r][c] += weighted * xi.c[c];
    }
  });
  return Moments<T>(sums);  // a copy: the sums stay in registers while they are added up
}

// Σ ω V ξ of a point, in extended precision: it acts with the same sign in every step, so that its round-off would make
// the momentum drift.
template <class Weight>
inline Vector first_moment(const OfPoint& family, const Site* sites, Weight weight) {
  long double sum[3] = {0, 0, 0};
  over(family, sites, weight, [&](int, double w, const Vector3<double>& xi, double) {
    for (int c = 0; c < 3; ++c) sum[c] += static_cast<long double>(w) * xi.c[c];
  });
  return {static_cast<double>(sum[0]), static_cast<double>(sum[1]), static_cast<double>(sum[2])};
}

// Σ ω V_j [ A_j ξ + C_j (y_j − y_i) ]. with_springs: some point of the scene has C > 0.
template <bool with_springs, class Family, class Weight>
inline Vector3<ScalarOf<Family>> far_force(const Family& family, const Site* sites, const ForceState* states,
                                           Weight weight) {
  using T = ScalarOf<Family>;
  const Vector3<T> y = own_position(family, sites, &Site::current);
  Tensor3<T> by_axis = zero_tensor<T>();  // by the component of ξ, for independent chains of additions
  Vector3<T> springs = zero_vector<T>();
  over(
      family, sites, weight,
      [&](int j, const T& w, const Vector3<T>& xi, const auto&) {
        const ForceState& there = states[j];
        for (int c = 0; c < 3; ++c) {
          const T weighted = w * xi.c[c];
          for (int r = 0; r < 3; ++r) by_axis.c[r][c] += there.column[c][r] * weighted;
        }
        if constexpr (with_springs) {
          const Vector3<T> eta = apart(sites[j].current, y);
          const T stiffness = w * there.stiffness();
          for (int c = 0; c < 3; ++c) springs.c[c] += stiffness * eta.c[c];
        }
      },
      states);
  Vector3<T> sum;
  for (int r = 0; r < 3; ++r) sum.c[r] = by_axis.c[r][0] + by_axis.c[r][1] + by_axis.c[r][2] + springs.c[r];
  return sum;
}

// A Σ ω V ξ + C Σ ω V (y_j − y_i), from sums that are known already.
template <class T>
inline Vector3<T> own_force(const Tensor3<T>& A, const T& C, const Vector3<T>& first_moment, const Vector3<T>& pull) {
  const Vector3<T>& S = first_moment;
  Vector3<T> sum;
  for (int r = 0; r < 3; ++r) sum.c[r] = A.c[r][0] * S.c[0] + A.c[r][1] * S.c[1] + A.c[r][2] * S.c[2] + C * pull.c[r];
  return sum;
}

// Σ ω V |y_j − y_i − F ξ|², the least-squares residual of F.
template <class Family, class Weight>
inline ScalarOf<Family> squared_residual(const Family& family, const Site* sites, const MaterialPoint* points,
                                         Weight weight) {
  using T = ScalarOf<Family>;
  const Vector3<T> y = own_position(family, sites, &Site::current);
  const auto F = family.template own<9>([&](int i) { return points[i].deformation_gradient.data(); });  // by columns
  T sum = zero_vector<T>().c[0];
  over(family, sites, weight, [&](int j, const T& w, const Vector3<T>& xi, const auto&) {
    Vector3<T> z = apart(sites[j].current, y);
    for (int r = 0; r < 3; ++r) z.c[r] -= F[r] * xi.c[0] + F[3 + r] * xi.c[1] + F[6 + r] * xi.c[2];
    sum += w * dot(z, z);
  });
  return sum;
}

// ---- The residual of both ends' gradients --------------------------------------------------------------------------

// F, C and the factor on the force of the points (GradientState).
template <class T>
struct OwnGradient {
  Tensor3<T> F;
  T stiffness, force_factor;
};

// C of a record if its stabilization is the one at `kind`, else 0; with only one bond stabilization there is no check.
template <class T>
T stiffness_of(std::size_t kind, const T& stiffness, const T& of_kind) {
  if constexpr (bond_stabilizations == 1) return stiffness;
  if constexpr (std::is_same_v<T, double>) {
    return of_kind == static_cast<double>(kind) ? stiffness : 0;
  } else {
    return (of_kind == static_cast<double>(kind)).select(stiffness, T::Zero());
  }
}

template <class Family>
OwnGradient<ScalarOf<Family>> own_gradient(const Family& family, const GradientState* states, std::size_t kind) {
  const auto numbers = family.template own<12>([&](int i) { return states[i].column[0].data(); });
  OwnGradient<ScalarOf<Family>> own;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) own.F.c[r][c] = numbers[4 * c + r];
  }
  own.stiffness = stiffness_of(kind, numbers[3], numbers[11]), own.force_factor = numbers[7];
  return own;
}

// Calls visit(ω V_j t, z, ξ, factor) for each bond of a family: t is the force of the stabilization S at `kind`, which
// the visit multiplies by the factor. A spring acts in the steps of its end with the lower time-step level, so the
// larger factor of both ends counts.
template <class S, class Family, class Weight, class Visit>
inline void over_residuals(std::size_t kind, const Family& family, const Site* places, const GradientState* gradients,
                           Weight weight, Visit&& visit) {
  using T = ScalarOf<Family>;
  const Vector3<T> y = own_position(family, places, &Site::current);
  const OwnGradient<T> here = own_gradient(family, gradients, kind);
  const Tensor3<T>& F = here.F;
  over(
      family, places, weight,
      [&](int j, const T& w, const Vector3<T>& xi, const auto&) {
        const GradientState& there = gradients[j];
        Vector3<T> z = apart(places[j].current, y);
        for (int r = 0; r < 3; ++r) {
          const T fitted = (F.c[r][0] + there.column[0][r]) * xi.c[0] + (F.c[r][1] + there.column[1][r]) * xi.c[1] +
                           (F.c[r][2] + there.column[2][r]) * xi.c[2];
          z.c[r] -= 0.5 * fitted;
        }
        const double far_C = stiffness_of(kind, there.stiffness(), there.kind()), far_factor = there.column[1][3];
        T stiffness, factor;
        if constexpr (std::is_same_v<T, double>) {
          stiffness = 2 * w * std::min(here.stiffness, far_C), factor = std::max(here.force_factor, far_factor);
        } else {
          stiffness = 2 * w * here.stiffness.min(far_C), factor = here.force_factor.max(far_factor);
        }
        visit(S::bond_force(stiffness, z, xi), z, xi, factor);
      },
      gradients);
}

template <class T>
struct Residual {
  Vector3<T> force;   // Σ ω V_j t, N/m³
  Tensor3<T> moment;  // M = Σ ω V_j t ⊗ ξ, Pa
};

template <class S, class Family, class Weight>
inline Residual<ScalarOf<Family>> residual(std::size_t kind, const Family& family, const Site* places,
                                           const GradientState* gradients, Weight weight) {
  using T = ScalarOf<Family>;
  Residual<T> sums{zero_vector<T>(), zero_tensor<T>()};
  over_residuals<S>(kind, family, places, gradients, weight,
                    [&](const Vector3<T>& force, const Vector3<T>&, const Vector3<T>& xi, const T& factor) {
                      for (int r = 0; r < 3; ++r) {
                        const T t = factor * force.c[r];
                        sums.force.c[r] += t;
                        for (int c = 0; c < 3; ++c) sums.moment.c[r][c] += t * xi.c[c];
                      }
                    });
  return Residual<T>(sums);  // a copy: the sums stay in registers while they are added up
}

// ½ Σ ω V_j ½ z·t, the point's half of the energy of the springs, J/m³.
template <class S, class Family, class Weight>
inline ScalarOf<Family> residual_energy(std::size_t kind, const Family& family, const Site* places,
                                        const GradientState* gradients, Weight weight) {
  using T = ScalarOf<Family>;
  T sum = zero_vector<T>().c[0];
  over_residuals<S>(
      kind, family, places, gradients, weight,
      [&](const Vector3<T>& force, const Vector3<T>& z, const Vector3<T>&, const T&) { sum += dot(force, z); });
  return 0.25 * sum;
}

}  // namespace strut::bonds

namespace strut {

// Calls visit(j, ω V_j, ξ) for each bond of point i, where SIMD is not worthwhile.
template <class Visit>
void over_family(const Body& body, int i, const Visit& visit) {
  bonds::with_influence(body.influence, [&](auto weight) {
    bonds::over(bonds::OfPoint{{i}, body.domain.families}, body.domain.sites.data(), weight,
                [&](int j, double w, const auto& xi, double) { visit(j, w, bonds::to_vector(xi)); });
  });
}

}  // namespace strut
