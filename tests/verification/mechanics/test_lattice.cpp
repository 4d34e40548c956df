// Families on a lattice as stencils: the same bonds, deformation gradients, forces and tangent as by lists.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "mechanics/kernels/group_tile.hpp"
#include "mechanics/kernels/lane_groups.hpp"
#include "verification/larger.hpp"
#include "verification/probes.hpp"

namespace strut {
namespace {

struct Case {
  double horizon;
  Influence influence;
  double silling, mean;
  double full;  // the part of the cells that holds a point
  Vector spacing{1e-3, 1e-3, 1e-3};
  std::array<int, 3> cells{21, 12, 11};
  bool cracked = false;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << "horizon " << c.horizon << ", influence " << static_cast<int>(c.influence) << ", Silling " << c.silling
             << ", mean gradient " << c.mean << ", full " << c.full << (c.cracked ? ", cracked" : "");
}

// Lumps of a lattice with random volumes, two blocks, and an origin somewhere.
PointCloud porous_cloud(const Case& c, const Communicator& world) {
  PointCloud cloud;
  cloud.block_names = {"left", "right"};
  if (world.rank() != 0) return cloud;
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> part(0, 1);
  const auto [nx, ny, nz] = c.cells;
  for (int cell = 0; cell < nx * ny * nz; ++cell) {
    const Vector at(cell % nx, cell / nx % ny, cell / (nx * ny));
    const double shape = std::sin(0.7 * at[0]) + std::sin(0.9 * at[1] + 1) + std::sin(0.8 * at[2] + 2);
    if (shape < 3 - 6 * c.full) continue;
    cloud.ids.push_back(static_cast<std::int64_t>(cloud.ids.size()));
    cloud.element_ids.push_back(cloud.ids.back() + 1);
    cloud.positions.push_back(Vector(0.3, -0.2, 1.7) + at.cwiseProduct(c.spacing));
    cloud.volumes.push_back(c.spacing.prod() * (0.5 + part(engine)));
    cloud.spacings.push_back(1e-3);
    cloud.blocks.push_back(at[0] > 9 ? 1 : 0);
    cloud.sets.push_back(0);
  }
  return cloud;
}

Body body_of(const Case& c, FamilyKind families, const Communicator& world) {
  BlockBonds bonds(c.horizon * 1e-3);
  bonds.families = families;
  bonds.may_lose_bonds = c.cracked;
  std::vector<Crack> cracks;
  if (c.cracked) cracks.emplace_back(DiskCrack{Vector(0.31, -0.195, 1.7051), Vector(0.6, 0, 0.8), 4.3e-3});
  const materials::Elastic soft = std::get<materials::Elastic>(elastic(1e9, 0.3));
  // Where both are asked for one block has the one, and one the other.
  const Stabilization mean = MeanGradientStabilization{c.mean};
  const Stabilization silling = SillingStabilization{c.silling}, twice = SillingStabilization{2 * c.silling};
  const BlockMaterial left{1000, soft, c.silling > 0 ? silling : mean},
      right{2000, elastic(3e9, 0.2), c.mean > 0 ? mean : twice};
  return make_body(make_domain(partitioned(porous_cloud(c, world), world), {bonds, bonds}, world, cracks), c.influence,
                   {left, right});
}

class LatticeOf : public testing::TestWithParam<Case> {
 protected:
  Communicator world;

  // A value of each point of all ranks, by id.
  std::vector<double> by_id(const Body& body, const std::function<Vector(int)>& of) const {
    const std::int64_t count = world.sum(static_cast<std::int64_t>(body.owned()));
    std::vector<double> values(3 * static_cast<std::size_t>(count), 0);
    for (int i = 0; i < body.owned(); ++i) {
      const Vector v = of(i);
      for (int c = 0; c < 3; ++c) values[3 * body.domain.cloud.ids[i] + c] = v[c];
    }
    world.sum(values);
    return values;
  }

  // The largest difference over the largest value.
  double difference(const std::vector<double>& a, const std::vector<double>& b) const {
    double largest = 0, off = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      largest = larger(largest, std::abs(b[k]));
      off = larger(off, std::abs(a[k] - b[k]));
    }
    return off / largest;
  }
};

Vector bent(const Vector& X) {
  const Vector x = X - Vector(0.3, -0.2, 1.7);
  return X +
         Vector(0.02 * std::sin(90 * x[1]) + 0.05 * x[0], 0.001 * std::cos(110 * x[2]), 2e-4 * std::sin(300 * x[0]));
}

TEST_P(LatticeOf, IsFoundAndHasTheBondsOfLists) {
  const Body stencil = body_of(GetParam(), FamilyKind::stencil, world),
             lists = body_of(GetParam(), FamilyKind::lists, world);
  EXPECT_EQ(stencil.domain.families.lattices.size(), 1U);
  EXPECT_EQ(stencil.domain.families.lists.entries() > 0, GetParam().cracked);
  std::int64_t off_stencil = 0;
  for (const char off : stencil.domain.families.off_stencil) off_stencil += off;
  EXPECT_EQ(world.sum(off_stencil) > 0, GetParam().cracked);
  EXPECT_TRUE(lists.domain.families.lattices.empty());
  const auto size = [](const Body& b) {
    return [&b](int i) { return Vector::Constant(static_cast<double>(b.domain.families.size(i))); };
  };
  EXPECT_EQ(by_id(stencil, size(stencil)), by_id(lists, size(lists)));
  EXPECT_EQ(world.sum(static_cast<std::int64_t>(stencil.domain.families.bonds())),
            world.sum(static_cast<std::int64_t>(lists.domain.families.bonds())));
}

// Sums of some hundred terms in another order: round-off of 1e-16 times the number of additions that a digit passes.
TEST_P(LatticeOf, HasTheForcesOfLists) {
  Body stencil = body_of(GetParam(), FamilyKind::stencil, world), lists = body_of(GetParam(), FamilyKind::lists, world);
  for (Body* body : {&stencil, &lists}) {
    deform(*body, bent);
    ASSERT_FALSE(advance_stress_and_force(*body, 1e-6, true).failure);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto gradient = [axis](const Body& b) {
      return [&b, axis](int i) -> Vector { return b.points[i].deformation_gradient.col(axis); };
    };
    EXPECT_LT(difference(by_id(stencil, gradient(stencil)), by_id(lists, gradient(lists))), 1e-12);
  }
  const auto force = [](const Body& b) { return [&b](int i) { return b.force_density[i]; }; };
  EXPECT_LT(difference(by_id(stencil, force(stencil)), by_id(lists, force(lists))), 1e-12);
  const Energies a = stored_energies(stencil), b = stored_energies(lists);
  EXPECT_NEAR(a.elastic, b.elastic, 1e-11 * b.elastic);
  EXPECT_NEAR(a.stabilization, b.stabilization, 1e-11 * b.stabilization);
}

TEST_P(LatticeOf, HasTheTangentOfLists) {
  std::vector<std::vector<double>> results;
  for (const FamilyKind families : {FamilyKind::stencil, FamilyKind::lists}) {
    Body body = body_of(GetParam(), families, world);
    deform(body, bent);
    const auto field = [&](int i) {
      const Vector X = body.domain.reference(i);
      return Vector(std::sin(4000 * X[0]), std::cos(5000 * X[1]), std::sin(3000 * X[2] + 1));
    };
    const std::vector<Vector> image = operator_on(body, field);
    results.push_back(by_id(body, [&](int i) { return image[i]; }));
  }
  EXPECT_LT(difference(results[0], results[1]), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    All, LatticeOf,
    testing::Values(Case{1.75, Influence::one, 0, 0.01, 0.6}, Case{2.015, Influence::one, 0.02, 0, 1},
                    Case{3.015, Influence::one, 0.02, 0, 0.5}, Case{3.015, Influence::cubic_decay, 0, 0.01, 0.7},
                    Case{3.015, Influence::linear_decay, 0.05, 0.01, 0.5}, Case{6.015, Influence::one, 0.01, 0, 0.5},
                    Case{3.3, Influence::linear_decay, 0.05, 0.01, 0.6, {1e-3, 1.3e-3, 0.7e-3}},
                    // Two strips of rows of more than 64 pencils.
                    Case{3.015, Influence::one, 0.02, 0.01, 0.7, {1e-3, 1e-3, 1e-3}, {560, 24, 6}},
                    // With a crack, who is beside it goes by a list.
                    Case{2.015, Influence::linear_decay, 0, 0.01, 0.7, {1e-3, 1e-3, 1e-3}, {21, 12, 11}, true},
                    Case{3.015, Influence::one, 0.02, 0, 0.7, {1e-3, 1e-3, 1e-3}, {21, 12, 11}, true}));

// The sum in a point's lane of a cluster is that over the point's own family, but for round-off.
TEST(ClusterLists, LanesAreTheSumsOfTheirPoints) {
  const Communicator world;
  Body body = body_of({2.3, Influence::linear_decay, 0.02, 0.01, 0.8}, FamilyKind::lists, world);
  deform(body, bent);
  ASSERT_FALSE(advance_stress_and_force(body, 1e-6, false).failure);
  const Site* sites = body.domain.sites.data();
  const ForceStates& states = body.force_states;
  const auto check = [&](const auto& lanes, int l, const auto& own) {
    double largest = 0;
    for (int c = 0; c < 3; ++c) largest = larger(largest, std::abs(own.c[c]));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(lanes.c[c][l], own.c[c], 1e-12 * largest);
  };
  const bonds::LinearDecay decay;
  const auto sums_of = [&](const auto& family) {
    constexpr std::size_t kind = Stabilization(MeanGradientStabilization()).index();
    return std::pair(
        bonds::far_force<true>(family, sites, states.tensors.data(), decay),
        bonds::residual<MeanGradientStabilization>(kind, family, sites, states.gradients.data(), decay).force);
  };
  std::size_t seen = 0;
  const ClusterLists& lists = body.domain.families.lists;
  for (int b = 0; b < lists.count(); ++b) {
    const auto [forces, residuals] = sums_of(bonds::OfCluster{lists[b]});
    for (std::size_t l = 0; l < lists[b].points.size(); ++l, ++seen) {
      const auto [force, residual] = sums_of(bonds::OfPoint{{lists[b].points[l]}, body.domain.families});
      check(forces, static_cast<int>(l), force);
      check(residuals, static_cast<int>(l), residual);
    }
  }
  EXPECT_EQ(seen, static_cast<std::size_t>(body.owned()));
}

// A body that is no lattice has lists, and so has one that is faster with them.
TEST(NoLattice, HasLists) {
  const Communicator world;
  const Body moved = lattice_body({{6, 6, 6}, 1, 2.015, 1e-6, Influence::one, {1000, elastic(1e9, 0.3)}}, world);
  EXPECT_TRUE(moved.domain.families.lattices.empty());
  const Body wide = lattice_body({{12, 12, 12}, 1, 9.015, 0, Influence::one, {1000, elastic(1e9, 0.3)}}, world);
  EXPECT_TRUE(wide.domain.families.lattices.empty());
  const Body thin = lattice_body({{2, 6, 6}, 1, 2.015, 0, Influence::one, {1000, elastic(1e9, 0.3)}}, world);
  EXPECT_TRUE(thin.domain.families.lattices.empty());
}

TEST(Lattice, IsTakenWhereItIsFaster) {
  const Communicator world;
  const Body thick = lattice_body({{24, 6, 6}, 1, 3.015, 0, Influence::one, {1000, elastic(1e9, 0.3)}}, world);
  EXPECT_EQ(thick.domain.families.lattices.size(), 1U);
}

// Strips report in any order.
TEST(StepReport, TellsTheWorstFailureOfTheFirstPointWhicheverComesFirst) {
  using Kind = Failure::Kind;
  std::vector<Failure> failures{{1, Kind::inverted}, {3, Kind::inverted}, {5, Kind::no_stress}, {7, Kind::no_stress}};
  do {
    StepReport all;
    for (const Failure& failure : failures) all.add({.failure = failure});
    ASSERT_TRUE(all.failure);
    EXPECT_EQ(all.failure->point, 5);
    EXPECT_EQ(all.failure->kind, Kind::no_stress);
  } while (std::next_permutation(failures.begin(), failures.end(),
                                 [](const Failure& a, const Failure& b) { return a.point < b.point; }));
}

// The other records of its tile belong to another group, which another thread may write meanwhile.
TEST(GroupTile, AGroupThatDoesNotFillATileWorksOnACopy) {
  small::Tiles states;
  states.assign(LaneGroup::width, std::array{1.0, 2.0});
  const auto rows_of = [&](int count) {
    std::array<int, LaneGroup::width> places;
    for (int l = 0; l < LaneGroup::width; ++l) places[l] = std::min(l, count - 1);
    const GroupTile<2> tile(states, places, count);
    for (int n = 0; n < 2; ++n) small::lanes(tile.rows()[n]) += 1;
    const bool is_copy = tile.rows() != states.tile_of(0);
    tile.give_back(states, places, count);
    return is_copy;
  };
  EXPECT_TRUE(rows_of(3));
  for (int k = 0; k < LaneGroup::width; ++k) EXPECT_EQ(states.at(k, 1), k < 3 ? 3.0 : 2.0) << k;
  EXPECT_FALSE(rows_of(LaneGroup::width));
}

}  // namespace
}  // namespace strut
