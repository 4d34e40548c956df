// One force evaluation of a lattice block, all passes: bonds, deformation, stress, force. Compare with the peers'
// figures for the same block (50³ points, horizon 3.015 spacings) in ns per directed bond and step.
//   build/release/tests/bench/bench_step --benchmark_repetitions=9 --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include "../verification/lattice.hpp"

namespace strut {
namespace {

// The third argument of a bench.
enum Model { elastic_correspondence, plastic_correspondence, ordinary, plastic_mean_gradient };

BlockMaterial copper(std::int64_t model) {
  const auto e = std::get<materials::Elastic>(elastic(110e9, 0.296));
  if (model == elastic_correspondence) return {8960, e, 0.02};
  if (model == ordinary) return {8960, e, 0, Formulation::ordinary};
  const materials::FlowStress flow{50e6, materials::PowerHardening{0.00218, 0.1}, materials::PowerRate{1e-3, 0.01}};
  const materials::J2 law{e.bulk, e.shear, flow};
  if (model == plastic_mean_gradient) return {8960, law, 0, Formulation::correspondence, 0.01};
  return {8960, law, 0.02};
}

// Arguments: points along an edge, horizon in thousandths of a spacing, model, whether the families are lists though the
// points sit on a lattice.
void step(benchmark::State& state) {
  const Communicator world;
  const int n = static_cast<int>(state.range(0));
  const LatticeSpec spec{{n, n, n}, 1e-3,           1e-3 * static_cast<double>(state.range(1)),
                         0,         Influence::one, copper(state.range(2)),
                         state.range(3) != 0 ? FamilyKind::lists : FamilyKind::stencil};
  Body body = lattice_body(spec, world);
  const double dt = 1e-7, rate = 1e4;  // a shear that keeps a plastic block flowing
  double shear = 0;
  for (auto _ : state) {
    state.PauseTiming();
    shear += rate * dt;
    deform(body, [&](const Vector& X) -> Vector { return {X[0] + shear * X[1], X[1], X[2]}; });
    state.ResumeTiming();
    benchmark::DoNotOptimize(advance_stress_and_force(body, dt, false).steepest);
  }
  const auto steps = static_cast<double>(state.iterations());
  const auto time_per = [](double count) {
    return benchmark::Counter(count, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  };
  state.counters["per_bond"] = time_per(steps * static_cast<double>(body.domain.families.bonds()));
  state.counters["per_point"] = time_per(steps * body.owned());
}

BENCHMARK(step)
    ->Args({50, 3015, elastic_correspondence, 1})
    ->Args({50, 3015, elastic_correspondence, 0})
    ->Args({50, 3015, plastic_correspondence, 1})
    ->Args({50, 3015, plastic_correspondence, 0})
    ->Args({27, 2015, plastic_correspondence, 1})
    ->Args({27, 2015, plastic_correspondence, 0})
    ->Args({50, 3015, ordinary, 1})
    ->Args({50, 3015, plastic_mean_gradient, 1})
    ->Args({50, 3015, plastic_mean_gradient, 0})
    ->Args({40, 6015, plastic_correspondence, 1})
    ->Args({40, 6015, plastic_correspondence, 0})
    ->Args({50, 1750, plastic_mean_gradient, 1})
    ->Args({50, 1750, plastic_mean_gradient, 0})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace strut

int main(int argc, char** argv) {
  strut::Runtime runtime(argc, argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
