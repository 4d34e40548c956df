#include "run/input.hpp"

#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/portions.hpp"
#include "checkpoint/checkpoint.hpp"
#include "io/file_lock.hpp"
#include "output/variables.hpp"
#include "setup/setup.hpp"

namespace strut {

namespace {

// On rank 0, whose disk it is. Of files that are found wrong by their names in the deck nothing more is said.
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
  if (deck.history.enabled) attempt("History > Filename", [&] { io::check_not_held(deck.history.file); });
  if (!deck.restart.enabled) return;
  attempt("Restart > Filename", [&] { io::check_not_held(lock_of(deck.restart.file)); });
}

}  // namespace

void check_new_run(const deck::Deck& deck, const Communicator& communicator, deck::Problems& problems) {
  if (deck.restart.enabled && communicator.rank() == 0) {
    const std::string why = obstacle(deck.restart.file, FileKind::checkpoint);
    if (!why.empty()) problems.add("Restart > Filename", why);
  }
  if (!deck.restart.resumes || !checkpoint_exists(deck, communicator)) return;
  problems.add("Restart > Restart", "'true' asks to go on from a checkpoint, and there is one, " +
                                        deck.restart.file.string() + ": expected 'strut --continue " +
                                        deck.file.string() + "', or 'false' to begin anew and replace it");
}

PointCloud checked_mesh(const deck::Deck& deck, deck::Problems problems, const Communicator& communicator) {
  if (communicator.rank() == 0) check_files(deck, problems);
  for (const std::string& line : broadcast_names(problems.lines(), communicator)) problems.add(line);
  PointCloud cloud = mesh_of(deck, communicator, problems);
  check_output_variables(deck, cloud, communicator, problems);
  raise_together(communicator, problems.text(deck.file.string()));
  return cloud;
}

}  // namespace strut
