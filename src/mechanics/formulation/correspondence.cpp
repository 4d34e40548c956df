// Correspondence: from the positions of the points to their force states, by F, rotation, law and first Piola–Kirchhoff
// stress.
#include "mechanics/formulation/stress_pass.hpp"
#include "mechanics/formulation/stress_update.hpp"
#include "mechanics/kernels/prefetch.hpp"

namespace strut {

namespace {

LaneSymmetric shape_inverses(const LaneGroup& g, const Body& body) {
  LaneSymmetric s;
  for (int c = 0; c < 6; ++c) s[c] = lanes_of([&](int l) { return body.shape_inverse[g.i[l]][c]; });
  return s;
}

// A = P K⁻¹ − C F, times the fraction of the step.
LaneTensor force_states(const Deformed& now, const Lanes& C, const LaneSymmetric& shape_inverse,
                        const Lanes& step_fraction) {
  LaneTensor A =
      small::product(piola_kirchhoff(now.stress, now.polar, now.inverse_stretch, now.J), small::full(shape_inverse));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) A.c[i][j] = step_fraction * (A.c[i][j] - C * now.F.c[i][j]);
  }
  return A;
}

// Sums of a group over its families. Not a part of Update, which is compiled for every law.
bonds::Moments<Lanes> moments(const Body& body, const LaneGroup& group, bool with_springs) {
  return bonds::with_influence(
      body.influence, [&](auto weight) { return moments(group, {body.domain.sites.data()}, with_springs, weight); });
}

// The stress update of one block.
template <class L>
struct Update {
  LawUpdate<L> law;
  bool with_springs;    // some point of the scene has springs on its own gradient
  bool with_gradients;  // the block has springs on both ends' gradients

  Body& body() const { return law.body; }
  MaterialBlock& block() const { return law.block; }

  PointRecords members(const LaneGroup& group) const {
    PointRecords g;
    for (int l = 0; l < LaneGroup::width; ++l) {
      g.points[l] = &body().points[group.i[l]];
      if (law.pass.level == 0) fetch_ahead(body().points.data(), group.i[l]);
    }
    return g;
  }
  void store(int i, int l, const Deformed& now) const {
    body().points[i].rotation = Rotation(at(now.polar.rotation, l));
    body().points[i].deformation_gradient = at(now.F, l);
  }

  // A failed point keeps its mass. F and R keep their values; if bonds may break, those at the time of failure, because
  // Fracture counts the energy of its springs before they vanish. Springs on both ends' gradients vanish with its
  // bonds, in the next step.
  void store_failed(const LaneGroup& g, int l, const Deformed& now) const {
    const int i = g.i[l];
    double& failed = body().force_states.tensors[i].failed();
    if (!block().material.damage) {
      body().points[i].stabilization = 0;
    } else if (!(failed > 0) && now.J[l] > 0) {
      store(i, l, now);
    }
    drop_forces(g, l);
    failed = 1;
    if (block().material.damage)
      store_gradient(i, body().points[i].stabilization, body().step_fraction(i, law.pass.level));
  }

  // A point with broken bonds may be crushed between others: it then carries no stress, which is no failure.
  void report(const LaneGroup& g, int l, double J, bool carries) const {
    if (std::isnan(J)) return law.failure.report(g.k[l], Failure::Kind::not_finite);
    if (carries && !body().has_lost_bonds(g.i[l])) law.failure.report(g.k[l], Failure::Kind::inverted);
  }

  void drop_forces(const LaneGroup& g, int l) const {
    const int i = g.i[l];
    body().force_states.tensors[i] = bonds::force_state(Tensor::Zero(), 0);
    body().force_density[i].setZero();
    store_gradient(i, 0, body().step_fraction(i, law.pass.level));
  }

  // Stores what the springs on both ends' gradients read.
  void store_gradient(int i, double C, double step_fraction) const {
    if (!with_gradients) return;
    body().force_states.gradients[i] =
        bonds::gradient_state(body().points[i].deformation_gradient, C, step_fraction, block().material.stabilization);
  }

  void store_point(int i, int l, const Deformed& now, const LaneTensor& A, double C, double step_fraction) const {
    store(i, l, now);
    body().force_states.tensors[i] = bonds::force_state(at(A, l), C);
    store_gradient(i, body().points[i].stabilization, step_fraction);
  }

  LaneTensor deformation_gradient(const LaneGroup& g, const LaneTensor& N, const LaneSymmetric& shape_inverse,
                                  const Lanes& carries) const {
    LaneTensor F = small::product(N, small::full(shape_inverse));
    // On lattices N sums displacements: add I. Elsewhere add I where neighbors do not span space (it stays undeformed).
    const Lanes missing = g.cluster ? Lanes(1 - carries) : Lanes::Constant(1);
    for (int i = 0; i < 3; ++i) F.c[i][i] += missing;
    return F;
  }

  // Advances a group; returns the largest frequency bound² of its points, 1/s².
  double advance(const LaneGroup& group) const {
    GroupTile<materials::state_size<L>> state(*block().state, group.k, group.count);
    Prefetch next;
    next.add(state.rows() + materials::state_size<L>, materials::state_size<L>);
    next.all();
    const IntegrationPoints<PointRecords> g{group, group.k, members(group), state.rows()};
    const LaneSymmetric shape_inverse = shape_inverses(group, body());
    const auto [N, pull] = moments(body(), group, with_springs);
    const Lanes trace = shape_inverse.c[0] + shape_inverse.c[1] + shape_inverse.c[2];
    const Lanes carries = (trace > 0).select(Lanes::Constant(1), Lanes::Zero());
    const LaneTensor F = deformation_gradient(group, N, shape_inverse, carries);
    const Lanes step_fraction = step_fractions(body(), group, law.pass.level);
    Deformed now = law.deformed(group, g.numbers, F, step_fraction, carries);
    law.set_stress(g, step_fraction, now);
    law.template count_expansion<1>(group, {&now});
    state.give_back(*block().state, group.k, group.count);
    const Lanes C = lanes_of([&](int l) { return block().own_springs_of(*g.numbers.points[l]); }),
                shared_C = step_fraction * C;
    const LaneTensor A = force_states(now, C, shape_inverse, step_fraction);
    const LaneVector own = bonds::own_force(A, shared_C, first_moments(group, body().first_moment), pull);
    const Lanes per_density =
        lanes_of([&](int l) { return body().domain.volume(group.i[l]) / body().density[group.i[l]]; });
    const Lanes bound2 = step_fraction * step_fraction * per_density * steepened_modulus(now) * trace;
    double fastest = 0;
    for (int l = 0; l < group.count; ++l) {
      if (!(now.stiffness[l] > 0)) {  // the point has failed
        store_failed(group, l, now);
        continue;
      }
      if (!(now.J[l] > 0)) {  // or NaN
        report(group, l, now.J[l], carries[l] > 0);
        drop_forces(group, l);
        continue;
      }
      store_point(group.i[l], l, now, A, shared_C[l], step_fraction[l]);
      body().force_density[group.i[l]] = at(own, l);
      fastest = std::max(fastest, bound2[l]);
    }
    return fastest;
  }
};

}  // namespace

void advance_stress(Body& body, MaterialBlock& block, const StressPass& pass, const LaneGroups& groups,
                    StepReport& report) {
  const auto advance = [&]<class L>(const L& law) {
    WorstFailure failure;
    const Update<L> update{{body, block, law, pass, failure},
                           body.has_springs(ResidualKind::own_gradient),
                           block.has_springs(ResidualKind::both_gradients)};
    advance_groups(update, groups, report);
  };
  std::visit(advance, block.material.law);
}

namespace {

// Σ ω V |y_j − y_i − F ξ|² of each point of a group, m⁵.
template <class Weight>
Lanes squared_residuals(const Body& body, const LaneGroup& group, Weight weight) {
  if (group.cluster) {
    return bonds::squared_residual(bonds::OfCluster{*group.cluster}, body.domain.sites.data(), body.points.data(),
                                   weight);
  }
  Lanes result = Lanes::Zero();
  for (int l = 0; l < group.count; ++l) {
    const int i = group.i[l];
    result[l] = group.chunk->squared_residual(i, {body.domain.sites.data()}, body.points[i].deformation_gradient,
                                              body.shape_inverse[i]);
  }
  return result;
}

}  // namespace

void diagnose_residuals(Body& body, const LaneGroups& groups) {
  bonds::with_influence(body.influence, [&](auto weight) {
    for_each_point(0, groups.count(), [&, weight](int g) {
      const LaneGroup group = groups[g];
      const Lanes squares = squared_residuals(body, group, weight);
      for (int l = 0; l < group.count; ++l) body.residual[group.i[l]] = squares[l];
    });
  });
}

}  // namespace strut
