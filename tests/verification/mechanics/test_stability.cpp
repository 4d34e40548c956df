// Tries to break the scheme, and prints what comes of it as a table:
//   build/release/tests/verification/test_stability | grep '^|'
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "verification/larger.hpp"
#include "verification/probes.hpp"

namespace strut {
namespace {

constexpr double young = 110e9, density = 8960, h = 1e-3;
constexpr double coefficient = 0.01;  // the deck's default

BlockMaterial metal(double stabilization, double modulus = young, double poisson = 0.3) {
  return {density, elastic(modulus, poisson), MeanGradientStabilization{stabilization}};
}

void row(const std::string& what, const std::string& outcome) {
  std::printf("| %s | %s |\n", what.c_str(), outcome.c_str());
}

std::string text(const char* format, auto... values) {
  char line[200];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

// A body of a cloud on rank 0.
Body body_of(const PointCloud& cloud, const BlockBonds& bonds, const std::vector<BlockMaterial>& materials) {
  const Communicator world;
  const std::vector<BlockBonds> of_blocks(materials.size(), bonds);
  return make_body(make_domain(partitioned(cloud, world), of_blocks, world), Influence::one, materials);
}

// Both sides of the limit: noise stays bounded over a thousand steps at 0.99 of it, and grows at 1.05.
void expect_limit(const std::string& what, const std::function<Body()>& body) {
  const bool below = stays_bounded(body(), 0.99), above = stays_bounded(body(), 1.05);
  row(what,
      text("%s at 0.99 of the limit, %s at 1.05", below ? "bounded" : "NOT BOUNDED", above ? "BOUNDED" : "unstable"));
  EXPECT_TRUE(below);
  EXPECT_FALSE(above);
}

// ---- Patterns that F does not see ----------------------------------------------------------------------------------

// e · Kv/(e · v) deep in the lattice for v = ± direction, alternating along the axes of `pattern`; 1/s².
double resistance(double horizon, double stabilization, const Eigen::Array3i& pattern) {
  const Communicator world;
  const LatticeSpec spec{{17, 17, 17}, h, horizon, 0, Influence::one, metal(stabilization)};
  Body body = lattice_body(spec, world);
  const auto sign = [&](int i) {
    const Eigen::Array3i cell = (body.domain.reference(i) / h).array().floor().cast<int>();
    return (cell * pattern).sum() % 2 == 0 ? 1.0 : -1.0;
  };
  const Vector direction = Vector(1, 0.5, -0.3).normalized();
  const std::vector<Vector> result = operator_on(body, [&](int i) -> Vector { return sign(i) * direction; });
  return largest_over(body, [&](int i) {
    const bool middle = is_deep(spec, body.domain.reference(i), 8);
    return middle ? std::abs(sign(i) * direction.dot(result[i])) : 0.0;
  });
}

TEST(Stability, PatternsAreResisted) {
  for (const double horizon : {1.5, 2.015, 2.515}) {
    for (const Eigen::Array3i& pattern : {Eigen::Array3i(1, 1, 1), {1, 1, 0}, {1, 0, 0}}) {
      const double plain = resistance(horizon, 0, pattern), held = resistance(horizon, coefficient, pattern);
      const double scale = young / density / (h * h);
      row(text("pattern (%d %d %d), horizon %g", pattern[0], pattern[1], pattern[2], horizon),
          text("resistance in units of E/(ρ h²): %.1e, %.1e without stabilization", held / scale, plain / scale));
      EXPECT_GT(held, 10 * plain);
      EXPECT_GT(held, 1e-3 * scale);
    }
  }
}

// The remaining part of random displacements: their mean over 2000 steps (root mean squares, less the shift of the
// whole body). Resisted ones swing about zero, others stay.
double left_of_noise(double stabilization) {
  constexpr int steps = 2000;
  const Communicator world;
  const LatticeSpec spec{{9, 9, 9}, h, 2.015, 0, Influence::one, metal(stabilization)};
  Body body = lattice_body(spec, world), at_rest = lattice_body(spec, world);
  const double limit = CentralDifference(at_rest, {}, {}, {0, 1}, 0).critical_time_step();
  throw_apart(body, 1e-4 * h);
  for (int i = 0; i < body.owned(); ++i) {
    body.domain.sites[i].current.head<3>() += body.velocity[i].array();
    body.velocity[i].setZero();
  }
  advance_stress_and_force(body, 1e-9, false);  // stress comes from motion, so the points have been moved there
  const auto spread = [&](const std::vector<Vector>& displacements) {
    const double n = static_cast<double>(body.owned());
    Vector shift = Vector::Zero();
    double square = 0;
    for (const Vector& u : displacements) shift += u / n, square += u.squaredNorm() / n;
    return std::sqrt(square - shift.squaredNorm());
  };
  std::vector<Vector> first(body.owned()), mean(body.owned(), Vector::Zero());
  for (int i = 0; i < body.owned(); ++i) first[i] = body.displacement(i);
  CentralDifference solver(body, {}, {}, {0.8 * limit, 0}, 0);
  for (int n = 0; n < steps; ++n) {
    solver.advance_velocity(1e9);
    solver.advance_position(false);
    for (int i = 0; i < body.owned(); ++i) mean[i] += body.displacement(i) / steps;
  }
  return spread(mean) / spread(first);
}

// Only few of all patterns are those that F does not see: noise is resisted without stabilization too.
TEST(Stability, RandomNoiseIsResisted) {
  const double held = left_of_noise(coefficient), plain = left_of_noise(0);
  row("random displacements",
      text("%.1e of them left in the mean over 2000 steps, %.1e without stabilization", held, plain));
  EXPECT_LT(held, 0.05);  // the turn of the whole body stays: √(3/2187) = 0.037 on average
}

// ---- Clouds and materials ------------------------------------------------------------------------------------------

TEST(Stability, LimitOnPerturbedLattices) {
  const Communicator world;
  for (const double shift : {0.1, 0.2, 0.3}) {
    const LatticeSpec spec{{7, 7, 7}, h, 2.015, shift, Influence::one, metal(coefficient)};
    expect_limit(text("points moved by up to %.0f %% of a spacing", 100 * shift),
                 [&] { return lattice_body(spec, world); });
  }
}

TEST(Stability, LimitByHorizon) {
  const Communicator world;
  for (const double horizon : {1.5, 1.75, 3.015, 4.015}) {
    const LatticeSpec spec{{9, 9, 9}, h, horizon, 0, Influence::one, metal(coefficient)};
    expect_limit(text("horizon of %g spacings", horizon), [&] { return lattice_body(spec, world); });
  }
}

// Layers along z that grow by a tenth each, with horizons that follow.
TEST(Stability, LimitOnGradedVolumes) {
  const Communicator world;
  PointCloud cloud;
  cloud.block_names = {"block"};
  double low = 0, width = h;
  for (int k = 0; world.rank() == 0 && k < 10; ++k, low += width, width *= 1.1) {
    const int n = static_cast<int>(8 * h / width);
    for (int cell = 0; cell < n * n; ++cell) {
      const Vector at(8 * h / n * (cell % n + 0.5), 8 * h / n * (cell / n + 0.5), low + width / 2);
      const double volume = std::pow(8 * h / n, 2) * width;
      add_point(cloud, static_cast<std::int64_t>(cloud.size()), at, volume, std::cbrt(volume));
    }
  }
  expect_limit("volumes graded 1 : 13",
               [&] { return body_of(cloud, BlockBonds::per_spacing(2.015), {metal(coefficient)}); });
}

TEST(Stability, LimitNearlyIncompressible) {
  const Communicator world;
  const LatticeSpec spec{{7, 7, 7}, h, 2.015, 0, Influence::one, metal(coefficient, young, 0.4999)};
  expect_limit("Poisson's ratio 0.4999", [&] { return lattice_body(spec, world); });
}

TEST(Stability, LimitAcrossAJumpOfStiffness) {
  const Communicator world;
  PointCloud cloud = lattice_cloud({{8, 6, 6}, h, 2.015, 0, Influence::one, {}}, world);
  cloud.block_names = {"soft", "stiff"};
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.blocks[i] = cloud.positions[i][0] > 4 * h ? 1 : 0;
  expect_limit("blocks bonded to others a thousand times as stiff", [&] {
    return body_of(cloud, 2.015 * h, {metal(coefficient), metal(coefficient, 1000 * young)});
  });
}

// ---- Loads ---------------------------------------------------------------------------------------------------------

// 10 % compression in a hundred steps: every point is at the flow stress of its rate.
TEST(Stability, StrainRatesOfSevenDecades) {
  const Communicator world;
  const auto moduli = std::get<materials::Elastic>(elastic(young, 0.3));
  const materials::FlowStress flow{50e6, materials::PowerHardening{0.00218, 0.1}, materials::PowerRate{1e-3, 0.01}};
  const materials::J2 law{moduli.bulk, moduli.shear, flow};
  for (const double rate : {1.0, 1e3, 1e7}) {
    Body body = lattice_body(
        {{5, 5, 5}, h, 2.015, 0, Influence::one, {density, law, MeanGradientStabilization{coefficient}}}, world);
    const double dt = 1e-3 / rate;
    for (int n = 1; n <= 100; ++n) {
      const double stretch = std::exp(-1e-3 * n), across = 1 / std::sqrt(stretch);
      deform(body, [&](const Vector& X) -> Vector { return Vector(across, across, stretch).cwiseProduct(X); });
      ASSERT_FALSE(advance_stress_and_force(body, dt, false).failure);
    }
    const double expected = flow(0.1, rate).stress;
    const double off = largest_over(body, [&](int i) {
      const Symmetric s = deviator(body.points[i].stress);
      return std::abs(std::sqrt(1.5 * double_dot(s, s)) / expected - 1);
    });
    row(text("strain rate %g /s, to 10 %%", rate), text("von Mises stress off by %.1e", off));
    EXPECT_LT(off, 1e-3);  // the elastic part of the strain, σ/E ≈ 1e-3, is not plastic: h'/h of it in the stress
  }
}

TEST(Stability, TwentyTurnsLeaveNoStress) {
  const Communicator world;
  Body body = lattice_body({{5, 5, 5}, h, 2.015, 0.2, Influence::one, metal(coefficient)}, world);
  const int steps = 2000;
  for (int n = 1; n <= steps; ++n) {
    const Tensor Q = Eigen::AngleAxisd(20 * 2 * M_PI * n / steps, Vector(1, 2, 3).normalized()).toRotationMatrix();
    deform(body, [&](const Vector& X) -> Vector { return Q * X; });
    advance_stress_and_force(body, 1e-6, false);
  }
  const double stress = largest_over(body, [&](int i) { return body.points[i].stress.norm(); }) / young;
  row("20 turns in 2000 steps", text("stress %.1e E", stress));
  EXPECT_LT(stress, 2000 * 1e-15 * 10);  // round-off of each step's strain, added up
}

TEST(Stability, TwoHundredThousandStepsKeepTheEnergy) {
  const Communicator world;
  Body body = lattice_body({{4, 4, 4}, h, 1.75, 0, Influence::one, metal(coefficient)}, world);
  const double limit = CentralDifference(body, {}, {}, {0, 1}, 0).critical_time_step();
  throw_apart(body, 1e-3);
  CentralDifference solver(body, {}, {}, {0.9 * limit, 0}, 0);
  double drift = 0;
  for (int n = 0; n < 200000; ++n) {
    solver.advance_velocity(1e9);
    if (n % 20000 == 0) drift = larger(drift, solver.ledger().balance_error);
    solver.advance_position((n + 1) % 20000 == 0);
  }
  row("200,000 steps of free vibration at 0.9 of the limit", text("energy off by %.1e", drift));
  EXPECT_LT(drift, 1e-5);
}

// ---- Warnings and errors -------------------------------------------------------------------------------------------

TEST(Stability, APointTurnedInsideOutIsNamed) {
  const Communicator world;
  Body body = lattice_body({{5, 5, 5}, h, 2.015, 0, Influence::one, metal(coefficient)}, world);
  deform(body, [&](const Vector& X) -> Vector { return {X[0], X[1], X[2] > 2 * h ? 4 * h - X[2] : X[2]}; });
  const StepReport report = advance_stress_and_force(body, 1e-6, false);
  const std::string said = report.failure ? describe(*report.failure, body) : "";
  row("det F ≤ 0", said.empty() ? "NOTHING SAID" : said.substr(0, said.find(". Likely")));
  EXPECT_NE(said.find("element"), std::string::npos);
  EXPECT_NE(said.find("reference position"), std::string::npos);
}

TEST(Stability, APointWithoutNeighborsIsNamed) {
  const char* said = degeneracy(0, Tensor::Zero());
  ASSERT_TRUE(said);
  row("a point with no neighbors", text("refused: %s", said));
}

}  // namespace
}  // namespace strut
