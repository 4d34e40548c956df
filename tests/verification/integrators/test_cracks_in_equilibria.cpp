// Equilibria of bodies whose bonds break: where the energy goes, and that a crack stops.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "base/archive.hpp"
#include "base/errors.hpp"
#include "fracture/fracture.hpp"
#include "integrators/explicit/step_length.hpp"
#include "verification/loading.hpp"

namespace strut {
namespace {

constexpr double modulus = 32e9, toughness = 100;  // Pa, J/m²

BlockMaterial brittle(Formulation formulation, Stabilization stabilization, DamageModel damage) {
  const materials::AnyLaw solid = elastic(modulus, 0.25);
  return {.density = 2500,
          .law = damage.is_gradual ? materials::cracking(solid, toughness).value() : solid,
          .stabilization = std::move(stabilization),
          .formulation = formulation,
          .damage = std::move(damage)};
}

// ---- Two bonds in a row --------------------------------------------------------------------------------------------

// Three points along x whose bonds are 1 and 1.2 spacings long.
Body row_body(const LatticeSpec& spec, const Communicator& world) {
  PointCloud cloud;
  cloud.block_names = {"block"};
  const std::vector<double> places = {0, 1, 2.2};
  for (std::size_t i = 0; world.rank() == 0 && i < places.size(); ++i) {
    add_point(cloud, static_cast<std::int64_t>(i), {places[i] * spacing, 0, 0}, std::pow(spacing, 3), spacing);
  }
  BlockBonds bonds(spec.horizon * spec.spacing);
  bonds.may_lose_bonds = true;
  return make_body(make_domain(partitioned(std::move(cloud), world), {bonds}, world), spec.influence, {spec.material});
}

// The middle point is free along the row. When one bond breaks, the energy of the other is lost, since nothing is left
// that would pull at it; with K = 5/3 G each bond holds the energy of its own extension, ½ force times that.
TEST(BreakingEquilibria, TheBondThatIsLeftLosesItsEnergy) {
  LatticeSpec spec{{3, 1, 1}, spacing, 1.3};
  spec.material = brittle(Formulation::ordinary, NoStabilization(), DamageModel{Function(1.01e-2)});
  Loaded row(spec, row_body);
  const auto at = [&](double x) {
    return points_where(row.body, [x](const Vector& X) { return std::abs(X[0] - x * spacing) < 0.1 * spacing; });
  };
  const auto all = points_where(row.body, [](const Vector&) { return true; });
  row.hold(all, Vector::UnitY());
  row.hold(all, Vector::UnitZ());
  row.move(at(0), 0, "0");
  row.move(at(2.2), 0, ramp(0.05 * spacing));
  QuasiStatic solver(row.body, row.conditions, {}, {.load_steps = 20}, 0, 1, nobody(), fracture_of(row.body));
  double first = 0, second = 0, held = 0;  // extensions before the break, m; the energy then, J
  load(solver, [&](QuasiStatic& now) {
    const Ledger ledger = now.ledger();
    EXPECT_LT(ledger.balance_error, 1e-9);
    if (ledger.fracture > 0) {
      EXPECT_LT(ledger.elastic, 1e-9 * held);
      return;
    }
    held = ledger.elastic;
    const auto middle = at(1);
    first = row.world.sum(middle.empty() ? 0.0 : row.body.displacement(middle[0])[0]);
    second = 0.05 * spacing * now.time() - first;
  });
  const Ledger end = solver.ledger();
  const double broken = first / 1 > second / 1.2 ? first : second;
  EXPECT_GT(end.fracture + end.jumps, held);
  EXPECT_NEAR(end.fracture / (end.fracture + end.jumps), broken / (first + second), 1e-6);
  EXPECT_NEAR(end.external, end.fracture + end.jumps, 1e-9 * end.external);
}

// A force that grows draws the two free points from the held one: when the first bond has broken, nothing holds them.
// The run ends; who asks a search to stop is heard again.
TEST(BreakingEquilibria, ThatAreNotFoundLeaveTheirObserver) {
  LatticeSpec spec{{3, 1, 1}, spacing, 1.3};
  spec.material = brittle(Formulation::ordinary, NoStabilization(), DamageModel{Function(1.01e-2)});
  Loaded row(spec, row_body);
  const auto all = points_where(row.body, [](const Vector&) { return true; });
  row.hold(all, Vector::UnitY());
  row.hold(all, Vector::UnitZ());
  row.move(points_where(row.body, [](const Vector& X) { return X[0] < 0.1 * spacing; }), 0, "0");
  row.conditions.add(BodyForce{all, {0}, Function::parse("1e13*t")});
  bool is_stopped = false;
  Observer observer = nobody();
  observer.stop_requested = [&] { return is_stopped; };
  QuasiStatic solver(row.body, row.conditions, {}, {.load_steps = 4}, 0, 1, observer, fracture_of(row.body));
  EXPECT_THROW(load(solver), Error);
  EXPECT_GT(row.world.sum(broken_bonds(row.body)), 0);
  is_stopped = true;
  EXPECT_FALSE(solver.advance());
}

// ---- A crack in a strip --------------------------------------------------------------------------------------------

struct Kind {
  const char* name;
  Formulation formulation;
  Stabilization stabilization;
  int length = 26, height = 16, notch = 8, held = 3, far = 32;  // of the strip, spacings
  const char* turn = "(0.4 + 0.1*t)*1e-3";                      // amid which a crack grows
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

const std::vector<Kind> kinds = {{"ordinary", Formulation::ordinary, NoStabilization()},
                                 {"mean_gradient", Formulation::correspondence, MeanGradientStabilization{0.3}}};
const Kind cohesive{"cohesive", Formulation::quadratic, NoStabilization(), 14, 8, 5, 2, 17, "(0.6 + 0.1*t)*1e-3"};

// One layer across y between periodic sides.
Body plane_body(const LatticeSpec& spec, const Communicator& world) {
  BlockBonds bonds(spec.horizon * spec.spacing);
  bonds.may_lose_bonds = true;
  Domain domain = make_domain(partitioned(lattice_cloud(spec, world), world), {bonds}, world, spec.cracks, {},
                              {{1, spec.cells[1] * spec.spacing, 0, Function(1)}});
  return make_body(std::move(domain), spec.influence, {spec.material});
}

// A strip along x with a notch in its middle; its edges are turned apart about a line behind its end, so that a crack
// needs more and more of it to grow. Plane strain.
struct Strip : Loaded {
  // `turn`: 1, of t.
  Strip(const Kind& kind, const std::string& turn, const QuasiStaticControl& control)
      : Loaded(spec_of(kind), plane_body), middle(0.5 * kind.height * spacing) {
    const double far = kind.far * spacing;  // m, the line
    for (const int side : {-1, 1}) {
      const auto edge = points_where(
          body, [&](const Vector& X) { return side * (X[2] - middle) > (0.5 * kind.height - kind.held) * spacing; });
      move(edge, 2, number(0.5 * side) + "*(" + number(far) + " - x)*(" + turn + ")");
      hold(edge, Vector::UnitX());
    }
    hold(points_where(body, [](const Vector&) { return true; }), Vector::UnitY());
    solver.emplace(body, conditions, contact::Contact(), control, 0, 1, nobody(), fracture_of(body));
  }
  static LatticeSpec spec_of(const Kind& kind) {
    const bool is_gradual = kind.formulation == Formulation::quadratic;
    LatticeSpec spec{{kind.length, 1, kind.height}, spacing, is_gradual ? 1.75 : 3.015};
    spec.material = brittle(kind.formulation, kind.stabilization, {Function(1), toughness, is_gradual});
    const Vector corner(-spacing, -4 * spacing, 0.5 * kind.height * spacing);
    spec.cracks = {RectangularCrack{corner, Vector::UnitZ(), Vector::UnitY(), 9 * spacing, (kind.notch + 1) * spacing}};
    return spec;
  }

  void go_to(double time) {
    while (solver->time() < time - 1e-9) solver->advance();
  }
  // Collective. The damage of the rows beside the plane, over that by all bonds across it, summed along x; spacings.
  double crack() const {
    double sum = 0;
    for (int i = 0; i < body.owned(); ++i) {
      if (std::abs(body.domain.reference(i)[2] - middle) < spacing) sum += body.damage[i];
    }
    int across = 0, all = 0;
    for (int x = -3; x <= 3; ++x) {
      for (int y = -3; y <= 3; ++y) {
        for (int z = -3; z <= 3; ++z) {
          const int square = x * x + y * y + z * z;
          all += square > 0 && square <= 9, across += z < 0 && square <= 9;
        }
      }
    }
    return body.domain.communicator.sum(sum) / 2 * all / across;
  }

  // The energies (J) that the opened cells of this rank have dissipated; the stress of an opened cell has fallen to 0.
  std::vector<double> opened_cells() const {
    const MaterialBlock& block = body.blocks[0];
    std::vector<double> all;
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      double left = 0, work = 0;
      for (int q = 0; q < 4; ++q) {
        const auto state = block.state_of<materials::Brittle>(block.index(static_cast<int>(k), q));
        left = std::max(left, 1 - state.damage), work += state.dissipated / 4;
      }
      if (left < 1.01e-3) all.push_back(work * body.domain.volume(block.points[k]));
    }
    return all;
  }

  const double middle;  // m, the plane
  std::optional<QuasiStatic> solver;
};

// The forecast counts memory that the first step in which bonds may break, and the first estimate of the time step,
// allocate later.
TEST(Fracture, ForecastsTheStatesThatAreKept) {
  const Communicator world;
  Body body = plane_body(Strip::spec_of(kinds[1]), world);
  const Fracture fracture(body);
  EXPECT_EQ(StepLength::bytes(body) - CriticalTimeStep::bytes(body), body.force_states.bytes());
  const double all = fracture.bytes(body);
  const auto kept = static_cast<double>(body.domain.sites.size() * sizeof(GradientState));
  body.force_states.gradients.clear();
  EXPECT_EQ(all - fracture.bytes(body), kept);
}

class InAStrip : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(By, InAStrip, ::testing::ValuesIn(kinds), [](const auto& info) { return info.param.name; });

// The strip is turned until the crack has grown by some eight spacings, and back. Cracks that run take 0.9 (mean
// gradient) to 1.05 G_c (ordinary; inputs/fracture); the zone at the tip is some tenth of this one. By correspondence
// the stress follows only a part of the jump of F where bonds break, and 0.3 % of the energy stays locked in; the law
// in rates is off by the first order in the strain, 1e-3.
TEST_P(InAStrip, ACrackTakesItsEnergyAndTheRestIsElastic) {
  if (Communicator().size() > 1) GTEST_SKIP() << "long; on two ranks a crack grows as on one: restarts.parting";
  const bool by_rates = GetParam().formulation == Formulation::correspondence;
  const double locked = by_rates ? 5e-3 : 1e-6, balance = by_rates ? 1e-3 : 1e-4;
  Strip strip(GetParam(), "6e-4*min(2*t, 2 - 2*t)", {.load_steps = 8, .tolerance = {.relative = 1e-5}});
  strip.go_to(0.5);
  const Ledger turned = strip.solver->ledger();
  EXPECT_GT(strip.crack(), 6);
  const double whole = strip.crack() * spacing * spacing * toughness;
  EXPECT_NEAR(turned.fracture / whole, 1, 0.15);
  EXPECT_GT(turned.jumps, 0);
  EXPECT_LT(turned.jumps, 0.2 * turned.fracture);
  const std::int64_t broken = broken_bonds(strip.body);
  strip.go_to(1);
  const Ledger end = strip.solver->ledger();
  EXPECT_EQ(broken_bonds(strip.body), broken);
  EXPECT_LT(end.balance_error, balance);
  EXPECT_LT(end.elastic + end.stabilization, locked * turned.elastic);
}

// A bar without a notch, torn within a few load steps, cracks at one end, where each opened cell takes its half of the
// energy, and some of what the jump would lose; at the other end a crack begins. If all cells softened at once, the bar
// would take some three times as much.
TEST(BreakingEquilibria, AGradualCrackIsOneAndTakesItsEnergy) {
  if (Communicator().size() > 1) GTEST_SKIP() << "long";
  Kind bar = cohesive;
  bar.length = 4, bar.height = 12, bar.notch = 0, bar.held = 1, bar.far = 1000;
  Strip strip(bar, "2e-5*t", {.load_steps = 3, .tolerance = {.relative = 2e-3}});
  strip.go_to(1);
  const double whole = bar.length * spacing * spacing * toughness;
  const std::vector<double> opened = strip.opened_cells();
  EXPECT_EQ(opened.size(), 2 * bar.length);
  for (const double energy : opened) EXPECT_NEAR(energy / (0.5 * whole / bar.length), 1, 0.15);
  const Ledger end = strip.solver->ledger();
  EXPECT_NEAR(end.fracture / whole, 1.2, 0.2);
  EXPECT_GT(end.jumps, 0);
  EXPECT_LT(end.balance_error, 1e-3);
}

class Restored : public InAStrip {};
INSTANTIATE_TEST_SUITE_P(By, Restored, ::testing::Values(kinds[0], kinds[1], cohesive),
                         [](const auto& info) { return info.param.name; });

// A run that goes on from a checkpoint amid the growth has the same bits. Broken bonds are restored to whole families
// only.
TEST_P(Restored, ACrackGrowsAlike) {
  const QuasiStaticControl control{.load_steps = 4, .tolerance = {.relative = 1e-4}};
  Strip one(GetParam(), GetParam().turn, control), other(GetParam(), GetParam().turn, control);
  one.go_to(0.5);
  EXPECT_GT(broken_bonds(one.body), 0);
  Snapshot kept;
  Archive saved = Archive::saving_to(kept);
  one.solver->serialize(saved);
  Archive restored = Archive::loading_from(kept);
  other.solver->serialize(restored);
  one.go_to(1), other.go_to(1);
  EXPECT_EQ(broken_bonds(one.body), broken_bonds(other.body));
  EXPECT_EQ(largest_difference(one.body, other.body), 0);
  EXPECT_EQ(one.solver->ledger().fracture, other.solver->ledger().fracture);
  EXPECT_EQ(one.solver->ledger().jumps, other.solver->ledger().jumps);
  Archive again = Archive::loading_from(kept);
  EXPECT_THROW(one.solver->serialize(again), std::logic_error);
}

}  // namespace
}  // namespace strut
