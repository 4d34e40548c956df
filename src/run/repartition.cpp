#include "run/repartition.hpp"

#include <algorithm>

#include "base/timing.hpp"
#include "checkpoint/moved_snapshot.hpp"
#include "setup/setup.hpp"

namespace strut {

namespace {

RanksOfPoints by_ids(const Domain& domain, const std::vector<int>& ranks) {
  RanksOfPoints all;
  for (int i = 0; i < domain.owned; ++i) all.emplace_back(domain.id(i), ranks[i]);
  std::ranges::sort(all);
  return all;
}

Snapshot saved(const ExplicitRun& run, int step, double time) {
  Snapshot snapshot;
  Archive archive = Archive::saving_to(snapshot);
  run.solver->serialize(archive);
  run.writers->serialize(archive, step, time);
  return snapshot;
}

// Rebuilds everything that depends on the order of points in memory, in the order of dependence.
void make_anew(const ExplicitRun& run, const std::vector<int>& ranks) {
  const Communicator communicator = run.scene->body.domain.communicator;
  MigrationState migrated =
      migration_state_of(*run.scene, moved(whole_cloud(run.scene->body.domain), ranks, communicator));
  HistoryRows* const rows = run.writers->history.kept_rows();
  run.writers.reset();
  run.solver.reset();
  run.scene.reset();
  Scene& scene = run.scene.emplace(set_up_again(run.deck, std::move(migrated), communicator));
  run.writers.emplace(run.deck, output_variables_of(run.deck, scene.body, scene.contact));
  run.writers->history.keep_rows(rows);
  run.solver.emplace(scene.body, std::move(scene.conditions), std::move(scene.contact), scene.control,
                     CentralDifference::ToBeRestored(), std::move(scene.fracture));
  if (run.writers->history.has_reactions()) {
    run.solver->gather_reactions(static_cast<int>(run.deck.conditions.size()));
  }
}

}  // namespace

void repartition(const ExplicitRun& run, const std::vector<int>& ranks) {
  static Teuchos::Time& timer = phase("Another partition");
  const Timed timed(timer);
  const int step = run.solver->steps();
  const double time = run.solver->time();
  Snapshot snapshot = saved(run, step, time);
  const RanksOfPoints where = by_ids(run.scene->body.domain, ranks);
  try {
    make_anew(run, ranks);
  } catch (const Error& error) {
    throw LostState(error.what());
  }
  Snapshot here = saved(run, step, time);
  move_snapshot(snapshot, where, here, run.scene->body.domain.communicator);
  Archive archive = Archive::loading_from(here);
  run.solver->serialize(archive);
  run.writers->serialize(archive, step, time);
  run.writers->open(run.scene->body);
}

}  // namespace strut
