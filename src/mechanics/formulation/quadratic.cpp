// By quadratic correspondence, from the places of the points to the states of their bonds: F at four places of each
// cell, rotation, law and first Piola–Kirchhoff stress there.
#include "mechanics/formulation/quadratic.hpp"

#include <array>

#include "mechanics/formulation/flow.hpp"
#include "mechanics/formulation/quadratic_cell.hpp"
#include "mechanics/formulation/shared_volume.hpp"
#include "mechanics/formulation/stress_update.hpp"
#include "mechanics/fracture/broken_family.hpp"

namespace strut {

namespace {

// Sums of a group over its families. Not in the update of a block, which is compiled for every law.
bonds::QuadraticMoments<Lanes> moments(const Body& body, const LaneGroup& group) {
  return bonds::with_influence(body.influence, [&](auto weight) {
    return bonds::quadratic_gather(bonds::OfCluster{*group.cluster}, body.domain.sites.data(), body.fits->multipliers(),
                                   weight);
  });
}

// All that the update of one block needs.
template <class L>
struct Update {
  LawUpdate<L> law;

  Body& body() const { return law.body; }
  MaterialBlock& block() const { return law.block; }

  LawPoints places(const LaneGroup& group, int q) const {
    LawPoints g{{}, {}, group};
    for (int l = 0; l < LaneGroup::width; ++l) {
      g.places[l] = static_cast<int>(block().place(group.k[l], q));
      g.points[l] = &block().cells[g.places[l]];
      if (law.pass.level == 0) fetch_ahead(block().cells.data(), g.places[l]);
    }
    return g;
  }

  // 1 for cells whose metal had flowed when the step began, 0 for others.
  Lanes flowed(const LaneGroup& group) const {
    if constexpr (!materials::tells_flow<L>) return Lanes::Zero();
    return lanes_of([&](int l) { return block().flowed[group.k[l]] ? 1.0 : 0.0; });
  }

  // The largest frequency bound² of the points of a group.
  double advance(const LaneGroup& group) const {
    const std::vector<Site>& sites = body().domain.sites;
    for (const int i : group.i) {
      if (law.pass.level == 0) fetch_ahead(&(*body().fits)[i], 0);
    }
    QuadraticCells cells(group, *body().fits, sites);
    cells.take(moments(body(), group));
    const Lanes share = lanes_of([&](int l) { return body().share(group.i[l], law.pass.level); });
    const Lanes carries = lanes_of([&](int l) { return (*body().fits)[group.i[l]].carries_stress() ? 1.0 : 0.0; });
    const std::array<LawPoints, 4> points{places(group, 0), places(group, 1), places(group, 2), places(group, 3)};
    const Lanes has_flowed = flowed(group);
    std::array<Deformed, 4> at;
    for (int q = 0; q < 4; ++q) {
      LaneTensor F = cells.gradient_at(q);
      for (int i = 0; i < 3; ++i) F.c[i][i] += 1 - carries;  // those without stress stay undeformed
      at[q] = law.deformed(points[q], F, share, carries);
    }
    const std::array<Lanes, 4> J{at[0].J, at[1].J, at[2].J, at[3].J};
    share_traces(J, {&at[0].rates, &at[1].rates, &at[2].rates, &at[3].rates}, has_flowed);
    for (int q = 0; q < 4; ++q) law.set_stress(points[q], share, at[q]);
    share_traces(J, {&at[0].stress, &at[1].stress, &at[2].stress, &at[3].stress}, has_flowed);
    Lanes stiffest = at[0].stiffness, softest = at[0].stiffness;
    for (const Deformed& now : at) stiffest = stiffest.max(now.stiffness), softest = softest.min(now.stiffness);
    Lanes modulus = Lanes::Zero(), determinant = Lanes::Constant(1);
    for (int q = 0; q < 4; ++q) {
      const Deformed& now = at[q];
      LaneTensor P = piola_kirchhoff(now.stress, now.polar, now.inverse_stretch, now.J);
      for (int l = 0; l < group.count; ++l) {
        // A failed place of a metal beside others bears its share of their pressure, as their strains have it.
        if (now.J[l] > 0 && stiffest[l] > 0) {
          law.store(points[q], l, now);
          continue;
        }
        for (auto& row : P.c) row[0][l] = row[1][l] = row[2][l] = 0;  // all have failed, NaN, or no stress is carried
        if (!(now.J[l] > 0)) determinant[l] = now.J[l] + 1 - carries[l];
      }
      cells.add_stress(q, P);
      modulus = modulus.max(steepened_modulus(now));
    }
    const auto state_of = [&](int l) -> QuadraticState& { return body().force_states.quadratics[group.i[l]]; };
    cells.store(group, share, state_of);
    for (int l = 0; l < group.count; ++l) state_of(l).failed = stiffest[l] > 0 ? 0 : 1;
    if (law.pass.dt > 0 && !law.pass.of_any_size) {
      begin_flow_of(group, points, at, share, (determinant > 0 && stiffest > 0).select(Lanes::Ones(), Lanes::Zero()));
    }
    for (int l = 0; l < group.count; ++l) {
      const int i = group.i[l];
      body().force_density[i] = bonds::quadratic_own_force(state_of(l), (*body().fits)[i]);
    }
    const Lanes density = lanes_of([&](int l) { return body().density[group.i[l]]; });
    return report(group, determinant, softest, share * share * cells.volume() / density * cells.steepness() * modulus);
  }

 private:
  // A cell that begins to flow (only where `may` is 1) has the mean of two forces: those that end the step, by its old
  // fit, and those that begin the next step, by its new fit. So the work over both steps is that of its stress, to the
  // second order in the step.
  void begin_flow_of(const LaneGroup& group, const std::array<LawPoints, 4>& points, const std::array<Deformed, 4>& at,
                     const Lanes& share, const Lanes& may) const {
    Lanes begun = Lanes::Zero();
    for (int l = 0; l < group.count; ++l) begun[l] = may[l] > 0 && begin_flow(body(), block(), group.k[l]) ? 1 : 0;
    if (!(begun > 0).any()) return;
    std::array<LaneTensor, 4> F, R;
    std::array<Lanes, 4> J;
    std::array<LaneSymmetric, 4> stress{at[0].stress, at[1].stress, at[2].stress, at[3].stress};
    for (int q = 0; q < 4; ++q) {
      F[q] = deformation_gradients(points[q]), R[q] = rotations(points[q]), J[q] = small::determinant(F[q]);
    }
    share_traces(J, {&stress[0], &stress[1], &stress[2], &stress[3]}, begun);
    QuadraticCells cells(group, *body().fits, body().domain.sites);
    for (int q = 0; q < 4; ++q) {
      const LaneSymmetric stretch = small::symmetric_part(small::transposed_product(R[q], F[q]));
      cells.add_stress(q, piola_kirchhoff(stress[q], {R[q], stretch}, small::inverse(stretch), J[q]));
    }
    std::array<QuadraticState, LaneGroup::width> next;
    cells.store(group, share, [&](int l) -> QuadraticState& { return next[l]; });
    for (int l = 0; l < group.count; ++l) {
      if (begun[l] > 0) body().force_states.quadratics[group.i[l]].take_half_of(next[l]);
    }
  }

  // Reports points that are turned inside out at a place, and returns the largest frequency bound² of the others. One
  // that has lost bonds, or failed at a place, may be crushed between others: it only carries no stress meanwhile.
  double report(const LaneGroup& group, const Lanes& determinant, const Lanes& softest, const Lanes& bound2) const {
    double fastest = 0;
    for (int l = 0; l < group.count; ++l) {
      if (determinant[l] > 0) {
        fastest = std::max(fastest, bound2[l]);
      } else {
        const bool is_number = !std::isnan(determinant[l]);
        const bool is_broken = has_lost_bonds(body(), group.i[l]) || !(softest[l] > 0);
        if (!is_number) law.failure.report(group.k[l], Failure::Kind::not_finite);
        if (is_number && !is_broken) law.failure.report(group.k[l], Failure::Kind::inverted);
        body().force_states.quadratics[group.i[l]] = {};
        body().force_states.quadratics[group.i[l]].failed = is_broken;  // where points fail, crushed ones do
        body().force_density[group.i[l]].setZero();
      }
    }
    return fastest;
  }
};

// What a look at the body shows of a cell: F and R in its middle, and the mean of the stresses.
void diagnose_cell(Body& body, const MaterialBlock& block, int k, const Tensor& F) {
  MaterialPoint& point = body.points[block.points[k]];
  point.deformation_gradient = F;
  const Tensor R = F.determinant() > 0 ? polar_rotation(F) : Tensor::Identity();
  point.rotation = Rotation(R);
  Tensor stress = Tensor::Zero();
  for (int q = 0; q < 4; ++q) {
    const MaterialPoint& there = block.cells[block.place(k, q)];
    const Tensor turned = R.transpose() * there.rotation.tensor();
    stress += 0.25 * turned * to_tensor(there.stress) * turned.transpose();
  }
  point.stress = symmetric_part(stress);
}

}  // namespace

void advance_quadratic(Body& body, MaterialBlock& block, const StressPass& pass, const LaneGroups& groups,
                       StepReport& report) {
  const auto advance = [&]<class L>(const L& law) {
    WorstFailure failure;
    advance_groups(Update<L>{{body, block, law, pass, failure}}, groups, report);
  };
  std::visit(advance, block.material.law);
}

void diagnose_cells(Body& body, const MaterialBlock& block, const LaneGroups& groups) {
  for_each_point(0, groups.count(), [&](int g) {
    const LaneGroup group = groups[g];
    QuadraticCells cells(group, *body.fits, body.domain.sites);
    cells.take(moments(body, group));
    for (int l = 0; l < group.count; ++l) {
      const bool carries = (*body.fits)[group.i[l]].carries_stress();
      diagnose_cell(body, block, group.k[l], carries ? at(cells.gradient(), l) : Tensor(Tensor::Identity()));
    }
  });
}

}  // namespace strut
