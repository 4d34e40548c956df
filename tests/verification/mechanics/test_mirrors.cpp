// Symmetry planes by images of points: a quarter has the forces, the tangent and the plane's reactions of the whole.
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "mechanics/mirror_forces.hpp"
#include "verification/larger.hpp"
#include "verification/probes.hpp"

namespace strut {
namespace {

constexpr int half = 5, height = 4;  // cells

struct Case {
  std::string name;
  BlockMaterial material;
  FamilyKind families = FamilyKind::lists;
  double horizon = 1.75;
  Influence influence = Influence::one;
  double size = 1e-3, tolerance = 1e-11;
};

Vector off() { return {0.3, -0.2, 1.7}; }  // where the planes x and y meet

bool is_in_quarter(int cell) { return cell % (2 * half) >= half && cell / (2 * half) % (2 * half) >= half; }

// A box of 2 half × 2 half × height cells around the planes, or its quarter; ids by cells of the whole.
Body box(const Case& c, bool whole, const Communicator& world) {
  PointCloud cloud;
  cloud.block_names = {"block"};
  for (int cell = 0; world.rank() == 0 && cell < 4 * half * half * height; ++cell) {
    const Vector at(cell % (2 * half) - half, cell / (2 * half) % (2 * half) - half, cell / (4 * half * half));
    if (!whole && !is_in_quarter(cell)) continue;
    add_point(cloud, cell, off() + at + Vector::Constant(0.5), 1 + 0.1 * at[2] / height, 1);
  }
  BlockBonds bonds(c.horizon);
  bonds.families = c.families;
  std::vector<Mirror> mirrors{{.on = off(), .normal = Vector::UnitX(), .number = 0},
                              {.on = off(), .normal = Vector::UnitY(), .number = 1}};
  if (whole) mirrors.clear();
  return make_body(make_domain(partitioned(std::move(cloud), world), {bonds}, world, {}, mirrors), c.influence,
                   {c.material});
}

// A symmetric field.
Vector field(const Vector& X, double size) {
  const Vector x = X - off();
  return size * Vector(std::sin(0.3 * x[0]) * std::cos(0.2 * x[1] + 0) * (1 + 0.1 * x[2]),
                       0.5 * x[1] * std::cos(0.4 * x[0]), std::cos(0.5 * x[0]) * std::cos(0.3 * x[1]) - 0.2 * x[2]);
}

class Mirrored : public testing::TestWithParam<Case> {
 protected:
  Communicator world;

  std::vector<double> by_id(const Body& body, const std::function<Vector(int)>& of) const {
    std::vector<double> values(3 * 4 * half * half * height, 0);
    for (int i = 0; i < body.owned(); ++i) {
      const Vector v = of(i);
      for (int c = 0; c < 3; ++c) values[3 * body.domain.cloud.ids[i] + c] = v[c];
    }
    world.sum(values);
    return values;
  }

  // The largest difference of the values of the quarter's points, lost ones too, over the largest value.
  static double difference(const std::vector<double>& quarter, const std::vector<double>& whole) {
    double largest = 0, most = 0;
    for (std::size_t k = 0; k < quarter.size(); ++k) {
      largest = larger(largest, std::abs(whole[k]));
      if (is_in_quarter(static_cast<int>(k / 3))) most = larger(most, std::abs(quarter[k] - whole[k]));
    }
    return most / largest;
  }
};

// Sums of up to 200 terms, the largest of which are some ten times what is left of them. The four places of a cell by
// quadratic correspondence are no mirror images of each other: there the second order in the strain differs.
constexpr double round_off = 1e-11;

TEST_P(Mirrored, HasTheForcesOfTheWhole) {
  Body whole = box(GetParam(), true, world), quarter = box(GetParam(), false, world);
  if (GetParam().families == FamilyKind::stencil) {
    EXPECT_EQ(quarter.domain.families.lattices.size(), 1U);
  }
  for (Body* body : {&whole, &quarter}) {
    deform(*body, [](const Vector& X) -> Vector { return X + field(X, GetParam().size); });
    advance_stress_and_force(*body, 1, true);
  }
  const auto force = [](const Body& body) { return [&body](int i) { return body.force_density[i]; }; };
  EXPECT_LT(difference(by_id(quarter, force(quarter)), by_id(whole, force(whole))), GetParam().tolerance);
  const Energies a = stored_energies(quarter), b = stored_energies(whole);
  EXPECT_NEAR(4 * a.elastic, b.elastic, GetParam().tolerance * b.elastic);
  EXPECT_NEAR(4 * a.stabilization, b.stabilization, 1e-9 * b.elastic);
}

TEST_P(Mirrored, HasTheTangentOfTheWhole) {
  Body whole = box(GetParam(), true, world), quarter = box(GetParam(), false, world);
  const auto product = [](Body& body) {
    const std::vector<Vector> result = operator_on(body, [&](int i) { return field(body.domain.reference(i), 1); });
    return [result](int i) { return result[i]; };
  };
  EXPECT_LT(difference(by_id(quarter, product(quarter)), by_id(whole, product(whole))), round_off);
}

const BlockMaterial by_mean{1000, elastic(1e9, 0.3), MeanGradientStabilization{0.1}},
    by_silling{1000, elastic(1e9, 0.3), SillingStabilization{0.1}},
    ordinary{1000, elastic(1e9, 0.3), NoStabilization(), Formulation::ordinary},
    quadratic{1000, elastic(1e9, 0.3), NoStabilization(), Formulation::quadratic};

INSTANTIATE_TEST_SUITE_P(
    By, Mirrored,
    testing::Values(Case{"MeanGradient", by_mean}, Case{"Silling", by_silling},
                    Case{"MeanGradientOnALattice", by_mean, FamilyKind::stencil, 3.015, Influence::cubic_decay},
                    Case{"SillingOnALattice", by_silling, FamilyKind::stencil, 2.01},
                    Case{"Ordinary", ordinary, FamilyKind::lists, 3.015, Influence::linear_decay},
                    Case{"Quadratic", quadratic, FamilyKind::lists, 1.75, Influence::one, 1e-6, 1e-6}),
    [](const auto& info) { return info.param.name; });

// At 180°/n images of a wedge fill the space around its edge once; at other angles they overlap.
TEST(Images, FillSpaceOnce) {
  const auto images = [](double angle) {
    const Mirror first{.normal = Vector::UnitY()}, second{.normal = Vector(std::sin(angle), -std::cos(angle), 0)};
    const Eigen::AlignedBox3d box(Vector(0.1, 0, 0), Vector(1, 1, 1));
    return Images({first, second}, {box, box}, 10).count();
  };
  for (const int n : {2, 3, 4, 6}) EXPECT_EQ(images(std::numbers::pi / n), 2 * n) << n;
  EXPECT_THROW(images(1), Error);
}

// Each of two parallel planes has the bonds across it: where a body between two is strained at one of them only, this
// is the sum of the internal forces, as bonds within the body give nothing to it.
TEST(MirrorForces, OfParallelPlanesAreThoseOfTheBondsAcross) {
  const Communicator world;
  for (const BlockMaterial& material : {by_mean, by_silling, ordinary, quadratic}) {
    LatticeSpec spec;
    spec.cells = {3, 4, 9};
    BlockBonds bonds(1.75);
    bonds.families = FamilyKind::lists;
    const std::vector<Mirror> mirrors{{.normal = Vector::UnitX(), .number = 0},
                                      {.normal = Vector::UnitZ(), .number = 1},
                                      {.on = Vector(0, 0, 9), .normal = -Vector::UnitZ(), .number = 2}};
    Body body = make_body(make_domain(partitioned(lattice_cloud(spec, world), world), {bonds}, world, {}, mirrors),
                          Influence::one, {material});
    deform(body, [](const Vector& X) -> Vector {
      return X[2] > 3 ? X : Vector(X + 1e-3 * Vector(std::sin(X[1]) * X[0], X[0] * X[2], 1 + std::cos(X[0])));
    });
    advance_stress_and_force(body, 1, false);
    std::vector<Vector> forces = mirror_forces(body);
    Vector whole = Vector::Zero();
    for (int i = 0; i < body.owned(); ++i) whole += body.domain.volume(i) * body.force_density[i];
    forces.push_back(whole);
    world.sum(std::span(forces[0].data(), 12));
    whole = forces.back();
    EXPECT_GT(std::abs(whole[2]), 1e5);
    // Round-off of strains of 1e-3, and of sums over a hundred points.
    EXPECT_NEAR(forces[0][0], whole[0], 1e-11 * whole.norm());
    EXPECT_NEAR(forces[1][2], whole[2], 1e-11 * whole.norm());
    EXPECT_LT(forces[2].norm(), 1e-11 * whole.norm());
  }
}

}  // namespace
}  // namespace strut
