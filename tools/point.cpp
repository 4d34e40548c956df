// strut-point: drives one material point of a deck along a path; prints time, strain, stress and state as CSV.
//   strut-point deck.xml --material copper --uniaxial-stress 1e3 0.2
//   strut-point deck.xml --uniaxial-strain 1e5 -0.05 --steps 200
//   strut-point deck.xml --path stress path.csv --steps 50
// A path is linear between its rows; --steps divides each interval (default 1; for a uniaxial path 1000).
// Stress is the unrotated Cauchy stress, strain is logarithmic; components xx yy zz xy yz zx, shear as tensor
// components. Exit status: 0, or 1 with one error message if the request is wrong or the law does not converge.
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <variant>
#include <vector>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "deck/deck.hpp"
#include "point/request.hpp"
#include "point_driver.hpp"

namespace {

using namespace strut;
using namespace strut::point;

const materials::AnyLaw& law_of(const deck::Deck& deck, const std::string& material) {
  if (material.empty() && deck.materials.size() == 1) return deck.materials.front().law;
  std::vector<std::string> names;
  for (const auto& candidate : deck.materials) {
    if (candidate.name == material) return candidate.law;
    names.push_back(candidate.name);
  }
  const std::string there = deck.file.string() + " has the materials " + joined(names);
  if (material.empty()) throw Error(there + "; choose one with --material");
  throw Error("--material '" + material + "'" + did_you_mean(material, names) + ": " + there);
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
  char text[160];
  std::snprintf(text, sizeof text,
                "no step found after t = %.6g s, towards row %zu: the law does not converge, or does not carry the "
                "prescribed stress",
                time, row);
  return text;
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
  std::visit([&](const auto& law) { follow(request.path, law); }, law_of(deck, request.material));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Request request = parse({argv + 1, argv + argc});
    Runtime runtime(argc, argv);
    drive(request);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "strut-point: %s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
