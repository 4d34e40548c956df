#include "run/input.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "base/text.hpp"
#include "checkpoint/checkpoint.hpp"
#include "io/check_sum.hpp"
#include "io/file_lock.hpp"
#include "materials/user_law.hpp"
#include "output/variables.hpp"
#include "output/writers.hpp"
#include "run/run_control.hpp"
#include "setup/setup.hpp"

namespace strut {

namespace {

// On rank 0, whose disk counts. Files whose names in the deck are wrong get no further message.
void check_files(const deck::Deck& deck, deck::Problems& problems) {
  const auto attempt = [&problems](const std::string& path, const auto& check) {
    if (problems.about(path)) return;
    try {
      check();
    } catch (const Error& error) {
      problems.add(path, error.what());
    }
  };
  if (deck.output.enabled) attempt("Output > Output Filename", [&] { io::check_not_held(deck.output.file); });
  if (deck.history.has_file()) attempt("History > Filename", [&] { io::check_not_held(deck.history.file); });
  if (deck.restart.enabled || deck.next_solver)  // two solvers remove what an earlier run has left
    attempt("Restart > Filename", [&] { io::check_not_held(lock_of(deck.restart.file)); });
  if (!deck.restart.enabled) return;
  std::error_code failure;
  if (std::filesystem::exists(before_of(deck.restart.file), failure))
    return;  // a damaged checkpoint does not prevent resuming
  const std::string why = obstacle(deck.restart.file, FileKind::checkpoint);
  if (!why.empty() && !problems.about("Restart > Filename")) problems.add("Restart > Filename", why);
}

// A run of two solvers that ended early left no checkpoint: in a chain of jobs each one would come no further, and
// would replace the files of the one before.
void check_two_solvers(const deck::Deck& deck, const Communicator& communicator, deck::Problems& problems) {
  if (!deck.next_solver || is_over(deck, communicator)) return;
  const auto is_there = [&](const std::filesystem::path& file) {
    std::error_code failure;
    return communicator.any(communicator.rank() == 0 && std::filesystem::exists(file, failure));
  };
  for (const auto& file :
       {deck.output.enabled ? deck.output.file : "", deck.history.has_file() ? deck.history.file : ""}) {
    if (file.empty() || !is_there(file)) continue;
    problems.add("Solver 2", "a run of two solvers writes no checkpoint: there is none to go on from, and " +
                                 file.string() + " would be replaced; expected 'strut " + deck.file.string() +
                                 "', which begins anew, with time enough for both solvers");
  }
}

}  // namespace

void check_resumption(const deck::Deck& deck, bool is_there, bool begins_anew, deck::Problems& problems) {
  if (!deck.restart.resumes) return;
  const std::string file = deck.restart.file.string(), key = "Restart > Restart";
  if (is_there && begins_anew) {
    problems.add(key, "'true' asks to go on from a checkpoint, and there is one, " + file +
                          ": expected 'strut --continue " + deck.file.string() +
                          "', or 'false' to begin anew and replace it");
  }
  if (is_there || deck.start_from || deck.solver.initial_time == 0) return;
  problems.add(key, text_of("'true' asks to go on from a checkpoint at t = ", deck.solver.initial_time,
                            " s (Solver > Initial Time), but there is none, ", file,
                            ": expected Start From > Checkpoint with that of the first part, or the deck of the first "
                            "part with a later Final Time and 'strut --continue'; or 'false' to begin then with bodies "
                            "that are undeformed"));
}

bool check_checkpoint(const deck::Deck& deck, bool begins_anew, const Communicator& communicator,
                      deck::Problems& problems) {
  const bool is_there = checkpoint_exists(deck, communicator);
  check_resumption(deck, is_there, begins_anew, problems);
  if (!is_there && !begins_anew) check_two_solvers(deck, communicator, problems);
  if (!problems.empty()) return false;
  if (is_there && !begins_anew) return check_changes(deck, communicator);
  if (!is_there && (!begins_anew || deck.restart.resumes))
    say(communicator, "there is no checkpoint " + deck.restart.file.string() + ": the run begins anew\n");
  return false;
}

PointCloud checked_mesh(const deck::Deck& deck, deck::Problems problems, const Communicator& communicator,
                        const io::Mesh* in_memory) {
  if (communicator.rank() == 0) check_files(deck, problems);
  for (const std::string& line : broadcast_names(problems.lines(), communicator)) problems.add(line);
  PointCloud cloud = mesh_of(deck, communicator, problems, in_memory);
  check_output_variables(deck, cloud, communicator, problems);
  raise_together(communicator, problems.text(deck.file.string()));
  return cloud;
}

std::set<std::string> names_of_probes(const deck::Deck& deck) {
  std::set<std::string> names;
  for (const deck::NodeSet& set : deck.node_sets) {
    if (set.nearest && !set.numbers) names.insert(set.name);
  }
  return names;
}

UserLibraries::UserLibraries(const deck::Deck& deck, const Communicator& communicator) {
  for (const deck::Material& material : deck.materials) {
    const auto* law = std::get_if<materials::UserLaw>(&material.law);
    if (!law) continue;
    std::vector<double> mark(1);
    run_on_root(communicator, [&] {
      std::ifstream file(law->function.file, std::ios::binary);
      io::CheckSum sum;
      sum.add(std::string(std::istreambuf_iterator<char>(file), {}));
      mark[0] = sum.value();
    });
    communicator.broadcast(mark);
    all_.push_back({"Materials > " + material.name + " > Library: '" + law->function.file + "'", mark[0], mark[0]});
  }
  std::ranges::sort(all_, {}, &Library::path);
}

void UserLibraries::serialize(Archive& archive) {
  for (std::size_t k = 0; k < all_.size(); ++k) archive.number("user_library_" + std::to_string(k), all_[k].before);
}

std::string UserLibraries::changed() const {
  std::vector<std::string> others;
  for (const Library& one : all_) {
    if (one.before != one.mark) others.push_back(one.path);
  }
  return others.empty() ? "" : joined(others) + " is not the file with which the run began";
}

}  // namespace strut
