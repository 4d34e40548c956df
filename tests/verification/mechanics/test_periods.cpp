// Periodic sides by images of points: one period has the forces and the tangent of a period in the middle of a long
// body, and the force through its sides is the change of its energy with the period.
#include <gtest/gtest.h>

#include <numbers>

#include "mechanics/mirror_forces.hpp"
#include "verification/larger.hpp"
#include "verification/probes.hpp"

namespace strut {
namespace {

constexpr int period = 5, height = 4, several = 5;  // cells; periods of the long body along x and y

struct Case {
  std::string name;
  BlockMaterial material;
  FamilyKind families = FamilyKind::lists;
  double horizon = 1.75;
  Influence influence = Influence::one;
};

bool is_in_the_middle(const Vector& X) {
  return (X.head<2>().array() > 2 * period).all() && (X.head<2>().array() < 3 * period).all();
}

// The period in the middle of the box alone, or all of it; ids by cells of the whole.
Body box(const Case& c, bool whole, const Communicator& world) {
  constexpr int across = several * period;
  PointCloud cloud;
  cloud.block_names = {"block"};
  for (int cell = 0; world.rank() == 0 && cell < across * across * height; ++cell) {
    const Vector at = Vector(cell % across, cell / across % across, cell / (across * across)) + Vector::Constant(0.5);
    if (!whole && !is_in_the_middle(at)) continue;
    add_point(cloud, cell, at, 1 + 0.1 * at[2] / height, 1);
  }
  BlockBonds bonds(c.horizon);
  bonds.families = c.families;
  std::vector<Period> periods{{0, period, 0, Function(1)}, {1, period, 1, Function(1)}};
  if (whole) periods.clear();
  return make_body(make_domain(partitioned(std::move(cloud), world), {bonds}, world, {}, {}, periods), c.influence,
                   {c.material});
}

// A field of this period along x and y, on a uniform stretch.
const Vector stretch(1.002, 0.997, 1);
Vector field(const Vector& X) {
  const double x = 2 * std::numbers::pi / period * X[0], y = 2 * std::numbers::pi / period * X[1];
  return {std::sin(x) * std::cos(y) * (1 + 0.1 * X[2]), 0.5 * std::cos(x + 1) + 0.2 * std::sin(y),
          std::cos(x) * std::sin(y + 2) - 0.2 * X[2]};
}
Vector deformed(const Vector& X) { return stretch.cwiseProduct(X) + 1e-3 * field(X); }

class Periodic : public testing::TestWithParam<Case> {
 protected:
  Communicator world;

  // The largest difference between both bodies in the middle over the largest value there.
  double difference(const Body& part, const Body& whole, const std::function<Vector(const Body&, int)>& of) const {
    constexpr int cells = several * several * period * period * height;
    std::vector<double> some(3 * cells, 0), all(3 * cells, 0);
    const auto take = [&](const Body& body, std::vector<double>& values) {
      for (int i = 0; i < body.owned(); ++i) {
        if (!is_in_the_middle(body.domain.reference(i))) continue;
        const Vector v = of(body, i);
        std::copy_n(v.data(), 3, &values[3 * body.domain.cloud.ids[i]]);
      }
      world.sum(values);
    };
    take(part, some), take(whole, all);
    double largest = 0, most = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      largest = larger(largest, std::abs(all[k]));
      most = larger(most, std::abs(some[k] - all[k]));
    }
    EXPECT_GT(largest, 0);
    return most / largest;
  }

  // The stored energy at a stretch of the sides alone, with the points where they are.
  double energy_at(Body& body, const Vector& of_sides) const {
    body.domain.halo.set_stretch(of_sides);
    advance_stress_and_force(body, 1, true);
    const Energies energies = stored_energies(body);
    return energies.elastic + energies.stabilization;
  }
};

// Sums of up to 200 terms, the largest of which are some ten times what is left of them; places of 25 beside
// displacements of 1e-3.
constexpr double round_off = 1e-9;

TEST_P(Periodic, HasTheForcesOfALongBody) {
  Body whole = box(GetParam(), true, world), part = box(GetParam(), false, world);
  if (GetParam().families == FamilyKind::stencil) {
    EXPECT_EQ(part.domain.families.lattices.size(), 1U);
  }
  part.domain.halo.set_stretch(stretch);
  for (Body* body : {&whole, &part}) {
    deform(*body, deformed);
    advance_stress_and_force(*body, 1, true);
  }
  EXPECT_LT(difference(part, whole, [](const Body& body, int i) { return body.force_density[i]; }), round_off);
}

TEST_P(Periodic, HasTheTangentOfALongBody) {
  Body whole = box(GetParam(), true, world), part = box(GetParam(), false, world);
  std::map<const Body*, std::vector<Vector>> products;
  for (Body* body : {&whole, &part}) {
    products[body] = operator_on(*body, [&](int i) { return field(body->domain.reference(i)); });
  }
  EXPECT_LT(difference(part, whole, [&](const Body& body, int i) { return products[&body][i]; }), round_off);
}

TEST_P(Periodic, ForcesThroughSidesAreTheChangeOfTheEnergy) {
  Body part = box(GetParam(), false, world);
  deform(part, deformed);
  energy_at(part, stretch);
  std::vector<Vector> forces = mirror_forces(part);
  world.sum(std::span(forces[0].data(), 6));
  for (int axis = 0; axis < 2; ++axis) {
    constexpr double step = 1e-5;  // of the stretch, which is 3e-3: central differences are off by its square
    const Vector more = step * Vector::Unit(axis);
    const double change = energy_at(part, stretch + more) - energy_at(part, stretch - more);
    const double expected = change / (2 * step * period);
    EXPECT_NEAR(forces[axis][axis], expected, 1e-5 * std::abs(expected));
    EXPECT_GT(std::abs(expected), 1e5);
  }
}

// With a strain energy: the energy of the elastic law, which is one of rates, is off by the strain.
materials::Hyperelastic rubber() { return {.bulk = 1e9 / 1.2, .terms = {{{1e9 / 2.6, 2}}}}; }

const BlockMaterial by_mean{1000, rubber(), MeanGradientStabilization{0.1}},
    by_silling{1000, rubber(), SillingStabilization{0.1}},
    ordinary{1000, elastic(1e9, 0.3), NoStabilization(), Formulation::ordinary},
    quadratic{1000, rubber(), NoStabilization(), Formulation::quadratic};

INSTANTIATE_TEST_SUITE_P(By, Periodic,
                         testing::Values(Case{"MeanGradient", by_mean}, Case{"Silling", by_silling},
                                         Case{"MeanGradientOnALattice", by_mean, FamilyKind::stencil, 3.015,
                                              Influence::cubic_decay},
                                         Case{"SillingOnALattice", by_silling, FamilyKind::stencil, 2.01},
                                         Case{"Ordinary", ordinary, FamilyKind::lists, 3.015, Influence::linear_decay},
                                         Case{"Quadratic", quadratic, FamilyKind::lists, 1.75, Influence::one}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace strut
