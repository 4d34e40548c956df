// The criterion of ductile failure in cells by quadratic correspondence reads a mean stress without what alternates
// from cell to cell, and with what varies linearly.
#include <gtest/gtest.h>

#include <cmath>

#include "fracture/fitted_criterion.hpp"
#include "verification/lattice.hpp"
#include "verification/probes.hpp"

namespace strut {
namespace {

constexpr double spacing = 1e-3;
constexpr int strain = 0, indicator = materials::state_size<materials::J2>;  // columns of the state

BlockMaterial metal(const materials::FailureCriterion& criterion) {
  const materials::J2 cold{160e9, 80e9, {300e6, materials::NoHardening{}, materials::NoRate{}}};
  const materials::Ductility ductility{criterion};
  BlockMaterial material{7800, materials::Ductile{cold, ductility}, NoStabilization(), Formulation::quadratic};
  material.damage = DamageModel{.ductility = ductility};
  return material;
}

Body body_of(const materials::FailureCriterion& criterion, const Communicator& world) {
  return lattice_body({{8, 7, 9}, spacing, 1.75, 0, Influence::one, metal(criterion), FamilyKind::lists}, world);
}

double linear(const Vector& X) { return 1e8 + 3e10 * X[0] - 2e10 * X[2]; }  // Pa

// A shear stress of 3e8 Pa, and mean stresses.
template <class Mean>
void set_stress(Body& body, const Mean& mean) {
  MaterialBlock& block = body.blocks[0];
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    for (int q = 0; q < 4; ++q) {
      MaterialPoint point = block.cells[block.index(k, q)];
      point.stress << 0, 0, 0, 3e8, 0, 0;
      point.stress.head<3>().setConstant(mean(body.domain.reference(block.points[k])));
      block.cells->set(block.index(k, q), point);
    }
  }
}

// Flow by 1 % in a step whose law has given all points this growth.
void flow(Body& body, FittedCriterion& fitted, double given) {
  MaterialBlock& block = body.blocks[0];
  fitted.start(body);
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    for (int q = 0; q < 4; ++q) {
      block.state->at(block.index(k, q), strain) += 0.01;
      block.state->at(block.index(k, q), indicator) += given;
    }
  }
  fitted.finish(body);
}

double indicator_of(const Body& body, std::size_t k) {
  return body.blocks[0].state->at(body.blocks[0].index(k, 3), indicator);
}

const materials::JohnsonCookFailure steep{{-0.77, 1.45, -0.47, 0, 0}};

double growth_at(double mean) {
  Symmetric stress = Symmetric::Zero();
  stress << mean, mean, mean, 3e8, 0, 0;
  return steep.growth(stress, 1.0, 0.0);
}

TEST(FittedCriterion, ReadsALinearMeanStress) {
  const Communicator world;
  Body body = body_of(steep, world);
  FittedCriterion fitted(body);
  set_stress(body, [](const Vector&) { return 2e8; });
  flow(body, fitted, 123);
  for (std::size_t k = 0; k < body.blocks[0].points.size(); ++k) {
    EXPECT_NEAR(indicator_of(body, k), 0.01 * growth_at(2e8), 1e-12) << "a uniform one";
  }
  set_stress(body, linear);
  flow(body, fitted, 0);
  for (std::size_t k = 0; k < body.blocks[0].points.size(); ++k) {
    const double expected =
        0.01 * (growth_at(2e8) + growth_at(linear(body.domain.reference(body.blocks[0].points[k]))));
    EXPECT_NEAR(indicator_of(body, k), expected, 0.02 * expected) << "the least moment takes a part of the slope";
  }
}

// 6e8 Pa more and less in turns: 1.35 times the von Mises stress is what these constants bear at all.
TEST(FittedCriterion, DoesNotReadWhatAlternates) {
  const Communicator world;
  Body body = body_of(steep, world);
  FittedCriterion fitted(body);
  set_stress(body, [](const Vector& X) {
    const Vector n = X / spacing;
    return std::lround(std::floor(n[0]) + std::floor(n[1]) + std::floor(n[2])) % 2 == 0 ? 6e8 : -6e8;
  });
  flow(body, fitted, 1e4);
  for (std::size_t k = 0; k < body.blocks[0].points.size(); ++k) {
    EXPECT_LT(indicator_of(body, k), 0.01 * growth_at(2.5e8));
  }
}

// A point that softens goes on by its law, and a criterion without stress needs nothing.
TEST(FittedCriterion, LeavesWhatHasFailedAndOtherCriteria) {
  const Communicator world;
  Body body = body_of(steep, world);
  FittedCriterion fitted(body);
  flow(body, fitted, 0);
  MaterialBlock& block = body.blocks[0];
  for (std::size_t k = 0; k < block.points.size(); ++k) block.state->at(block.index(k, 3), indicator) = 1.5;
  flow(body, fitted, 0.25);
  for (std::size_t k = 0; k < block.points.size(); ++k) EXPECT_EQ(indicator_of(body, k), 1.75);
  Body other = body_of(materials::FailureStrain{0.1}, world);
  FittedCriterion none(other);
  flow(other, none, 0.25);
  for (std::size_t k = 0; k < other.blocks[0].points.size(); ++k) EXPECT_EQ(indicator_of(other, k), 0.25);
  EXPECT_EQ(none.bytes(), 0);
}

}  // namespace
}  // namespace strut
