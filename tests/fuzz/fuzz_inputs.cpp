// fuzz_inputs [--seed N] [--first N] [--inputs N | --minutes M] [--subject NAME] [--keep FOLDER] [--file FILE]
// Inputs that are nearly right, to every reader: each must be read or refused with an Error, within limits of time and
// memory (README.md). A failure is printed with the command that repeats it; its input is kept.
// Exit status: 0 no failure, 1 failures, 2 wrong use.
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>

#include "worker.hpp"

namespace {

using namespace strut::fuzz;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t batch = 500;  // inputs a process tries
constexpr int most_failures = 20;     // then there is enough to do
constexpr double patience = 120;      // seconds on the wall for one input; the processor's limit is far below

class Fuzzing {
 public:
  explicit Fuzzing(const Options& options) : options_(options) {
    std::string name = (fs::temp_directory_path() / "strut-fuzz-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    folder_ = name;
    void* const shared = mmap(nullptr, sizeof(Word), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    word_ = new (shared) Word{};
  }
  ~Fuzzing() { fs::remove_all(folder_); }
  Fuzzing(const Fuzzing&) = delete;
  Fuzzing& operator=(const Fuzzing&) = delete;

  int run() {
    const auto start = Clock::now();
    const auto minutes = [&] { return std::chrono::duration<double>(Clock::now() - start).count() / 60; };
    const auto over = [&](std::uint64_t next) {
      return options_.minutes > 0 ? minutes() >= options_.minutes : next >= options_.first + options_.inputs;
    };
    for (std::uint64_t next = options_.first; !over(next) && failures_ < most_failures;) {
      const std::uint64_t left = options_.minutes > 0 ? batch : options_.first + options_.inputs - next;
      next = try_batch(next, next + std::min(batch, left), options_);
    }
    std::printf("%llu inputs in %.1f minutes (%.0f a minute), %llu accepted, the others refused: %d failures\n",
                static_cast<unsigned long long>(tried_), minutes(), static_cast<double>(tried_) / minutes(),
                static_cast<unsigned long long>(accepted_), failures_);
    return failures_ > 0 ? 1 : 0;
  }

 private:
  // The first input that is not yet tried.
  std::uint64_t try_batch(std::uint64_t first, std::uint64_t last, const Options& options) {
    const int status = child(first, last, options);
    accepted_ += word_->accepted;
    if (status == done) return tried_ += last - first, last;
    if (status == leaked << 8 && !options.leaks_of_each) return find_leak(first, last);
    tell(status, first);
    if (!word_->ready) std::exit(1);
    tried_ += word_->input + 1 - first;
    return word_->input + 1;
  }

  // Once more, slowly, to see which one it is.
  std::uint64_t find_leak(std::uint64_t first, std::uint64_t last) {
    accepted_ -= word_->accepted;
    Options slow = options_;
    slow.leaks_of_each = true;
    while (first < last && failures_ < most_failures) first = try_batch(first, last, slow);
    return first;
  }

  int child(std::uint64_t first, std::uint64_t last, const Options& options) {
    *word_ = Word{};
    std::fflush(stdout);
    const pid_t id = fork();
    if (id == 0) work(options, folder_, first, last, *word_);
    return wait_for(id);
  }

  // The exit status; a child that stays with one input for too long is killed.
  int wait_for(pid_t id) {
    int status = 0;
    std::uint64_t seen = ~std::uint64_t{0};
    auto since = Clock::now();
    while (waitpid(id, &status, WNOHANG) == 0) {
      usleep(20000);
      if (word_->input != seen) since = Clock::now();
      seen = word_->input;
      if (std::chrono::duration<double>(Clock::now() - since).count() > patience) kill(id, SIGKILL);
    }
    return status;
  }

  void tell(int status, std::uint64_t first) {
    ++failures_;
    static const std::map<int, std::string> reasons = {{wrong_error, "no error of ours"},
                                                       {too_slow, "takes too long"},
                                                       {leaked, "leaks"},
                                                       {broken_sample, "the samples"}};
    const auto known = WIFEXITED(status) ? reasons.find(WEXITSTATUS(status)) : reasons.end();
    const std::string what = known != reasons.end() ? known->second
                             : WIFSIGNALED(status)  ? strsignal(WTERMSIG(status))
                                                    : "ended (a sanitizer's report?)";
    const std::uint64_t input = word_->ready ? word_->input : first;
    std::printf("FAILURE %s, input %llu: %s: %s\n", word_->subject, static_cast<unsigned long long>(input),
                what.c_str(), word_->problem);
    fs::create_directories(options_.keep);
    const fs::path kept = options_.keep / (std::to_string(options_.seed) + "-" + std::to_string(input) + "-" +
                                           fs::path(word_->file).filename().string());
    std::error_code ignored;
    fs::copy_file(word_->file, kept, fs::copy_options::overwrite_existing, ignored);
    std::printf("  again: fuzz_inputs --subject %s --file %s\n", word_->subject, kept.c_str());
  }

  Options options_;
  fs::path folder_;
  Word* word_;
  std::uint64_t tried_ = 0, accepted_ = 0;
  int failures_ = 0;
};

// False where the words are wrong.
bool parse(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; i += 2) {
    if (i + 1 == argc) return false;
    const std::string word = argv[i], value = argv[i + 1];
    if (word == "--seed") {
      options.seed = std::strtoull(value.c_str(), nullptr, 10);
    } else if (word == "--first") {
      options.first = std::strtoull(value.c_str(), nullptr, 10);
    } else if (word == "--inputs") {
      options.inputs = std::strtoull(value.c_str(), nullptr, 10);
    } else if (word == "--minutes") {
      options.minutes = std::strtod(value.c_str(), nullptr);
    } else if (word == "--subject") {
      options.subject = value;
    } else if (word == "--keep") {
      options.keep = value;
    } else if (word == "--file") {
      options.file = value;
      options.inputs = 1;
    } else {
      return false;
    }
  }
  return options.file.empty() || !options.subject.empty();
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) {
    std::fputs(
        "usage: fuzz_inputs [--seed N] [--first N] [--inputs N | --minutes M] [--subject NAME] [--keep FOLDER]\n"
        "       fuzz_inputs --subject NAME --file FILE\n",
        stderr);
    return 2;
  }
  return Fuzzing(options).run();
}
