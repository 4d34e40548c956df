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
  writer_.emplace(file_, body.domain.communicator, whole_cloud(body.domain), std::move(fields), before_, sum_);
}

void FieldWriter::write(double time, const Body& body) {
  static Teuchos::Time& timer = phase("Output");
  const Timed timed(timer);
  for (std::size_t v = 0; v < variables_.size(); ++v) variables_[v].fill(body, columns_[v]);
  writer_->write(time, columns_);
  schedule.done(time);
  last_ = time;
}

void FieldWriter::serialize(Archive& archive, double time) {
  if (writer_) {
    writer_->sync();
    before_ = writer_->frames(), sum_ = writer_->sum();
  }
  archive.number("frames", before_);
  archive.number("frames_sum", sum_);
  archive.number("last_frame", last_);
  schedule.serialize(archive, "frames", time);
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
      contacts_(variables.contacts) {}

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
  for (const Extreme& extreme : extremes_) columns.push_back({extreme.name(), extreme.unit()});
  for (const ReactionComponent& reaction : reactions_) columns.push_back({reaction.name, "N"});
  for (const CrackColumn& column : crack_columns_) columns.push_back({column.name, column.is_speed ? "m/s" : "m"});
  for (const Mean& mean : means_) {
    for (std::string& name : mean.columns()) columns.push_back({std::move(name), mean.unit()});
  }
  for (const ContactComponent& contact : contacts_) columns.push_back({contact.name, "N"});
  file_.emplace(path_, body.domain.communicator, columns, before_, sum_);
}

// Collective.
std::vector<double> History::contact_forces(const contact::Contact& contact, const Domain& domain) const {
  std::vector<double> forces;
  if (contacts_.empty()) return forces;
  for (const ContactComponent& c : contacts_) forces.push_back(contact.force(domain, c.first, c.second)[c.component]);
  domain.communicator.sum(forces);
  return forces;
}

void History::write(const Ledger& now, const Reactions& reactions, const contact::Contact& contact, const Body& body) {
  static Teuchos::Time& timer = phase("History");
  const Timed timed(timer);
  std::vector<double> row{now.time,          now.dt,       now.kinetic,       now.elastic,      now.dissipated,
                          now.stabilization, now.fracture, now.heat,          now.tool_kinetic, now.tools,
                          now.contact,       now.external, now.balance_error, now.momentum[0],  now.momentum[1],
                          now.momentum[2]};
  const std::size_t fixed = row.size();
  for (const Extreme& e : extremes_) row.push_back(e.local(body));
  for (const CrackTip& crack : cracks_) row.push_back(crack.local(body));
  body.domain.communicator.max(std::span(row).subspan(fixed));
  for (std::size_t k = 0; k < extremes_.size(); ++k) row[fixed + k] = extremes_[k].value(row[fixed + k]);
  const std::size_t tips = fixed + extremes_.size();
  for (std::size_t k = 0; k < cracks_.size(); ++k) cracks_[k].take(now.time, row[tips + k]);
  row.resize(tips);
  for (const ReactionComponent& reaction : reactions_) row.push_back(reaction.of(reactions));
  for (const CrackColumn& column : crack_columns_) row.push_back(column.of(cracks_[column.crack]));
  for (const Mean& mean : means_) {
    for (const double value : mean.values(body)) row.push_back(value);
  }
  for (const double force : contact_forces(contact, body.domain)) row.push_back(force);
  file_->write(row);
  schedule.done(now.time);
  last_ = now.time;
}

void History::serialize(Archive& archive, double time) {
  if (file_) {
    file_->sync();
    before_ = file_->bytes(), sum_ = file_->sum();
  }
  archive.number("history_bytes", before_);
  archive.number("history_sum", sum_);
  archive.number("last_line", last_);
  schedule.serialize(archive, "history", time);
  for (CrackTip& crack : cracks_) crack.serialize(archive);
}

bool is_over(const deck::Deck& deck, const Communicator& communicator) {
  double over = 0;
  if (communicator.rank() == 0 && deck.output.enabled) {
    const std::optional<double> last = io::last_time_of_result(deck.output.file);
    over = last && *last >= deck.solver.final_time ? 1 : 0;
  }
  return communicator.max(over) > 0;
}

}  // namespace strut
