// How fast errors fall: F of smooth fields in space, inside and at a face; places in time.
#include <gtest/gtest.h>

#include "verification/larger.hpp"
#include "verification/probes.hpp"

namespace strut {
namespace {

constexpr double h = 0.1;

LatticeSpec spec_of(double horizon) {
  return {{7, 7, 7}, h, horizon, 0, Influence::one, {1000, elastic(1e9, 0.3), MeanGradientStabilization{0.01}}};
}

// F_xx − 1 under x → x + field(x), of the points whose x-layer is `layer`, less the exact slope there; the same for
// all.
double slope_error(double horizon, int layer, const std::function<double(double)>& field, double exact_slope) {
  const Communicator world;
  Body body = lattice_body(spec_of(horizon), world);
  deform(body, [&](const Vector& X) -> Vector { return X + Vector(field(X[0]), 0, 0); });
  EXPECT_FALSE(advance_stress_and_force(body, 1e-6, false).failure);
  const double x = (layer + 0.5) * h;
  double least = 1e9, most = -1e9;
  for (int i = 0; i < body.owned(); ++i) {
    if (std::abs(body.domain.reference(i)[0] - x) > 0.1 * h) continue;
    const double error = body.points[i].deformation_gradient(0, 0) - 1 - exact_slope;
    least = std::min(least, error);
    most = larger(most, error);
  }
  least = world.min(least);
  most = world.max(most);
  EXPECT_LT(most - least, 1e-14);  // edges and corners of the layer, too: ξ_x and the other parts are independent
  return most;
}

// Families of less than two spacings have ξ_x = 0, ±h alone: of a x² nothing is missed inside, a h at a face; of a x³
// a h² (Σ ξ_x⁴ / Σ ξ_x² = h²).
TEST(Order, GradientsOfQuadraticAndCubicFields) {
  for (const double horizon : {1.5, 1.75}) {
    const double a = 0.02, inside = 3.5 * h, face = 0.5 * h;
    const auto quadratic = [=](double x) { return a * x * x; };
    EXPECT_NEAR(slope_error(horizon, 3, quadratic, 2 * a * inside), 0, 1e-14);
    EXPECT_NEAR(slope_error(horizon, 0, quadratic, 2 * a * face), a * h, 1e-14);
    const auto cubic = [=](double x) { return a * x * x * x; };
    EXPECT_NEAR(slope_error(horizon, 3, cubic, 3 * a * inside * inside), a * h * h, 1e-14);
  }
}

// Places of a vibrating block after a given time.
std::vector<Vector> places_after(double time, int steps) {
  const Communicator world;
  Body body = lattice_body(spec_of(1.75), world);
  for (int i = 0; i < body.owned(); ++i) {
    const Vector x = body.domain.reference(i) / (7 * h) * M_PI;
    body.velocity[i] = 1e-2 * Vector(std::cos(x[0]), 0.5 * std::cos(x[2]), -0.4 * std::cos(x[1]));
  }
  CentralDifference solver(body, {}, {}, {time / steps, 0}, 0);
  for (int n = 0; n < steps; ++n) {
    solver.advance_velocity(1e9);
    solver.advance_position(false);
  }
  std::vector<Vector> places;
  for (int i = 0; i < body.owned(); ++i) places.push_back(body.current(i));
  return places;
}

// Half the step, a quarter of the error: smooth motion, four steps a period of the fastest mode and more.
TEST(Order, TimeIsOfSecondOrder) {
  const double time = 5e-4;
  const auto exact = places_after(time, 640);
  const auto error = [&](int steps) {
    const auto places = places_after(time, steps);
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i) sum += (places[i] - exact[i]).squaredNorm();
    return std::sqrt(Communicator().sum(sum));
  };
  const double order = std::log2(error(20) / error(40));
  EXPECT_NEAR(order, 2, 0.1);  // the next term is (Δt ω)² smaller; the reference has 1/256 of the coarse error
}

}  // namespace
}  // namespace strut
