// The sums over a family that correspondence peridynamics needs, and the choice of ω outside of them.
//   gather:  N = Σ ω V_j (y_j − y_i) ⊗ ξ                                              (F = N K⁻¹)
//   force:   f_i = Σ ω V_j [ (A_i + A_j) ξ + (C_i + C_j)(y_j − y_i) ],  ξ = X_j − X_i
// and, between them, the one of the stabilisation by the mean gradient:
//   residual: Σ ω V_j C_ij z and M = Σ ω V_j C_ij z ⊗ ξ,  z = (y_j − y_i) − ½ (F_i + F_j) ξ
// A family is read in the order of global ids, four lanes at a time; what stands in the fourth lane is ignored.
// The sums of ordinary points: ordinary_bonds.hpp.
#pragma once

#include <span>

#include "mechanics/body.hpp"

namespace strut::bonds {

// of(r) is ω itself, of one number or of several side by side.

struct One {
  double operator()(const Eigen::Array4d&, double) const { return 1; }
  template <class T>
  static double of(const T&) {
    return 1;
  }
};

// |ξ|/δ with δ = (δ_i + δ_j)/2
inline double ratio(const Eigen::Array4d& xi, double horizons) { return 2 * xi.head<3>().matrix().norm() / horizons; }

struct LinearDecay {
  double operator()(const Eigen::Array4d& xi, double horizons) const { return of(ratio(xi, horizons)); }
  template <class T>
  static T of(const T& r) {
    return 1 - r;
  }
};

struct CubicDecay {
  double operator()(const Eigen::Array4d& xi, double horizons) const { return of(ratio(xi, horizons)); }
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

// Calls visit(lane, j, ξ, weight) over the family of point i, weight = ω V_j. Bonds alternate between two lanes,
// compile time constants, so that two chains of additions are under way at a time: one alone waits for its own last
// sum.
template <class Weight, class Visit>
inline void over_family(const Families& families, const Site* sites, int i, Weight weight, Visit&& visit) {
  const Site here = sites[i];
  const auto bond_to = [&](auto lane, int j) {
    const Eigen::Array4d xi = sites[j].reference - here.reference;
    visit(lane, j, xi, sites[j].reference[3] * weight(xi, here.current[3] + sites[j].current[3]));
  };
  if (const LatticeFamilies* stencil = families.lattice(i)) {
    return stencil->for_each(i, [&](int j) { bond_to(std::integral_constant<int, 0>{}, j); });
  }
  const auto bond = [&](auto lane, std::size_t b) { bond_to(lane, families.neighbours[b]); };
  const std::size_t begin = families.start[i], end = families.start[i + 1];
  const std::size_t paired = begin + (end - begin) / 2 * 2;
  for (std::size_t b = begin; b < paired; b += 2) {
    bond(std::integral_constant<int, 0>{}, b);
    bond(std::integral_constant<int, 1>{}, b + 1);
  }
  if (paired < end) bond(std::integral_constant<int, 0>{}, paired);
}

// Some points of a family, in the place of families.
struct Listed {
  std::span<const int> points;
};

template <class Weight, class Visit>
inline void over_family(const Listed& family, const Site* sites, int i, Weight weight, Visit&& visit) {
  const Site here = sites[i];
  for (const int j : family.points) {
    const Eigen::Array4d xi = sites[j].reference - here.reference;
    visit(std::integral_constant<int, 0>{}, j, xi,
          sites[j].reference[3] * weight(xi, here.current[3] + sites[j].current[3]));
  }
}

inline Tensor tensor_of(const Eigen::Array4d& a, const Eigen::Array4d& b, const Eigen::Array4d& c) {
  Tensor t;
  t << a.head<3>().matrix(), b.head<3>().matrix(), c.head<3>().matrix();
  return t;
}

inline ForceState packed(const Tensor& A, double stabilization, double share = 0) {
  ForceState state;
  for (int c = 0; c < 3; ++c) state.column[c] << A.col(c).array(), 0;
  state.column[0][3] = stabilization;
  state.column[1][3] = share;
  return state;
}

template <class Weight>
inline Tensor gather(const Families& families, const Site* sites, int i, Weight weight) {
  const Eigen::Array4d y = sites[i].current;
  struct Sums {
    Eigen::Array4d x = Eigen::Array4d::Zero(), y = x, z = x;
  } sums[2];
  over_family(families, sites, i, weight, [&](auto lane, int j, const Eigen::Array4d& xi, double w) {
    const Eigen::Array4d weighted = w * (sites[j].current - y);
    sums[lane].x += weighted * xi[0];
    sums[lane].y += weighted * xi[1];
    sums[lane].z += weighted * xi[2];
  });
  return tensor_of(sums[0].x + sums[1].x, sums[0].y + sums[1].y, sums[0].z + sums[1].z);
}

// Σ ω V |y_j − y_i − F ξ|², the least-squares residual of F.
template <class Weight>
inline double squared_residual(const Families& families, const Site* sites, int i, const Tensor& F, Weight weight) {
  double sum = 0;
  over_family(families, sites, i, weight, [&](auto, int j, const Eigen::Array4d& xi, double w) {
    const Vector eta = (sites[j].current - sites[i].current).head<3>().matrix();
    sum += w * (eta - F * xi.head<3>().matrix()).squaredNorm();
  });
  return sum;
}

template <class Weight>
inline Vector force(const Families& families, const Site* sites, const ForceState* states, int i, Weight weight) {
  const Eigen::Array4d y = sites[i].current;
  const ForceState here = states[i];
  const double stabilization = here.column[0][3];
  Eigen::Array4d sum[2] = {Eigen::Array4d::Zero(), Eigen::Array4d::Zero()};
  over_family(families, sites, i, weight, [&](auto lane, int j, const Eigen::Array4d& xi, double w) {
    const ForceState& there = states[j];
    Eigen::Array4d bond = (here.column[0] + there.column[0]) * xi[0];
    bond += (here.column[1] + there.column[1]) * xi[1];
    bond += (here.column[2] + there.column[2]) * xi[2];
    bond += (stabilization + there.column[0][3]) * (sites[j].current - y);
    sum[lane] += w * bond;
  });
  return (sum[0] + sum[1]).head<3>().matrix();
}

struct Residual {
  Vector force;   // Σ ω V_j C_ij z, N/m³
  Tensor moment;  // M = Σ ω V_j C_ij z ⊗ ξ, Pa
  double energy;  // ½ Σ ω V_j ½ C_ij |z|², the point's half of it, J/m³
};

// What the mean gradient of both ends does not see of their bond: z = (y_j − y_i) − ½ (F_i + F_j) ξ. A bond is as stiff
// as its softer end: C_ij = 2 min(C̄_i, C̄_j), none to a point that has none. It acts at the steps of the end whose step
// is halved less often, so with the greater share of a step.
template <class Family, class Weight>
inline Residual residual(const Family& families, const Site* places, const ForceState* gradients, int i,
                         Weight weight) {
  const Eigen::Array4d y = places[i].current;
  const ForceState here = gradients[i];
  const double own = here.column[0][3], own_share = here.column[1][3];
  struct Sums {
    Eigen::Array4d force = Eigen::Array4d::Zero(), x = force, y = force, z = force, square = force;
  } sums[2];
  over_family(families, places, i, weight, [&](auto lane, int j, const Eigen::Array4d& xi, double w) {
    const ForceState& there = gradients[j];
    Eigen::Array4d fitted = (here.column[0] + there.column[0]) * xi[0];
    fitted += (here.column[1] + there.column[1]) * xi[1];
    fitted += (here.column[2] + there.column[2]) * xi[2];
    const Eigen::Array4d z = (places[j].current - y) - 0.5 * fitted;
    const Eigen::Array4d whole = (2 * w * std::min(own, there.column[0][3])) * z;
    const Eigen::Array4d t = std::max(own_share, there.column[1][3]) * whole;
    sums[lane].force += t;
    sums[lane].x += t * xi[0];
    sums[lane].y += t * xi[1];
    sums[lane].z += t * xi[2];
    sums[lane].square += whole * z;
  });
  const Eigen::Array4d force = sums[0].force + sums[1].force, square = sums[0].square + sums[1].square;
  return {force.head<3>().matrix(), tensor_of(sums[0].x + sums[1].x, sums[0].y + sums[1].y, sums[0].z + sums[1].z),
          0.25 * square.head<3>().sum()};
}

}  // namespace strut::bonds
