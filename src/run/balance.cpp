#include "run/balance.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <numeric>
#include <stdexcept>
#include <string>

#include "base/parallel/gather_scatter.hpp"
#include "base/text.hpp"
#include "base/timing.hpp"
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

// New ranks of the points: id and rank of each point of this rank, sorted by id.
using RanksOfPoints = std::vector<std::pair<std::int64_t, int>>;

RanksOfPoints by_ids(const Domain& domain, const std::vector<int>& ranks) {
  RanksOfPoints all;
  for (int i = 0; i < domain.owned; ++i) all.emplace_back(domain.id(i), ranks[i]);
  std::ranges::sort(all);
  return all;
}

// The places of some points among those that have come, by their ids.
std::vector<std::size_t> places_of(const std::vector<std::int64_t>& ids, const std::vector<std::int64_t>& arrived,
                                   const std::string& group) {
  std::vector<std::size_t> order(arrived.size()), places;
  std::iota(order.begin(), order.end(), 0);
  const auto id_of = [&](std::size_t k) { return arrived[k]; };
  std::ranges::sort(order, {}, id_of);
  for (const std::int64_t id : ids) {
    const auto place = std::ranges::lower_bound(order, id, {}, id_of);
    if (place == order.end() || arrived[*place] != id) throw std::logic_error("a point has not come: " + group);
    places.push_back(*place);
  }
  return places;
}

// Sends a number of each point at a time, so that messages need little memory beside the run's.
void move_group(const Snapshot::Group& from, const RanksOfPoints& ranks, Snapshot::Group& to,
                const Communicator& communicator) {
  std::vector<int> targets;
  for (const std::int64_t id : from.ids) targets.push_back(std::ranges::lower_bound(ranks, std::pair(id, -1))->second);
  const Routes routes(communicator, targets);
  const std::vector<std::size_t> places = places_of(to.ids, routes.there(from.ids), to.name);
  for (std::size_t column = 0; column < to.columns.size(); ++column) {
    const std::vector<double>& values = from.columns[column].values;
    const std::size_t width = to.columns[column].width;
    for (std::size_t c = 0; c < width; ++c) {
      const std::vector<double> arrived = routes.there([&](int k) { return values[k * width + c]; });
      for (std::size_t k = 0; k < places.size(); ++k) to.columns[column].values[k * width + c] = arrived[places[k]];
    }
  }
}

// Collective. Fills `to`, a snapshot of the same run on the new partition, with the values of `from`, on the old one.
// Each rank keeps its own sums (Snapshot::rank_sums).
void move_snapshot(const Snapshot& from, const RanksOfPoints& ranks, Snapshot& to, const Communicator& communicator) {
  to.numbers = from.numbers;
  to.rank_sums = from.rank_sums;
  const auto same = [](const Snapshot::Column& one, const Snapshot::Column& other) {
    return one.name == other.name && one.width == other.width;
  };
  for (std::size_t g = 0; g < to.groups.size(); ++g) {
    if (from.groups.at(g).name != to.groups[g].name ||
        !std::ranges::equal(from.groups[g].columns, to.groups[g].columns, same)) {
      throw std::logic_error("another partition keeps other things of points: " + to.groups[g].name);
    }
    move_group(from.groups[g], ranks, to.groups[g], communicator);
  }
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
