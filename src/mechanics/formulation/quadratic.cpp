// Quadratic correspondence: from the positions of the points to the states of their bonds, by F, rotation, law and
// first Piola–Kirchhoff stress at the four integration points of each cell.
#include <array>

#include "mechanics/formulation/quadratic_cell.hpp"
#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/formulation/shared_volume.hpp"
#include "mechanics/formulation/stress_pass.hpp"
#include "mechanics/formulation/stress_update.hpp"

namespace strut {

namespace {

// Sums of a group over its families. Not a part of Update, which is compiled for every law.
__attribute__((noinline)) bonds::QuadraticMoments<Lanes> moments(const Body& body, const LaneGroup& group,
                                                                 Prefetch ahead) {
  ahead.spread_over(2 * group.cluster->near.size());
  return bonds::with_influence(body.influence, [&](auto weight) {
    return bonds::quadratic_gather(bonds::OfCluster{*group.cluster}, body.domain.sites.data(), body.fits->multipliers(),
                                   weight, ahead);
  });
}

// The integration points of the cells of a group. Those of the cells of a tile lie side by side, q after q.
template <class L>
class CellsOfGroup {
 public:
  CellsOfGroup(MaterialBlock& block, const LaneGroup& group)
      : block_(block),
        group_(group),
        first_(places_of(block, group)),
        numbers_(block.cells->tiles(), first_, group.count),
        state_(*block.state, first_, group.count) {}

  IntegrationPoints<PointTile> points(int q) const {
    std::array<int, LaneGroup::width> places;
    for (int l = 0; l < LaneGroup::width; ++l) places[l] = first_[l] + q * LaneGroup::width;
    return {group_, places, numbers(q), state_.rows() + q * columns};
  }
  PointTile numbers(int q) const { return {numbers_.rows() + q * CellPoints::size}; }
  void give_back() const {
    numbers_.give_back(block_.cells->tiles(), first_, group_.count);
    state_.give_back(*block_.state, first_, group_.count);
  }

 private:
  static constexpr std::size_t columns = materials::state_size<L>;
  using Places = std::array<int, LaneGroup::width>;
  static Places places_of(const MaterialBlock& block, const LaneGroup& group) {
    Places places;
    for (int l = 0; l < LaneGroup::width; ++l) places[l] = static_cast<int>(block.index(group.k[l], 0));
    return places;
  }

  MaterialBlock& block_;
  const LaneGroup& group_;
  Places first_;  // of the first integration points
  GroupTile<4 * CellPoints::size> numbers_;
  GroupTile<4 * columns> state_;
};

// The stress update of one block.
template <class L>
struct Update {
  LawUpdate<L> law;

  Body& body() const { return law.body; }
  MaterialBlock& block() const { return law.block; }

  // 1 for cells whose metal had flowed when the step began, 0 for others.
  Lanes flowed(const LaneGroup& group) const {
    if constexpr (!materials::tells_flow<L>) return Lanes::Zero();
    return lanes_of([&](int l) { return static_cast<double>(block().flowed[group.k[l]]); });
  }

  // Advances a group; returns the largest frequency bound² of its points, 1/s².
  double advance(const LaneGroup& group) const {
    QuadraticCells cells(group, *body().fits, body().domain.sites);
    cells.take(moments(body(), group, after(group)));
    const Lanes step_fraction = step_fractions(body(), group, law.pass.level);
    const Lanes carries = small::where_positive(cells.steepness(), Lanes::Ones(), Lanes::Zero());
    const Lanes has_one_volume = block().shares_volume ? carries : flowed(group);
    const double resisting = resisting_part(block());
    const CellsOfGroup<L> at(block(), group);
    std::array<Deformed, 4> now;
    for (int q = 0; q < 4; ++q) {
      LaneTensor F = cells.gradient_at(q);
      for (int i = 0; i < 3; ++i) F.c[i][i] += 1 - carries;  // cells without stress stay undeformed
      now[q] = law.deformed(group, at.numbers(q), F, step_fraction, carries);
    }
    const std::array<Lanes, 4> J{now[0].J, now[1].J, now[2].J, now[3].J};
    share_traces(J, {&now[0].rates, &now[1].rates, &now[2].rates, &now[3].rates}, has_one_volume, resisting);
    if (materials::follows_stretch<L> && block().shares_volume) {
      set_stress_of_shared_volume(at, step_fraction, now);
    } else {
      for (int q = 0; q < 4; ++q) law.set_stress(at.points(q), step_fraction, now[q]);
      share_traces(J, {&now[0].stress, &now[1].stress, &now[2].stress, &now[3].stress}, has_one_volume, resisting);
    }
    law.template count_expansion<4>(group, {&now[0], &now[1], &now[2], &now[3]});
    Lanes stiffest = now[0].stiffness, softest = now[0].stiffness;
    for (const Deformed& there : now) {
      stiffest = stiffest.max(there.stiffness), softest = softest.min(there.stiffness);
    }
    const Lanes some_hold = small::where_positive(stiffest, present(group), Lanes::Zero());
    Lanes modulus = Lanes::Zero(), determinant = Lanes::Constant(1);
    for (int q = 0; q < 4; ++q) {
      // While an integration point of a cell holds, its failed ones bear their fraction of the shared pressure.
      const Lanes holds = small::where_positive(J[q], some_hold, Lanes::Zero());
      at.numbers(q).set_motion(now[q].polar, holds);
      LaneTensor P = piola_kirchhoff(now[q].stress, now[q].polar, now[q].inverse_stretch, J[q]);
      for (auto& row : P.c) {  // zero if all have failed, for NaN, and if no stress is carried
        for (Lanes& number : row) number = small::where_positive(holds, number, Lanes::Zero());
      }
      determinant = small::where_positive(J[q], determinant, J[q] + 1 - carries);
      cells.add_stress(q, P);
      modulus = modulus.max(steepened_modulus(now[q]));
    }
    at.give_back();
    const Lanes density = lanes_of([&](int l) { return body().density[group.i[l]]; });
    const Lanes bound2 = step_fraction * step_fraction * cells.volume() / density * cells.steepness() * modulus;
    auto states = cells.states(step_fraction);
    states.back() = small::where_positive(stiffest, Lanes::Zero(), Lanes::Ones());  // failed
    const LaneVector force = cells.own_force(states);
    small::store_numbers(states, group.count, [&](int l) { return state_of(group, l).first; });
    for (int l = 0; l < group.count; ++l) body().force_density[group.i[l]] = small::at(force, l);
    if (law.pass.dt > 0 && !law.pass.of_any_size) {
      begin_flow_of(group, now, step_fraction, small::where_positive(determinant, some_hold, Lanes::Zero()));
    }
    return report(group, determinant, softest, bound2);
  }

 private:
  static constexpr std::size_t columns = materials::state_size<L>;

  // The law's stress at the stretches of the mean volume.
  __attribute__((noinline)) void set_stress_of_shared_volume(const CellsOfGroup<L>& at, const Lanes& step_fraction,
                                                             std::array<Deformed, 4>& now) const {
    const MeanVolume mean({now[0].J, now[1].J, now[2].J, now[3].J});
    for (int q = 0; q < 4; ++q) {
      Deformed shared = now[q];
      mean.bring(q, shared.polar.stretch, shared.J);
      law.set_stress(at.points(q), step_fraction, shared);
      now[q].stress = shared.stress, now[q].stiffness = shared.stiffness;
    }
    mean.distribute({&now[0].stress, &now[1].stress, &now[2].stress, &now[3].stress});
  }

  // The records of the next group. In a whole step they lie behind those of this one.
  Prefetch after(const LaneGroup& group) const {
    const int next = LaneGroup::width;
    const std::size_t index = block().index(group.k[0], 0);
    Prefetch records;
    records.add(body().fits->tiles().tile_of(body().fits->index(group.i[0])) + QuadraticFit::size, QuadraticFit::size);
    records.add(block().cells->tiles().tile_of(index) + 4 * CellPoints::size, 4 * CellPoints::size);
    records.add(block().state->tile_of(index) + 4 * columns, 4 * columns);
    records.add(&state_of(group, 0) + next, next);
    records.add(&body().density[group.i[0]] + next, next);
    records.add(group.cluster->near.data() + group.cluster->near.size(), group.cluster->near.size());
    return records;
  }
  QuadraticState& state_of(const LaneGroup& group, int l) const { return body().force_states.quadratics[group.i[l]]; }

  // A cell that begins to flow (only where `may` is 1) gets the mean of two forces: by its old fit, at the end of this
  // step, and by its new fit, at the start of the next. The work over both steps is then that of its stress, to second
  // order in the step.
  void begin_flow_of(const LaneGroup& group, const std::array<Deformed, 4>& now, const Lanes& step_fraction,
                     const Lanes& may) const {
    if constexpr (!materials::tells_flow<L>) return;
    Lanes begun = Lanes::Zero();
    for (int l = 0; l < group.count; ++l) begun[l] = may[l] > 0 && begin_flow(body(), block(), group.k[l]) ? 1 : 0;
    if (small::any_positive(begun)) take_mean_force(group, now, step_fraction, begun);
  }
  __attribute__((noinline)) void take_mean_force(const LaneGroup& group, const std::array<Deformed, 4>& now,
                                                 const Lanes& step_fraction, const Lanes& begun) const {
    const CellsOfGroup<L> at(block(), group);
    std::array<Polar<Lanes>, 4> polar;
    std::array<Lanes, 4> J;
    std::array<LaneSymmetric, 4> stress{now[0].stress, now[1].stress, now[2].stress, now[3].stress};
    for (int q = 0; q < 4; ++q) {
      polar[q] = {at.numbers(q).rotations(), at.numbers(q).stretches()};
      J[q] = small::determinant(small::full(polar[q].stretch));
    }
    share_traces(J, {&stress[0], &stress[1], &stress[2], &stress[3]}, begun);
    QuadraticCells cells(group, *body().fits, body().domain.sites);
    for (int q = 0; q < 4; ++q) {
      cells.add_stress(q, piola_kirchhoff(stress[q], polar[q], small::inverse(polar[q].stretch), J[q]));
    }
    std::array<QuadraticState, LaneGroup::width> next;
    cells.store(group, step_fraction, [&](int l) -> QuadraticState& { return next[l]; });
    for (int l = 0; l < group.count; ++l) {
      if (!(begun[l] > 0)) continue;
      state_of(group, l).take_half_of(next[l]);
      body().force_density[group.i[l]] = bonds::quadratic_own_force(state_of(group, l), (*body().fits)[group.i[l]]);
    }
  }

  // Reports inverted points and returns the largest frequency bound² of the others, 1/s². A point with broken bonds or
  // a failed integration point may be crushed between others; it then only carries no stress.
  double report(const LaneGroup& group, const Lanes& determinant, const Lanes& softest, const Lanes& bound2) const {
    double fastest = 0;
    if (small::lanes_below_zero(-determinant) == (1u << LaneGroup::width) - 1) {  // the usual case, without branches
      for (int l = 0; l < LaneGroup::width; ++l) fastest = std::max(fastest, bound2[l]);
      return fastest;
    }
    for (int l = 0; l < group.count; ++l) {
      if (determinant[l] > 0) {
        fastest = std::max(fastest, bound2[l]);
      } else {
        const bool is_number = !std::isnan(determinant[l]);
        const bool is_broken = body().has_lost_bonds(group.i[l]) || !(softest[l] > 0);
        if (!is_number) law.failure.report(group.k[l], Failure::Kind::not_finite);
        if (is_number && !is_broken) law.failure.report(group.k[l], Failure::Kind::inverted);
        body().force_states.quadratics[group.i[l]] = {};
        body().force_states.quadratics[group.i[l]].failed = is_broken;  // where points may fail, crushed ones do
        body().force_density[group.i[l]].setZero();
      }
    }
    return fastest;
  }
};

// Sets what output shows of a cell: F and R in its middle, and the mean stress.
void diagnose_cell(Body& body, const MaterialBlock& block, int k, const Tensor& F) {
  MaterialPoint& point = body.points[block.points[k]];
  point.deformation_gradient = F;
  const Tensor R = F.determinant() > 0 ? polar_rotation(F) : Tensor::Identity();
  point.rotation = Rotation(R);
  Tensor stress = Tensor::Zero();
  for (int q = 0; q < 4; ++q) {
    const std::size_t index = block.index(k, q);
    const Tensor turned = R.transpose() * block.cells->rotation_at(index).tensor();
    stress += 0.25 * turned * to_tensor(block.cells->stress_at(index)) * turned.transpose();
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
    cells.take(moments(body, group, {}));
    for (int l = 0; l < group.count; ++l) {
      const bool carries = body.fits->carries_stress(group.i[l]);
      diagnose_cell(body, block, group.k[l], carries ? at(cells.gradient(), l) : Tensor(Tensor::Identity()));
    }
  });
}

}  // namespace strut
