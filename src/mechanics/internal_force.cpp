#include "mechanics/force_sum.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/rigid_motion.hpp"

namespace strut {

namespace {

StepReport together(const PerThread<StepReport>& reports) {
  StepReport all;
  for (const StepReport& of_thread : reports.all()) all.add(of_thread);
  return all;
}

StepReport advance(Body& body, const StressPass& pass, bool with_diagnostics, BondBreaking* breaking) {
  static Teuchos::Time& deforming = phase("Deformation and stress");
  set_expansion(body, pass.time, pass.dt);
  if (breaking && !body.expansion.empty()) exchange_expansion(body);
  PerThread<StepReport> reports;  // one per thread: threads share the strips of a lattice
  const Displacements u{body.domain.sites.data()};
  const auto advance = [&](MaterialBlock& block, const LaneGroups& groups) {
    StepReport& report = reports.mine();
    if (block.is_ordinary()) return advance_ordinary(body, block, with_diagnostics, groups, report);
    if (block.is_quadratic()) return advance_quadratic(body, block, pass, groups, report);
    advance_stress(body, block, pass, groups, report);
  };
  const auto view = [&](const MaterialBlock& block, const LaneGroups& groups) {
    if (block.is_quadratic()) diagnose_cells(body, block, groups);
    diagnose_residuals(body, groups);
  };
  const auto over = [&](Part part) {
    if (breaking && pass.dt > 0) breaking->break_bonds(body, part, pass.time, pass.dt);
    const Timed timed(deforming);
    over_blocks(
        body, Bodies::deforming, part, [&](LatticeSums& sums, const LatticeSums::Take& take) { sums.moments(u, take); },
        advance);
    if (breaking && pass.dt > 0) breaking->count_dissipation(body, part);
    if (!with_diagnostics) return;
    over_blocks(
        body, Bodies::deforming, part, [&](LatticeSums& sums, const LatticeSums::Take& take) { sums.squares(u, take); },
        view);
  };
  for (const MaterialBlock& block : body.blocks) {
    if (block.in_rigid_motion) reports.mine().add({.frequency_bound = block.rest_frequency_bound});
  }
  if (all_move_rigidly(body)) {
    over(Part::interior);
    return together(reports);
  }
  behind_exchange_of<reflect_position>(body.domain.halo, body.domain.sites, over);
  if (breaking) breaking->finish_step();
  return together(reports);
}

}  // namespace

StepReport advance_stress(Body& body, double dt, bool with_diagnostics, double time, BondBreaking* breaking) {
  return advance(body, {.dt = dt, .time = time}, with_diagnostics, breaking);
}

void sum_forces(Body& body, bool with_diagnostics, BondBreaking* breaking) {
  static Teuchos::Time& stabilizing = phase("Stabilization");
  static Teuchos::Time& summing = phase("Force");
  for (const MaterialBlock& block : body.blocks) {
    if (!block.in_rigid_motion) continue;
    for (const int i : block.points) body.force_density[i].setZero();
  }
  if (all_move_rigidly(body)) return;
  const Displacements u{body.domain.sites.data()};
  if (!body.force_states.gradients.empty()) {
    const std::span<double> energy = with_diagnostics ? std::span(body.bond_work) : std::span<double>();
    const ResidualSum sum{body, Bodies::deforming, u, body.force_states, body.force_density, energy};
    behind_exchange(body.domain.halo, body.force_states.gradients, [&](Part part) {
      const Timed timed(stabilizing);
      sum(part);
    });
  }
  const auto extension_of = [](const auto& family) { return bonds::OfPlaces(family); };
  add_up(body.domain.halo, ForceSum{body, Bodies::deforming, u, extension_of, body.force_states, body.force_density},
         [] { return Timed(summing); });
  if (breaking && !body.force_states.gradients.empty()) breaking->count_springs(body);
}

StepReport advance_stress_and_force(Body& body, double dt, bool with_diagnostics, BondBreaking* breaking) {
  const StepReport report = advance_stress(body, dt, with_diagnostics, 0, breaking);
  sum_forces(body, with_diagnostics, breaking);
  return report;
}

StepReport advance_by_any_step(Body& body, double dt, double time, bool with_diagnostics, BondBreaking* breaking) {
  const StepReport report = advance(body, {.dt = dt, .of_any_size = true, .time = time}, with_diagnostics, breaking);
  sum_forces(body, with_diagnostics, breaking);
  return report;
}

}  // namespace strut
