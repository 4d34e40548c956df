#include "worker.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "base/errors.hpp"
#include "files.hpp"
#include "mutate.hpp"
#include "sanitizers.hpp"
#include "subjects.hpp"

namespace strut::fuzz {

namespace {

namespace fs = std::filesystem;

constexpr rlim_t memory = rlim_t{1} << 30;  // bytes, beyond what the process has at the start

// Under the address sanitizer, which reserves terabytes, ASAN_OPTIONS set the limit (tests/fuzz/long).
void limit_memory() {
  if (sanitized) return;
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  const rlim_t most = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + memory;
  const rlimit limit = {most, most};
  setrlimit(RLIMIT_AS, &limit);
}

// A file of that size is as wrong as that much memory.
void limit_files() {
  const rlimit none = {0, 0}, limit = {100 << 20, 100 << 20};
  setrlimit(RLIMIT_FSIZE, &limit);
  setrlimit(RLIMIT_CORE, &none);
}

void set_timer(double seconds) {
  itimerval timer = {};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>((seconds - static_cast<double>(timer.it_value.tv_sec)) * 1e6);
  setitimer(ITIMER_PROF, &timer, nullptr);
}

void silence() {
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  if (!sanitized) dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

std::size_t open_files() {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd")) count += !entry.path().empty();
  return count;
}

// An Error that carries the text of an exception of the library is none of ours: nobody can act on it.
bool is_ours(const std::string& text) {
  static const char* const foreign[] = {
      "std::", "_M_", "basic_string", "vector::", "map::", "stod", "stoi", "bad_alloc", "Throw number", "Assertion"};
  for (const char* const one : foreign) {
    if (text.find(one) != std::string::npos) return false;
  }
  return text.size() > 5;
}

class Worker {
 public:
  Worker(const Options& options, const fs::path& folder, Word& word)
      : options_(options), word_(word), folder_(folder), subjects_(all_subjects(folder, world_)) {
    if (!options.subject.empty())
      std::erase_if(subjects_, [&](const Subject& one) { return one.name != options.subject; });
    if (subjects_.empty()) throw Error("there is no subject '" + options.subject + "'");
  }

  // Without a change they must be read; a deck may miss points in a set of its own, as its mesh is another one.
  void check_samples() {
    for (const Subject& subject : subjects_) {
      std::size_t read = 0;
      for (const std::string& sample : subject.samples) read += try_one(subject, sample) == done && accepted_;
      if (2 * read < subject.samples.size()) end(broken_sample, subject.name + ": most samples are refused: " + said_);
    }
    word_.accepted = 0;
    word_.ready = true;
  }

  void try_number(std::uint64_t number) {
    word_.input = number;
    Random random(options_.seed, number);
    const Subject& subject = random.pick(subjects_);
    const std::string sample = random.pick(subject.samples);
    settle(subject, try_one(subject, subject.change(sample, random.pick(subject.samples), random)));
    if (options_.leaks_of_each && has_leaked()) end(leaked, "memory leaked");
  }

  void try_file() { settle(subjects_.front(), try_one(subjects_.front(), contents(options_.file))); }

  [[noreturn]] void end(Exit code, const std::string& problem) {
    problem.copy(word_.problem, sizeof word_.problem - 1);
    std::cerr << std::flush;
    _exit(code);
  }

 private:
  void settle(const Subject& subject, Exit outcome) {
    if (outcome != done) end(outcome, subject.name + ": " + said_);
    word_.accepted = word_.accepted + accepted_;
    if (!options_.file.empty()) std::fprintf(stderr, "%s\n", accepted_ ? "accepted" : said_.c_str());
  }

  Exit try_one(const Subject& subject, const std::string& bytes) {
    const fs::path file = folder_ / subject.file;
    std::snprintf(word_.subject, sizeof word_.subject, "%s", subject.name.c_str());
    std::snprintf(word_.file, sizeof word_.file, "%s", file.c_str());
    write(file, bytes);
    const std::size_t open = open_files();
    set_timer(options_.seconds);
    const Exit outcome = outcome_of(subject, file);
    set_timer(0);
    // Exodus itself leaves open what it finds to be no Exodus file.
    const bool not_opened = !accepted_ && said_.find("cannot open it") != std::string::npos;
    if (open_files() <= open + (not_opened ? 1 : 0)) return outcome;
    said_ = "a file is left open";
    return leaked;
  }

  Exit outcome_of(const Subject& subject, const fs::path& file) {
    accepted_ = false;
    try {
      subject.read(file);
      accepted_ = true;
      return done;
    } catch (const Error& error) {
      said_ = error.what();
      return is_ours(said_) ? done : wrong_error;
    } catch (const std::exception& error) {
      said_ = std::string("not an Error of ours: ") + error.what();
      return wrong_error;
    }
  }

  const Options& options_;
  Word& word_;
  fs::path folder_;
  Communicator world_;
  std::vector<Subject> subjects_;
  std::string said_;
  bool accepted_ = false;
};

// Never finalised: the process ends with its work.
Runtime* volatile started = nullptr;

}  // namespace

void work(const Options& options, const fs::path& folder, std::uint64_t first, std::uint64_t last, Word& word) {
  static char name[] = "fuzz_inputs";
  static char* names[] = {name, nullptr};
  int count = 1;
  char** words = names;
  ask_for_leaks(false);
  started = new Runtime(count, words);
  ask_for_leaks(true);
  silence();
  signal(SIGXFSZ, SIG_IGN);
  signal(SIGPROF, [](int) { _exit(too_slow); });
  static auto* const worker = new Worker(options, folder, word);
  limit_memory();
  limit_files();
  worker->check_samples();
  if (!options.file.empty()) worker->try_file();
  if (options.file.empty()) {
    for (std::uint64_t number = first; number < last; ++number) worker->try_number(number);
  }
  if (has_leaked()) worker->end(leaked, "memory leaked by one of the inputs from " + std::to_string(first));
  _exit(done);
}

}  // namespace strut::fuzz
