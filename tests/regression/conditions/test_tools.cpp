// Rigid tools that stand and move: nothing enters them, friction is Coulomb's, and the ledger sees their work.
#include <gtest/gtest.h>

#include <optional>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"
#include "verification/larger.hpp"

namespace strut::regression {
namespace {

std::string tool(const std::string& name, const std::string& type, const std::string& keys) {
  return section(name, key("Type", type) + keys);
}
std::string rigid_plane(const std::string& name, const std::string& point, const std::string& normal,
                        const std::string& keys = "") {
  return tool(name, "Rigid Plane", key("Point", point) + key("Normal", normal) + keys);
}

// The smallest gap between a tool and a point of any rank.
double smallest_gap(const Simulation& run, const RigidTool& tool) {
  double smallest = 1;
  const Vector offset = tool.offset(run.solver.time());
  for (const int i : tool.points) {
    smallest = std::min(smallest, surface(tool.shape, run.scene.body.current(i) - offset).gap);
  }
  return run.scene.body.domain.communicator.min(smallest);
}

// Displacements by the number of the element, of this rank.
std::map<int, Vector> displacements(Simulation& run) {
  std::map<int, Vector> all;
  for (int i = 0; i < run.body().owned(); ++i) {
    all[static_cast<int>(run.body().domain.cloud.element_ids[i])] = run.body().displacement(i);
  }
  return all;
}

// The end rows are pressed at all times, so that a wall that they may leave is the same as one that they may not: what
// differs is the round-off of some 100 steps in places of 6 mm, and what that does to strains, 1e-16 times some 10.
TEST(RigidTool, MovingPlaneIsPrescribedMotionOfWhatItPresses) {
  const RunFolder folder;
  Parts parts;
  parts.times = key("Final Time", "4e-6");
  const std::string travel = "value = -1e6*t*t";
  parts.conditions =
      rigid_plane("low", "0 0 0.5e-3", "0 0 1") + rigid_plane("high", "0 0 5.5e-3", "0 0 -2", key("Travel Z", travel));
  Simulation walls(folder, parts);
  double worst_balance = 0;
  const Ledger pressed = walls.go([&](const Ledger& now) {
    if (now.time > 2e-6) worst_balance = larger(worst_balance, now.balance_error);  // before, hardly an energy
  });
  parts.node_sets = key("first", "z &lt; 1e-3") + key("last", "z &gt; 5e-3");
  parts.conditions = along("low", "Prescribed Displacement", "first", "z", "0") +
                     along("high", "Prescribed Displacement", "last", "z", travel);
  Simulation ends(folder, parts);
  const Ledger moved = ends.go();
  const std::map<int, Vector> expected = displacements(ends);
  for (const auto& [id, u] : displacements(walls)) EXPECT_LT((u - expected.at(id)).norm(), 1e-12 * 6e-3) << id;
  EXPECT_EQ(pressed.external, 0);
  EXPECT_GT(pressed.tools, 0);
  // Prescribed motion starts with the velocity of the first step, of 2.5 % of the time: that much of the work, squared.
  EXPECT_NEAR(pressed.tools, moved.external, 1e-3 * moved.external);
  EXPECT_LT(worst_balance, 1e-2);
}

struct Indented {
  double smallest_gap, worst_balance, depth;
  Ledger end;
};

// A block on a fixed plane, and a tool from above that goes down by 0.1 mm in 8 µs, then to the side by four times as
// much.
Indented indent(const std::string& type, const std::string& shape, const std::string& material = copper()) {
  const RunFolder folder;
  Parts parts;
  parts.materials = material;
  parts.times = key("Final Time", "16e-6");
  parts.conditions = rigid_plane("floor", "0 0 0.5e-3", "0 0 1", key("Friction Coefficient", "0.5")) +
                     tool("press", type,
                          shape + key("Friction Coefficient", "0.3") +
                              key("Travel Z", "value = -12.5*t; if (t &gt; 8e-6) { value = -1e-4; }") +
                              key("Travel X", "value = 0; if (t &gt; 8e-6) { value = 50*(t - 8e-6); }"));
  Simulation run(folder, parts);
  Indented result{1, 0, 0, {}};
  const double top = 5.5e-3;
  result.end = run.go([&](const Ledger& now) {
    for (const RigidTool& tool : tools_of(run.scene.conditions)) {
      result.smallest_gap = std::min(result.smallest_gap, smallest_gap(run, tool));
    }
    if (now.time > 4e-6) result.worst_balance = std::max(result.worst_balance, now.balance_error);
  });
  for (int i = 0; i < run.body().owned(); ++i) {
    if (run.reference(i)[2] > 5e-3) result.depth = std::max(result.depth, top - run.body().current(i)[2]);
  }
  result.depth = run.world().max(result.depth);
  return result;
}

// Tangent planes of convex tools never promise too much (unit/conditions/test_tool): a point ends a step outside, up to
// the round-off of its place and of the gap, some 1e-15 of 10 mm.
constexpr double deepest = 1e-14 * 1e-2;
// The elastic energy is that of a law in rates, to the first order in strains of some 4 %.
constexpr double energy_of_rates = 1e-2;

TEST(RigidTool, NothingEntersACylinder) {
  const std::string roll = key("Point", "2.5e-3 0 7.5e-3") + key("Axis", "0 3 0") + key("Radius", "2e-3");
  const Indented elastic = indent("Rigid Cylinder", roll);
  EXPECT_GE(elastic.smallest_gap, -deepest);
  EXPECT_GT(elastic.depth, 0.9e-4);
  EXPECT_LT(elastic.worst_balance, energy_of_rates);
  const std::string yields = copper(key("Yield Stress", "400e6"));
  const Indented plastic = indent("Rigid Cylinder", roll, yields);
  EXPECT_GE(plastic.smallest_gap, -deepest);
  EXPECT_GT(plastic.end.dissipated, plastic.end.elastic);
  EXPECT_LT(plastic.worst_balance, energy_of_rates);
}

TEST(RigidTool, NothingEntersABox) {
  const Indented run =
      indent("Rigid Box", key("Lower Corner", "1e-3 -1e-3 5.5e-3") + key("Upper Corner", "2.2e-3 9e-3 7e-3"));
  EXPECT_GE(run.smallest_gap, -deepest);
  EXPECT_GT(run.depth, 0.9e-4);
  EXPECT_LT(run.worst_balance, energy_of_rates);
}

// A punch whose edges are those of the body: the points on its edges and in its corners go down with those between.
TEST(RigidTool, ABoxTakesAlongWhatItsEdgesCoincideWith) {
  const RunFolder folder(Lattice{.nx = 3, .ny = 3, .nz = 4, .spacing = 1e-3});
  Parts parts;
  parts.points = "Nodes";
  parts.node_sets = key("lowest", "z &lt; 0.1e-3");
  parts.times = key("Final Time", "4e-6");
  parts.conditions =
      along("floor", "Prescribed Displacement", "lowest", "z", "0") +
      along("sides", "Prescribed Displacement", "all", "xy", "0") +
      tool("punch", "Rigid Box",
           key("Lower Corner", "0 0 4e-3") + key("Upper Corner", "3e-3 3e-3 6e-3") + key("Travel Z", "-1e6*t*t"));
  Simulation run(folder, parts);
  run.go();
  double top = 0;
  for (int i = 0; i < run.body().owned(); ++i) {
    if (run.body().domain.reference(i)[2] < 3.9e-3) continue;
    EXPECT_NEAR(run.body().displacement(i)[2], -16e-6, deepest) << run.body().domain.reference(i).transpose();
    ++top;
  }
  run.world().sum(std::span(&top, 1));
  EXPECT_EQ(top, 16);
}

// A plastic bar whose foot is subcycled: what counts is how fast wall and bar come together, at 227 m/s. Places
// differ by the round-off of velocities, 1e-16, which yielding does not let grow beyond some 1e-10 of the way.
TEST(RigidTool, WallThatComesIsABarThatFlies) {
  Lattice lattice;
  lattice.nz = 60;
  const RunFolder folder(lattice);
  Parts parts;
  parts.materials = copper(key("Yield Stress", "100e6"));
  parts.times = key("Final Time", "20e-6");
  parts.conditions =
      rigid_plane("wall", "0 0 0.3e-3", "0 0 1", key("Friction Coefficient", "0.1") + key("Travel Z", "227*t"));
  Simulation comes(folder, parts);
  const Ledger pushed = comes.go();
  parts.conditions = rigid_plane("wall", "0 0 0.3e-3", "0 0 1", key("Friction Coefficient", "0.1")) +
                     along("flight", "Initial Velocity", "all", "z", "-227");
  Simulation flies(folder, parts);
  const Ledger stopped = flies.go();
  EXPECT_GT(flies.solver.most_substeps(), 1);
  const std::map<int, Vector> expected = displacements(flies);
  const double way = 227 * 20e-6;
  for (const auto& [id, u] : displacements(comes)) {
    EXPECT_LT((u - expected.at(id) - way * Vector::UnitZ()).norm(), 1e-10 * way) << id;
  }
  EXPECT_NEAR(pushed.dissipated, stopped.dissipated, 1e-9 * stopped.dissipated);
  EXPECT_LT(pushed.balance_error, 1e-2);
  EXPECT_LT(stopped.balance_error, 1e-2);
}

// A block on a belt that runs under it at 10 m/s. Its weight is so large that it reaches 0.6 m/s. As long as all of its
// points slide, the belt's impulse along is μ times that across, whatever vibrations do; what points move
// sideways, some 0.1 m/s, turns their friction by the hundredth part, and takes half the square of that from it.
TEST(RigidTool, BeltAcceleratesWhatSlidesOnIt) {
  const RunFolder folder;
  const double weight = 1e9, friction = 0.3, speed = 10;  // N/m³, -, m/s
  Parts parts;
  parts.conditions =
      along("weight", "Body Force", "all", "z", "-1e9") +
      rigid_plane("belt", "0 0 0.5e-3", "0 0 1", key("Friction Coefficient", "0.3") + key("Travel X", "10*t"));
  parts.times = key("Final Time", "20e-6");
  parts.verlet = key("Fixed dt", "1e-7");
  Simulation run(folder, parts);
  double worst_balance = 0, fastest = 0;
  const Ledger end = run.go([&](const Ledger& now) {
    if (now.time > 5e-6) worst_balance = larger(worst_balance, now.balance_error);
    for (int i = 0; i < run.body().owned(); ++i) fastest = std::max(fastest, run.body().velocity[i][0]);
  });
  ASSERT_LT(run.world().max(fastest), speed);
  const double across = end.momentum[2] + weight * run.volume() * end.time;
  EXPECT_GT(end.momentum[0], 0.5 * friction * weight * run.volume() * end.time);
  EXPECT_NEAR(end.momentum[0], friction * across, 1e-3 * friction * across);
  EXPECT_NEAR(end.momentum[1], 0, 1e-3 * friction * across);
  EXPECT_GT(end.tools, 0);  // of the belt on the block
  EXPECT_LT(worst_balance, 1e-3);
}

// Friction leaves points alone along the axes of their prescribed motion.
TEST(RigidTool, FrictionLeavesPrescribedMotionsAlone) {
  const RunFolder folder;
  for (const std::string velocity : {"0", "3"}) {
    Parts parts;
    parts.conditions =
        along("weight", "Body Force", "all", "z", "-1e9") +
        along("hold", "Prescribed Velocity", "foot", "x", velocity) +
        rigid_plane("belt", "0 0 0", "0 0 1", key("Friction Coefficient", "0.3") + key("Travel X", "10*t"));
    parts.times = key("Final Time", "5e-6");
    Simulation run(folder, parts);
    const Ledger end = run.go();
    double off = 0, pressed = 0;
    for (int i = 0; i < run.body().owned(); ++i) {
      if (run.body().domain.reference(i)[2] > 1e-3) continue;
      off = std::max(off, std::abs(run.body().displacement(i)[0] - std::stod(velocity) * end.time));
      pressed += 1;
    }
    EXPECT_LT(run.world().max(off), 1e-15);  // round-off of positions of some mm
    EXPECT_EQ(run.world().sum(pressed), 16);
    EXPECT_GT(run.world().max(*tools_of(run.scene.conditions)[0].touched ? 1.0 : 0.0), 0);
  }
}

// A block flies 0.7 spacings to a wall that its face meets all at once, with points in the middles of cells and at
// nodes, after the way of its face and not of its points: within a step, which takes it a few hundredths of a spacing.
// So does a block whose mesh lies in the wall, and that begins displaced.
TEST(RigidTool, IsMetWhereTheFaceOfABodyIs) {
  const RunFolder folder;
  const double way = 0.7e-3, speed = 227;
  for (const auto& [points, is_lifted] : {std::pair("Elements", false), {"Nodes", false}, {"Elements", true}}) {
    Parts parts;
    parts.points = points;
    if (is_lifted) parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
    parts.conditions = along("flight", "Initial Velocity", "all", "z", "-227") +
                       (is_lifted ? along("lift", "Initial Displacement", "all", "z", "9.3e-3") : "") +
                       rigid_plane("wall", is_lifted ? "0 0 8.6e-3" : "0 0 -0.7e-3", "0 0 1");
    Simulation run(folder, parts);
    double before = 0, touched = 0, step = 0, stopped = 0;
    run.go([&](const Ledger& now) {
      if (touched > 0 || now.momentum[2] < -(1 - 1e-9) * run.mass() * speed) return void(before = now.time);
      touched = now.time, step = now.time - before;
      for (int i = 0; i < run.body().owned(); ++i) stopped += run.body().velocity[i][2] > -0.99 * speed;
    });
    EXPECT_NEAR(touched, way / speed, step) << points;
    EXPECT_LT(speed * step, 0.1e-3);
    EXPECT_EQ(run.world().sum(stopped), parts.points == "Nodes" ? 25 : 16) << points;
  }
}

// The momentum and the energy of a punch that strikes a free bar and leaves it again; 4 g against 0.86 g.
TEST(FreeTool, KeepsMomentumAndEnergyWithTheBodyThatItStrikes) {
  const RunFolder folder;
  Parts parts;
  parts.times = key("Final Time", "8e-6");
  parts.conditions = rigid_plane("punch", "0 0 0.499e-3", "0 0 1",
                                 key("Mass", "4e-3") + key("Speed Z", "20") + key("Friction Coefficient", "0.1"));
  Simulation run(folder, parts);
  const FreeMotion& punch = *tools_of(run.scene.conditions)[0].free;
  const double momentum = 4e-3 * 20;
  double worst_momentum = 0, worst_balance = 0, pushed = 0;
  run.go([&](const Ledger& now) {
    const double of_punch = 4e-3 * punch.mid_steps.velocity(punch.before, punch.velocity)[2];
    worst_momentum = larger(worst_momentum, std::abs(now.momentum[2] + of_punch - momentum));
    worst_balance = larger(worst_balance, now.balance_error);
    pushed = std::max(pushed, now.momentum[2]);
  });
  EXPECT_GT(pushed, 0.1 * momentum);
  EXPECT_LT(worst_momentum, 1e-12 * momentum);  // round-off of sums over 96 points and some 100 steps
  // The layer that is struck takes the velocity of the punch at once, which is Tool_Work; the rest is that of explicit
  // steps (tests of moving planes above).
  EXPECT_LT(worst_balance, 1e-3);
}

// A rigid mass strikes the end of a long elastic bar: until the wave comes back its speed is V exp(−ρ c A t/M)
// (Timoshenko & Goodier 1970, Theory of Elasticity, longitudinal impact of bars).
TEST(FreeTool, SlowsDownAsSaintVenantsMassOnABar) {
  constexpr double density = 8930, young = 117e9, area = 16e-6, length = 40e-3, mass = 20e-3, speed = 10;
  const RunFolder folder({.nx = 4, .ny = 4, .nz = 40});
  Parts parts;
  parts.materials = changed(copper(), "\"0.35\"", "\"0\"");
  const double c = std::sqrt(young / density), end = 1.5 * length / c;
  parts.times = key("Final Time", std::to_string(end));
  parts.conditions = rigid_plane("punch", "0 0 0.5e-3", "0 0 1", key("Mass", "20e-3") + key("Speed Z", "10"));
  Simulation run(folder, parts);
  const FreeMotion& punch = *tools_of(run.scene.conditions)[0].free;
  double worst = 0;
  run.go([&](const Ledger& now) {
    const double expected = speed * std::exp(-density * c * area * now.time / mass);
    worst = larger(worst, std::abs(punch.velocity[2] - expected));
  });
  EXPECT_LT(std::exp(-density * c * area * end / mass), 0.7) << "it is slowed down by more than the error";
  // The layer that it strikes, 0.7 % of its mass, takes its velocity at once; the front is smeared over some layers.
  EXPECT_LT(worst, 0.02 * speed);
}

// Nothing in its way: F t²/2M, which central differences have exactly.
TEST(FreeTool, FollowsItsForce) {
  const RunFolder folder;
  Parts parts;
  parts.conditions =
      rigid_plane("punch", "0 0 -1", "0 0 1", key("Mass", "0.5") + key("Force X", "3") + key("Speed X", "-2"));
  Simulation run(folder, parts);
  std::optional<double> first;  // half of the first impulse belongs to the time before
  const Ledger end = run.go([&](const Ledger& now) { first = first.value_or(now.external); });
  const RigidTool punch = tools_of(run.scene.conditions)[0];
  const double t = run.solver.time();
  EXPECT_NEAR(punch.offset(t)[0], -2 * t + 3 * t * t, 1e-12 * 2 * t);
  EXPECT_NEAR(end.external - *first, 0.25 * ((6 * t - 2) * (6 * t - 2) - 4), 1e-12);
  EXPECT_LT(end.balance_error, 1e-12);
}

// Two blocks beside the bar, or on both sides of it, 2 mm from each other, of which one flies at 100 m/s: they meet at
// 20 us.
TEST(FreeTool, IsToldWhereItMeetsAnotherTool) {
  const auto said = [](const std::string& first, const std::string& second, const std::string& mass) {
    const RunFolder folder;
    Parts parts;
    const auto box = [](const std::string& name, const std::string& x, const std::string& end,
                        const std::string& keys) {
      return tool(name, "Rigid Box", key("Lower Corner", x + " 0 0") + key("Upper Corner", end + " 4e-3 6e-3") + keys);
    };
    parts.conditions = box("hammer", first, first == "-2e-3" ? "-1e-3" : "11e-3", mass) +
                       box("anvil", second, second == "13e-3" ? "14e-3" : "6e-3", "");
    parts.times = key("Final Time", "30e-6");
    testing::internal::CaptureStdout();
    run(folder.write("deck.xml", parts.text()), folder.world);
    const std::string text = testing::internal::GetCapturedStdout();
    return folder.world.rank() == 0 ? text : "";
  };
  const std::string flies = key("Mass", "1e-6") + key("Speed X", "100");
  const std::string apart = said("10e-3", "13e-3", flies);
  if (apart.empty()) return void((said("-2e-3", "5e-3", flies), said("10e-3", "13e-3", key("Travel X", "100*t"))));
  // One of a hundred looks after it: 0.3 us.
  EXPECT_NE(apart.find("the tools 'hammer' and 'anvil' meet by about t = 2.01e-05 s"), std::string::npos) << apart;
  EXPECT_NE(apart.find("the tools 'hammer' and 'anvil' pass through each other"), std::string::npos) << apart;
  EXPECT_EQ(said("-2e-3", "5e-3", flies).find("the tools"), std::string::npos) << "the bar stops it";
  EXPECT_EQ(said("10e-3", "13e-3", key("Travel X", "100*t")).find("the tools"), std::string::npos) << "as prescribed";
}

TEST(FreeTool, IsToldWhereKeysDoNotFit) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = rigid_plane("punch", "0 0 0", "0 0 1", key("Mass", "1") + key("Travel Z", "t")) +
                     rigid_plane("other", "0 0 0", "0 0 1", key("Speed Z", "1"));
  std::string said;
  try {
    deck::read(folder.write("deck.xml", parts.text()), folder.world);
  } catch (const Error& error) {
    said = error.what();
  }
  for (const char* part :
       {"2 problems", "punch > Travel Z: is of a tool without a Mass", "other > Speed Z: is of a tool with a Mass"}) {
    EXPECT_NE(said.find(part), std::string::npos) << part << " in: " << said;
  }
}

// Slower than the belt the block is pushed, as fast as it no more: it sticks.
TEST(RigidTool, BeltCarriesWhatSticksToIt) {
  const RunFolder folder;
  Parts parts;
  parts.conditions =
      along("weight", "Body Force", "all", "z", "-1e9") +
      rigid_plane("belt", "0 0 0.5e-3", "0 0 1", key("Friction Coefficient", "0.3") + key("Travel X", "0.1*t"));
  parts.times = key("Final Time", "100e-6");
  Simulation run(folder, parts);
  double last_third = 0;
  int count = 0;
  run.go([&](const Ledger& now) {
    if (now.time < 60e-6) return;
    last_third += now.momentum[0];
    ++count;
  });
  // It shakes about the belt's speed: some periods of some 7 µs leave a tenth part of that.
  EXPECT_NEAR(last_third / count, 0.1 * run.mass(), 0.02 * 0.1 * run.mass());
}

}  // namespace
}  // namespace strut::regression
