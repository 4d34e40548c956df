// The average of the criterion of ductile failure: what a single point has grown by is spread with the variance of the
// ball, none is lost, and none passes a crack.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fracture/averaged_criterion.hpp"
#include "verification/lattice.hpp"
#include "verification/probes.hpp"

namespace strut {
namespace {

constexpr double spacing = 1e-3;

BlockMaterial metal(Formulation formulation, double radius) {
  const materials::J2 metal{160e9, 80e9, {300e6, materials::NoHardening{}, materials::NoRate{}}};
  const materials::Ductility ductility{materials::FailureStrain{0.1}, 2e4, radius};
  BlockMaterial material{7800, materials::Ductile{metal, ductility}, NoStabilization(), formulation};
  material.damage = DamageModel{.ductility = ductility};
  return material;
}

constexpr int number = materials::state_size<materials::J2>;  // of the indicator in the state

void set_indicators(Body& body, const std::function<double(const Vector& X)>& value) {
  MaterialBlock& block = body.blocks[0];
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    const double here = value(body.domain.reference(block.points[k]));
    for (int q = 0; q < block.points_per_cell(); ++q) block.state->at(block.index(k, q), number) = here;
  }
}

double indicator(const Body& body, std::size_t k, int q = 0) {
  return body.blocks[0].state->at(body.blocks[0].index(k, q), number);
}

struct Kind {
  const char* name;
  Formulation formulation;
  double horizon;
  FamilyKind families;
};
const std::vector<Kind> kinds = {
    {"quadratic", Formulation::quadratic, 1.75, FamilyKind::lists},
    {"lists", Formulation::correspondence, 2.015, FamilyKind::lists},
    {"a lattice", Formulation::correspondence, 2.015, FamilyKind::stencil},
};

LatticeSpec block_of(const Kind& kind, double radius) {
  return {{19, 19, 19}, spacing, kind.horizon, 0, Influence::one, metal(kind.formulation, radius), kind.families};
}

Vector middle() { return Vector::Constant(9.5) * spacing; }

struct Moments {
  double sum = 0;
  Vector squares = Vector::Zero();  // of distances, times growth
};

Moments moments(const Body& body, const Vector& at) {
  const Communicator& world = body.domain.communicator;
  Moments result;
  for (std::size_t k = 0; k < body.blocks[0].points.size(); ++k) {
    const Vector xi = body.domain.reference(body.blocks[0].points[k]) - at;
    result.sum += indicator(body, k);
    result.squares += indicator(body, k) * xi.cwiseProduct(xi);
  }
  for (double* number : {&result.sum, &result.squares[0], &result.squares[1], &result.squares[2]}) {
    *number = world.sum(*number);
  }
  return result;
}

TEST(AveragedCriterion, HasTheVarianceOfItsBallAndLosesNothing) {
  const Communicator world;
  for (const Kind& kind : kinds) {
    for (const double radius : {0.7e-3, 2e-3, 3e-3}) {
      SCOPED_TRACE(std::string(kind.name) + ", " + std::to_string(radius));
      Body body = lattice_body(block_of(kind, radius), world);
      AveragedCriterion averaged(body);
      set_indicators(body, [](const Vector& X) { return (X - middle()).norm() < 0.1 * spacing ? 0.5 : 0.0; });
      EXPECT_NEAR(moments(body, middle()).sum, 0.5, 1e-12);
      averaged.average(body);
      const Moments after = moments(body, middle());
      EXPECT_NEAR(after.sum, 0.5, 1e-12);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(after.squares[c] / after.sum, radius * radius / 5, 1e-6 * radius * radius);
    }
  }
}

// Growth below a hundredth of the value at which a point fails waits; a uniform growth stays as it is, and the next
// average adds to the one before.
TEST(AveragedCriterion, KeepsAUniformGrowthAndWaitsForAHundredth) {
  const Communicator world;
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.name);
    Body body = lattice_body(block_of(kind, 2.5e-3), world);
    AveragedCriterion averaged(body);
    set_indicators(body, [](const Vector& X) { return X[0] > 9 * spacing ? 0.009 : 0.0; });
    averaged.average(body);
    EXPECT_EQ(largest_over(body, [&](int i) { return body.averaged_indicator[i]; }), 0);
    for (const double reached : {0.2, 0.6}) {
      set_indicators(body, [=](const Vector&) { return reached; });
      averaged.average(body);
      for (std::size_t k = 0; k < body.blocks[0].points.size(); ++k) EXPECT_NEAR(indicator(body, k), reached, 1e-14);
    }
  }
}

// A point that has failed keeps its indicator, though its neighbors have none.
TEST(AveragedCriterion, LeavesWhatHasFailed) {
  const Communicator world;
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.name);
    Body body = lattice_body(block_of(kind, 2e-3), world);
    AveragedCriterion averaged(body);
    set_indicators(body, [](const Vector& X) { return (X - middle()).norm() < 0.1 * spacing ? 1.0 : 0.0; });
    averaged.average(body);
    std::vector<double> largest{0, 0};
    for (std::size_t k = 0; k < body.blocks[0].points.size(); ++k) {
      double& most = largest[indicator(body, k) < 1 ? 1 : 0];
      most = std::max(most, indicator(body, k));
    }
    const double given = moments(body, middle()).sum;
    averaged.average(body);
    EXPECT_EQ(moments(body, middle()).sum, given) << "its growth is given once";
    EXPECT_EQ(world.max(largest[0]), 1);
    EXPECT_GT(world.max(largest[1]), 0.01);
    EXPECT_LT(world.max(largest[1]), 0.2);
  }
}

// A block without a radius keeps what each of its integration points has, and gives nothing.
TEST(AveragedCriterion, LeavesOtherBlocks) {
  const Communicator world;
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.name);
    LatticeSpec spec = block_of(kind, 2e-3);
    PointCloud cloud = lattice_cloud(spec, world);
    for (std::size_t i = 0; i < cloud.size(); ++i) cloud.blocks[i] = cloud.positions[i][0] > middle()[0] ? 1 : 0;
    cloud.block_names = {"averaged", "other"};
    BlockBonds bonds(kind.horizon * spacing);
    bonds.families = FamilyKind::lists;
    Domain domain = make_domain(partitioned(std::move(cloud), world), {bonds, bonds}, world);
    Body body = make_body(std::move(domain), spec.influence, {spec.material, metal(kind.formulation, 0)});
    MaterialBlock& other = body.blocks[1];
    const auto own = [](std::size_t k, int q) { return 0.001 * static_cast<double>(k % 7) + 0.1 * q; };
    for (std::size_t k = 0; k < other.points.size(); ++k) {
      for (int q = 0; q < other.points_per_cell(); ++q)
        other.state->at(other.index(static_cast<int>(k), q), number) = own(k, q);
    }
    AveragedCriterion averaged(body);
    set_indicators(body, [](const Vector& X) { return X[0] < 5 * spacing ? 0.5 : 0.0; });
    averaged.average(body);
    for (std::size_t k = 0; k < other.points.size(); ++k) {
      for (int q = 0; q < other.points_per_cell(); ++q)
        EXPECT_EQ(other.state->at(other.index(static_cast<int>(k), q), number), own(k, q));
    }
  }
}

TEST(AveragedCriterion, PassesNoCrack) {
  const Communicator world;
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(kind.name);
    LatticeSpec spec = block_of(kind, 3e-3);
    const double plane = 10 * spacing, wide = 21 * spacing;
    spec.cracks = {RectangularCrack{Vector(-spacing, -spacing, plane), Vector::UnitZ(), Vector::UnitY(), wide, wide}};
    Body body = lattice_body(spec, world);
    AveragedCriterion averaged(body);
    set_indicators(body, [=](const Vector& X) { return X[2] > plane ? 0.5 : 0.0; });
    averaged.average(body);
    for (std::size_t k = 0; k < body.blocks[0].points.size(); ++k) {
      const bool is_above = body.domain.reference(body.blocks[0].points[k])[2] > plane;
      EXPECT_NEAR(indicator(body, k), is_above ? 0.5 : 0, 1e-14);
    }
  }
}

TEST(AveragedCriterion, RefusesARadiusInAnotherUnit) {
  const Communicator world;
  Body body = lattice_body(block_of(kinds[0], 2.0), world);
  EXPECT_THROW(AveragedCriterion{body}, Error);
}

}  // namespace
}  // namespace strut
