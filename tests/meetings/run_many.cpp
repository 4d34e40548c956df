// Many small runs by one process (or by the ranks of one mpirun), since most of the time of a small run is that of
// MPI's start: 0.4 s for some milliseconds. Reads a run a line: its folder, and the words that strut would get in it,
//   /tmp/scene --threads 2 deck.xml
// runs it there and answers with its exit status. Its output goes to the file `log` in the folder. Before the deck
// there may be `--break 4 WORD`: the run gets a SIGTERM as it prints WORD for the fourth time, which is the same step
// each time.
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/launch.hpp"
#include "base/parallel/threads.hpp"
#include "run/simulation.hpp"

namespace {

// Keeps what is said, and raises SIGTERM where that has been told for the last time.
class Listener : public std::streambuf {
 public:
  void end_at(int count, std::string word) { count_ = count, word_ = std::move(word); }
  const std::string& said() const { return said_; }

 protected:
  int overflow(int character) override {
    if (character == traits_type::eof()) return traits_type::not_eof(character);
    said_ += static_cast<char>(character);
    if (count_ > 0 && said_.ends_with(word_) && --count_ == 0) std::raise(SIGTERM);
    return character;
  }

 private:
  int count_ = 0;
  std::string word_, said_;
};

// std::cout and std::cerr are its own while it lives.
class Heard {
 public:
  explicit Heard(Listener& listener) : out_(std::cout.rdbuf(&listener)), errors_(std::cerr.rdbuf(&listener)) {}
  Heard(const Heard&) = delete;
  ~Heard() {
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(errors_);
  }

 private:
  std::streambuf *out_, *errors_;
};

int act(std::vector<std::string> words, const strut::Communicator& world, Listener& listener) {
  int threads = 1;
  strut::Start start = strut::Start::anew;
  bool check = false;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (words[i] == "--threads") threads = std::stoi(words[i + 1]);
    if (words[i] == "--break" && world.rank() == 0) listener.end_at(std::stoi(words[i + 1]), words[i + 2]);
    if (words[i] == "--continue") start = strut::Start::continued;
    if (words[i] == "--check") check = true;
  }
  strut::raise_together(world, strut::set_threads(threads));
  if (check) return strut::check(words.back(), world), 0;
  return strut::run(words.back(), world, start) ? 0 : 3;
}

int reported(const std::vector<std::string>& words, const strut::Communicator& world, Listener& listener) {
  const Heard heard(listener);
  try {
    return act(words, world, listener);
  } catch (const strut::Error& error) {
    if (world.rank() == 0) std::cerr << "strut: " << error.what() << "\n";
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  strut::Runtime runtime(argc, argv);
  const strut::Communicator world;
  for (;;) {
    std::string line;
    if (world.rank() == 0 && !std::getline(std::cin, line)) line.clear();
    world.broadcast(line);
    if (line.empty()) return 0;
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    std::filesystem::current_path(words[0]);
    Listener listener;
    int status = 0;
    try {
      status = reported({words.begin() + 1, words.end()}, world, listener);
    } catch (const std::exception& error) {  // strut itself aborts here
      std::fprintf(stderr, "rank %d: %s\n", world.rank(), error.what());
      world.abort();
    }
    const std::string file = world.rank() == 0 ? "log" : "log." + std::to_string(world.rank());
    std::ofstream(file) << listener.said();
    world.barrier();
    if (world.rank() == 0) std::printf("%d\n", status), std::fflush(stdout);
  }
}
