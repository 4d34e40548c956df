#include "fracture/work_balance.hpp"

#include <algorithm>

#include "mechanics/energies.hpp"
#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/kernels/bonds.hpp"
#include "mechanics/kernels/quadratic_bonds.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

namespace {

using bonds::Lanes, bonds::Vector3;

// Sums over the families of a cluster's points.
struct Sums {
  Lanes squares = Lanes::Zero();  // residual or extension squares for the energy of the bonds, m⁵
  Lanes work = Lanes::Zero();     // Σ ω V_j T·Δη, J/m³
};

struct Bond {
  int j;
  Lanes weight;                   // ω V_j
  Vector3<Lanes> xi, eta, moved;  // moved: Δη over the step
  Lanes absent;                   // 1 in lanes that do not have j in their family
};

// Calls visit(bond) for each bond of a cluster.
template <class Visit>
void over_bonds(const Cluster& cluster, const StepEnd& end, const Visit& visit) {
  const Site* sites = end.body.domain.sites.data();
  const bonds::OfCluster family{cluster};
  const auto now = bonds::own_position(family, sites, &Site::current);
  const auto numbers = family.own<3>([&end](int i) { return end.start[i].data(); });
  const Vector3<Lanes> start{{numbers[0], numbers[1], numbers[2]}};
  bonds::with_influence(end.body.influence, [&](auto weight) {
    bonds::over(family, sites, weight, [&](int j, const Lanes& w, const Vector3<Lanes>& xi, const auto& present) {
      const auto eta_now = bonds::apart(sites[j].current, now);
      Eigen::Array4d there;
      there << end.start[j].array(), 0;
      const auto eta_start = bonds::apart(there, start);
      Vector3<Lanes> moved;
      for (int c = 0; c < 3; ++c) moved.c[c] = eta_now.c[c] - eta_start.c[c];
      visit(Bond{j, w, xi, end.at_start ? eta_start : eta_now, moved, Lanes(1 - present)});
    });
  });
}

Sums sums_of_ordinary(const Cluster& cluster, const StepEnd& end) {
  const bonds::OfCluster family{cluster};
  const std::vector<PointExpansion>& expansions = end.body.expansion;
  const auto [a, b] = family.own<2>([&end](int i) { return &end.body.force_states.scalars[i].a; });
  Lanes expanded = Lanes::Ones();
  for (std::size_t l = 0; l < cluster.points.size() && !expansions.empty(); ++l) {
    const PointExpansion& point = expansions[cluster.points[l]];
    expanded[l] += end.at_start ? point.before : point.now;
  }
  Sums sums;
  over_bonds(cluster, end, [&](const Bond& bond) {
    const Lanes length = (bonds::dot(bond.eta, bond.eta) + bond.absent).sqrt();
    const Lanes rest = (bonds::dot(bond.xi, bond.xi) + bond.absent).sqrt(), extension = length - rest;
    sums.squares += bond.weight * (length - expanded * rest).square();
    sums.work += bond.weight * (a * rest + b * extension) / length * bonds::dot(bond.eta, bond.moved);
  });
  return sums;
}

// T = A ξ + C η; squares of η − F ξ.
Sums sums_of_correspondence(const Cluster& cluster, const StepEnd& end) {
  const bonds::OfCluster family{cluster};
  const auto A = family.own<12>([&end](int i) { return end.body.force_states.tensors[i].column[0].data(); });
  const auto F = family.own<9>([&end](int i) { return end.body.points[i].deformation_gradient.data(); });
  Sums sums;
  over_bonds(cluster, end, [&](const Bond& bond) {
    const auto& xi = bond.xi.c;
    for (int r = 0; r < 3; ++r) {
      const Lanes T = A[r] * xi[0] + A[4 + r] * xi[1] + A[8 + r] * xi[2] + A[3] * bond.eta.c[r];
      const Lanes z = bond.eta.c[r] - F[r] * xi[0] - F[3 + r] * xi[1] - F[6 + r] * xi[2];
      sums.work += bond.weight * T * bond.moved.c[r];
      sums.squares += bond.weight * z * z;
    }
  });
  return sums;
}

// T = A ξ + B q + D (μ_j − c).
Sums sums_of_quadratic(const Cluster& cluster, const StepEnd& end) {
  const bonds::OfCluster family{cluster};
  const auto state = family.own<39>([&end](int i) { return end.body.force_states.quadratics[i].first; });
  const Lanes *A = &state[0], *B = &state[9], *D = &state[27], *offset = &state[36];
  const Eigen::Array4d* multipliers = end.body.fits->multipliers();
  Sums sums;
  over_bonds(cluster, end, [&](const Bond& bond) {
    const std::array<Lanes, 6> q = bonds::squares(bond.xi);
    const Eigen::Array4d& mu = multipliers[bond.j];
    for (int r = 0; r < 3; ++r) {
      Lanes T = -offset[r];
      for (int c = 0; c < 3; ++c) T += A[3 * r + c] * bond.xi.c[c] + D[3 * r + c] * mu[c];
      for (int k = 0; k < 6; ++k) T += B[6 * r + k] * q[k];
      sums.work += bond.weight * T * bond.moved.c[r];
    }
  });
  return sums;
}

// The energy of a point without that which its expansion gave, J/m³.
double energy_of(const Body& body, const MaterialBlock& block, int k, double squares) {
  const int i = block.points[k];
  const double of_expansion = body.expansion.empty() ? 0 : body.expansion[i].work;
  if (block.is_ordinary()) return ordinary_energy(block, block.ordinary[k], squares) - of_expansion;
  const double springs = block.is_quadratic() ? 0 : block.own_springs_of(body.points[i]);
  const PointEnergy of_law = law_energy(body, block, k);
  return of_law.elastic + of_law.dissipated + 0.5 * springs * squares - of_expansion;
}

}  // namespace

std::array<BondWorkBalance, Cluster::width> balances_of(const MaterialBlock& block, int first, const Cluster& cluster,
                                                        const StepEnd& end) {
  const Sums sums = block.is_ordinary()    ? sums_of_ordinary(cluster, end)
                    : block.is_quadratic() ? sums_of_quadratic(cluster, end)
                                           : sums_of_correspondence(cluster, end);
  std::array<BondWorkBalance, Cluster::width> balances;
  for (std::size_t l = 0; l < cluster.points.size(); ++l) {
    const double volume = end.body.domain.volume(cluster.points[l]);
    const double energy = energy_of(end.body, block, first + static_cast<int>(l), sums.squares[l]);
    balances[l] = {volume * energy, volume * sums.work[l]};
  }
  return balances;
}

namespace {

using Numbers = bonds::Vector3<double>;

// The far ends of one point, as a family for the sums over bonds.
struct OfFarEnds : bonds::NearPoint {
  std::span<const int> far;

  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const int j : far) visit(j, 1.0);
  }
};

Numbers numbers_of(const Vector& v) { return {{v[0], v[1], v[2]}}; }

// Calls add<stabilization>(its number, j, weight, ξ) for each bond of a point's family.
template <class Family, class Add>
void over_springs(const Body& body, const Family& family, const Add& add) {
  bonds::with_influence(body.influence, [&](auto omega) {
    bonds::over(family, body.domain.sites.data(), omega, [&](int j, double weight, const Numbers& xi, double) {
      for_each_bond_stabilization([&]<class S>(const S&, std::size_t kind) {
        add.template operator()<S>(kind, j, weight, bonds::to_vector(xi));
      });
    });
  });
}

// Energy that the springs of owned point i lose, J; half of that of a bond whose far end loses, too.
double lost(const StepEnd& end, const std::vector<GradientState>& start, int i) {
  const Body& body = end.body;
  const std::vector<GradientState>& finish = body.force_states.gradients;
  double sum = 0;
  const auto add = [&]<class S>(std::size_t kind, int j, double weight, const Vector& xi) {
    if (body.force_states.tensors[j].lost_bonds() > 0) return;
    const auto stiffness = [&](const std::vector<GradientState>& at) {
      return 2 * std::min(bonds::stiffness_of(kind, at[i].stiffness(), at[i].kind()),
                          bonds::stiffness_of(kind, at[j].stiffness(), at[j].kind()));
    };
    const auto residual = [&](const std::vector<GradientState>& at, const Vector& eta) -> Vector {
      return eta - 0.5 * (bonds::tensor_of(at[i]) + bonds::tensor_of(at[j])) * xi;
    };
    const Vector z = residual(start, end.start[j] - end.start[i]),
                 after = residual(finish, body.domain.current(j) - body.domain.current(i));
    const Numbers force = S::bond_force(weight * (stiffness(start) - stiffness(finish)), numbers_of(z), numbers_of(xi));
    const double part = finish[j].stiffness() < start[j].stiffness() ? 0.5 : 1;
    sum += part * 0.5 * bonds::to_vector(force).dot(after);
  };
  over_springs(body, bonds::OfPoint{{i}, body.domain.families}, add);
  return body.domain.volume(i) * sum;
}

}  // namespace

BondWorkBalance SpringWorkBalance::of(int i, std::span<const int> family) const {
  const Body& body = end.body;
  BondWorkBalance sums;
  const auto add = [&]<class S>(std::size_t kind, int j, double weight, const Vector& xi) {
    const double C = 2 * std::min(bonds::stiffness_of(kind, now[i].stiffness(), now[i].kind()),
                                  bonds::stiffness_of(kind, now[j].stiffness(), now[j].kind()));
    const Tensor F = 0.5 * (bonds::tensor_of(now[i]) + bonds::tensor_of(now[j]));
    const Vector z = end.position(j) - end.position(i) - F * xi;
    const Numbers force = S::bond_force(weight * C, numbers_of(z), numbers_of(xi));
    const Vector t = bonds::to_vector(force);
    const Vector moved = body.domain.current(j) - body.domain.current(i) - end.start[j] + end.start[i];
    const bool far_lost = body.force_states.tensors[j].lost_bonds() > 0;
    sums.energy += (far_lost ? 0.25 : 0.5) * z.dot(t);
    sums.work += 0.5 * t.dot(moved);
    if (!far_lost) sums.work += 0.5 * t.dot(moved - (bonds::tensor_of(finish[j]) - bonds::tensor_of(start[j])) * xi);
  };
  over_springs(body, OfFarEnds{{i}, family}, add);
  const double volume = body.domain.volume(i);
  return {volume * sums.energy, volume * sums.work};
}

void count_fading(Body& body, const StepEnd& end, const std::vector<GradientState>& start) {
  if (start.size() != body.force_states.gradients.size()) return;  // no step has begun
  for (const MaterialBlock& block : body.blocks) {
    if (!springs_fade(block) || block.in_rigid_motion) continue;
    for_each_point(0, static_cast<int>(block.points.size()), [&](int k) {
      const int i = block.points[k];
      const bool fades = body.points[i].stabilization < start[i].stiffness();  // not for a step, as of a crushed point
      if (fades && !(body.force_states.tensors[i].lost_bonds() > 0)) body.fracture_energy[i] += lost(end, start, i);
    });
  }
}

}  // namespace strut
