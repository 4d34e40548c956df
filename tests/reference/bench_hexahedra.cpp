// A body of voxels crushed by explicit hexahedra (hexahedra.hpp): its work, and what an element and step costs.
//   build/release/tests/reference/bench_hexahedra HOURGLASS < BODY
// BODY: edge, Young's modulus, Poisson's ratio, density, yield stress, duration; how many nodes, elements, held nodes;
// of each node place and velocity at the start; of each element its nodes, along x first, then y, then z; of each held
// node its number and velocity. All SI. HOURGLASS: the stiffness of hourglass modes over μ; 0: eight points. One line:
// work in J, steps, ns an element and step, core-seconds.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>

#include "base/errors.hpp"
#include "hexahedra.hpp"

namespace strut::reference {
namespace {

template <class Number>
Number next() {
  Number number;
  if (!(std::cin >> number)) throw Error("the body ends early, or holds what is no number");
  return number;
}

Vector next_vector() {
  const auto x = next<double>(), y = next<double>(), z = next<double>();
  return {x, y, z};
}

void crush(double hourglass) {
  Impact impact;
  impact.body.edge = next<double>();
  const auto young = next<double>(), poisson = next<double>(), density = next<double>(), yield = next<double>();
  impact.duration = next<double>();
  const int nodes = next<int>(), elements = next<int>(), held = next<int>();
  for (int n = 0; n < nodes; ++n) {
    impact.body.nodes.push_back(next_vector());
    impact.velocities.push_back(next_vector());
  }
  for (int e = 0; e < elements; ++e) {
    Corners corners;
    for (int& node : corners) node = next<int>();
    impact.body.voxels.push_back(corners);
  }
  for (int h = 0; h < held; ++h) {
    const int node = next<int>();
    impact.held.push_back({node, next_vector()});
  }
  Hexahedra hexahedra(impact, {young, poisson, density, yield}, hourglass);
  const std::clock_t start = std::clock();
  int steps = 0;
  for (double time = 0; time < impact.duration; ++steps) {
    const double dt = hexahedra.step();
    if (dt < 1e-9 * impact.duration) throw Error("an element is inside out");
    time += dt;
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%.10g %d %.1f %.3g\n", hexahedra.work(), steps, 1e9 * seconds / steps / elements, seconds);
}

}  // namespace
}  // namespace strut::reference

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw strut::Error("usage: bench_hexahedra HOURGLASS < BODY");
    strut::reference::crush(std::atof(argv[1]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_hexahedra: %s\n", error.what());
    return 1;
  }
}
