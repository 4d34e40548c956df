// A metal that fails: closed forms of the criteria, and what it dissipates from then on.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contract/laws.hpp"
#include "materials/step_work.hpp"
#include "point_driver.hpp"

namespace strut::testing {
namespace {

using namespace materials;

constexpr double flow = 200e6, energy = 20e3, length = 1e-3;  // Pa, J/m², m: 20 MJ/m³, 50 times what is stored at yield

Ductile metal(FailureCriterion criterion, Hardening hardening = NoHardening{}, Rate rate = NoRate{}) {
  return {{bulk, shear, {flow, hardening, rate}}, {criterion, energy}, length};
}

using Step = bool (*)(point::Driver<Ductile>& point, double increment);

bool pull(point::Driver<Ductile>& point, double increment) { return point.advance_uniaxial_stress(increment, 1e-6); }
bool shear_point(point::Driver<Ductile>& point, double increment) {
  return point.advance_strain({0, 0, 0, increment * std::sqrt(0.75), 0, 0}, 1e-6);
}
bool push(point::Driver<Ductile>& point, double increment) { return pull(point, -increment); }

// The plastic strain at which the criterion is met, to a step of 1e-4.
double strain_at_failure(const Ductile& law, Step step) {
  point::Driver<Ductile> point(law);
  for (int n = 0; n < 20000 && point.state.indicator < 1; ++n) EXPECT_TRUE(step(point, 1e-4));
  return point.state.metal.equivalent_plastic_strain;
}

TEST(FailureCriterion, FailureStrain) {
  for (const Step step : {pull, shear_point, push}) {
    EXPECT_NEAR(strain_at_failure(metal(FailureStrain{0.3}), step), 0.3, 1e-4);
  }
}

// A tenth of what Johnson & Cook (1985) give for OFHC copper. Strains grow at 100 /s here; σ* is ⅓ in tension, 0 in
// shear, −⅓ in compression.
TEST(FailureCriterion, JohnsonCook) {
  JohnsonCookFailure copper{{0.054, 0.489, -3.03, 0.014}, 1e2};
  const auto strain = [](double triaxiality) { return 0.054 + 0.489 * std::exp(-3.03 * triaxiality); };
  EXPECT_NEAR(strain_at_failure(metal(copper), pull), strain(1.0 / 3), 2e-4);
  EXPECT_NEAR(strain_at_failure(metal(copper), shear_point), strain(0), 2e-4);
  EXPECT_NEAR(strain_at_failure(metal(copper), push), strain(-1.0 / 3), 2e-4);
  copper.reference_rate = 1;
  EXPECT_NEAR(strain_at_failure(metal(copper), pull), strain(1.0 / 3) * (1 + 0.014 * std::log(100)), 3e-4);
}

// In tension σ₁ is the flow stress, in shear a √3rd of it; in compression there is none.
TEST(FailureCriterion, CockcroftLatham) {
  const CockcroftLatham criterion{0.3 * flow};
  EXPECT_NEAR(strain_at_failure(metal(criterion), pull), 0.3, 2e-4);
  EXPECT_NEAR(strain_at_failure(metal(criterion), shear_point), 0.3 * std::sqrt(3), 2e-4);
  point::Driver<Ductile> point(metal(criterion));
  for (int n = 0; n < 1000; ++n) ASSERT_TRUE(push(point, 1e-3));
  EXPECT_LT(point.state.indicator, 1e-8);  // stress aside is nothing to 1e-10 of σ
}

TEST(FailureCriterion, LargestPrincipalStress) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1e8, 1e8);
  for (int n = 0; n < 200; ++n) {
    Symmetric stress;
    for (int c = 0; c < 6; ++c) stress[c] = number(random);
    const double exact = Eigen::SelfAdjointEigenSolver<Tensor>(to_tensor(stress)).eigenvalues()[2];
    EXPECT_NEAR(CockcroftLatham::largest_principal(stress), exact, 1e-6 * 1e8);  // of the cosine's round-off the root
  }
}

struct Failed {
  double dissipated = 0, strain = 0;  // from where the criterion was met, J/m³
};

Failed fail(const Ductile& law, Step step, double increment) {
  point::Driver<Ductile> point(law);
  while (point.state.indicator < 1) EXPECT_TRUE(step(point, increment));
  const auto start = point.state;
  for (int n = 0; n < 100000 && point.state.damage < 1; ++n) {
    if (!step(point, increment)) break;
  }
  EXPECT_EQ(point.state.damage, 1);
  EXPECT_EQ(point.stress.norm(), 0);
  return {law.dissipation(point.state) - law.dissipation(start),
          point.state.metal.equivalent_plastic_strain - start.metal.equivalent_plastic_strain};
}

// However it hardens and is strained. The last part W L/(2 G_c) of x falls at once, and a step ends beyond it.
TEST(Ductile, DissipatesTheFractureEnergy) {
  const std::vector<std::pair<Hardening, Rate>> kinds = {
      {NoHardening{}, NoRate{}}, {LinearHardening{500e6}, NoRate{}}, {VoceHardening{100e6, 8}, PowerRate{1e2, 0.1}}};
  for (const auto& [hardening, rate] : kinds) {
    for (const Step step : {shear_point, pull, push}) {
      const Failed failed = fail(metal(FailureStrain{0.1}, hardening, rate), step, 1e-5);
      EXPECT_NEAR(failed.dissipated, energy / length, 0.02 * energy / length);
    }
  }
}

// With perfect plasticity stress falls linearly, to nothing at 2 G_c/(σ_y L) if nothing were stored.
TEST(Ductile, FallsLinearly) {
  Ductile law = metal(FailureStrain{0.1});
  law.length = 1e-5;  // 2 GJ/m³, beside which what is stored is nothing
  law.ductility.fracture_energy = 200;
  const double whole = 2 * law.ductility.fracture_energy / law.length / flow;
  point::Driver<Ductile> point(law);
  while (point.state.indicator < 1) ASSERT_TRUE(shear_point(point, 1e-5));
  const double start = point.state.metal.equivalent_plastic_strain;
  while (von_mises(point.stress) > 0.2 * flow) {
    ASSERT_TRUE(shear_point(point, 1e-5));
    const double part = (point.state.metal.equivalent_plastic_strain - start) / whole;
    ASSERT_NEAR(von_mises(point.stress) / flow, 1 - part, 0.02);
  }
}

// A softened point still resists compression as a whole metal does, and takes up tension as it is.
TEST(Ductile, ClosesInCompression) {
  point::Driver<Ductile> point(metal(FailureStrain{0.1}));
  while (point.state.damage < 0.5) ASSERT_TRUE(shear_point(point, 1e-4));
  const double x = 1 - point.state.damage, start = trace(point.stress) / 3;
  ASSERT_TRUE(point.advance_strain(spherical(-1e-4), 1e-6));
  EXPECT_NEAR(trace(point.stress) / 3 - start, -3e-4 * bulk, 1e-6 * bulk * 3e-4);
  for (int n = 0; n < 2; ++n) ASSERT_TRUE(point.advance_strain(spherical(1e-4), 1e-6));
  EXPECT_NEAR(trace(point.stress) / 3, x * 3e-4 * bulk, 0.02 * bulk * 3e-4 * x);
}

TEST(Ductile, WorkIsStoredOrDissipated) {
  const Ductile law = metal(FailureStrain{0.05}, LinearHardening{500e6});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int path = 0; path < 20; ++path) {
    Ductile::State state;
    Symmetric stress = Symmetric::Zero(), direction;
    double work = 0;
    for (int n = 0; n < 4000 && state.damage < 1; ++n) {
      if (n % 500 == 0) {
        for (int c = 0; c < 6; ++c) direction[c] = number(random);
        direction = deviator(direction);
      }
      const PointStep step{1e-4 * direction / 1e-6, 1e-6, 1, spherical(1)};
      const Symmetric before = stress;
      const auto [next, converged] = law.step(step, stress, state);
      ASSERT_TRUE(converged);
      stress = next;
      work += step_work(step, old_determinant(step), before, stress);
    }
    EXPECT_GT(state.damage, 0);
    EXPECT_NEAR(work, law.elastic_energy(stress, state) + law.dissipation(state), 2e-3 * work);
  }
}

TEST(Ductile, WithoutAnEnergyItFailsAtOnce) {
  Ductile law = metal(FailureStrain{0.1});
  law.ductility.fracture_energy = 0;
  point::Driver<Ductile> point(law);
  while (point.state.indicator < 1) ASSERT_TRUE(shear_point(point, 1e-4));
  EXPECT_GT(von_mises(point.stress), 0.9 * flow);
  ASSERT_TRUE(shear_point(point, 1e-4));
  EXPECT_EQ(point.stress.norm(), 0);
  EXPECT_EQ(law.moduli(point.state).bulk, 0);
}

// A point that softens beside others, one per SIMD lane: each gets the bits that it gets among its like.
TEST(Ductile, DoesNotDependOnWhoIsBesideIt) {
  const Ductile law = metal(JohnsonCookFailure{{0.01, 0.03, -1.5, 0.02}, 1}, VoceHardening{100e6, 8});
  using Lanes = RawLanes;
  struct Group {
    SymmetricOf<Lanes> stress{};
    Ductile::StateOf<Lanes> state{};
  };
  const auto advance = [&law](Group& group, const std::array<Symmetric, small::lane_count>& strains) {
    StepOf<Lanes> step{};
    for (int l = 0; l < small::lane_count; ++l) {
      for (int c = 0; c < 6; ++c) step.rate[c][l] = strains[l][c] / 1e-6, step.stretch[c][l] = c < 3;
      step.dt[l] = 1e-6, step.J[l] = 1;
    }
    const auto [stress, converged] = law.step(step, group.stress, group.state);
    for (int l = 0; l < small::lane_count; ++l) ASSERT_TRUE(converged[l]);
    group.stress = stress;
  };
  Group beside;
  std::array<Group, small::lane_count> alike;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1, 1);
  bool softened = false, failed = false;
  for (int n = 0; n < 3000; ++n) {
    std::array<Symmetric, small::lane_count> strains;
    for (int l = 0; l < small::lane_count; ++l) {
      for (int c = 0; c < 6; ++c) strains[l][c] = 1e-4 * (l + 1) * number(random);
      strains[l] = deviator(strains[l]);
      strains[l][3] += 2e-5 * l;
    }
    advance(beside, strains);
    for (int l = 0; l < small::lane_count; ++l) {
      std::array<Symmetric, small::lane_count> same;
      same.fill(strains[l]);
      advance(alike[l], same);
      for (int c = 0; c < 6; ++c) ASSERT_EQ(beside.stress[c][l], alike[l].stress[c][l]);
      ASSERT_EQ(beside.state.damage[l], alike[l].state.damage[l]);
      ASSERT_EQ(beside.state.metal.plastic_work[l], alike[l].state.metal.plastic_work[l]);
      softened = softened || (beside.state.damage[l] > 0 && beside.state.damage[l] < 1);
      failed = failed || beside.state.damage[l] == 1;
    }
  }
  EXPECT_TRUE(softened && failed);
}

}  // namespace
}  // namespace strut::testing
