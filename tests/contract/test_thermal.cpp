// Metals that heat: flow stresses beside their printed formulas, closed forms of heating, and the Hugoniot.
#include <gtest/gtest.h>

#include <cmath>

#include "contract/laws.hpp"
#include "formulas.hpp"
#include "point_driver.hpp"

namespace strut::testing {
namespace {

using namespace materials;

constexpr double strains[] = {3e-5, 1.1e-3, 0.017, 0.13, 0.41, 1.7};
constexpr double strain_rates[] = {2e-4, 0.3, 40, 3e3, 5e6};
constexpr double temperatures[] = {77, 250, 294, 500, 900, 1300};

// σ̄ of a flow stress at one place; the threshold is that of a metal that has been strained before.
template <class Flow>
FlowStress::Value<double> value_of(const Flow& flow, double temperature, double strain, double rate) {
  ThermalState<double> state;
  state.temperature = temperature, state.threshold = 150e6;
  state.equivalent_plastic_strain = strain;
  const auto now = flow.at(state, Symmetric(Symmetric::Zero()));
  return now.at_rate(rate, now.at_rest(strain));
}

TEST(ThermalFlow, IsThePrintedFormula) {
  for (const auto& [name, flow] : thermal_flows()) {
    for (const double T : temperatures) {
      for (const double strain : strains) {
        for (const double rate : strain_rates) {
          const double printed =
              std::visit([&](const auto& law) { return printed_flow_stress(law, strain, rate, T, 150e6); }, flow);
          const double here = std::visit([&](const auto& law) { return value_of(law, T, strain, rate).stress; }, flow);
          // Powers of numbers near 1 lose a digit or two.
          EXPECT_NEAR(here, printed, 1e-12 * printed) << name << " " << T << " " << strain << " " << rate;
        }
      }
    }
  }
}

// Central differences over ± 1e-5 x, as in test_flow_stress.cpp; away from kinks.
TEST(ThermalFlow, RateSlopesAreThoseOfTheValue) {
  for (const auto& [name, flow] : thermal_flows()) {
    for (const double T : temperatures) {
      for (const double rate : strain_rates) {
        const auto at = [&](double r) {
          return std::visit([&](const auto& law) { return value_of(law, T, 0.13, r); }, flow);
        };
        const double slope = (at(rate * (1 + 1e-5)).stress - at(rate * (1 - 1e-5)).stress) / (2e-5 * rate);
        EXPECT_NEAR(at(rate).by_rate, slope, 1e-8 * at(rate).stress / rate) << name << " " << T << " " << rate;
      }
    }
  }
}

TEST(ThermalFlow, NothingIsLeftWhereItMelts) {
  const JohnsonCookSoftening softening{294, 1356, 1.09};
  EXPECT_EQ(softening(1356.0), 0);
  EXPECT_EQ(softening(2000.0), 0);
  EXPECT_EQ(softening(294.0), 1);
  EXPECT_EQ(softening(20.0), 1);
}

ThermalJ2 perfect(double capacity) {
  const SoftenedFlow flow{{200e6, NoHardening{}, NoRate{}}, JohnsonCookSoftening{300, 1300, 1}};
  return {.bulk = bulk, .shear = shear, .flow = flow, .heating = {capacity, 0.9, 300}};
}

bool shear_point(auto& point, double increment) {
  return point.advance_strain({0, 0, 0, increment * std::sqrt(0.75), 0, 0}, 1e-6);
}

// With m = 1 and without hardening: dT/dε̄ = β σ₀ θ/(ρ c_p), so σ̄ = σ₀ exp(−ε̄/ε_c), ε_c = ρ c_p (T_m − T_r)/(β σ₀).
TEST(ThermalJ2, SoftensByItsOwnHeat) {
  const double capacity = 3.4e5, scale = capacity * 1000 / (0.9 * 200e6);
  point::Driver<ThermalJ2> point(perfect(capacity));
  for (int n = 0; n < 20000; ++n) ASSERT_TRUE(shear_point(point, 1e-4));
  const double theta = std::exp(-point.state.equivalent_plastic_strain / scale);
  EXPECT_LT(theta, 0.4);
  // First order in the step, whose heat is 1e-4/scale of what melts it.
  EXPECT_NEAR(von_mises(point.stress), 200e6 * theta, 1e-4 * 200e6 * theta);
  EXPECT_NEAR(point.state.temperature, 1300 - 1000 * theta, 0.1);
  EXPECT_NEAR(point.law().heat(point.state), 0.9 * point.state.plastic_work, 1e-10 * point.state.plastic_work);
}

TEST(ThermalJ2, WithoutHeatingItStaysAsWarmAsItIs) {
  ThermalJ2 law = perfect(0);
  law.set_initial_temperature(800);
  point::Driver<ThermalJ2> point(law);
  for (int n = 0; n < 100; ++n) ASSERT_TRUE(shear_point(point, 1e-3));
  EXPECT_EQ(point.state.temperature, 800);
  EXPECT_NEAR(von_mises(point.stress), 100e6, 1e-3);
}

// The elastic strain stays as the shear modulus falls, and the work is stored, or has been dissipated.
TEST(ThermalJ2, TheShearModulusFalls) {
  ThermalJ2 law = perfect(3.4e5);
  law.shear_fall = 4e-4, law.shear_reference = 300;
  point::Driver<ThermalJ2> point(law);
  double work = 0;
  for (int n = 0; n < 6000; ++n) {
    const Symmetric before = point.stress, old = point.strain;
    ASSERT_TRUE(shear_point(point, 1e-4));
    work += 0.5 * double_dot(Symmetric(before + point.stress), Symmetric(point.strain - old));
  }
  const double left = 1 - 4e-4 * (point.state.temperature - 300);
  EXPECT_LT(left, 0.9);
  EXPECT_NEAR(law.shear_modulus(point.state), shear * left, 1e-9 * shear);
  const double elastic = von_mises(point.stress) / (3 * shear * left);
  EXPECT_NEAR(std::sqrt(4.0 / 3) * point.strain[3], point.state.equivalent_plastic_strain + elastic, 2e-5);
  // Half of the part by which the modulus falls in a step, 1e-5: the stress falls after the flow.
  EXPECT_NEAR(law.elastic_energy(point.stress, point.state) + law.dissipation(point.state), work, 2e-5 * work);
  law.set_initial_temperature(800);
  EXPECT_NEAR(law.moduli().shear, 0.8 * shear, 1e-9 * shear);
}

// At a constant rate, with y = α σ̂/σ̂_s and t = tanh α: ε̄ α θ₀/σ̂_s = (t² y + t ln(cosh y − sinh y/t))/(t² − 1).
TEST(MechanicalThreshold, HardensToSaturation) {
  ThermalJ2 law = hot_metal(thermal_flows().back().second);
  law.heating.capacity = 0, law.heating.initial = 600;
  const auto& flow = std::get<MechanicalThreshold>(law.flow);
  point::Driver<ThermalJ2> point(law);
  for (int n = 0; n < 20000; ++n) ASSERT_TRUE(shear_point(point, 2e-5));
  const double rate = point.state.plastic_strain_rate, mu = 47.7e9 - 3e9 / (std::exp(0.3) - 1);
  const double limit = 770e6 * std::pow(rate / 1e7, 0.823e6 * 600 / (0.2625 * mu));
  const double theta = flow.slopes[0] + flow.slopes[1] * std::log(rate) + flow.slopes[2] * std::sqrt(rate);
  const double t = std::tanh(2), y = 2 * point.state.threshold / limit;
  const double strain = limit / (2 * theta) * (t * t * y + t * std::log(std::cosh(y) - std::sinh(y) / t)) / (t * t - 1);
  EXPECT_GT(y, 1);
  // The rate settles in the first steps; then first order in a step of 2e-5 of a strain of 0.4.
  EXPECT_NEAR(point.state.equivalent_plastic_strain, strain, 1e-3 * strain);
}

// Above some 2800 K the fit of the shear modulus of copper is negative.
TEST(MechanicalThreshold, FlowsAtTheAthermalStressWhereItIsFarTooHot) {
  ThermalJ2 law = hot_metal(thermal_flows().back().second);
  law.heating.capacity = 0;
  const double athermal = std::get<MechanicalThreshold>(law.flow).athermal;
  for (const double threshold : {0.0, 100e6}) {
    for (double T = 1300; T < 6000; T += 50) {
      law.heating.initial = T;
      point::Driver<ThermalJ2> point(law);
      point.state.threshold = threshold;
      for (int n = 0; n < 50; ++n) ASSERT_TRUE(shear_point(point, 1e-4)) << T;
      // Round-off of the return to the flow stress.
      EXPECT_GE(von_mises(point.stress), (1 - 1e-9) * athermal) << T;
      EXPECT_LE(von_mises(point.stress), (T > 2900 ? 1 + 1e-9 : 3) * athermal) << T;
    }
  }
}

// ---- Failure --------------------------------------------------------------------------------------------------------

TEST(JohnsonCookFailure, AHotMetalIsMoreDuctile) {
  ThermalJ2 metal = perfect(0);
  const JohnsonCookFailure criterion{{0.1, 0, 0, 0, 2}, 1, 300, 1300};
  for (const double T : {300.0, 800.0}) {
    metal.set_initial_temperature(T);
    point::Driver<ThermalDuctile> point(ThermalDuctile{metal, {criterion, 20e3}, 1e-3});
    while (point.state.indicator < 1) ASSERT_TRUE(shear_point(point, 1e-4));
    EXPECT_NEAR(point.state.metal.equivalent_plastic_strain, 0.1 * (1 + 2 * (T - 300) / 1000), 2e-4);
  }
}

TEST(ThermalDuctile, HeatsByWhatItDissipatesAsItFails) {
  point::Driver<ThermalDuctile> point(ThermalDuctile{perfect(3.4e7), {FailureStrain{0.1}, 20e3}, 1e-3});
  while (point.state.damage < 1) ASSERT_TRUE(shear_point(point, 1e-4));
  EXPECT_NEAR(point.law().heat(point.state), 0.9 * point.law().dissipation(point.state),
              1e-9 * point.law().dissipation(point.state));
}

// ---- Shock ----------------------------------------------------------------------------------------------------------

constexpr double density = 8930, sound = 3940, slope = 1.49, gamma_0 = 2;  // copper

ShockJ2 fluid(EquationOfState equation) {
  const SoftenedFlow flow{{1, NoHardening{}, NoRate{}}, NoSoftening{}};
  return {{.bulk = density * sound * sound, .shear = 1, .flow = flow, .heating = {density * 383, 0.9, 300}}, equation};
}

// A step that compresses at once does the work ½ p (1 − v): then p is that of the Hugoniot, p_H = ρ₀ c₀² x/(1 − s x)².
TEST(ShockJ2, OneStepOfCompressionReachesTheHugoniot) {
  const ShockJ2 law = fluid(MieGruneisen{density, sound, slope, gamma_0});
  for (const double x : {0.01, 0.05, 0.15, 0.3}) {
    ShockJ2::State state = law.virgin_state();
    const double d = 2 * (1 - x - 1) / (1 - x + 1);  // (1 + d/2)/(1 − d/2) = v
    const PointStep step{{d, 0, 0, 0, 0, 0}, 1, 1 - x, spherical(1)};
    const auto [stress, converged] = law.step(step, Symmetric::Zero(), state);
    ASSERT_TRUE(converged);
    const double p = density * sound * sound * x / ((1 - slope * x) * (1 - slope * x));
    EXPECT_NEAR(-trace(stress) / 3, p, 1e-8 * p);  // shear has 1 Pa
    EXPECT_NEAR(state.energy, 0.5 * p * x, 1e-8 * p * x);
    EXPECT_NEAR(state.volume, 1 - x, 1e-14);
  }
}

// In small steps it follows the isentrope: c² = v (γ p − dp_c/dv) there, T = T₀ exp(Γ₀ x), and back it gives all.
TEST(ShockJ2, FollowsTheIsentropeAndBack) {
  const ShockJ2 law = fluid(MieGruneisen{density, sound, slope, gamma_0});
  point::Driver<ShockJ2> point(law);
  for (int n = 0; n < 1000; ++n) ASSERT_TRUE(point.advance_uniaxial_strain(-2e-4, 1e-6));
  const double x = 1 - std::exp(-0.2), before = -trace(point.stress) / 3;
  EXPECT_NEAR(point.state.volume, 1 - x, 1e-6);
  EXPECT_NEAR(point.state.temperature, 300 * std::exp(gamma_0 * x), 0.05);
  const double bulk_modulus = law.moduli(point.state).bulk, strain = 1e-6;
  ASSERT_TRUE(point.advance_uniaxial_strain(-strain, 1e-6));
  EXPECT_NEAR((-trace(point.stress) / 3 - before) / strain, bulk_modulus, 1e-4 * bulk_modulus);
  ASSERT_TRUE(point.advance_uniaxial_strain(strain, 1e-6));
  for (int n = 0; n < 1000; ++n) ASSERT_TRUE(point.advance_uniaxial_strain(2e-4, 1e-6));
  EXPECT_NEAR(point.state.energy, 0, 1e-6 * before);
  EXPECT_NEAR(trace(point.stress) / 3, 0, 1e-6 * before);
}

TEST(ShockJ2, TaitIsItsFormula) {
  const double K = 2.2e9, n = 7.15;
  const ShockJ2 law = fluid(Tait{K, n});
  point::Driver<ShockJ2> point(law);
  for (const double strain : {-0.1, 0.02}) {
    point = point::Driver<ShockJ2>(law);
    ASSERT_TRUE(point.advance_strain(spherical(strain / 3), 1e-6));
    const double v = point.state.volume;
    EXPECT_NEAR(v, std::exp(strain), 1e-4);  // third order of one step
    EXPECT_NEAR(-trace(point.stress) / 3, K / n * (std::pow(v, -n) - 1), 1e-6 * K);
  }
}

// All that is put in is stored, flowed away, or heat of the viscosity; the pressure bears that heat.
TEST(ShockJ2, EnergyIsWhatIsPutIn) {
  ShockJ2 law = fluid(MieGruneisen{density, sound, slope, gamma_0});
  law.metal.flow = SoftenedFlow{{200e6, LinearHardening{100e6}, NoRate{}}, JohnsonCookSoftening{300, 1300, 1}};
  law.metal.shear = shear;
  ShockJ2::State state = law.virgin_state();
  Symmetric stress = Symmetric::Zero();
  double viscous = 0, J = 1, work = 0;
  for (int n = 0; n < 2000; ++n) {
    const double d = (n / 500) % 2 == 0 ? -1e-4 : 0.8e-4, old_J = J;
    J *= (1 + 0.5 * d) / (1 - 0.5 * d);
    const Symmetric rate{d, 0, 0, 0.5 * d, 0, 0}, before = stress;
    PointStep step{rate, 1, J, spherical(1), d < 0 ? 1e4 : 0};
    const auto [next, converged] = law.step(step, stress, state);
    ASSERT_TRUE(converged);
    stress = next, viscous += step.viscous_work;
    work += 0.25 * (J + old_J) * double_dot(Symmetric(before + stress), rate);
  }
  EXPECT_GT(law.dissipation(state), 0.01 * work);
  EXPECT_NEAR(state.energy, work + viscous, 1e-5 * work);
  EXPECT_NEAR(law.stored_energy(state) + law.dissipation(state), work, 1e-5 * work);
}

// Denser than the Hugoniot can be: no stress is made up.
TEST(ShockJ2, SaysWhereTheHugoniotEnds) {
  const ShockJ2 law = fluid(MieGruneisen{density, sound, slope, gamma_0});
  ShockJ2::State state = law.virgin_state();
  const PointStep step{{-1.4, 0, 0, 0, 0, 0}, 1, 0.176, spherical(1)};
  EXPECT_FALSE(law.step(step, Symmetric::Zero(), state).converged);
  EXPECT_EQ(to_columns<ShockJ2>(state), to_columns<ShockJ2>(law.virgin_state()));
}

}  // namespace
}  // namespace strut::testing
