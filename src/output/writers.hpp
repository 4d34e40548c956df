// Result files of a run: frames of the fields, and lines of the history.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deck/deck.hpp"
#include "integrators/ledger.hpp"
#include "io/exodus/exodus.hpp"
#include "io/text/history.hpp"
#include "output/means.hpp"
#include "output/schedule.hpp"
#include "output/variables.hpp"

namespace strut {

// Writes the frames of the result file.
class FieldWriter {
 public:
  FieldWriter(const deck::Deck& deck, const OutputVariables& variables);

  // Collective. Replaces the file; a resumed run appends to it.
  void open(const Body& body);
  void write(double time, const Body& body);  // collective
  void serialize(Archive& archive, int step, double time);

  bool has(double time) const { return time == last_; }  // the last frame was of this time
  bool enabled() const { return enabled_; }
  bool is_open() const { return writer_.has_value(); }
  Schedule schedule;

 private:
  bool enabled_;
  double last_ = never;
  std::filesystem::path file_;
  std::vector<Observable> variables_;
  std::vector<std::vector<double>> columns_;
  int before_ = 0;  // number of frames before the restart
  double sum_ = 0;  // their checksum
  std::optional<io::ExodusWriter> writer_;
};

// Rows of a history that are kept in memory, the same on all ranks.
struct HistoryRows {
  std::vector<io::HistoryColumn> columns;
  std::vector<double> values;  // row by row
};

// Writes the table of the ledger, extremes, means, reactions, contact forces and cracks over time.
class History {
 public:
  History(const deck::Deck& deck, const OutputVariables& variables);

  // Keeps the rows there, too; `rows` must outlive this object. Call it before open().
  void keep_rows(HistoryRows* rows) { rows_ = rows; }
  HistoryRows* kept_rows() const { return rows_; }
  void open(const Body& body);  // as FieldWriter::open
  // Call it at each time of explicit steps, before write() there.
  void gather(const StepImpulses& impulses, const contact::Contact& contact, const Domain& domain);
  // Collective.
  void write(const Ledger& now, const Reactions& reactions, const contact::Contact& contact, const Body& body);
  void serialize(Archive& archive, int step, double time);

  bool has(double time) const { return time == last_; }
  bool enabled() const { return enabled_; }
  bool has_reactions() const { return !reactions_.empty(); }
  Schedule schedule;

 private:
  std::vector<Vector> contact_forces(const contact::Contact& contact, const Domain& domain) const;
  std::vector<double> forces(double time, const Reactions& reactions, const contact::Contact& contact,
                             const Domain& domain);

  bool enabled_;
  double last_ = never;
  std::filesystem::path path_;
  std::vector<Reduction> extremes_;
  std::vector<ReactionComponent> reactions_;
  std::vector<CrackColumn> crack_columns_;
  std::vector<CrackTip> cracks_;
  std::vector<Reduction> means_;
  std::vector<ContactComponent> contacts_;
  bool has_means_;              // false for equilibria: all forces are those at the time
  bool has_means_later_;        // explicit steps follow the equilibria
  MeanForces means_of_forces_;  // of reactions_, then contacts_
  std::int64_t before_ = 0;     // bytes before the restart
  double sum_ = 0;              // their checksum
  std::optional<io::HistoryFile> file_;
  HistoryRows* rows_ = nullptr;
};

// Collective. True if the result named in the deck, or without one the history, is that of a completed run.
bool is_over(const deck::Deck& deck, const Communicator& communicator);

// Frames and history together.
struct OutputWriters {
  OutputWriters(const deck::Deck& deck, const OutputVariables& variables)
      : frames(deck, variables), history(deck, variables) {}

  void open(const Body& body) {
    frames.open(body);
    history.open(body);
  }
  bool is_scheduled(int step, double time) const {
    return frames.schedule.is_scheduled(step, time) || history.schedule.is_scheduled(step, time);
  }
  void serialize(Archive& archive, int step, double time) {
    frames.serialize(archive, step, time);
    history.serialize(archive, step, time);
  }
  // Collective. Writes a frame and a line of history if they are due, or if it is the last time. `reactions`: called if
  // a line is written. Returns the ledger if either is written.
  template <class Solver, class OfConditions>
  std::optional<Ledger> write(const Body& body, Solver& solver, const OfConditions& reactions, bool last) {
    const double now = solver.time();
    const auto wanted = [&](const auto& sink) {
      return sink.enabled() && !sink.has(now) && (last || sink.schedule.is_scheduled(solver.steps(), now));
    };
    const bool frame = wanted(frames), line = wanted(history);
    if (!frame && !line) return std::nullopt;
    if (frame) frames.write(now, body);
    const Ledger ledger = solver.ledger();
    if (line) history.write(ledger, reactions(), solver.contact(), body);
    return ledger;
  }

  FieldWriter frames;
  History history;
};

}  // namespace strut
