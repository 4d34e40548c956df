#include "run/balance.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <numeric>
#include <string>

#include "base/text.hpp"
#include "base/timing.hpp"
#include "checkpoint/moved_snapshot.hpp"
#include "setup/setup.hpp"
#include "topology/partition.hpp"

namespace strut {

namespace {

constexpr int steps_between_checks = 100;
constexpr double worse = 1.1;

// Cost of a new partition, in steps with evenly distributed work (docs/decisions.md, Another partition).
constexpr double cost_of_change = 100;

// Cost of the contact of a touching point, ns per step (docs/decisions.md, Another partition).
constexpr double cost_of_contact = 2000;

// Approximate work of the owned points, ns per step. Points in rigid motion count, because it will not last.
std::vector<double> work_of_points(const Scene& scene, const contact::Contact& contact) {
  const Body& body = scene.body;
  std::vector<double> work(body.owned());
  for (int i = 0; i < body.owned(); ++i) {
    const int updates = body.time_levels.empty() ? 1 : 1 << body.time_levels[i];
    work[i] = updates * scene.weights.costs[body.domain.cloud.blocks[i]];
  }
  contact.add_where_touched(cost_of_contact, work);
  return work;
}

std::string to_text(double ratio) { return text_of(std::setprecision(3), ratio); }

void tell(const Communicator& communicator, int step, const std::string& text) {
  if (communicator.rank() == 0) std::cout << "step " << step << ": " << text << std::endl;
}

// Collective. The largest work of a rank over the mean, if each point is on the rank given for it.
double imbalance(const std::vector<double>& work, const std::vector<int>& ranks, const Communicator& communicator) {
  std::vector<double> of_ranks(communicator.size(), 0);
  for (std::size_t i = 0; i < work.size(); ++i) of_ranks[ranks[i]] += work[i];
  communicator.sum(of_ranks);
  const double sum = std::accumulate(of_ranks.begin(), of_ranks.end(), 0.0);
  return *std::max_element(of_ranks.begin(), of_ranks.end()) * communicator.size() / sum;
}

}  // namespace

Balance::Balance(const deck::Deck& deck)
    : enabled_(!deck.solver.quasi_static),
      most_(deck.solver.rebalance),
      final_time_(deck.solver.final_time),
      verbose_(deck.solver.verbose) {}

std::optional<std::vector<int>> Balance::better_ranks(const Scene& scene, const CentralDifference& solver) {
  const Communicator& communicator = scene.body.domain.communicator;
  if (!enabled_ || communicator.size() == 1) return std::nullopt;
  if (most_ >= communicator.size() && !verbose_) return std::nullopt;  // the imbalance cannot be so large
  if (solver.steps() == 0 || solver.steps() % steps_between_checks != 0) return std::nullopt;
  const std::vector<double> work = work_of_points(scene, solver.contact());
  const double now = imbalance(work, std::vector<int>(work.size(), communicator.rank()), communicator);
  if (verbose_) tell(communicator, solver.steps(), "the rank with most work has " + to_text(now) + " times the mean");
  if (!(now > std::max(most_, worse * accepted_))) return std::nullopt;
  const std::vector<int> ranks = bisected(whole_cloud(scene.body.domain), work, scene.weights.lengths, communicator);
  const double then = imbalance(work, ranks, communicator);
  const double steps_left = (final_time_ - solver.time()) / solver.dt();
  const bool pays = (now - then) * steps_left > cost_of_change;
  accepted_ = pays ? then : now;
  if (!pays) return std::nullopt;
  tell(communicator, solver.steps(),
       "points are spread over the ranks anew, as one had " + to_text(now) + " times the mean work; now " +
           to_text(then));
  return ranks;
}

void Balance::serialize(Archive& archive, const Body& body) {
  if (!enabled_) return;
  const Communicator& communicator = body.domain.communicator;
  int size = communicator.size();
  std::vector<int> ranks(body.owned(), communicator.rank());
  archive.number("ranks", size);
  archive.number("accepted_imbalance", accepted_);
  archive.points("all points", body.domain.cloud.ids);
  archive.field("rank", 1, [&](std::size_t i, int) -> int& { return ranks[i]; });
  if (!archive.loading()) return;
  if (size != communicator.size()) {
    accepted_ = 0;
    return;
  }
  const auto stays = [&](int rank) { return rank == communicator.rank(); };
  const bool all = std::all_of(ranks.begin(), ranks.end(), stays);
  if (communicator.any(!all)) restored_ = std::move(ranks);
}

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
