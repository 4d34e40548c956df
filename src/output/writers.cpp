#include "output/writers.hpp"

#include <span>

#include "base/timing.hpp"

namespace strut {

FieldWriter::FieldWriter(const deck::Deck& deck, const OutputVariables& variables)
    : schedule(deck.output.enabled, deck.output.frequency, deck.output.interval, deck.solver.initial_time),
      enabled_(deck.output.enabled),
      file_(deck.output.file),
      variables_(variables.frame),
      columns_(variables.frame.size()) {}

void FieldWriter::open(const Body& body) {
  if (!enabled_) return;
  std::vector<io::OutputField> fields;
  for (const Observable& v : variables_) fields.push_back({v.name, v.components, v.nodal});
  writer_.emplace(file_, body.domain.communicator, whole_cloud(body.domain), std::move(fields), before_, sum_,
                  schedule.uncounted());
}

void FieldWriter::write(double time, const Body& body) {
  static Teuchos::Time& timer = phase("Output");
  const Timed timed(timer);
  for (std::size_t v = 0; v < variables_.size(); ++v) variables_[v].fill(body, columns_[v]);
  writer_->write(time, columns_);
  schedule.done(time);
  last_ = time;
}

void FieldWriter::serialize(Archive& archive, int step, double time) {
  if (writer_) {
    writer_->sync();
    before_ = writer_->frames(), sum_ = writer_->sum();
  }
  archive.number("frames", before_);
  archive.number("frames_sum", sum_);
  archive.number("last_frame", last_);
  schedule.serialize(archive, "frames", step, time);
}

History::History(const deck::Deck& deck, const OutputVariables& variables)
    : schedule(deck.history.enabled, deck.history.frequency, deck.history.interval, deck.solver.initial_time),
      enabled_(deck.history.enabled),
      path_(deck.history.file),
      extremes_(variables.extremes),
      reactions_(variables.reactions),
      crack_columns_(variables.crack_columns),
      cracks_(variables.cracks),
      means_(variables.means),
      contacts_(variables.contacts),
      has_means_(!deck.solver.quasi_static),
      has_means_later_(deck.next_solver.has_value()),
      means_of_forces_(reactions_.size() + contacts_.size(), deck.solver.initial_time) {}

void History::open(const Body& body) {
  if (!enabled_) return;
  std::vector<io::HistoryColumn> columns{{"Time", "s"},
                                         {"Step_Size", "s"},
                                         {"Kinetic_Energy", "J"},
                                         {"Elastic_Energy", "J"},
                                         {"Plastic_Work", "J"},
                                         {"Stabilization_Energy", "J"},
                                         {"Fracture_Energy", "J"},
                                         {"Heat", "J"},
                                         {"Tool_Kinetic_Energy", "J"},
                                         {"Tool_Work", "J"},
                                         {"Contact_Work", "J"},
                                         {"External_Work", "J"},
                                         {"Balance_Error", "1"},
                                         {"Momentum_X", "kg m/s"},
                                         {"Momentum_Y", "kg m/s"},
                                         {"Momentum_Z", "kg m/s"}};
  for (const Reduction& extreme : extremes_) columns.push_back({extreme.columns()[0], extreme.unit()});
  const std::string of_forces = has_means_ ? "N (mean)" : has_means_later_ ? "N (mean in explicit steps)" : "N";
  const auto unit = [&](bool is_instant) { return is_instant ? "N" : of_forces; };
  for (const ReactionComponent& reaction : reactions_) columns.push_back({reaction.name, unit(reaction.is_instant)});
  for (const CrackColumn& column : crack_columns_) columns.push_back({column.name, column.is_speed ? "m/s" : "m"});
  for (const Reduction& mean : means_) {
    for (std::string& name : mean.columns()) columns.push_back({std::move(name), mean.unit()});
  }
  for (const ContactComponent& contact : contacts_) columns.push_back({contact.name, unit(contact.is_instant)});
  if (rows_ && rows_->columns.empty()) rows_->columns = columns;  // as in the file, which other solvers go on with
  if (path_.empty()) return;
  file_.emplace(path_, body.domain.communicator, columns, before_, sum_, schedule.uncounted());
  if (rows_ && rows_->values.empty()) rows_->values = file_->rows();  // those before the checkpoint
}

// Contact forces on this rank, N; one per column.
std::vector<Vector> History::contact_forces(const contact::Contact& contact, const Domain& domain) const {
  std::vector<Vector> forces;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const ContactComponent& c = contacts_[k];
    const bool known = k > 0 && c.first == contacts_[k - 1].first && c.second == contacts_[k - 1].second;
    forces.push_back(known ? forces.back() : contact.force(domain, c.first, c.second));
  }
  return forces;
}

void History::gather(const StepImpulses& impulses, const contact::Contact& contact, const Domain& domain) {
  if (!enabled_ || (reactions_.empty() && contacts_.empty())) return;
  std::vector<double> before, after;
  for (const ReactionComponent& reaction : reactions_) {
    before.push_back(reaction.of(impulses.conditions_before));
    after.push_back(reaction.of(impulses.conditions_after));
  }
  const std::vector<Vector> forces = contact_forces(contact, domain);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    before.push_back(impulses.before * forces[k][contacts_[k].component]);
    after.push_back(impulses.after * forces[k][contacts_[k].component]);
  }
  means_of_forces_.add(before, after);
}

// Collective. Values of reactions, then of contacts.
std::vector<double> History::forces(double time, const Reactions& reactions, const contact::Contact& contact,
                                    const Domain& domain) {
  std::vector<double> row = means_of_forces_.take(time, domain.communicator), of_contacts;
  const std::vector<Vector> forces = contact_forces(contact, domain);
  for (std::size_t k = 0; k < contacts_.size(); ++k) of_contacts.push_back(forces[k][contacts_[k].component]);
  domain.communicator.sum(of_contacts);
  const auto is_shown = [this](const auto& column) { return column.is_instant || !has_means_; };
  for (std::size_t k = 0; k < reactions_.size(); ++k) {
    if (is_shown(reactions_[k])) row[k] = reactions_[k].of(reactions.forces);
  }
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (is_shown(contacts_[k])) row[reactions_.size() + k] = of_contacts[k];
  }
  return row;
}

void History::write(const Ledger& now, const Reactions& reactions, const contact::Contact& contact, const Body& body) {
  static Teuchos::Time& timer = phase("History");
  const Timed timed(timer);
  std::vector<double> row{now.time,          now.dt,       now.kinetic,       now.elastic,      now.dissipated,
                          now.stabilization, now.fracture, now.heat,          now.tool_kinetic, now.tools,
                          now.contact,       now.external, now.balance_error, now.momentum[0],  now.momentum[1],
                          now.momentum[2]};
  for (const Reduction& extreme : extremes_) row.push_back(extreme.values(body)[0]);
  std::vector<double> tips;
  for (const CrackTip& crack : cracks_) tips.push_back(crack.local(body));
  body.domain.communicator.max(tips);
  for (std::size_t k = 0; k < cracks_.size(); ++k) cracks_[k].take(now.time, tips[k]);
  const std::vector<double> forces = this->forces(now.time, reactions, contact, body.domain);
  const auto of_contacts = forces.begin() + static_cast<std::ptrdiff_t>(reactions_.size());
  row.insert(row.end(), forces.begin(), of_contacts);
  for (const CrackColumn& column : crack_columns_) row.push_back(column.of(cracks_[column.crack]));
  for (const Reduction& mean : means_) {
    for (const double value : mean.values(body)) row.push_back(value);
  }
  row.insert(row.end(), of_contacts, forces.end());
  if (rows_) rows_->values.insert(rows_->values.end(), row.begin(), row.end());
  if (file_) file_->write(row);
  schedule.done(now.time);
  last_ = now.time;
}

void History::serialize(Archive& archive, int step, double time) {
  if (file_) {
    file_->sync();
    before_ = file_->bytes(), sum_ = file_->sum();
  }
  archive.number("history_bytes", before_);
  archive.number("history_sum", sum_);
  archive.number("last_line", last_);
  schedule.serialize(archive, "history", step, time);
  for (CrackTip& crack : cracks_) crack.serialize(archive);
  means_of_forces_.serialize(archive);
}

bool is_over(const deck::Deck& deck, const Communicator& communicator) {
  double over = 0;
  if (communicator.rank() == 0) {
    std::optional<double> last;
    if (deck.output.enabled) {
      last = io::last_time_of_result(deck.output.file);
    } else if (deck.history.has_file()) {
      last = io::last_time_of_history(deck.history.file);
    }
    over = last && *last >= deck.next_solver.value_or(deck.solver).final_time ? 1 : 0;
  }
  return communicator.max(over) > 0;
}

}  // namespace strut
