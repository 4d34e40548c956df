// The flow stress of every hardening × rate: its value against the printed formulas, its derivatives against
// differences, and its lower bound.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "formulas.hpp"
#include "laws.hpp"

namespace strut::testing {
namespace {

using namespace materials;

struct NamedFlow {
  std::string name;
  FlowStress flow;
};
void PrintTo(const NamedFlow& flow, std::ostream* out) { *out << flow.name; }

std::vector<NamedFlow> flow_stresses() {
  std::vector<NamedFlow> all;
  for (const auto& [hardening_name, hardening] : hardenings()) {
    for (const auto& [rate_name, rate] : rates()) {
      all.push_back({hardening_name + "_" + rate_name, {yield_stress, hardening, rate}});
    }
  }
  return all;
}

class FlowStressTest : public ::testing::TestWithParam<NamedFlow> {
 protected:
  const FlowStress& flow() const { return GetParam().flow; }
};

// None of them is a kink of a table of laws.hpp or the reference rate of Johnson and Cook.
constexpr double strains[] = {3e-5, 1.1e-3, 0.017, 0.13, 0.41, 1.7};
constexpr double strain_rates[] = {2e-4, 0.3, 40, 3e3, 5e6};

TEST_P(FlowStressTest, IsThePrintedFormula) {
  for (const double strain : strains) {
    for (const double rate : strain_rates) {
      const double printed = printed_flow_stress(flow(), strain, rate);
      // A few operations on numbers whose logarithms stay below 25: round-off is below 1e-14.
      EXPECT_NEAR(flow()(strain, rate).stress, printed, 1e-13 * printed) << strain << " " << rate;
    }
  }
}

TEST_P(FlowStressTest, StartsAtTheYieldStress) { EXPECT_DOUBLE_EQ(flow()(0, 0).stress, yield_stress); }

// Central differences over ± 1e-5 x: truncation 1e-10 of x² σ̄‴ x, round-off 1e-16/1e-5 of σ̄; both below 1e-9 of σ̄/x.
TEST_P(FlowStressTest, DerivativesAreThoseOfTheValue) {
  for (const double strain : strains) {
    for (const double rate : strain_rates) {
      const auto [stress, by_strain, by_rate] = flow()(strain, rate);
      const double e = 1e-5 * strain, r = 1e-5 * rate;
      const double strain_slope = (flow()(strain + e, rate).stress - flow()(strain - e, rate).stress) / (2 * e);
      const double rate_slope = (flow()(strain, rate + r).stress - flow()(strain, rate - r).stress) / (2 * r);
      EXPECT_NEAR(by_strain, strain_slope, 1e-9 * stress / strain) << strain << " " << rate;
      EXPECT_NEAR(by_rate, rate_slope, 1e-9 * stress / rate) << strain << " " << rate;
    }
  }
}

// Newton starts there: Ludwik's slope would be infinite.
TEST_P(FlowStressTest, DerivativesAreFiniteAtTheStart) {
  const auto [stress, by_strain, by_rate] = flow()(0, 0);
  EXPECT_TRUE(std::isfinite(by_strain));
  EXPECT_TRUE(std::isfinite(by_rate));
}

TEST_P(FlowStressTest, GrowsWithTheRate) {
  const double rate_free = flow()(0.1, 0).stress;
  EXPECT_GE(flow()(0.1, 10).stress, rate_free);
  EXPECT_GE(flow()(0.1, 1e5).stress, flow()(0.1, 10).stress);
}

TEST_P(FlowStressTest, NeverFallsBelowZero) {
  EXPECT_GE(flow()(100, 0).stress, 0);
  EXPECT_GE(flow()(100, 1e5).stress, 0);
}

INSTANTIATE_TEST_SUITE_P(Table, FlowStressTest, ::testing::ValuesIn(flow_stresses()),
                         [](const auto& info) { return info.param.name; });

TEST(FlowStress, ARateExponentOfZeroIsNoRate) {
  const FlowStress free{yield_stress, PowerHardening{0.00218, 0.1}, NoRate{}};
  const FlowStress zero{yield_stress, PowerHardening{0.00218, 0.1}, PowerRate{1e-3, 0}};
  for (const double strain : strains) {
    // exp(0) is exactly 1, but a product of exponentials may be formed as one: a unit or two in the last place.
    EXPECT_DOUBLE_EQ(zero(strain, 1e4).stress, free(strain, 1e4).stress);
    EXPECT_EQ(zero(strain, 1e4).by_rate, 0);
  }
}

TEST(FlowStress, ATableIsConstantBeyondItsEnd) {
  const FlowStress flow{50e6, TableHardening{{0, 0.1}, {50e6, 80e6}}, NoRate{}};
  EXPECT_EQ(flow(0.1, 0).stress, 80e6);
  EXPECT_EQ(flow(5.0, 0).stress, 80e6);
  EXPECT_EQ(flow(5.0, 0).by_strain, 0);
}

}  // namespace
}  // namespace strut::testing
