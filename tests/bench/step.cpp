// One force evaluation of a lattice block, all passes: bonds, deformation, stress, force. Compare with the peers'
// figures for the same block (50³ points, horizon 3.015 spacings) in ns per directed bond and step.
//   build/release/tests/bench/bench_step --benchmark_repetitions=9 --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include "../verification/lattice.hpp"
#include "mechanics/kernels/lane_groups.hpp"
#include "textbook.hpp"

namespace strut {
namespace {

// The third argument of a bench.
enum Model {
  elastic_correspondence,
  plastic_correspondence,
  ordinary,
  plastic_mean_gradient,
  plastic_quadratic,
  quadratic_below_yield
};

BlockMaterial copper(std::int64_t model) {
  const auto e = std::get<materials::Elastic>(elastic(110e9, 0.296));
  if (model == elastic_correspondence) return {8960, e, SillingStabilization{0.02}};
  if (model == ordinary) return {8960, e, {}, Formulation::ordinary};
  const double yield_stress = model == quadratic_below_yield ? 50e9 : 50e6;
  const materials::FlowStress flow{yield_stress, materials::PowerHardening{0.00218, 0.1},
                                   materials::PowerRate{1e-3, 0.01}};
  const materials::J2 law{e.bulk, e.shear, flow};
  if (model == plastic_quadratic || model == quadratic_below_yield) return {8960, law, {}, Formulation::quadratic};
  if (model == plastic_mean_gradient) return {8960, law, MeanGradientStabilization{0.01}};
  return {8960, law, SillingStabilization{0.02}};
}

// Arguments: points along an edge, horizon in thousandths of a spacing, model, whether the families are lists though
// the points sit on a lattice.
void step(benchmark::State& state) {
  const Communicator world;
  const int n = static_cast<int>(state.range(0));
  const LatticeSpec spec{{n, n, n},
                         1e-3,
                         1e-3 * static_cast<double>(state.range(1)),
                         0,
                         Influence::one,
                         copper(state.range(2)),
                         state.range(3) != 0 ? FamilyKind::lists : FamilyKind::stencil};
  Body body = lattice_body(spec, world);
  const double dt = 1e-7, rate = 1e4;  // a shear that keeps a plastic block flowing
  double shear = 0;
  const auto deform_further = [&] {
    shear += rate * dt;
    deform(body, [&](const Vector& X) -> Vector { return {X[0] + shear * X[1], X[1], X[2]}; });
  };
  // A cell that begins to flow is fitted anew, once in a run.
  for (int n = 0; n < 3; ++n) deform_further(), advance_stress_and_force(body, dt, false);
  for (auto _ : state) {
    state.PauseTiming();
    deform_further();
    state.ResumeTiming();
    benchmark::DoNotOptimize(advance_stress_and_force(body, dt, false).frequency_bound);
  }
  const auto steps = static_cast<double>(state.iterations());
  const auto time_per = [](double count) {
    return benchmark::Counter(count, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  };
  state.counters["per_bond"] = time_per(steps * static_cast<double>(body.domain.families.bonds()));
  state.counters["per_point"] = time_per(steps * body.owned());
}

// Struts along the body diagonals of cubes, so many cells thick: 6 % of the volume.
bool is_in_strut(const Eigen::Array3i& cell, double thickness) {
  const double cube = 9.5 * thickness, radius = thickness / 2;
  const Vector X = (cell.cast<double>() + 0.5).matrix(),
               p = X - (cube * (X / cube).array().floor() + cube / 2).matrix();
  for (const Vector& diagonal : {Vector(1, 1, 1), Vector(1, 1, -1), Vector(1, -1, 1), Vector(-1, 1, 1)}) {
    if (p.cross(diagonal).squaredNorm() / 3 <= radius * radius) return true;
  }
  return false;
}

// The two passes over bonds alone, Silling's stabilization included: moments of all families, then forces. Arguments:
// cells along an edge, horizon in thousandths of a spacing, lists or not, and of a foam the thickness of its struts.
void passes(benchmark::State& state) {
  const Communicator world;
  const int n = static_cast<int>(state.range(0));
  const FamilyKind kind = state.range(2) != 0 ? FamilyKind::lists : FamilyKind::stencil;
  LatticeSpec spec{{n, n, n}, 1e-3,           1e-3 * static_cast<double>(state.range(1)),
                   0,         Influence::one, copper(elastic_correspondence),
                   kind};
  const auto thickness = static_cast<double>(state.range(3));
  if (thickness > 0) spec.is_filled = [=](const Eigen::Array3i& cell) { return is_in_strut(cell, thickness); };
  Body body = lattice_body(spec, world);
  advance_stress_and_force(body, 1e-7, false);
  const Site* sites = body.domain.sites.data();
  const auto& states = body.force_states.tensors;
  const MaterialBlock& block = body.blocks[0];
  std::vector<Vector> force(body.owned(), Vector::Zero());
  const auto gather = [&](const LaneGroups& groups) {
    for (int g = 0; g < groups.count(); ++g) {
      auto moment = moments(groups[g], {sites}, true, bonds::One{});
      benchmark::DoNotOptimize(moment);
    }
  };
  const auto sum = [&](const LaneGroups& groups) {
    for (int g = 0; g < groups.count(); ++g) {
      const LaneGroup group = groups[g];
      const auto sums = far_forces(group, {sites}, states, true, bonds::One{});
      for (int l = 0; l < group.count; ++l) force[group.i[l]] += at(sums, l);
    }
  };
  for (auto _ : state) {
    if (kind == FamilyKind::lists) {
      const LaneGroups groups(body, block, Part::interior);
      gather(groups);
      sum(groups);
    } else {
      LatticeSums& sums = *body.lattice_sums[0];
      sums.moments({sites}, [&](const LatticeSums::Chunk& chunk) { gather(LaneGroups(block, chunk)); });
      sums.forces({sites}, states, [&](const LatticeSums::Chunk& chunk) { sum(LaneGroups(block, chunk)); });
    }
    benchmark::ClobberMemory();
  }
  const auto bonds = static_cast<double>(body.domain.families.bonds());
  const auto entries = static_cast<double>(body.domain.families.lists.entries());
  if (entries > 0) state.counters["shared"] = bonds / entries;  // bonds to an entry of a list
  state.counters["per_bond"] = benchmark::Counter(static_cast<double>(state.iterations()) * bonds,
                                                  benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK(passes)
    ->Args({50, 1750, 1, 0})
    ->Args({50, 1750, 0, 0})
    ->Args({50, 3015, 1, 0})
    ->Args({50, 3015, 0, 0})
    ->Args({40, 6015, 1, 0})
    ->Args({40, 6015, 0, 0})
    ->Args({105, 3015, 1, 11})
    ->Args({105, 3015, 0, 11})
    ->Args({209, 6015, 0, 22})
    ->Args({114, 3015, 1, 4})
    ->Args({114, 3015, 0, 4})
    ->Unit(benchmark::kMillisecond);

// A whole step by the textbook, and whether both agree. Arguments as of a step, but for the last one.
void textbook(benchmark::State& state) {
  const Communicator world;
  const int n = static_cast<int>(state.range(0));
  const LatticeSpec spec{{n, n, n}, 1e-3,           1e-3 * static_cast<double>(state.range(1)),
                         0,         Influence::one, copper(state.range(2))};
  Body body = lattice_body(spec, world);
  Textbook oracle(body);
  const double dt = 1e-7, rate = 1e4;
  double shear = 0, off = 0, largest = 0;
  std::visit(
      [&](const auto& law) {
        std::vector<typename std::decay_t<decltype(law)>::State> states(body.owned());
        for (auto _ : state) {
          state.PauseTiming();
          shear += rate * dt;
          deform(body, [&](const Vector& X) -> Vector { return {X[0] + shear * X[1], X[1], X[2]}; });
          advance_stress_and_force(body, dt, false);
          state.ResumeTiming();
          const std::vector<Vector> forces = oracle.forces(law, states, dt);
          state.PauseTiming();
          for (int i = 0; i < body.owned(); ++i) {
            off = std::max(off, (forces[i] - body.force_density[i]).norm());
            largest = std::max(largest, forces[i].norm());
          }
          state.ResumeTiming();
        }
      },
      spec.material.law);
  // The rotation is an update here and a decomposition there: 1e-12 of it, times the moduli over the flow stress.
  if (!(off < 1e-8 * largest)) state.SkipWithError("results differ from the textbook's");
  state.counters["per_bond"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(body.domain.families.bonds()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["difference"] = off / largest;
}

BENCHMARK(textbook)
    ->Args({50, 3015, elastic_correspondence})
    ->Args({50, 3015, plastic_correspondence})
    ->Unit(benchmark::kMillisecond);
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
    ->Args({50, 1750, plastic_quadratic, 1})
    ->Args({50, 1750, quadratic_below_yield, 1})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace strut

int main(int argc, char** argv) {
  strut::Runtime runtime(argc, argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
