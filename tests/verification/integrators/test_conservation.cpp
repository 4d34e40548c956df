// Conserved quantities: momentum to round-off, energy with the order of the scheme; and the limit of the step.
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "verification/conservation.hpp"
#include "verification/probes.hpp"

namespace strut {
namespace {

BlockMaterial copper(bool plastic) {
  const materials::Elastic e = std::get<materials::Elastic>(elastic(110e9, 0.296));
  if (!plastic) return {8960, e, SillingStabilization{0.02}};
  const materials::FlowStress flow{50e6, materials::PowerHardening{0.00218, 0.1}, materials::PowerRate{1e-3, 0.01}};
  return {8960, materials::J2{e.bulk, e.shear, flow}, MeanGradientStabilization{0.05}};
}

// A free block whose ends fly apart and shear, smoothly.
void throw_apart(Body& body, double speed, double size) {
  for (int i = 0; i < body.owned(); ++i) {
    const Vector x = body.domain.reference(i) / size * M_PI;
    body.velocity[i] = speed * Vector(std::cos(x[0]) + 0.3, 0.5 * std::cos(x[2]), -0.4 * std::cos(x[1]));
  }
}

const double crossing_time = 9e-3 / std::sqrt(110e9 / 8960);  // of a wave through the block, s

Conservation run_free_block(const BlockMaterial& material, double speed, StepControl control, double crossings) {
  const Communicator world;
  LatticeSpec spec{{9, 9, 9}, 1e-3, 2.515, 0.1, Influence::one, material};
  Body body = lattice_body(spec, world);
  throw_apart(body, speed, 9e-3);
  CentralDifference solver(body, {}, {}, control, 0);
  return run_free(solver, crossings * crossing_time);
}

// Central differences at a constant step conserve the energy of a linear body to round-off. Two errors remain: strains
// of 3e-6 make the body linear to 3e-6; the energy of the stabilization is a difference of two sums 1e9 times as large.
TEST(Conservation, ElasticBlockAtConstantStep) {
  const Conservation outcome = run_free_block(copper(false), 0.01, {4e-8, 0}, 200 * 4e-8 / crossing_time);
  EXPECT_LT(outcome.momentum_drift, 1e-12);  // forces are pairs: the round-off of some hundred thousand additions
  EXPECT_LT(outcome.balance_error, 2e-5);
}

// With its own step, which follows the deformation, and strains of 3e-4.
TEST(Conservation, ElasticBlockAtItsOwnStep) {
  const Conservation outcome = run_free_block(copper(false), 1, {0, 0.8}, 10);
  EXPECT_LT(outcome.momentum_drift, 1e-12);
  EXPECT_LT(outcome.balance_error, 1e-3);  // of the order of the strain: a hypoelastic law has no exact energy
}

// The critical time step of a body at rest is the one that it has as it is struck: √(1 + b₁²) − b₁ of that without
// viscosity, where each change would cost energy.
TEST(CriticalTimeStep, HasTheLinearViscosityFromTheStart) {
  constexpr double linear = 0.1;
  const Communicator world;
  const auto step = [&world](double viscosity) {
    BlockMaterial material = copper(false);
    material.viscosity.linear = viscosity;
    Body body = lattice_body({{4, 4, 4}, 1e-3, 1.75, 0, Influence::one, material}, world);
    return CentralDifference(body, {}, {}, {0, 0.8}, 0).critical_time_step();
  };
  EXPECT_NEAR(step(linear) / step(0), std::sqrt(1 + linear * linear) - linear, 1e-12);  // round-off of a root
}

TEST(Conservation, PlasticBlock) {
  const Conservation coarse = run_free_block(copper(true), 50, {0, 0.8, false}, 3),
                     fine = run_free_block(copper(true), 50, {0, 0.4, false}, 3);
  EXPECT_LT(coarse.momentum_drift, 1e-12);
  EXPECT_LT(coarse.balance_error, 1e-2);
  EXPECT_LT(fine.balance_error, 0.7 * coarse.balance_error);  // first order at least, where yielding starts and stops
}

// Free elastic cubes whose own frequencies are not far below the highest. Steps that followed the frequency bound,
// which follows the vibration, doubled the energy of such a cube in 14,000 steps at a fifth of this speed.
struct Cube {
  const char* name;
  BlockMaterial material;
  double speed;  // m/s
};

class FreeCube : public testing::TestWithParam<Cube> {};

TEST_P(FreeCube, KeepsItsEnergyAtItsOwnStep) {
  const Communicator world;
  Body body = lattice_body({{4, 4, 4}, 1e-3, 1.75, 0, Influence::one, GetParam().material}, world);
  for (int i = 0; i < body.owned(); ++i) {
    body.velocity[i] = GetParam().speed * std::sin(1000 * body.domain.reference(i)[0]) * Vector::UnitX();
  }
  CentralDifference solver(body, {}, {}, {}, 0);
  const Conservation outcome = run_free(solver, 1000 * 0.8 * solver.critical_time_step());
  EXPECT_GE(solver.steps(), 1000);
  EXPECT_LT(solver.steps(), 1100);                            // the step falls by some percent, once
  EXPECT_LT(outcome.balance_error, 0.01) << GetParam().name;  // it swings with the strain, which is 0.01
}

const materials::AnyLaw stiff = elastic(117e9, 0.35);

INSTANTIATE_TEST_SUITE_P(
    Of, FreeCube,
    testing::Values(Cube{"mean gradient", {8930, stiff, MeanGradientStabilization{0.01}}, 50},
                    Cube{"Silling", {8930, stiff, SillingStabilization{0.01}}, 50},
                    Cube{"quadratic", {.density = 8930, .law = stiff, .formulation = Formulation::quadratic}, 50},
                    Cube{"ordinary", {.density = 8930, .law = stiff, .formulation = Formulation::ordinary}, 50}),
    [](const auto& info) { return "Case" + std::to_string(info.index); });

// A last step of any length is no loss: the energies at the end are those of steps as long as usual. One error remains:
// the acceleration changes by ω Δt in a step, and an eighth of its square counts, for noise with ω Δt of one.
TEST(Conservation, AShortLastStepCostsNoEnergy) {
  const Communicator world;
  Body body = lattice_body({{7, 7, 7}, 1e-3, 2.015, 0, Influence::one, copper(false)}, world);
  throw_apart(body, 0.01);
  CentralDifference solver(body, {}, {}, {8e-8, 0}, 0);
  EXPECT_LT(run_free(solver, 100.3 * 8e-8).balance_error, 0.01);
}

// At 0.99 of the estimated limit a noisy elastic block stays bounded over a thousand steps; above it, it does not.
TEST(CriticalTimeStep, LimitIsTheLimit) {
  const Communicator world;
  const LatticeSpec spec{{7, 7, 7}, 1e-3, 2.015, 0, Influence::one, copper(false)};
  EXPECT_TRUE(stays_bounded(lattice_body(spec, world), 0.99));
  EXPECT_FALSE(stays_bounded(lattice_body(spec, world), 1.05));
}

// Pairs of points, each with one bond of another length: a pair holds 9 K V (e/|ξ|)² and so swings with ω² = 36 K/(ρ
// ξ²), the shortest fastest. The estimate starts from noise by the numbers of points. For some numbers it is all but
// orthogonal to the mode of that pair, and a lower one converges; the estimate must not be that of the next pair, 8 %
// longer.
TEST(CriticalTimeStep, IsOfTheHighestModeHoweverPointsAreNumbered) {
  const Communicator world;
  constexpr int pairs = 26;
  const BlockMaterial material{.density = 1000, .law = elastic(1e9, 0.3), .formulation = Formulation::ordinary};
  const auto limit = [&](int first_number) {
    PointCloud cloud;
    cloud.block_names = {"block"};
    for (int n = 0; n < 2 * pairs && world.rank() == 0; ++n) {
      const int pair = n / 2;
      const double length = pair == 0 ? 1 : 1.01 + 0.07 * pair;
      cloud.ids.push_back(first_number + n);
      cloud.element_ids.push_back(n + 1);
      cloud.positions.emplace_back(n % 2 * length, 10.0 * pair, 0);
      cloud.volumes.push_back(1), cloud.spacings.push_back(1);
      cloud.blocks.push_back(0), cloud.sets.push_back(0);
    }
    BlockBonds bonds(3);
    bonds.families = FamilyKind::lists;
    Body body = make_body(make_domain(partitioned(cloud, world), {bonds}, world), Influence::one, {material});
    return CentralDifference(body, {}, {}, {0, 1}, 0).critical_time_step();
  };
  const double bulk = 1e9 / (3 * (1 - 2 * 0.3)), exact = 2 / std::sqrt(36 * bulk / 1000);
  for (int first_number = 0; first_number < (world.size() == 1 ? 4000 : 40); first_number += 2) {
    const double found = limit(first_number);
    ASSERT_LT(found, exact * (1 + 1e-6)) << first_number;  // of modes in single precision
    ASSERT_GT(found, exact * (1 - 0.5 * CriticalTimeStep::accuracy - 1e-3)) << first_number;
  }
}

// A lattice's own formula: for the dispersion of Waves.DispersionOfTheOperator no bulk wave is faster than the limit.
TEST(CriticalTimeStep, ScalesWithSpacingAndSpeed) {
  const Communicator world;
  const auto limit = [&](double spacing, double young) {
    LatticeSpec spec{{7, 7, 7}, spacing,        2.015,
                     0,         Influence::one, {1000, elastic(young, 0.3), SillingStabilization{0.02}}};
    Body body = lattice_body(spec, world);
    return CentralDifference(body, {}, {}, {0, 1}, 0).critical_time_step();
  };
  // Rounded down to 10 bits of mantissa: a part in 512 at the most.
  EXPECT_NEAR(limit(2e-3, 1e9) / limit(1e-3, 1e9), 2, 2.0 / 512);
  EXPECT_NEAR(limit(1e-3, 1e9) / limit(1e-3, 4e9), 2, 2.0 / 512);
}

}  // namespace
}  // namespace strut
