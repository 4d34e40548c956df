// Equilibria of bodies that touch rigid tools and each other: closed forms, held bodies in their place, and the
// stiffness of contact against differences of its forces.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/laws/laws.hpp"
#include "verification/loading.hpp"

namespace strut {
namespace {

// As the program states: what points may be inside a tool, what they may slide in a step where they stick (spacings),
// and how far pressures may run ahead of the multipliers that bound friction, as a part of the largest.
constexpr double most_penetration = 1e-4, most_sliding = 1e-3, most_lag = 5e-3;

// ---- Stiffness of tools --------------------------------------------------------------------------------------------

struct Probe {
  ToolContact contact;
  Field forces;

  Probe(const RigidTool& tool, const Body& body) : contact({tool}, body) {}
  const Field& at(Body& body, const Field& places) {
    for (int i = 0; i < body.owned(); ++i) body.domain.sites[i].current.head<3>() = places[i].array();
    forces.assign(body.owned(), Vector::Zero());
    contact.add_forces(body, forces);
    return forces;
  }
};

// Pressed into the tool, then, with the multipliers that this leaves, moved on: the error of the stiffness there.
double error_of_stiffness(const RigidTool& tool, const Vector& pressed, const Vector& moved) {
  Loaded loaded(lattice_of({5, 5, 3}, elastic(young, poisson)));
  Body& body = loaded.body;
  RigidTool all = tool;
  all.points = points_where(body, [](const Vector&) { return true; });
  Probe probe(all, body);
  probe.contact.begin(body, 0, 1);
  Field places(body.owned()), direction(body.owned()), product(body.owned(), Vector::Zero());
  for (int i = 0; i < body.owned(); ++i) places[i] = body.domain.reference(i) + pressed;
  probe.at(body, places);
  probe.contact.augment();
  for (int i = 0; i < body.owned(); ++i) {
    places[i] += moved;
    direction[i] = Vector(std::sin(1.0 + places[i][1] / spacing), std::cos(places[i][0] / spacing), 0.5);
  }
  // Errors of second order: the curvature of a turn by 1e-5 leaves its square, round-off of positions 1e-16 over 1e-8.
  const double h = 1e-5 * spacing;
  const auto shifted = [&](double by) {
    Field there = places;
    for (std::size_t i = 0; i < there.size(); ++i) there[i] += by * direction[i];
    return Field(probe.at(body, there));
  };
  const Field above = shifted(h), below = shifted(-h);
  probe.at(body, places);
  probe.contact.add_stiffness(direction, product);
  const double scale = largest_over(body, [&](int i) { return product[i].norm(); });
  EXPECT_GT(scale, 0);
  return largest_over(body, [&](int i) { return ((above[i] - below[i]) / (2 * h) + product[i]).norm(); }) / scale;
}

constexpr double of_differences = 1e-7;

TEST(ToolStiffness, IsTheDerivativeOfForcesWhereAPointSticks) {
  const RigidTool floor{{}, HalfSpace{{0, 0, 0.6e-3}, Vector::UnitZ()}, {}, 0.3};
  EXPECT_LT(error_of_stiffness(floor, {0, 0, 0}, {1e-6, 2e-6, -1e-6}), of_differences);
}

TEST(ToolStiffness, IsTheDerivativeOfForcesWhereAPointSlides) {
  const RigidTool floor{{}, HalfSpace{{2.5e-3, 2.5e-3, 0.5e-3}, Vector(0.1, 0.2, 1).normalized()}, {}, 0.3};
  EXPECT_LT(error_of_stiffness(floor, {0, 0, 0}, {2e-3, -1e-3, -1e-6}), of_differences);
}

TEST(ToolStiffness, HasTheCurvatureOfACylinder) {
  const RigidTool roll{{}, Cylinder{{2.5e-3, 0, -1e-3}, Vector::UnitY(), 1.6e-3}, {}, 0};
  EXPECT_LT(error_of_stiffness(roll, {0, 0, 0}, {1e-5, 0, -1e-5}), of_differences);
}

// ---- Between planes ------------------------------------------------------------------------------------------------

// A bar along z between planes at its end layers, of which the upper comes down. Nothing else holds it along z.
struct Pressed : Loaded {
  Pressed(const LatticeSpec& lattice, double strain, double friction = 0) : Loaded(lattice) {
    guide();
    const double top = spec.spacing * (spec.cells[2] - 0.5);
    low = press(HalfSpace{{0, 0, 0.5 * spec.spacing}, Vector::UnitZ()}, 2, "0", friction);
    high = press(HalfSpace{{0, 0, top}, -Vector::UnitZ()}, 2, ramp(-strain * (top - 0.5 * spec.spacing)), friction);
  }
  // How far the deepest point is inside, spacings.
  double penetration() const {
    double smallest = 0;
    for (const RigidTool& tool : tools_of(conditions)) {
      for (const int i : tool.points) {
        smallest = std::min(smallest, surface(tool.shape, body.current(i) - tool.offset(1)).gap);
      }
    }
    return -world.min(smallest) / spec.spacing;
  }
  int low, high;
};

double sum_of(const Reactions& reactions) {
  Vector sum = Vector::Zero();
  for (const Vector& reaction : reactions.forces) sum += reaction;
  return sum.norm();
}

// σ = E ε, and σ_y + H (ε − σ/E) in flow; the ends reach the middle with 3e-4 and 2e-4 (test_quasi_static).
TEST(QuasiStaticTool, PressesABarInUniaxialStress) {
  constexpr double of_ends = 1e-3;
  for (const bool flows : {false, true}) {
    Pressed bar(lattice_of({3, 3, flows ? 29 : 17}, flows ? elastic_plastic() : elastic(young, poisson)), 0.03);
    Gauge gauge(bar.body, 0.5 * spacing * bar.spec.cells.cast<double>().matrix());
    const QuasiStaticControl control{.load_steps = 5};
    QuasiStatic solver = bar.solver(control);
    const Ledger end = load(solver, [&](QuasiStatic&) { gauge.step(); });
    const double strain = -gauge.strain(2);
    const double stress = flows ? (yield + hardening * strain) / (1 + hardening / young) : young * strain;
    EXPECT_NEAR(-gauge.stress(2), stress, of_ends * stress);
    const double sideways = 0.5 * strain - (0.5 - poisson) * stress / young;
    EXPECT_NEAR(gauge.strain(0), sideways, of_ends * strain);
    EXPECT_LT(bar.penetration(), most_penetration);
    const Reactions reactions = solver.reactions(bar.count);
    const double force = reactions.forces[bar.low][2];
    EXPECT_NEAR(force, -gauge.nominal_stress() * 9 * spacing * spacing, 2 * of_ends * force);
    // Bonds are equal and opposite: what is missing in the sum is what is left at points.
    EXPECT_LT(sum_of(reactions), left_over(bar, control.tolerance, std::sqrt(2.0) * force));
    EXPECT_EQ(end.external, 0);
    EXPECT_LT(end.balance_error, 0.03);  // of laws in rates: the strain
  }
}

// The same as prescribed motion of the end layers, but for what the tools let in, at both ends of a travel of 0.14
// spacings; the work has the square of that.
TEST(QuasiStaticTool, IsPrescribedMotionOfWhatItPresses) {
  Pressed pressed(lattice_of({4, 4, 8}, elastic(young, poisson)), 0.02);
  Bar moved(pressed.spec, -0.02);
  QuasiStatic by_tools = pressed.solver({.load_steps = 2}), by_motion = moved.solver({.load_steps = 2});
  const Ledger tools = load(by_tools), motion = load(by_motion);
  EXPECT_LT(largest_difference(pressed.body, moved.body), 2 * most_penetration * spacing);
  EXPECT_NEAR(tools.tools, motion.external, 4 * most_penetration / 0.14 * motion.external);
}

// Both to 1e-6 of the forces, some times more of the travel (test_quasi_static), and as far inside as the tools let
// them: each its own way.
TEST(QuasiStaticTool, RelaxationFindsTheEquilibriumOfNewton) {
  Pressed newton(lattice_of({4, 4, 8}, elastic(young, poisson)), 0.02), relaxed(newton.spec, 0.02);
  QuasiStatic with = newton.solver({.load_steps = 2}),
              without = relaxed.solver({.with_tangent = false, .load_steps = 2});
  load(with), load(without);
  EXPECT_EQ(without.steps(), 2);
  EXPECT_LT(relaxed.penetration(), most_penetration);
  EXPECT_LT(largest_difference(newton.body, relaxed.body), (2 * most_penetration + 10 * 1e-6 * 0.14) * spacing);
}

// A plastic block that is pressed by half a spacing under a cylinder of three: the forces of tool and bed cancel, and
// nothing is inside.
TEST(QuasiStaticTool, CylinderIndentsABlock) {
  Loaded loaded(lattice_of({9, 3, 6}, elastic_plastic()));
  const Body& body = loaded.body;
  for (int axis = 0; axis < 3; ++axis) loaded.move(layer(body, loaded.spec, 2, false), axis, "0");
  loaded.hold(points_where(body, [](const Vector&) { return true; }), Vector::UnitY());
  const int roll = loaded.press(Cylinder{{4.5e-3, 0, 8.5e-3}, Vector::UnitY(), 3e-3}, 2, ramp(-0.5 * spacing));
  const QuasiStaticControl control{.load_steps = 5};
  QuasiStatic solver = loaded.solver(control);
  const Ledger end = load(solver);
  const RigidTool tool = tools_of(loaded.conditions)[0];
  double smallest = 0, lowest = 0;
  for (const int i : tool.points) {
    smallest = std::min(smallest, surface(tool.shape, body.current(i) - tool.offset(1)).gap);
    lowest = std::min(lowest, body.displacement(i)[2]);
  }
  EXPECT_GT(loaded.world.min(smallest), -most_penetration * spacing);
  EXPECT_NEAR(loaded.world.min(lowest), -0.5 * spacing, most_penetration * spacing);  // the middle column
  const Reactions reactions = solver.reactions(loaded.count);
  const double force = -reactions.forces[roll][2];
  EXPECT_GT(force, 0);
  EXPECT_LT(sum_of(reactions), left_over(loaded, control.tolerance, std::sqrt(2.0) * force));
  EXPECT_LT(std::abs(reactions.forces[roll][0]), 1e-6 * force);  // by symmetry, to the tolerance
  EXPECT_GT(end.dissipated, end.elastic);
  EXPECT_LT(end.balance_error, 1e-2);  // strains of some tenths in five steps, squared
}

// ---- Friction ------------------------------------------------------------------------------------------------------

// A flat block on a floor, or on its held lower layer: its top layer is pressed down until t = ¼, then dragged along x.
struct Dragged : Loaded {
  Dragged(double depth, double way, double friction) : Loaded(lattice_of({6, 4, 3}, elastic(young, 0))) {
    const std::vector<int> top = layer(body, spec, 2, true), bottom = layer(body, spec, 2, false);
    move(top, 2, "value = " + ramp(-4 * depth) + "; if (t > 0.25) { value = " + number(-depth) + "; }");
    drag = move(top, 0, "value = 0; if (t > 0.25) { value = " + ramp(way / 0.75) + " - " + number(way / 3) + "; }");
    move(top, 1, "0");
    floor = count;
    if (friction > 0) {
      press(HalfSpace{{0, 0, 0.5 * spacing}, Vector::UnitZ()}, 2, "0", friction);
    } else {
      for (int axis = 0; axis < 3; ++axis) move(bottom, axis, "0");
    }
  }
  int drag, floor;
};

// At first it sticks, at last all slides: every point is bound by the multiplier of its pressure, which the pressure
// may be ahead of by most_lag of the largest one. Pressures of the four corners to the middle differ by less than
// twice.
TEST(QuasiStaticFriction, DragsWithItsShareOfThePressure) {
  constexpr double friction = 0.3;
  Dragged block(0.02 * spacing, 0.04 * spacing, friction);
  QuasiStatic solver = block.solver({.load_steps = 16});
  double before = 0;
  load(solver, [&](QuasiStatic& now) {
    const Reactions reactions = now.reactions(block.count);
    const Vector force = reactions.forces[block.floor];
    EXPECT_LT(-force[0], friction * force[2] * (1 + 2 * most_lag)) << now.time();
    EXPECT_LT(sum_of(reactions), left_over(block, {}, 2 * force[2])) << now.time();
    EXPECT_GT(-force[0], before - most_lag * force[2]) << now.time();
    if (now.time() < 0.26) {
      EXPECT_LT(-force[0], 1e-6 * force[2]);  // nothing drags: the tolerance
    }
    if (now.time() > 0.26 && now.time() < 0.4) {
      EXPECT_LT(-force[0], 0.5 * friction * force[2]);
    }
    if (now.time() > 0.9) {
      EXPECT_NEAR(-force[0], friction * force[2], 2 * most_lag * friction * force[2]);
    }
    EXPECT_LT(now.ledger().balance_error, 0.01) << now.time();  // of a law in rates: the strain
    before = -force[0];
  });
  EXPECT_LT(solver.ledger().tools, 0);  // friction takes
}

// With much friction the floor is as good as holding the lower layer, but for what the program lets points slide in a
// step: of the way of the top in a step, 13 times as much. Pressed so much that no point lifts off.
TEST(QuasiStaticFriction, HoldsWhatSticks) {
  const double way = 0.08 * spacing;
  Dragged sticks(way, way, 10), held(way, way, 0);
  QuasiStatic on_floor = sticks.solver({.load_steps = 8}), by_layer = held.solver({.load_steps = 8});
  load(on_floor), load(by_layer);
  const double force = on_floor.reactions(sticks.count).forces[sticks.drag][0];
  const double expected = by_layer.reactions(held.count).forces[held.drag][0];
  EXPECT_LT(force, expected);
  EXPECT_GT(force, expected * (1 - most_sliding / (0.08 / 6)));
}

// ---- Contact of bodies ---------------------------------------------------------------------------------------------

constexpr double penalty = 1e10;  // Pa

// Two blocks, one on the other with a spacing between their layers; the upper one comes down.
struct Pair : Loaded {
  static Body two_blocks(const LatticeSpec& spec, const Communicator& world) {
    PointCloud cloud = lattice_cloud(spec, world);
    cloud.block_names = {"lower", "upper"};
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
      cloud.blocks[i] = cloud.positions[i][2] > 0.5 * spec.cells[2] * spec.spacing;
    }
    const BlockBonds lower(spec.horizon * spec.spacing, 0), upper(spec.horizon * spec.spacing, 1);
    Domain domain = make_domain(partitioned(std::move(cloud), world), {lower, upper}, world);
    return make_body(std::move(domain), spec.influence, {spec.material, spec.material});
  }
  Pair(const LatticeSpec& lattice, double travel, const contact::Law& law) : Loaded(lattice, two_blocks) {
    guide();
    low = move(layer(body, spec, 2, false), 2, "0");
    high = move(layer(body, spec, 2, true), 2, ramp(-travel));
    contact = contact::Contact({{0, 1, {law}}}, body.domain);
  }
  int low, high;
};

// Elastic energy of a law in rates is off by the first order in strains of half a percent.
TEST(QuasiStaticContact, CarriesOneBlockOnAnother) {
  Pair pair(lattice_of({4, 4, 10}, elastic(young, poisson)), 0.05 * spacing,
            contact::PenaltyLaw{.radius = spacing, .penalty = penalty});
  const QuasiStaticControl control{.load_steps = 4};
  QuasiStatic solver = pair.solver(control);
  const Ledger end = load(solver);
  EXPECT_EQ(solver.steps(), 4);
  const Reactions reactions = solver.reactions(pair.count);
  const double force = reactions.forces[pair.low][2];
  EXPECT_LT(sum_of(reactions), left_over(pair, control.tolerance, std::sqrt(2.0) * force));
  // Springs in a row: two blocks of four spacings between their end layers, E A/l each, and one spring for each of the
  // 16 pairs of points that face each other. The ends of the blocks are softer by some percent (test_quasi_static).
  const double spring = 16 * contact::penalty_stiffness(penalty, horizon * spacing) * std::pow(spacing, 6);
  const double block = young * 16 * spacing * spacing / (4 * spacing);
  EXPECT_NEAR(force, 0.05 * spacing / (2 / block + 1 / spring), 0.2 * force);
  // The energy of the springs is least where all carry alike (Cauchy & Schwarz); those of the edges carry some tenths
  // more or less, and the square of that comes to it.
  const double least = 0.5 * force * force / spring;
  EXPECT_GT(-end.contact, least);
  EXPECT_LT(-end.contact, 1.2 * least);
  EXPECT_LT(end.balance_error, 5e-3);
}

// The same with springs that stiffen. Sixteen equal spheres in a row with the blocks have F = 16 · 4/3 E* √R* o^(3/2),
// so that the blocks are shortened by the rest of the displacement, 2 F/k. Their energy, 2/5 F o at the same force, is
// less than the greater part of the edges adds; and the tangent leads Newton to the equilibrium without help.
TEST(QuasiStaticContact, CarriesOneBlockOnAnotherByHertz) {
  const double modulus = young;
  Pair pair(lattice_of({4, 4, 10}, elastic(young, poisson)), 0.05 * spacing,
            contact::HertzLaw{.radius = spacing, .effective_modulus = modulus});
  const int steps = 12;
  QuasiStatic solver = pair.solver({.load_steps = steps});
  const Ledger end = load(solver);
  EXPECT_EQ(solver.steps(), steps);
  const double force = solver.reactions(pair.count).forces[pair.low][2];
  const double block = young * 16 * spacing * spacing / (4 * spacing);
  const double coefficient = 16 * 4.0 / 3 * modulus * std::sqrt(spacing / 4);
  double overlap = 0, too_much = 0.05 * spacing;  // where the force of the row is that of the blocks, by halving
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (overlap + too_much);
    const bool is_less = coefficient * std::pow(middle, 1.5) < 0.5 * block * (0.05 * spacing - middle);
    (is_less ? overlap : too_much) = middle;
  }
  const double expected = coefficient * std::pow(overlap, 1.5);
  EXPECT_NEAR(force, expected, 0.2 * expected);
  const double stored = 0.4 * force * std::pow(force / coefficient, 2.0 / 3);
  EXPECT_NEAR(-end.contact, stored, 0.2 * stored);
  // Trapezoids sum the work: for a force that grows as x^(3/2) too much by 0.3/n² of it, 2 % in 4 steps.
  EXPECT_LT(end.balance_error, 5e-3);
}

// ---- Contact between surfaces --------------------------------------------------------------------------------------

contact::SurfaceLaw surface_law() {
  const double longitudinal = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
  return {.modulus = longitudinal, .radius = contact::reach_in_spacings * spacing, .spacing = spacing};
}

// Two blocks with a common face. The upper one is pressed down until t = 0.25, then dragged along the lower one, which
// is held at the bottom; nothing guides them between.
struct Rubbed : Loaded {
  Rubbed(double depth, double way, double friction)
      : Loaded(lattice_of({6, 6, 8}, elastic(young, poisson)), Pair::two_blocks) {
    const std::vector<int> top = layer(body, spec, 2, true), bottom = layer(body, spec, 2, false);
    for (int axis = 0; axis < 3; ++axis) {
      const int condition = move(bottom, axis, "0");
      if (axis == 0) foot = condition;
    }
    move(top, 2, "value = " + ramp(-4 * depth) + "; if (t > 0.25) { value = " + number(-depth) + "; }");
    drag = move(top, 0, "value = 0; if (t > 0.25) { value = " + ramp(way / 0.75) + " - " + number(way / 3) + "; }");
    down = drag - 1;
    move(top, 1, "0");
    contact = contact::Contact({{0, 1, {surface_law(), friction}}}, body.domain);
  }
  int foot, down, drag;
};

// At first it sticks, with a force in proportion to the way; at last all slides, by μ times the load: the normals of
// the faces are theirs within a hundredth, and the faces slide over each other by equal lattices.
TEST(QuasiStaticSurfaces, DragWithTheirShareOfThePressure) {
  constexpr double friction = 0.3;
  Rubbed block(0.02 * spacing, 0.2 * spacing, friction);
  QuasiStatic solver = block.solver({.load_steps = 32});
  double stuck = 0;
  load(solver, [&](QuasiStatic& now) {
    const Reactions reactions = now.reactions(block.count);
    const double along = reactions.forces[block.drag][0], load = -reactions.forces[block.down][2];
    EXPECT_LT(sum_of(reactions), left_over(block, {}, 2 * load)) << now.time();
    if (now.time() < 0.26) {
      EXPECT_LT(std::abs(along), 1e-3 * load);
    }
    if (now.time() > 0.26 && stuck == 0) stuck = along;
    if (now.time() > 0.9) {
      EXPECT_NEAR(along, friction * load, 0.01 * friction * load);
    }
  });
  EXPECT_GT(stuck, 0);
  EXPECT_LT(solver.ledger().contact, 0);  // friction takes
  // Errors of a law in rates: the strain; and of trapezoids under a force that curves as points begin to touch, over 8
  // steps.
  EXPECT_LT(solver.ledger().balance_error, 0.01);
}

// Two blocks of which every point is prescribed: all that is put in is stored by contact. The trapezoids of a force
// that goes with the overlap u as u/(1 − u) put in too much by some thousandths in 16 steps.
TEST(QuasiStaticSurfaces, StoreWhatPrescribedPointsPutIn) {
  Loaded pressed(lattice_of({3, 3, 6}, elastic(young, poisson)), Pair::two_blocks);
  std::vector<int> halves[2];
  for (int i = 0; i < pressed.body.owned(); ++i) halves[pressed.body.domain.cloud.blocks[i]].push_back(i);
  for (int axis = 0; axis < 3; ++axis) {
    pressed.move(halves[0], axis, "0");
    pressed.move(halves[1], axis, axis == 2 ? ramp(-0.1 * spacing) : "0");
  }
  pressed.contact = contact::Contact({{0, 1, {surface_law(), 0}}}, pressed.body.domain);
  QuasiStatic solver = pressed.solver({.load_steps = 16});
  const Ledger end = load(solver);
  EXPECT_GT(end.external, 0);
  EXPECT_NEAR(-end.contact, end.external, 0.01 * end.external);
  EXPECT_LT(end.balance_error, 0.01);
}

}  // namespace
}  // namespace strut
