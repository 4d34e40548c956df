// strut-point: drives one material point of a deck along a path; prints time, strain, stress and state as CSV.
//   strut-point deck.xml --material copper --uniaxial-stress 1e3 0.2
//   strut-point deck.xml --uniaxial-strain 1e5 -0.05 --steps 200
//   strut-point deck.xml --path stress path.csv --steps 50
// The point starts at the Initial Temperature of the material's blocks.
// A path is linear between its rows; --steps divides each interval (default 1; for a uniaxial path 1000).
// Stress is the unrotated Cauchy stress, strain is logarithmic; components xx yy zz xy yz zx, shear as tensor
// components. Exit status: 0, or 1 with one error message if the request is wrong or the law does not converge.
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "base/errors.hpp"
#include "base/numbers.hpp"
#include "base/parallel/communicator.hpp"
#include "base/text.hpp"
#include "deck/deck.hpp"
#include "point/path.hpp"
#include "point_driver.hpp"

namespace {

using namespace strut;
using namespace strut::point;

// ---- the command line

struct Request {
  std::filesystem::path deck;
  std::string material;  // empty: the only one
  Path path;
};

const char* const usage =
    "usage: strut-point DECK.xml [--material NAME] PATH [--steps N]\n"
    "PATH is one of --uniaxial-strain RATE FINAL, --uniaxial-stress RATE FINAL, --path strain FILE.csv, "
    "--path stress FILE.csv";

constexpr int uniaxial_steps = 1000;

double number_of(const std::string& option, const std::string& word) {
  const auto number = to_finite(word);
  if (!number) throw Error(option + ": '" + word + "' is not a number");
  return *number;
}

// Takes the next word of the command line, which an option needs.
using Take = std::function<const std::string&(const std::string& what)>;

Path uniaxial_path(const std::string& option, const Take& take) {
  const double rate = number_of(option, take("a rate (1/s) and a final strain"));
  const double final = number_of(option, take("a final strain after the rate"));
  if (!(rate > 0)) throw Error(option + ": expected a rate > 0 (1/s); compression is a negative final strain");
  if (final == 0) throw Error(option + ": the final strain is 0, expected another (negative: compression)");
  Path path = uniaxial(option == "--uniaxial-stress" ? lateral_stress : all_strain, rate, final);
  path.steps = uniaxial_steps;
  return path;
}

Path path_from_file(const std::string& option, const Take& take) {
  const std::string kind = take("strain or stress, and a file");
  if (kind != "strain" && kind != "stress") {
    throw Error(option + ": '" + kind + "', expected strain or stress" + did_you_mean(kind, {"strain", "stress"}));
  }
  return read_path(take("a file after " + kind), kind == "stress" ? all_stress : all_strain);
}

int steps_of(const std::string& option, const Take& take) {
  const double steps = number_of(option, take("a number of steps"));
  if (!(steps >= 1 && steps <= 1e9 && steps == std::floor(steps))) {
    throw Error(option + ": expected a whole number from 1");
  }
  return static_cast<int>(steps);
}

// Throws Error with a description of the problem.
Request parse(const std::vector<std::string>& words) {
  const std::vector<std::string> options{"--material", "--uniaxial-strain", "--uniaxial-stress", "--path", "--steps"};
  Request request;
  std::optional<int> steps;
  const auto set_path = [&](const Path& path) {
    if (!request.path.rows.empty()) throw Error("more than one path is given\n" + std::string(usage));
    request.path = path;
  };
  for (std::size_t next = 0; next < words.size();) {
    const std::string& word = words[next++];
    const Take take = [&](const std::string& what) -> const std::string& {
      if (next == words.size()) throw Error(word + " needs " + what);
      return words[next++];
    };
    if (word == "--material") {
      request.material = take("a name");
    } else if (word == "--uniaxial-strain" || word == "--uniaxial-stress") {
      set_path(uniaxial_path(word, take));
    } else if (word == "--path") {
      set_path(path_from_file(word, take));
    } else if (word == "--steps") {
      steps = steps_of(word, take);
    } else if (word.starts_with("--")) {
      throw Error("unknown option " + word + did_you_mean(word, options));
    } else if (request.deck.empty()) {
      request.deck = word;
    } else {
      throw Error("'" + word + "' is one word too many\n" + usage);
    }
  }
  if (request.deck.empty()) throw Error("no deck is given\n" + std::string(usage));
  if (request.path.rows.empty()) throw Error("no path is given\n" + std::string(usage));
  if (steps) request.path.steps = *steps;
  return request;
}

// ---- the point

const deck::Material& material_of(const deck::Deck& deck, const std::string& material) {
  if (material.empty() && deck.materials.size() == 1) return deck.materials.front();
  std::vector<std::string> names;
  for (const auto& candidate : deck.materials) {
    if (candidate.name == material) return candidate;
    names.push_back(candidate.name);
  }
  const std::string there = deck.file.string() + " has the materials " + joined(names);
  if (material.empty()) throw Error(there + "; choose one with --material");
  throw Error("--material '" + material + "'" + did_you_mean(material, names) + ": " + there);
}

// The initial temperature of the blocks of a material, K; that of a room if no block has the material.
double temperature_of(const deck::Deck& deck, const deck::Material& material) {
  std::optional<double> found;
  bool differ = false;
  std::ostringstream described;
  for (const deck::Block& block : deck.blocks) {
    if (&deck.materials[block.material] != &material) continue;
    const double own = block.initial_temperature.value_or(materials::room_temperature);
    described << (found ? ", " : "") << block.name << " at " << own << " K";
    differ = differ || (found && *found != own);
    found = own;
  }
  if (differ) {
    throw Error(deck.file.string() + ": blocks of the material " + material.name +
                " start at different temperatures (" + described.str() +
                "); expected one Blocks > Initial Temperature");
  }
  return found.value_or(materials::room_temperature);
}

// The law of a material as its blocks start.
materials::AnyLaw law_of(const deck::Deck& deck, const deck::Material& material) {
  materials::AnyLaw law = material.law;
  const auto set_temperature = [&]<class L>(L& one) {
    if constexpr (materials::tells_heat<L>) one.set_initial_temperature(temperature_of(deck, material));
  };
  std::visit(set_temperature, law);
  return law;
}

void print_values(const Symmetric& values) {
  for (const double value : values) std::printf(",%.15g", value);
}

template <materials::Law L>
void print_header() {
  std::printf("Time");
  for (const char* quantity : {"Strain", "Stress"}) {
    for (const char* component : {"xx", "yy", "zz", "xy", "yz", "zx"}) std::printf(",%s_%s", quantity, component);
  }
  std::printf(",Von_Mises_Stress");
  for (const auto name : L::state_names) std::printf(",%s", std::string(name).c_str());
  std::printf("\n");
}

template <materials::Law L>
void print(const Driver<L>& point) {
  std::printf("%.15g", point.time);
  print_values(point.strain);
  print_values(point.stress);
  std::printf(",%.15g", von_mises(point.stress));
  for (const double value : materials::to_columns<L>(point.state)) std::printf(",%.15g", value);
  std::printf("\n");
}

std::string stuck(double time, std::size_t row) {
  return text_of("no step found after t = ", time, " s, towards row ", row,
                 ": the law does not converge, or does not carry the prescribed stress");
}

template <materials::Law L>
void follow(const Path& path, const L& law) {
  Driver<L> point(law);
  point.time = path.rows.front().time;
  print_header<L>();
  print(point);
  for (std::size_t i = 1; i < path.rows.size(); ++i) {
    const Row &from = path.rows[i - 1], &to = path.rows[i];
    const Symmetric change = to.value - from.value;
    for (int step = 1; step <= path.steps; ++step) {
      const Symmetric target = from.value + change * step / path.steps;
      if (!point.advance(change / path.steps, target, path.prescribed, (to.time - from.time) / path.steps)) {
        throw Error(stuck(point.time, i + 1));
      }
      print(point);
    }
  }
}

void drive(const Request& request) {
  const deck::Deck deck = deck::read(request.deck, Communicator());
  const materials::AnyLaw law = law_of(deck, material_of(deck, request.material));
  std::visit([&](const auto& one) { follow(request.path, one); }, law);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words == std::vector<std::string>{"--help"}) return std::puts(usage) < 0;
  try {
    const Request request = parse(words);
    Runtime runtime(argc, argv);
    drive(request);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw Error("cannot write to standard output");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "strut-point: %s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
