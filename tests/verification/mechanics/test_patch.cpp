// An affine deformation must be seen as it is: by every influence function, on a lattice and on a perturbed one, at
// surfaces too.
#include <gtest/gtest.h>

#include <tuple>

#include "verification/lattice.hpp"

namespace strut {
namespace {

Tensor small_affine() {
  Tensor F;
  F << 1.002, 0.003, -0.001, 0.0005, 0.998, 0.002, -0.0015, 0.001, 1.001;
  return F;
}

using Case = std::tuple<Influence, double, bool>;  // influence, perturbation, stabilized by the mean gradient

class Patch : public testing::TestWithParam<Case> {
 protected:
  Communicator world;
  LatticeSpec spec = [] {
    const auto [influence, perturbation, by_mean] = GetParam();
    LatticeSpec spec{{7, 8, 9}, 1e-3, 3.015, perturbation, influence, {1000, elastic(1e9, 0.3)}};
    spec.material.stabilization = SillingStabilization{0.02};
    if (by_mean) spec.material.stabilization = MeanGradientStabilization{0.02};
    return spec;
  }();
  Body body = lattice_body(spec, world);
};

TEST(LargestOver, IsNoNumberWhereOneIs) {  // so that no limit holds for a body that blew up
  const Communicator world;
  const Body body = lattice_body({.cells = {3, 3, 3}, .material = {1000, elastic(1e9, 0.3)}}, world);
  const double largest = largest_over(body, [&](int i) { return i == 0 ? NAN : i; });
  EXPECT_EQ(std::isnan(largest), body.owned() > 0);
}

// K is well conditioned here (condition below 10), so F carries some tens of units of round-off.
constexpr double round_off = 1e-13;

TEST_P(Patch, DeformationGradientIsExact) {
  const Tensor F = small_affine();
  deform(body, [&](const Vector& X) -> Vector { return F * X + Vector(1, 2, 3); });
  const StepReport report = advance_stress_and_force(body, 1e-6, true);
  EXPECT_FALSE(report.failure);
  // A shift by 1 m costs three digits beside a lattice of 1 mm.
  EXPECT_LT(largest_over(body, [&](int i) { return (body.points[i].deformation_gradient - F).norm(); }),
            1e3 * round_off);
}

TEST_P(Patch, StressIsHookes) {
  const Tensor F = small_affine();
  deform(body, [&](const Vector& X) -> Vector { return F * X; });
  advance_stress_and_force(body, 1e-6, true);
  // One step from rest: d dt = sym(ΔU U_mid⁻¹) up to the third order in the strain of 5e-3.
  const Symmetric e = symmetric_part(F) - spherical(1);
  const auto& law = std::get<materials::Elastic>(spec.material.law);
  const Symmetric hooke = 2 * law.shear * e + spherical((law.bulk - 2 * law.shear / 3) * trace(e));
  // Small-strain Hooke against the midpoint rule: they differ in the second order, 5e-3² of E at the most.
  EXPECT_LT(largest_over(body, [&](int i) { return (body.points[i].stress - hooke).norm(); }), 2.5e-5 * 1e9);
  // All points see the same stress to round-off.
  Symmetric first = body.owned() > 0 ? body.points[0].stress : Symmetric::Zero();
  EXPECT_LT(largest_over(body, [&](int i) { return (body.points[i].stress - first).norm(); }), 1e-10 * 1e9);
}

TEST_P(Patch, StabilizationHasNoPart) {
  const Tensor F = small_affine();
  deform(body, [&](const Vector& X) -> Vector { return F * X; });
  advance_stress_and_force(body, 1e-6, true);
  // ½ C Σ ω V |η|² is the size of the two sums whose difference is the energy.
  const double scale = 0.02 * 1e9;
  EXPECT_LT(largest_over(body, [&](int i) { return std::abs(body.stabilization_work(i)); }), round_off * scale);
}

TEST_P(Patch, UniformStressExertsNoForceInsideALattice) {
  if (std::get<1>(GetParam()) > 0) GTEST_SKIP() << "families differ from point to point on a perturbed lattice";
  spec.cells = {14, 14, 14};
  body = lattice_body(spec, world);
  const Tensor F = small_affine();
  deform(body, [&](const Vector& X) -> Vector { return F * X; });
  advance_stress_and_force(body, 1e-6, false);
  // A point feels the families of its neighbors: two reaches from the surface all is uniform.
  const auto is_inside = [&](int i) { return is_deep(spec, body.domain.reference(i), 2 * 3.015); };
  std::int64_t inside = 0;
  for (int i = 0; i < body.owned(); ++i) inside += is_inside(i);
  EXPECT_EQ(world.sum(inside), 8);
  const auto force = [&](bool deep) {
    return largest_over(body, [&](int i) { return is_inside(i) == deep ? body.force_density[i].norm() : 0.0; });
  };
  EXPECT_LE(force(true), 1e-10 * force(false));
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  constexpr const char* influences[] = {"One", "LinearDecay", "CubicDecay"};
  return std::string(influences[static_cast<int>(std::get<0>(info.param))]) +
         (std::get<1>(info.param) > 0 ? "Perturbed" : "Lattice") + (std::get<2>(info.param) ? "ByMeanGradient" : "");
}

INSTANTIATE_TEST_SUITE_P(Influences, Patch,
                         testing::Combine(testing::Values(Influence::one, Influence::linear_decay,
                                                          Influence::cubic_decay),
                                          testing::Values(0.0, 0.2), testing::Bool()),
                         name_of);

TEST(Shape, StepOfALargeAffineDeformationIsExactInOneOrManySteps) {
  // A stretch without rotation: strain in the unrotated frame is the logarithm; the midpoint rule is second order.
  const Communicator world;
  LatticeSpec spec{{6, 6, 6}, 1.0, 2.015, 0, Influence::one, {1000, elastic(1e9, 0.0)}};
  const auto error = [&](int steps) {
    Body body = lattice_body(spec, world);
    for (int n = 1; n <= steps; ++n) {
      const double stretch = 1 + 0.5 * n / steps;
      deform(body, [&](const Vector& X) -> Vector { return Vector(stretch * X[0], X[1], X[2]); });
      advance_stress_and_force(body, 1.0 / steps, false);
    }
    return largest_over(body, [&](int i) { return std::abs(body.points[i].stress[0] / 1e9 - std::log(1.5)); });
  };
  const double coarse = error(4), fine = error(8);
  EXPECT_LT(fine, 2e-4);
  EXPECT_NEAR(coarse / fine, 4, 0.2);  // order 2, up to the next term
}

}  // namespace
}  // namespace strut
