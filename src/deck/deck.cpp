#include "deck/deck.hpp"

#include <algorithm>
#include <fstream>
#include <map>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/math/table_files.hpp"
#include "base/numbers.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "base/text.hpp"
#include "deck/check.hpp"
#include "deck/peridigm/peridigm.hpp"
#include "deck/sections/combinations.hpp"
#include "deck/sections/materials.hpp"
#include "deck/sections/node_sets.hpp"
#include "deck/sections/several_sections.hpp"
#include "deck/yaml.hpp"
#include "materials/user_law.hpp"

namespace strut::deck {

namespace {

namespace fs = std::filesystem;

// Notes intervals longer than the run, or than the explicit steps of Solver 2: equilibria often last a thousand times
// as long.
void tell_of_long_intervals(const Deck& deck, Problems& problems) {
  const double duration = deck.next_solver ? deck.next_solver->duration() : deck.solver.duration();
  const auto tell = [&](const std::string& path, const auto& sink) {
    if (sink.parts > 0 || !sink.interval || *sink.interval < duration) return;
    if (deck.next_solver) {
      problems.note(path, "is " + to_text(*sink.interval) + " s, also in Solver 2, which lasts " + to_text(duration) +
                              " s: of its steps only the last one is written");
    } else if (*sink.interval > (1 + 1e-9) * duration) {
      problems.note(path, "is " + to_text(*sink.interval) + " s, and the run lasts " + to_text(duration) +
                              " s: only its start and its end are written");
    }
  };
  tell("Output > Output Interval", deck.output);
  tell("History > Interval", deck.history);
}

void tell_of_wall_time(const Deck& deck, Problems& problems) {
  if (!deck.solver.wall_time) return;
  problems.note("Solver > Wall Time", "ends a run of two solvers without a checkpoint: it can only begin anew");
}

Deck build(const Values& values, const fs::path& file, Problems& problems) {
  Deck deck;
  deck.file = file;
  deck.discretization = read_discretization(values, file, problems);
  deck.node_sets = read_node_sets(values, problems);
  deck.materials = read_materials(values, problems);
  deck.damage_models = read_damage_models(values, problems);
  deck.blocks = read_blocks(values, deck.materials, deck.damage_models, problems);
  deck.contact_models = read_contact_models(values);
  deck.interactions = read_interactions(values, deck.contact_models, problems);
  deck.conditions = read_conditions(values, problems);
  check_initial_strains(deck.conditions, deck.materials, problems);
  add_numbered_sets(values, file, deck.node_sets, problems);
  deck.start_from = read_start_from(values);
  deck.solver = read_solver(values, problems);
  check_temperatures(deck.materials, deck.conditions, deck.start_from.has_value(), problems);
  deck.next_solver = read_next_solver(values, deck.solver, problems);
  const bool steps_follow = deck.next_solver.has_value();
  check_quasi_static(deck.solver, deck.conditions, deck.contact_models, deck.materials, deck.blocks, deck.damage_models,
                     steps_follow, problems);
  deck.output = read_output(values, deck.solver, problems);
  deck.history = read_history(values, deck.solver, problems);
  tell_of_long_intervals(deck, problems);
  if (steps_follow) tell_of_wall_time(deck, problems);
  add_probes(values, deck.node_sets);
  deck.restart = read_restart(values, file, deck.output.enabled, problems);
  if (steps_follow && deck.restart.asked_for && deck.restart.enabled) {
    problems.add("Restart", "beside 'Solver 2'; expected none: a run of two solvers writes no checkpoints");
  }
  if (steps_follow) deck.restart.enabled = false;
  deck.watch = read_watch(values);
  return deck;
}

// ---- Files of a deck ------------------------------------------------------------------------------------------------

// A file with its path in the deck and its owner.
struct WrittenFile {
  std::string path, owner;
  fs::path file;
  FileKind kind;
};

struct ReadFile {
  std::string what;
  fs::path file;
};

// The paths of the keys that name each file.
using Users = std::map<std::string, std::vector<std::string>>;

void find_users(const List& list, const std::string& path, Users& users) {
  for (const Parameter& parameter : list.parameters) {
    for (const std::string& name : table_files(parameter.value)) users[name].push_back(path_to(path, parameter.name));
  }
  for (const List& section : list.lists) find_users(section, path_to(path, section.name), users);
}

// The reason why the file cannot be written, in view of the other written files; or nothing.
std::string problem_of(const WrittenFile& written, const std::vector<ReadFile>& read) {
  for (const ReadFile& one : read) {
    if (!same_file(written.file, one.file)) continue;
    return "'" + written.file.string() + "' is " + one.what + "; expected a file that may be replaced";
  }
  return obstacle(written.file, written.kind);
}

// Puts the numbers of the files that tables of `list`, which `text` was parsed to, name into the text: other ranks,
// checkpoints and comparisons of decks then need no file. Returns the files, found from `folder`.
std::vector<fs::path> fill_tables(std::string& text, const List& list, const fs::path& folder, Problems& problems) {
  Users users;
  find_users(list, "", users);
  std::vector<fs::path> files;
  for (const auto& [name, paths] : users) {
    files.push_back(folder / name);
    std::string numbers = "0, 0";  // after a problem: what else is wrong can be told
    try {
      numbers = numbers_in_table(files.back());
    } catch (const Error& error) {
      for (const std::string& path : paths) problems.add(path, error.what());
    }
    text = with_table(text, name, numbers);
  }
  return files;
}

// A run must not write a file that it reads, or write one file twice, under any name or link.
void check_files(const std::vector<WrittenFile>& written, const std::vector<ReadFile>& read, Problems& problems) {
  std::string reported;  // the path with the last reported problem: one for each is enough
  for (const WrittenFile& one : written) {
    const std::string problem = one.path == reported ? "" : problem_of(one, read);
    if (problem.empty()) continue;
    problems.add(one.path, problem);
    reported = one.path;
  }
  for (auto one = written.begin(); one != written.end(); ++one) {
    for (auto other = written.begin(); other != one; ++other) {
      if (!same_file(one->file, other->file)) continue;
      problems.add(one->path, "'" + one->file.string() + "' is " + other->owner + "'s file, too; expected another");
    }
  }
}

std::vector<WrittenFile> written_files(const Deck& deck) {
  std::vector<WrittenFile> written;
  if (deck.output.enabled) {
    written.push_back({"Output > Output Filename", "Output", deck.output.file, FileKind::result});
  }
  if (deck.history.has_file())
    written.push_back({"History > Filename", "History", deck.history.file, FileKind::history});
  if (!deck.restart.enabled) return written;
  const fs::path& checkpoint = deck.restart.file;
  for (const auto& [file, kind] : {std::pair(checkpoint, FileKind::unchecked),
                                   {before_of(checkpoint), FileKind::unchecked},
                                   {part_of(checkpoint), FileKind::checkpoint},
                                   {lock_of(checkpoint), FileKind::lock}}) {
    written.push_back({"Restart > Filename", "Restart", file, kind});
  }
  return written;
}

std::vector<ReadFile> read_files(const Deck& deck, const std::vector<fs::path>& tables) {
  std::vector<ReadFile> read{{"the input mesh", deck.discretization.mesh}, {"this deck", deck.file}};
  for (const fs::path& shells : deck.discretization.shells) read.push_back({"a mesh of Bond Filters", shells});
  for (const fs::path& table : tables) read.push_back({"a table of this deck", table});
  for (const NodeSet& set : deck.node_sets) {
    if (!set.file.empty()) read.push_back({"the file of node set '" + set.name + "'", set.file});
  }
  if (deck.start_from) read.push_back({"the checkpoint of Start From", deck.start_from->checkpoint});
  return read;
}

// In the longest steps that the run may take. The length of explicit ones is known once there are points
// (run/report.hpp: check_libraries); equilibria have their load steps.
void check_stiffness(const Deck& deck, Problems& problems) {
  const Solver& solver = deck.next_solver ? *deck.next_solver : deck.solver;
  const double duration = solver.duration();
  if (!(duration > 0)) return;
  for (const Material& material : deck.materials) {
    const auto* law = std::get_if<materials::UserLaw>(&material.law);
    const std::string where = "Materials > " + material.name + " > Library";
    if (!law || problems.about(where)) continue;
    const std::string file = "'" + law->function.file + "' ";
    if (!solver.quasi_static) {
      const std::string stiff = materials::too_stiff_in(*law, solver.fixed_dt.value_or(duration));
      if (!stiff.empty()) problems.add(where, file + stiff);
    } else {
      const std::string stiff = materials::stiffer_in(*law, duration / std::max(solver.quasi_static->load_steps, 1));
      if (!stiff.empty()) problems.note(where, file + stiff + ": stabilization and contact will be softer");
    }
  }
}

// Files are checked on one rank only: other ranks may not see them, and need not.
void check_read_files(Deck& deck, const std::vector<fs::path>& tables, Problems& problems) {
  check_mesh(deck.discretization.mesh, problems);
  for (const fs::path& shells : deck.discretization.shells) {
    if (fs::is_regular_file(shells)) continue;
    problems.add("Discretization > Bond Filters",
                 "'" + shells.string() +
                     "' is not a file that can be read; expected a mesh of shells, its "
                     "path relative to the deck's folder");
  }
  read_numbers(deck.node_sets, problems);
  load_user_libraries(deck.materials, deck.file.parent_path(), problems);
  check_stiffness(deck, problems);
  check_files(written_files(deck), read_files(deck, tables), problems);
}

// A deck of another program gets one error that says where to look, instead of an error for each line.
void refuse_cabanapds(const std::string& text, const fs::path& file, Problems& problems) {
  if (text.find("\"num_cells\"") == std::string::npos) return;
  problems.add("num_cells", "this is an input of CabanaPD, whose words inputs/from-cabanapd.md translates");
  problems.raise(file.string());
}
void refuse_perilabs(List& deck, const fs::path& file, Problems& problems) {
  const bool is_perilabs = find_list(deck, "Outputs") && (find_list(deck, "Models") || find_list(deck, "Physics"));
  if (!is_perilabs) return;
  problems.add("Models, Outputs",
               "this is a deck of PeriLab, whose words inputs/from-perilab.md translates; its lists of points and sets "
               "can be read as they are");
  problems.raise(file.string());
}

// A script in Python hands over a mesh and takes the rows of the history: a deck that runs without one needs files.
void check_runs_alone(const Deck& deck, Problems& problems) {
  if (deck.discretization.type == MeshType::memory) {
    problems.add(
        "Discretization > Type",
        "'Memory' is the mesh of a script in Python, and there is none; expected Exodus, Text File or PdQuickGrid");
  }
  if (deck.history.enabled && !deck.history.has_file() && !problems.about("History > Filename"))
    problems.add("History > Filename", "missing; expected a text (type string)");
}

enum class FileCheck { no, yes };

Deck parse(std::string text, const fs::path& file, FileCheck file_check, Problems& problems) {
  refuse_cabanapds(text, file, problems);
  auto list = parse_xml_or_yaml(text, problems);
  if (!list) problems.raise(file.string());
  std::vector<fs::path> tables;
  if (file_check == FileCheck::yes) {
    tables = fill_tables(text, *list, file.parent_path(), problems);
    if (!tables.empty()) list = parse_xml_or_yaml(text, problems);
  }
  refuse_perilabs(*list, file, problems);
  const bool from_peridigm = translate_peridigm(*list, file.parent_path(), problems);
  report_duplicates(*list, "", problems);
  const Values values = check(*list, schema(), "", problems);
  Deck deck = build(values, file, problems);
  deck.text = std::move(text);
  deck.from_peridigm = from_peridigm;
  if (file_check == FileCheck::yes) check_read_files(deck, tables, problems);
  deck.notes = problems.notes();
  return deck;
}

// Libraries are loaded by each rank: those of rank 0 are loaded with its files.
void load_libraries_of_ranks(Deck& deck, const Communicator& communicator) {
  Problems mine;
  if (communicator.rank() != 0) load_user_libraries(deck.materials, deck.file.parent_path(), mine);
  raise_together(communicator, mine.text(deck.file.string()));
}

constexpr std::uintmax_t largest_deck = 1'000'000;  // bytes; a long deck has twenty thousand

std::string contents(const fs::path& file) {
  std::ifstream stream;
  if (fs::is_regular_file(file)) stream.open(file, std::ios::binary);  // opening a pipe would block
  if (!fs::exists(file)) throw Error(file.string() + ": the deck does not exist");
  if (!fs::is_regular_file(file) || !stream) throw Error(file.string() + ": the deck is not a file that can be read");
  if (fs::file_size(file) > largest_deck) {
    throw Error(file.string() + ": the deck has " + std::to_string(fs::file_size(file)) + " bytes, expected at most " +
                std::to_string(largest_deck));
  }
  return std::string(without_mark(text_of(stream.rdbuf())));
}

}  // namespace

const Section& schema() {
  static const std::string one_solver =
      "unknown section; at most two solvers follow each other, equilibria and explicit steps: 'Solver', 'Solver 2'";
  static const Section whole = {
      .meaning = "",
      .keys = {verbose_without_effect()},
      .sections = {discretization_section(), node_sets_section(), materials_section(), damage_models_section(),
                   blocks_section(), contact_section(), conditions_section(), start_from_section(), solver_section(),
                   next_solver_section(), output_section(), history_section(), restart_section(), watch_section()},
      .hints = {{"Interfaces", "unknown section; there are no interfaces between elements"},
                {"Problem",
                 "unknown section; this is the oldest layout of Peridigm's decks: its sections belong to the "
                 "deck itself"},
                {"Solver 3", one_solver}}};
  return whole;
}

Deck read_text(std::string text, const fs::path& file, const Communicator& communicator, Problems& problems) {
  Deck deck;
  run_on_root(communicator, [&] {
    deck = parse(text, file, FileCheck::yes, problems);
    text = deck.text;
  });
  communicator.broadcast(text);
  if (communicator.rank() != 0) deck = parse(text, file, FileCheck::no, problems);
  load_libraries_of_ranks(deck, communicator);
  for (const std::string& line : broadcast_names(problems.lines(), communicator)) problems.add(line);
  for (NodeSet& set : deck.node_sets) {
    if (!set.file.empty()) communicator.broadcast(*set.numbers);
  }
  return deck;
}

Deck read(const fs::path& file, const Communicator& communicator, Problems& problems) {
  std::string text;
  run_on_root(communicator, [&] { text = contents(file); });
  Deck deck = read_text(std::move(text), file, communicator, problems);
  check_runs_alone(deck, problems);
  return deck;
}

Deck read(const fs::path& file, const Communicator& communicator) {
  Problems problems;
  Deck deck = read(file, communicator, problems);
  problems.raise(file.string());
  return deck;
}

}  // namespace strut::deck
