// strut: correspondence peridynamics of foams and bars under impact.
//   mpirun -np 2 strut deck.xml           run a deck
//   strut --check deck.xml                validate it and say what the run would do
//   strut --keys                          the reference page of all keys (Markdown)
// Exit status: 0 done, 1 error, 2 wrong use, 3 ended early by a signal.
#include <iostream>
#include <string>
#include <vector>

#include "base/communicator.hpp"
#include "base/errors.hpp"
#include "deck/deck.hpp"
#include "simulation.hpp"

namespace {

constexpr const char* usage = "usage: strut [--check] deck.xml | strut --keys\n";

int act(const std::vector<std::string>& words, const strut::Communicator& world) {
  if (words == std::vector<std::string>{"--keys"}) {
    if (world.rank() == 0) std::cout << strut::deck::reference_page();
    return 0;
  }
  if (words.size() == 2 && words[0] == "--check") {
    strut::check(words[1], world);
    return 0;
  }
  if (words.size() == 1 && words[0].rfind("--", 0) != 0) return strut::run(words[0], world) ? 0 : 3;
  if (world.rank() == 0) std::cerr << usage;
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  strut::Runtime runtime(argc, argv);
  const strut::Communicator world;
  try {
    return act({argv + 1, argv + argc}, world);
  } catch (const strut::Error& error) {  // raised on all ranks: rank 0 speaks for them
    if (world.rank() == 0) std::cerr << "strut: " << error.what() << "\n";
    return 1;
  } catch (const std::exception& error) {  // this rank alone: the others would wait for it
    std::cerr << "strut: rank " << world.rank() << ": " << error.what() << "\n";
    world.abort();
  }
}
