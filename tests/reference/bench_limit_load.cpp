// The limit load of a clamped and guided square strut, by all schemes.
//   build/release/tests/reference/bench_limit_load [points across]
// Prints F/(2 M_p/L) at deflections in units of that at which an elastic beam would carry this force, σ_y L²/(2 E a).
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/errors.hpp"
#include "limit_load.hpp"

namespace strut::reference {
namespace {

constexpr int furthest = 10, steps = 20;

void print_curve(const Scheme& scheme, PointsAt at, int across) {
  std::printf("| %s | %ss | %d ", scheme.name, word(at), across);
  try {
    bend_to_limit(scheme, at, across, furthest, steps, [shown = 0](double deflection, double force, double) mutable {
      if (deflection < shown + 1 - 1e-9) return;
      ++shown;
      std::printf("| %.3f ", force);
      std::fflush(stdout);
    });
    std::printf("|\n");
  } catch (const Error& error) {
    std::printf("| %s |\n", error.what());
  }
}

void print_curves(int across) {
  std::printf("Force over 2 M_p/L at deflections over σ_y L²/(2 E a)\n\n| scheme | points at | across ");
  for (int d = 1; d <= furthest; ++d) std::printf("| %d ", d);
  std::printf("|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Scheme& scheme : schemes) {
    for (const PointsAt at : {PointsAt::elements, PointsAt::nodes}) print_curve(scheme, at, across);
  }
}

}  // namespace
}  // namespace strut::reference

int main(int argc, char** argv) {
  strut::Runtime runtime(argc, argv);
  strut::reference::print_curves(argc > 1 ? std::atoi(argv[1]) : 4);
}
