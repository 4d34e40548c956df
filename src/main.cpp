// strut: correspondence peridynamics of foams and bars under impact.
// Its options are described in `help`.
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "base/build_facts.hpp"
#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/launch.hpp"
#include "base/parallel/threads.hpp"
#include "deck/deck.hpp"
#include "run/log.hpp"
#include "run/simulation.hpp"

namespace {

constexpr const char* help =
    R"(strut: how foams and bars deform when they are hit, by correspondence peridynamics.

usage: strut [option] deck.xml              on one core
       mpirun -np 8 strut [option] deck.xml  on eight

  deck.xml             run the deck. Paths of results are relative to the working folder; older results are replaced
  --continue deck.xml  resume a run from its last checkpoint (section Restart), on any number of ranks. Without a
                       checkpoint the run starts anew; a complete run is left as it is
  --check deck.xml     print the errors of the deck, or the points, memory, time step and time of the run. Writes no file
  --log FILE           before any other option: copy all terminal output to FILE
  --threads N          before any other option: N threads per rank (default 1), with the same bits. Each thread
                       needs a core: mpirun -np 4 --map-by slot:PE=2 strut --threads 2 deck.xml
  --explain KEY        print the place, type, unit and meaning of a key or section of a deck
  --keys               print all keys of a deck, with units and defaults, as a page of Markdown
  --version            print the version and the build, as all files of strut have them
  --help, -h           print this page

Files: the deck names the mesh (relative to the deck's folder), the result (Exodus II), the history (CSV) and the
checkpoint (relative to the working folder).
strut replaces a file only if strut wrote it and it is of the same kind (result, history, checkpoint, log). strut never
writes a file that the run reads.
Signals: after SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2 or SIGXCPU a run finishes the current step, writes a last frame
and a checkpoint, and ends; the deck's Wall Time does the same. A full disk and the limit of a file's size (ulimit -f)
are errors.
Exit status: 0 complete; 1 error, with a message on standard error; 2 wrong usage; 3 ended by a signal or the wall time.
tools/run passes signals on and returns the same status, and so does mpirun for SIGUSR1. After SIGTERM or SIGINT mpirun
of Open MPI returns 1, and kills ranks that take longer than a second.
)";

// True if standard output is a pipe that nobody reads any more.
bool reader_has_gone() {
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  return poll(&out, 1, 0) > 0 && (out.revents & POLLERR) != 0;
}

// Throws if the output of a command cannot be written. A reader that closes the pipe early, as `head` does, is no
// error.
int printed(const strut::Communicator& world) {
  if (world.rank() == 0 && !(std::cout << std::flush) && !reader_has_gone()) {
    throw strut::Error("standard output cannot be written, or not all of it (a full disk?)");
  }
  return 0;
}

int say(const strut::Communicator& world, const std::string& text) {
  if (world.rank() == 0) std::cout << text;
  return printed(world);
}

int run(const std::string& deck, const strut::Communicator& world, strut::Start start) {
  const strut::Launch launch = strut::launch_of_process();
  const std::string problem = strut::wrong_launcher(launch, world.size(), "strut");
  if (problem.empty()) return strut::run(deck, world, start) ? 0 : 3;
  // The first process prints the error, and its status is the job's: if another failed, the job might be killed before.
  if (launch.number != 0) return 0;
  std::cerr << "strut: " << problem << "\n";
  return 1;
}

std::optional<int> number_of_threads(const std::string& word) {
  const std::optional<int> number = strut::whole_number(word);
  return number >= 1 && number <= strut::most_threads ? number : std::nullopt;  // 0 is not a number of threads
}

// Describes the error in words that are no valid command.
std::string what_is_wrong(const std::vector<std::string>& words) {
  static const std::vector<std::string> options = {"--continue", "--check", "--log",     "--threads",
                                                   "--explain",  "--keys",  "--version", "--help"};
  if (words.empty()) return "no deck is named";
  if (words[0] == "--threads" && words.size() > 1 && !number_of_threads(words[1])) {
    return "'--threads' needs a whole number, 1 to " + std::to_string(strut::most_threads) + ", not '" + words[1] + "'";
  }
  for (const std::string& word : words) {
    const bool known = std::find(options.begin(), options.end(), word) != options.end();
    if (word.starts_with("-") && !known)
      return "there is no option '" + word + "'" + strut::did_you_mean(word, options);
  }
  if (words[0] == "--log" && words.size() < 3) return "'--log' needs a file, and a deck";
  if (words[0] == "--threads" && words.size() < 3) return "'--threads' needs a number, and a deck";
  if (words[0] == "--explain") return "'--explain' needs a key";
  if (words.size() == 1) return "'" + words[0] + "' needs a deck";
  return "'" + strut::joined(words, " ") + "' does not say what to do";
}

int act(const std::vector<std::string>& words, const strut::Communicator& world);

// Prints the error: it is raised on all ranks, and rank 0 prints it.
int reported(const std::vector<std::string>& words, const strut::Communicator& world) {
  try {
    return act(words, world);
  } catch (const strut::Error& error) {
    if (world.rank() == 0) std::cerr << "strut: " << error.what() << "\n";
    return 1;
  }
}

int act(const std::vector<std::string>& words, const strut::Communicator& world) {
  const std::string first = words.empty() ? "" : words[0];
  if (words.size() == 1) {
    if (first == "--help" || first == "-h") return say(world, help);
    if (first == "--version") return say(world, strut::build_facts() + "\n");
    if (first == "--keys") return say(world, strut::deck::reference_page());
    if (!first.starts_with("-")) return run(first, world, strut::Start::anew);
  }
  if (words.size() == 2 && !words[1].starts_with("-")) {
    if (first == "--explain") return say(world, strut::deck::explanation(words[1]));
    if (first == "--continue") return run(words[1], world, strut::Start::continued);
    if (first == "--check") return strut::check(words[1], world), printed(world);
  }
  if (words.size() > 2 && first == "--log" && !words[1].starts_with("-") && words[1] != words.back()) {
    const strut::Log log(words[1], world);
    return reported({words.begin() + 2, words.end()}, world);
  }
  if (words.size() > 2 && first == "--threads" && number_of_threads(words[1])) {
    strut::raise_together(world, strut::set_threads(*number_of_threads(words[1])));
    return act({words.begin() + 2, words.end()}, world);
  }
  if (world.rank() == 0) {
    std::cerr << "strut: " << what_is_wrong(words) << "; expected: strut [--continue | --check] deck.xml\n"
              << "'strut --help' tells more\n";
  }
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  strut::Runtime runtime(argc, argv);
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit fails, and is reported like a full disk
  std::signal(SIGPIPE, SIG_IGN);  // if the reader of the output is gone, the run continues
  const strut::Communicator world;
  try {
    return reported({argv + 1, argv + argc}, world);
  } catch (const std::exception& error) {  // on this rank alone: the others would wait for it
    std::cerr << "strut: rank " << world.rank() << ": " << error.what() << "\n";
    world.abort();
  }
}
