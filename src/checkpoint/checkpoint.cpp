#include "checkpoint/checkpoint.hpp"

#include <iostream>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/text.hpp"
#include "base/timing.hpp"
#include "deck/changes.hpp"
#include "deck/problems.hpp"
#include "io/checkpoint/checkpoint_file.hpp"

namespace strut {

namespace {

// A run of two solvers writes no checkpoint, but replaces the results to which an earlier checkpoint belongs. A file of
// another kind may stay, and so may the checkpoint with which this run has begun.
bool has_left_over(const deck::Deck& deck, const Communicator& communicator) {
  if (!deck.next_solver || !checkpoint_exists(deck, communicator)) return false;
  bool is_left = false;
  if (communicator.rank() == 0) {
    const auto may_go = [&](const std::filesystem::path& file) {
      return is_of_kind(file, FileKind::checkpoint) &&
             !(deck.start_from && same_file(file, deck.start_from->checkpoint));
    };
    is_left = may_go(deck.restart.file) && may_go(before_of(deck.restart.file));
  }
  return communicator.any(is_left);
}

}  // namespace

bool checkpoint_exists(const deck::Deck& deck, const Communicator& communicator) {
  const bool there = communicator.rank() == 0 && io::checkpoint_is_there(deck.restart.file);
  return communicator.any(there);
}

bool check_changes(const deck::Deck& deck, const Communicator& communicator) {
  const io::CheckpointFacts facts = io::facts_of_checkpoint(deck.restart.file, communicator);
  const deck::Changes changes = deck::changes(facts.deck, deck.text);
  deck::Problems problems;
  for (const std::string& one : changes.refused) problems.add(one);
  if (deck.solver.final_time < facts.time) {
    problems.add("Solver > Final Time", text_of("'", deck.solver.final_time, "' has passed: the checkpoint is of t = ",
                                                facts.time, " s; expected that or a later one"));
  }
  raise_together(
      communicator,
      problems.lines().empty()
          ? ""
          : problems.text(deck.file.string() + ": cannot go on from " + deck.restart.file.string() +
                          ", which is of another deck (a run goes on with another final time, steps, times of "
                          "output or load, and with or without Output and History); 'strut " +
                          deck.file.string() + "' begins anew"));
  if (communicator.rank() != 0) return facts.has_expanded;
  const std::string since = deck.file.string() + " is not as it was when the checkpoint was written: ";
  for (const std::string& one : changes.accepted) std::cout << "note: " << since << one << "\n";
  for (const std::string& one : changes.loads) std::cout << "WARNING: " << since << one << ", from here on\n";
  return facts.has_expanded;
}

Checkpoint::Checkpoint(const deck::Deck& deck, const Communicator& communicator, Serialize serialize)
    : settings_(deck.restart),
      deck_name_(deck.file.string()),
      deck_text_(deck.text),
      communicator_(communicator),
      serialize_(std::move(serialize)),
      has_left_over_(has_left_over(deck, communicator)),
      schedule_(deck.restart.enabled, deck.restart.frequency, deck.restart.interval, deck.solver.initial_time) {
  schedule_.done(deck.solver.initial_time);
  if (!settings_.enabled) return;
  run_on_root(communicator_, [this] {
    lock_.emplace(lock_of(settings_.file));
    std::filesystem::remove(part_of(settings_.file));  // left by a run that was killed while it wrote
  });
}

Checkpoint::~Checkpoint() {
  std::error_code ignored;
  if (lock_) std::filesystem::remove(lock_of(settings_.file), ignored);
}

void Checkpoint::close() {
  if (!is_scheduled_at_end()) remove();
}

// The present state defines what must be in the file.
void Checkpoint::load() {
  Snapshot snapshot;
  Archive asks = Archive::saving_to(snapshot);
  serialize_(asks);
  const std::string note = io::read_checkpoint(settings_.file, communicator_, snapshot);
  Archive restores = Archive::loading_from(snapshot);
  serialize_(restores);
  last_step_ = static_cast<int>(snapshot.numbers.at("steps"));
  last_time_ = snapshot.numbers.at("time");
  schedule_.done(last_time_);
  written_ = true;
  settings_.kept_at_end = true;  // the run before may have kept it, as this deck need not: it is not ours to remove
  if (communicator_.rank() != 0) return;
  if (!note.empty()) std::cout << "WARNING: " << note << "\n";
  std::cout << "going on from " << settings_.file.string() << ", t = " << last_time_ << " s, step " << last_step_
            << "\n";
}

void Checkpoint::remove() {
  if (settings_.enabled || has_left_over_) io::remove_checkpoint(settings_.file, communicator_);
}

bool Checkpoint::is_scheduled(int step, double time) const {
  return step > last_step_ && schedule_.is_scheduled(step, time);
}

bool Checkpoint::is_scheduled_by_clock() const {
  return settings_.enabled &&
         std::chrono::steady_clock::now() - last_ > std::chrono::duration<double>(60 * settings_.minutes);
}

void Checkpoint::write(int step, double time) {
  if (!settings_.enabled || (written_ && step == last_step_)) return;
  static Teuchos::Time& timer = phase("Checkpoint");
  const Timed timed(timer);
  Snapshot snapshot;
  Archive archive = Archive::saving_to(snapshot);
  serialize_(archive);
  io::write_checkpoint(settings_.file, communicator_, snapshot, deck_text_);
  last_ = std::chrono::steady_clock::now();
  last_step_ = step;
  last_time_ = time;
  written_ = true;
  schedule_.done(time);
}

std::string Checkpoint::kept() const {
  if (!is_scheduled_at_end()) return "";
  return settings_.file.string() + " keeps the state at the end (Start From, or --continue to a later Final Time)\n";
}

std::string Checkpoint::hint() const {
  if (!written_) return "";
  return text_of("; 'strut --continue ", deck_name_, "' goes on from t = ", last_time_, " s (", settings_.file.string(),
                 ")");
}

}  // namespace strut
