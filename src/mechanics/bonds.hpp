// The two sums over a family that correspondence peridynamics needs, and the choice of ω outside of them.
//   gather:  N = Σ ω V_j (y_j − y_i) ⊗ ξ                                              (F = N K⁻¹)
//   force:   f_i = Σ ω V_j [ (A_i + A_j) ξ + (C_i + C_j)(y_j − y_i) ],  ξ = X_j − X_i
// A family is read in the order of global ids, four lanes at a time; what stands in the fourth lane is ignored.
#pragma once

#include "mechanics/body.hpp"

namespace strut::bonds {

struct One {
  double operator()(const Eigen::Array4d&, double) const { return 1; }
};

// |ξ|/δ with δ = (δ_i + δ_j)/2
inline double ratio(const Eigen::Array4d& xi, double horizons) { return 2 * xi.head<3>().matrix().norm() / horizons; }

struct LinearDecay {
  double operator()(const Eigen::Array4d& xi, double horizons) const { return 1 - ratio(xi, horizons); }
};

struct CubicDecay {
  double operator()(const Eigen::Array4d& xi, double horizons) const {
    const double r = ratio(xi, horizons);
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

// Calls visit(j, ξ, weight) over the family of point i, weight = ω V_j.
template <class Weight, class Visit>
inline void over_family(const Families& families, const Site* sites, int i, Weight weight, Visit&& visit) {
  const Site here = sites[i];
  const std::size_t end = families.start[i + 1];
  for (std::size_t b = families.start[i]; b < end; ++b) {
    const int j = families.neighbours[b];
    const Eigen::Array4d xi = sites[j].reference - here.reference;
    visit(j, xi, sites[j].reference[3] * weight(xi, here.current[3] + sites[j].current[3]));
  }
}

inline Tensor tensor_of(const Eigen::Array4d& a, const Eigen::Array4d& b, const Eigen::Array4d& c) {
  Tensor t;
  t << a.head<3>().matrix(), b.head<3>().matrix(), c.head<3>().matrix();
  return t;
}

struct Gathered {
  Tensor moment;  // N
  double square;  // Σ ω V |y_j − y_i|², if asked for
};

template <bool with_square, class Weight>
inline Gathered gather(const Families& families, const Site* sites, int i, Weight weight) {
  const Eigen::Array4d y = sites[i].current;
  Eigen::Array4d a = Eigen::Array4d::Zero(), b = a, c = a, square = a;
  over_family(families, sites, i, weight, [&](int j, const Eigen::Array4d& xi, double w) {
    const Eigen::Array4d eta = sites[j].current - y;
    const Eigen::Array4d weighted = w * eta;
    a += weighted * xi[0];
    b += weighted * xi[1];
    c += weighted * xi[2];
    if constexpr (with_square) square += weighted * eta;
  });
  return {tensor_of(a, b, c), square.head<3>().sum()};
}

template <class Weight>
inline Vector force(const Families& families, const Site* sites, const ForceState* states, int i, Weight weight) {
  const Eigen::Array4d y = sites[i].current;
  const ForceState here = states[i];
  const double stabilization = here.column[0][3];
  Eigen::Array4d sum = Eigen::Array4d::Zero();
  over_family(families, sites, i, weight, [&](int j, const Eigen::Array4d& xi, double w) {
    const ForceState& there = states[j];
    Eigen::Array4d bond = (here.column[0] + there.column[0]) * xi[0];
    bond += (here.column[1] + there.column[1]) * xi[1];
    bond += (here.column[2] + there.column[2]) * xi[2];
    bond += (stabilization + there.column[0][3]) * (sites[j].current - y);
    sum += w * bond;
  });
  return sum.head<3>().matrix();
}

}  // namespace strut::bonds
