#include "run/start_from.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/text.hpp"
#include "mechanics/energies.hpp"
#include "mechanics/serialize.hpp"
#include "run/input.hpp"
#include "setup/conditions.hpp"
#include "setup/setup.hpp"

namespace strut {

namespace {

const std::string key = "Start From > Checkpoint";

// Times are sums over up to millions of steps.
constexpr double round_off = 1e-9;

bool has_initial_velocity(const deck::Deck& deck) {
  return std::ranges::any_of(
      deck.conditions, [](const deck::Condition& one) { return std::holds_alternative<InitialVelocity>(one.kind); });
}

// True for data that a checkpoint may lack: a body that could not break or soften is whole, one that was not heated has
// not expanded, equilibria have no velocities, and new contact begins anew.
bool may_be_missing(const std::string& name) {
  constexpr std::array of_points = {
      "thermal_strain",  "expansion_pull", "expansion_work",  "reference_temperature", "damage",
      "fracture_energy", "released",       "breaks",          "averaged_indicator",    "tensor_state",
      "scalar_state",    "gradient_state", "quadratic_state", "velocity_now"};
  if (name.starts_with("contact_") || name == "penetration" || name == "searches") return true;
  if (name.ends_with("_reach")) return true;  // a tool that was not there
  for (const std::string_view state : materials::Brittle::state_names) {
    if (name.ends_with(" > " + std::string(state))) return true;
  }
  return std::ranges::any_of(of_points, [&](const char* one) { return name == std::string("all points > ") + one; });
}

void check_missing(const std::filesystem::path& file, const std::vector<std::string>& missing,
                   const Communicator& communicator) {
  std::vector<std::string> needed = missing;
  std::erase_if(needed, may_be_missing);
  raise_together(communicator, needed.empty() ? ""
                                              : key + ": " + file.string() + " does not hold what this deck's bodies " +
                                                    "need: " + joined(needed));
}

// The stretch of periodic sides is that of the checkpoint, or all images would jump.
std::string other_stretch(const deck::Deck& deck, const std::vector<Period>& periods, const Snapshot& found) {
  const double t = deck.solver.initial_time;
  for (const Period& period : periods) {
    const double there = found.numbers.at(std::string("stretch_") + "xyz"[period.axis]),
                 here = stretch_at(periods, t)[period.axis];
    if (std::abs(there - here) <= round_off) continue;
    return text_of(std::setprecision(12), "Boundary Conditions > ", deck.conditions[period.number].name,
                   " > Stretch: is ", here, " at the initial time, t = ", t, " s; expected ", there,
                   ", as the checkpoint has it");
  }
  return "";
}

void refuse_displacements(const deck::Deck& deck, deck::Problems& problems) {
  for (const deck::Condition& one : deck.conditions) {
    if (!std::holds_alternative<InitialDisplacement>(one.kind)) continue;
    problems.add("Boundary Conditions > " + one.name + " > Type",
                 "'Initial Displacement' has no meaning beside Start From, whose points begin where the other run left "
                 "them; expected another condition, or all conditions of that run");
  }
}

}  // namespace

std::optional<StartState> start_state_of(const deck::Deck& deck, const Communicator& communicator,
                                         deck::Problems& problems) {
  if (!deck.start_from || !problems.empty()) return std::nullopt;
  return std::optional<StartState>(std::in_place, deck, communicator, problems);
}

StartState::StartState(const deck::Deck& deck, const Communicator& communicator, deck::Problems& problems)
    : facts_{.file = deck.start_from->checkpoint}, communicator_(communicator) {
  try {
    facts_ = io::facts_of_checkpoint(facts_.file, communicator);
  } catch (const Error& error) {
    std::string why = error.what();
    run_on_root(communicator, [&] {
      if (std::filesystem::exists(facts_.file) && is_of_kind(facts_.file, FileKind::result)) {
        why = facts_.file.string() +
              " is a result: its frames do not hold the state of the laws; expected the checkpoint of its last frame, "
              "which its run has kept (the deck's name with the suffix .restart)";
      }
    });
    communicator.broadcast(why);
    problems.add(key, why);
    return;
  }
  changes_ = deck::start_changes(facts_.deck, deck.text);
  if (!changes_.same_conditions) refuse_displacements(deck, problems);
  for (const std::string& one : changes_.refused)
    problems.add(one + "; expected the bodies of " + facts_.file.string() + " (" + key + ")");
  spare_files(deck, problems);
  keeps_velocities_ = deck.start_from->keeps_velocities.value_or(!changes_.after_equilibria);
}

bool StartState::steps_go_on(const deck::Deck& deck) const {
  const double now = deck.solver.initial_time;
  const bool same_time = std::abs(now - facts_.time) <= round_off * std::abs(facts_.time);
  const bool with_velocities =
      changes_.after_equilibria || (keeps_velocities_ && (changes_.same_conditions || !has_initial_velocity(deck)));
  return same_time && changes_.same_solver && changes_.same_contact && with_velocities &&
         changes_.after_equilibria == deck.solver.quasi_static.has_value();
}

// Sets of the mesh, and those of files of numbers, may hold other points although the decks are alike.
void StartState::compare_sets(const deck::Deck& deck, const Body& body) {
  const double here = mark_of_sets(body, names_of_probes(deck));
  Snapshot found{.numbers = {{mark_of_sets_name, here}}};
  const auto all = [](const std::string&) { return true; };
  check_missing(facts_.file, io::read_checkpoint_parts(facts_, communicator_, all, found), communicator_);
  other_sets_ = changes_.same_conditions && found.numbers.at(mark_of_sets_name) != here;
  if (!other_sets_) return;
  changes_.same_conditions = false;
  deck::Problems problems;
  refuse_displacements(deck, problems);
  raise_together(communicator_, problems.text(deck.file.string()));
}

// A deck made from that of the other run names its files, too, which are in the folder of its checkpoint.
void StartState::spare_files(const deck::Deck& deck, deck::Problems& problems) const {
  const auto spare = [&](const std::string& key_of_file, const std::filesystem::path& mine) {
    std::string why;
    run_on_root(communicator_, [&] {
      for (const std::filesystem::path& file : changes_.files) {
        std::error_code ignored;
        if (!std::filesystem::equivalent(facts_.file.parent_path() / file, mine, ignored)) continue;
        why = "'" + mine.string() + "' is of the run that " + facts_.file.string() +
              " comes from, and would be replaced; expected another name";
      }
    });
    communicator_.broadcast(why);
    if (!why.empty()) problems.add(key_of_file, why);
  };
  if (deck.output.enabled) spare("Output > Output Filename", deck.output.file);
  if (deck.history.has_file()) spare("History > Filename", deck.history.file);
  if (deck.restart.enabled) spare("Restart > Filename", deck.restart.file);
}

std::string StartState::restore(const deck::Deck& deck, Scene& scene) {
  Body& body = scene.body;
  compare_sets(deck, body);
  goes_on_ = steps_go_on(deck);
  keep_expansion(facts_.has_expanded, body);
  const contact::Kinematics kinematics{body.domain, body.velocity, body.density};
  UserLibraries libraries(deck, communicator_);
  std::vector<Vector> velocities(body.owned(), Vector::Zero());  // at the time of the checkpoint
  const auto pass = [&](Archive archive) {
    libraries.serialize(archive);
    serialize(archive, body);  // the node sets are those of this deck
    archive.field("velocity_now", 3, [&](std::size_t i, int c) -> double& { return velocities[i][c]; });
    if (changes_.same_conditions && goes_on_) {
      serialize_tools(archive, scene.conditions, body.owned());  // advice is of where they are
    } else if (changes_.same_conditions) {
      serialize_reaches(archive, scene.conditions);
    }
    if (scene.fracture) scene.fracture->serialize(archive, body);
    if (!goes_on_ && changes_.same_contact) scene.contact.serialize(archive, kinematics, 0);
  };
  Snapshot snapshot;
  pass(Archive::saving_to(snapshot));
  const auto all = [](const std::string&) { return true; };
  const std::vector<std::string> missing = io::read_checkpoint_parts(facts_, communicator_, all, snapshot);
  check_missing(facts_.file, missing, communicator_);
  raise_together(communicator_, other_stretch(deck, body.domain.periods, snapshot));
  pass(Archive::loading_from(snapshot));
  if (!keeps_velocities_) {
    std::ranges::fill(body.velocity, Vector::Zero());
  } else if (!goes_on_ && !changes_.after_equilibria) {
    std::ranges::copy(velocities, body.velocity.begin());
  }
  if (!goes_on_) body.previous_velocity = *body.velocity;
  const auto knows_reaches = [&](int tool) {
    const std::string name = "all points > tool_" + std::to_string(tool) + "_reach";
    return changes_.same_conditions && std::ranges::find(missing, name) == missing.end();
  };
  begin_from_here(deck, {goes_on_, changes_.same_conditions, keeps_all_velocities()}, knows_reaches, scene,
                  communicator_);
  const bool jumps = keeps_velocities_ && !changes_.after_equilibria && !changes_.masses.empty();
  const std::string other_laws = libraries.changed();
  return (facts_.note.empty() ? "" : "WARNING: " + facts_.note + "\n") +
         (other_laws.empty() ? "" : "WARNING: " + other_laws + " (" + facts_.file.string() + ")\n") +
         (jumps ? "WARNING: " + changes_.masses + ": momentum and kinetic energy are not those of the checkpoint\n"
                : "") +
         story(deck, scene);
}

std::string StartState::story(const deck::Deck& deck, const Scene& scene) const {
  const Energies stored = stored_energies(scene.body);
  const bool replaced = has_initial_velocity(deck) && !keeps_all_velocities();
  std::ostringstream text;
  text << "starts from " << facts_.file.string()
       << ", t = " << text_of(std::setprecision(17), facts_.time)  // to go on, Initial Time must be the same
       << " s there, after " << (changes_.after_equilibria ? "equilibria" : "explicit steps") << ": "
       << (goes_on_                               ? "goes on with its steps"
           : deck.solver.quasi_static.has_value() ? "without velocities"
           : keeps_velocities_                    ? "with its velocities"
                                                  : "at rest")
       << (replaced ? ", but for the points of an Initial Velocity" : "") << "; " << stored.elastic << " J stored and "
       << stored.dissipated + stored.fracture << " J dissipated before are given, work counts from here";
  if (other_sets_) text << "; node sets hold other points than there";
  if (!goes_on_ || !changes_.same_conditions) {
    text << "; loads" << (scene.tools.empty() ? "" : ", rigid tools") << " begin anew";
    if (deck.solver.quasi_static)
      text << "; forces of former loads and tools fade in the first load step, and their work counts as that of "
              "conditions (External_Work)";
  }
  if (scene.contact.any() && !changes_.same_contact) text << "; contact begins anew, without friction";
  return text.str() + "\n";
}

// Steps and work count from here; conditions that are not the same have no past.
bool StartState::takes_of_steps(const std::string& name) const {
  constexpr std::array counted = {"put_in",         "work_has_begun", "half_step",     "external_work",
                                  "tool_work",      "contact_work",   "work_of_tools", "work_of_friction",
                                  "lost_in_jumps",  "largest_energy", "most_substeps", "updates",
                                  "breaks_in_steps"};
  if (name == "steps" || std::ranges::any_of(counted, [&](const char* one) { return name.starts_with(one); }))
    return false;
  if (changes_.same_conditions) return true;
  const std::string column = name.substr(name.find(" > ") == std::string::npos ? 0 : name.find(" > ") + 3);
  return !name.starts_with("tool ") && !column.starts_with("tool_") && !column.starts_with("impulse_") &&
         !column.starts_with("last_") && !column.starts_with("load_");
}

std::string StartState::overlaps(const contact::Contact& contact, const Body& body) const {
  constexpr double worth_telling = 0.01;  // of the energy that is there
  if (changes_.same_contact || !contact.any()) return "";
  double kinetic = 0;
  for (int i = 0; i < body.owned(); ++i) kinetic += 0.5 * body.mass(i) * body.velocity[i].squaredNorm();
  const Communicator& communicator = body.domain.communicator;
  const double there = communicator.sum(kinetic) + stored_energies(body).elastic;
  const double by_contact = communicator.sum(contact.energy());
  if (!(by_contact > worth_telling * there)) return "";
  return text_of("WARNING: contact begins here between bodies that are inside each other, and stores ", by_contact,
                 " J at once, beside ", there,
                 " J that are there: it throws them apart; expected this contact in the other run, too\n");
}

template <class Solver>
void StartState::take_steps(Solver& solver, void (Solver::*serialize)(Archive&)) {
  Snapshot snapshot;
  Archive asks = Archive::saving_to(snapshot);
  (solver.*serialize)(asks);
  const auto takes = [this](const std::string& name) { return takes_of_steps(name); };
  check_missing(facts_.file, io::read_checkpoint_parts(facts_, communicator_, takes, snapshot), communicator_);
  Archive restores = Archive::loading_from(snapshot);
  (solver.*serialize)(restores);
}

void StartState::go_on(CentralDifference& solver) { take_steps(solver, &CentralDifference::serialize_steps); }

void StartState::begin(QuasiStatic& solver) {
  if (goes_on_) take_steps(solver, &QuasiStatic::serialize_search);
  solver.begin_strained(goes_on_ && changes_.same_conditions);  // loads and tools of the other run are unknown
}

}  // namespace strut
