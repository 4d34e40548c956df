// The limit load of a clamped and guided square strut: one end is held, the other moves across without turning, of an
// ideally plastic metal. Plastic hinges at both ends carry F = 2 M_p/L, M_p = σ_y a³/4.
//   build/release/tests/reference/bench_limit_load [points across]
// Prints F/(2 M_p/L) at deflections in units of that at which an elastic beam would carry this force, σ_y L²/(2 E a).
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "../verification/loading.hpp"
#include "base/errors.hpp"
#include "schemes.hpp"
#include "thin_members.hpp"

namespace strut::reference {
namespace {

// Yield so early that the strut neither stretches nor leans: at the last deflection its stretch is 2 % of that at
// yield.
constexpr double E = 1, sigma_y = 3e-5;               // Pa
constexpr int length = 8;                             // m, from one held layer of points to the other; a = 1 m
constexpr double limit = 2 * (sigma_y / 4) / length;  // N
constexpr double elastic_limit = sigma_y * length * length / (2 * E);  // m
constexpr int steps = 20;
constexpr double furthest = 10;  // elastic limits

materials::AnyLaw ideally_plastic() {
  const auto moduli = std::get<materials::Elastic>(elastic(E, 0.3));
  return materials::J2{moduli.bulk, moduli.shear, {sigma_y, materials::NoHardening{}, {}}};
}

// Points at elements stand half a spacing inside of the ends: one element more brings the layers apart by the length.
PointCloud strut_points(int across, PointsAt at) {
  return square_prism(across, length * across + (at == PointsAt::elements ? 1 : 0), at);
}

std::vector<int> end_layer(const Body& body, double end) {
  return points_where(body, [&](const Vector& X) { return std::abs(X[2] - end) < 1e-6; });
}

// The condition 0 is the one that pushes.
Conditions clamped_and_guided(const Body& body) {
  Conditions conditions;
  const std::vector<int> foot = end_layer(body, -0.5 * length), top = end_layer(body, 0.5 * length);
  const auto move = [&](const std::vector<int>& points, int component, double end, int condition) {
    conditions.motions.push_back({points, component, Function::parse(ramp(end)), false, condition});
  };
  move(top, 0, furthest * elastic_limit, 0);
  move(top, 1, 0, 1), move(top, 2, 0, 2);
  for (int c = 0; c < 3; ++c) move(foot, c, 0, 3 + c);
  return conditions;
}

void print_curve(const Scheme& scheme, PointsAt at, int across) {
  std::printf("| %s | %ss | %d ", scheme.name, word(at), across);
  const Communicator world;
  Body body = body_by(scheme, strut_points(across, at), ideally_plastic(), world);
  QuasiStatic solver(body, clamped_and_guided(body), {}, {.load_steps = steps}, 0, 1, nobody());
  try {
    for (double shown = 0; solver.time() < 1;) {
      solver.advance();
      const double deflection = furthest * solver.time();
      if (deflection < shown + 1 - 1e-9) continue;
      shown = std::floor(deflection + 1e-9);
      std::printf("| %.3f ", solver.reactions(6).forces[0][0] / limit);
      std::fflush(stdout);
    }
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
