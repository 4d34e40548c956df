// Time per point of one constitutive step, as the loop over the points of a block makes it.
// Sample run: bench_materials --benchmark_repetitions=7 --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "../contract/laws.hpp"
#include "materials/laws.hpp"
#include "materials/spectral.hpp"
#include "materials/tangent.hpp"

namespace {

using namespace strut;
using namespace strut::materials;

constexpr int points = 4096;   // half a megabyte: in cache, so that the law is timed and not the memory
constexpr double dt = 1e-8;    // s
constexpr double bulk = 90e9;  // Pa, copper
constexpr double shear = 42e9;
constexpr double yield_stress = 50e6;

const J2 power_law{bulk, shear, {yield_stress, PowerHardening{0.00218, 0.1}, PowerRate{1e-3, 0.01}}};
const J2 linear_law{bulk, shear, {yield_stress, LinearHardening{100e6}, NoRate{}}};
const J2 johnson_cook{bulk, shear, {90e6, LudwikHardening{292e6, 0.31}, JohnsonCookRate{1, 0.025}}};
const J2 table_law{
    bulk,
    shear,
    {yield_stress, TableHardening{{0, 0.1, 0.3, 1.0}, {50e6, 90e6, 120e6, 140e6}}, JohnsonCookRate{1, 0.02}}};

// Deviatoric rates of the equivalent size `size`, each point in its own direction.
std::vector<Symmetric> random_rates(double size) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<Symmetric> rates(points);
  for (auto& rate : rates) {
    for (double& r : rate) r = normal(random);
    rate = deviator(rate);
    rate *= size / std::sqrt(2.0 / 3 * double_dot(rate, rate));
  }
  return rates;
}

// The points of a block, stepped once per call with all rates multiplied by `factor`, one by one.
template <Law L>
struct Block {
  const L law;
  std::vector<Symmetric> rates;
  std::vector<Symmetric> stress = std::vector<Symmetric>(points, Symmetric::Zero());
  std::vector<typename L::State> state = std::vector<typename L::State>(points);

  bool advance(double factor) {
    bool converged = true;
    for (int i = 0; i < points; ++i) {
      const auto [next, good] = law.step({factor * rates[i], dt, 1.0, spherical(1)}, stress[i], state[i]);
      stress[i] = next;
      converged &= good;
    }
    return converged;
  }
};

// The same side by side.
template <Law L>
struct LaneBlock {
  static constexpr int width = small::lane_count, groups = points / width;
  const L law;
  std::vector<SymmetricOf<RawLanes>> rates;
  std::vector<SymmetricOf<RawLanes>> stress = std::vector<SymmetricOf<RawLanes>>(groups, SymmetricOf<RawLanes>{});
  std::vector<typename L::template StateOf<RawLanes>> state{groups};

  LaneBlock(const L& l, const std::vector<Symmetric>& of_points) : law(l), rates(groups) {
    for (int i = 0; i < points; ++i) {
      for (int k = 0; k < 6; ++k) rates[i / width][k][i % width] = of_points[i][k];
    }
  }

  bool advance(double factor) {
    bool converged = true;
    for (int g = 0; g < groups; ++g) {
      StepOf<RawLanes> step{rates[g], same<RawLanes>(dt), same<RawLanes>(1), {}};
      for (int k = 0; k < 6; ++k) step.rate[k] *= factor;
      const auto [next, good] = law.step(step, stress[g], state[g]);
      stress[g] = next;
      converged &= !any(!good);
    }
    return converged;
  }
};

// Each call follows the table of factors round and round.
template <class Block>
void time(benchmark::State& run, Block&& block, const std::vector<double>& factors) {
  std::size_t turn = 0;
  for (auto _ : run) {
    if (!block.advance(factors[turn++ % factors.size()])) run.SkipWithError("a step did not converge");
  }
  run.counters["time_per_point"] = benchmark::Counter(points * static_cast<double>(run.iterations()),
                                                      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// There and back below the yield stress.
const std::vector<double> back_and_forth{1, 1, -1, -1};
// Flow at a rate that changes by about 2 % or 20 % from step to step: the last rate is a guess and not the answer.
const std::vector<double> steady{1.0, 1.02, 1.05, 1.06, 1.04, 1.02, 0.99, 0.98};
const std::vector<double> unsteady{1.0, 1.1, 0.95, 0.8, 0.9, 1.05, 1.2, 1.0};

template <template <Law> class Block>
void elastic(benchmark::State& run) {
  time(run, Block<Elastic>{{bulk, shear}, random_rates(1e3)}, back_and_forth);
}

template <template <Law> class Block>
void j2_below_yield(benchmark::State& run) {
  time(run, Block<J2>{power_law, random_rates(1e3)}, back_and_forth);
}

// Hardened by one per cent of strain, then back and forth under the flow stress, above the first yield stress.
template <template <Law> class Block>
void j2_hardened_elastic(benchmark::State& run) {
  Block<J2> block{power_law, random_rates(1e4)};
  for (int i = 0; i < 100; ++i) block.advance(1);
  for (auto& rate : block.rates) {
    for (int k = 0; k < 6; ++k) rate[k] /= 100;
  }
  block.advance(-120);
  time(run, block, back_and_forth);
}

template <template <Law> class Block, Law L>
void flow(benchmark::State& run, const L& law, const std::vector<double>& factors) {
  Block<L> block{law, random_rates(1e4)};
  for (int i = 0; i < 20; ++i) block.advance(1);
  time(run, block, factors);
}

// Every other step relaxes under a falling rate: the flow jumps by orders of magnitude from step to step.
const std::vector<double> jerky{-0.5, 1.0};

// The foam goes by the stretch. Each call makes the same step again from the same states: one in the elastic range, one
// that flows by 1e-4 of strain in each point's own direction, as explicit steps of a crushed foam do.
void polymer_foam(benchmark::State& run, double crushed, double more) {
  const PolymerFoam law = testing::Polyurethane::hardening();
  const std::vector<Symmetric> directions = random_rates(1);
  std::vector<PointStep> steps;
  std::vector<Symmetric> stress;
  std::vector<PolymerFoam::State> states;
  for (const Symmetric& direction : directions) {
    const Symmetric crush = spherical(-0.1) + 0.1 * direction;
    const Symmetric old = exponential(crushed * crush), next = exponential((crushed + more) * crush);
    PolymerFoam::State state = law.virgin_state();
    stress.push_back(law.step(step_between(spherical(1), old, dt), Symmetric::Zero(), state).stress);
    states.push_back(state);
    steps.push_back(step_between(old, next, dt));
  }
  for (auto _ : run) {
    for (int i = 0; i < points; ++i) {
      PolymerFoam::State state = states[i];
      const auto [next, converged] = law.step(steps[i], stress[i], state);
      if (!converged) run.SkipWithError("a step did not converge");
      benchmark::DoNotOptimize(state);
    }
  }
  run.counters["time_per_point"] = benchmark::Counter(points * static_cast<double>(run.iterations()),
                                                      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

template <template <Law> class Block>
void add_benches(const std::string& how) {
  benchmark::RegisterBenchmark((how + "/elastic").c_str(), elastic<Block>);
  benchmark::RegisterBenchmark((how + "/j2_below_yield").c_str(), j2_below_yield<Block>);
  benchmark::RegisterBenchmark((how + "/j2_hardened_elastic").c_str(), j2_hardened_elastic<Block>);
  const auto add = [&how]<Law L>(const std::string& name, const L& law, const std::vector<double>& factors) {
    benchmark::RegisterBenchmark((how + "/flow/" + name).c_str(), flow<Block, L>, law, factors);
  };
  add("power_hardening_power_rate", power_law, steady);
  add("power_hardening_power_rate_unsteady", power_law, unsteady);
  add("power_hardening_power_rate_jerky", power_law, jerky);
  add("linear_hardening_no_rate", linear_law, steady);
  add("table_hardening_johnson_cook_rate", table_law, steady);
  add("johnson_cook", johnson_cook, steady);  // the same cold, for the ratio
  for (const auto& [name, hot] : testing::thermal_flows()) add("hot_" + name, testing::hot_metal(hot), steady);
  const ThermalJ2 hot = testing::hot_metal(testing::thermal_flows().front().second);
  add("shock_mie_gruneisen", ShockJ2{hot, MieGruneisen{8930, 3940, 1.49, 2}}, steady);
}

BENCHMARK_CAPTURE(polymer_foam, elastic, 0.0, 0.005);
BENCHMARK_CAPTURE(polymer_foam, flow, 3.0, 0.0005);
BENCHMARK_CAPTURE(polymer_foam, flow_in_large_steps, 3.0, 0.5);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  add_benches<Block>("one_by_one");
  add_benches<LaneBlock>("side_by_side");
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
