// Every condition does what the deck says, and the ledger sees its work.
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <span>

#include "regression/stiff_ended_bar.hpp"
#include "regression/stretched.hpp"
#include "verification/larger.hpp"

namespace strut::regression {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// The largest of `value` over all owned points of all ranks that `member` picks; at least one must be.
double worst(const Simulation& run, const std::function<bool(int)>& member, const std::function<double(int)>& value) {
  double largest = -1;
  for (int i = 0; i < run.scene.body.owned(); ++i) {
    if (member(i)) largest = larger(largest, std::abs(value(i)));
  }
  largest = larger(largest, run.scene.body.domain.communicator.max(largest));
  EXPECT_GE(largest, 0) << "no point is a member";
  return largest;
}
bool every(int) { return true; }

TEST(Condition, PrescribedDisplacementIsReachedExactly) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = along("pull", "Prescribed Displacement", "foot", "z", "-1.5*t*(1 + 100*x)*(2 - 200*y)") +
                     along("slide", "Prescribed Displacement", "top", "x", "value = 1.0e-3*sin(1e5*t)");
  Simulation run(folder, parts);
  const Ledger end = run.go();
  const double t = 5e-6;
  EXPECT_EQ(end.time, t);
  const auto error = [&](int i, int c, double wanted) { return run.body().displacement(i)[c] - wanted; };
  // The last step lands on X + u: what is left is the round-off of a place below 8 mm.
  const double round_off = 4 * epsilon * 8e-3;
  EXPECT_LE(worst(
                run, [&](int i) { return run.in_set(i, "foot"); },
                [&](int i) {
                  const Vector X = run.reference(i);
                  return error(i, 2, -1.5 * t * (1 + 100 * X[0]) * (2 - 200 * X[1]));
                }),
            round_off);
  EXPECT_LE(
      worst(
          run, [&](int i) { return run.in_set(i, "top"); }, [&](int i) { return error(i, 0, 1e-3 * std::sin(0.5)); }),
      round_off);
  EXPECT_GT(end.external, 0);
}

// However few steps follow its turns: the first one goes half of a period on, and back.
TEST(Condition, PrescribedDisplacementBeginsAtItsSlope) {
  const RunFolder folder;
  for (const auto& [value, speed] :
       {std::pair{"1e-9*sin(3e7*t)", 0.03}, {"1e-9*sin(2e7*t)", 0.02}, {"1e3*t^2", 0.0}, {"1e-9*(t &gt; 0)", 0.01}}) {
    Parts parts;
    parts.conditions = along("all", "Prescribed Displacement", "all", "z", value);
    parts.verlet = key("Fixed dt", "1e-7");
    parts.times = key("Final Time", "5e-7");
    Simulation run(folder, parts);
    std::optional<double> first;
    run.go([&](const Ledger& now) { first = first.value_or(now.momentum[2]); });
    EXPECT_NEAR(*first / run.mass(), speed, 1e-5 * speed) << value;  // the third difference over a part of a step
  }
}

// A table that ends at the final time describes the motion up to it. The velocities around that time, which the kinetic
// energy and the reaction of the last row need, are those of the same motion that goes on, also where a drift of 0.1 %
// is added. The third table ends before.
TEST(Condition, TableThatEndsAtTheFinalTimeDoesNotStopTheMotion) {
  const auto end_of = [](const std::string& value, bool is_tool) {
    const RunFolder folder;
    Parts parts;
    parts.conditions = along("hold", "Prescribed Displacement", "foot", "z", "0") +
                       (is_tool ? section("push", key("Type", "Rigid Plane") + key("Point", "0 0 5.5e-3") +
                                                      key("Normal", "0 0 -1") + key("Travel Z", value))
                                : along("push", "Prescribed Displacement", "top", "z", value));
    Simulation run(folder, parts);
    return run.go();
  };
  for (const bool is_tool : {false, true}) {
    const Ledger goes_on = end_of("-20*t", is_tool), ends = end_of("table(t, 0, 0, 5e-6, -1e-4)", is_tool),
                 drifts = end_of("table(t, 0, 0, 5e-6, -1e-4) - 0.02*t", is_tool),
                 stopped = end_of("table(t, 0, 0, 4e-6, -8e-5)", is_tool);
    // The table's value is that of the product but for round-off.
    EXPECT_NEAR(ends.kinetic / goes_on.kinetic, 1, 1e-9) << is_tool;
    EXPECT_NEAR(ends.momentum[2] / goes_on.momentum[2], 1, 1e-9) << is_tool;
    EXPECT_NEAR(drifts.momentum[2] / goes_on.momentum[2], 1.001, 1e-4) << is_tool;  // a tenth of the drift
    EXPECT_GT(std::abs(stopped.momentum[2] / goes_on.momentum[2] - 1), 1e-2) << is_tool;
  }
}

// A prescribed velocity moves its points on at the final time, if its value falls to 0 then, if it falls later, and if
// the last row of its table is at that time.
TEST(Condition, VelocityThatEndsAtTheFinalTimeDoesNotStopTheMotion) {
  const auto end_of = [](const std::string& value) {
    const RunFolder folder;
    Parts parts;
    parts.conditions = along("hold", "Prescribed Displacement", "foot", "z", "0") +
                       along("push", "Prescribed Velocity", "top", "z", value);
    Simulation run(folder, parts);
    return run.go();
  };
  const auto expect_to_go_on = [&](const std::string& value, const std::string& forever) {
    const Ledger ends = end_of(value), goes_on = end_of(forever);
    EXPECT_NEAR(ends.kinetic / goes_on.kinetic, 1, 1e-9) << value;  // round-off of a table's value
    EXPECT_NEAR(ends.external / goes_on.external, 1, 1e-9) << value;
  };
  expect_to_go_on("value = 0; if (t &lt; 5e-6) { value = -20; }", "-20");
  expect_to_go_on("value = 0; if (t &lt;= 5e-6) { value = -20; }", "-20");
  expect_to_go_on("table(t, 0, 0, 5e-6, -20)", "-4e6*t");
  expect_to_go_on("(t &lt; 5e-6)*-20 - 1e-3*t", "-20 - 1e-3*t");
  EXPECT_LT(end_of("value = 0; if (t &lt; 4e-6) { value = -20; }").kinetic, 0.9 * end_of("-20").kinetic);
}

TEST(Condition, PrescribedVelocityIsFollowed) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = along("push", "Prescribed Velocity", "top", "y", "1e6*t*(1 + 100*x)");
  Simulation run(folder, parts);
  run.go();
  // A velocity that is linear in time is taken at mid-step, so the displacement is its integral exactly; round-off of
  // a place of 8 mm gathers over some 50 steps.
  EXPECT_LE(worst(
                run, [&](int i) { return run.in_set(i, "top"); },
                [&](int i) {
                  const double u = 0.5e6 * 5e-6 * 5e-6 * (1 + 100 * run.reference(i)[0]);
                  return run.body().displacement(i)[1] - u;
                }),
            50 * epsilon * 8e-3);
}

// Prescribed motion does work on the body, whose energy it must become.
TEST(Condition, WorkOfPrescribedMotionBecomesEnergy) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = along("hold", "Prescribed Displacement", "foot", "z", "0") +
                     along("pull", "Prescribed Displacement", "top", "z", "value = 1e6*t*t");
  Simulation run(folder, parts);
  double largest = 0;
  const Ledger end = run.go([&](const Ledger& now) {
    if (now.time > 2e-6) largest = larger(largest, now.balance_error);  // before that there is hardly an energy
  });
  EXPECT_GT(end.external, 0);
  EXPECT_NEAR(end.kinetic + end.elastic + end.stabilization, end.external, 1e-3 * end.external);
  EXPECT_LT(largest, 1e-2);
}

// Nothing holds the block, and every point feels the same force per volume: it stays undeformed.
TEST(Condition, BodyForceGivesItsImpulseAndItsWork) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = along("pull", "Body Force", "all", "z", "3e10") + along("drag", "Body Force", "bar", "x", "-1e10");
  parts.verlet = key("Fixed dt", "1e-7");
  Simulation run(folder, parts);
  Ledger start;
  const Ledger end = run.go([&](const Ledger& now) {
    if (now.time == 0) start = now;
  });
  const double impulse = run.volume() * 5e-6;
  // The round-off of places (1e-16 of 6 mm) makes strains of 1e-15 and thus forces, of both signs: 1e-12 of the load.
  const double round_off = 1e-11;
  EXPECT_NEAR(end.momentum[2], 3e10 * impulse, round_off * 3e10 * impulse);
  EXPECT_NEAR(end.momentum[0], -1e10 * impulse, round_off * 3e10 * impulse);
  EXPECT_NEAR(end.momentum[1], 0, round_off * 3e10 * impulse);
  EXPECT_NEAR(end.external - start.external, end.kinetic - start.kinetic, round_off * end.kinetic);
  EXPECT_LT(end.balance_error, round_off);
  // The kinetic energy of central differences is ½ m v⁻·v⁺, which is below ½ m v² by (Δt/2t)² of it; here t = 50 Δt.
  const double kinetic = 0.5 * end.momentum.squaredNorm() / run.mass();
  EXPECT_NEAR(end.kinetic, kinetic, 1.001e-4 * kinetic);
}

// A time that is no multiple of the step: the last one is shorter, and yet the ledger of the end is of the end.
TEST(Condition, ImpulseOfABodyForceDoesNotDependOnTheSteps) {
  const RunFolder folder;
  for (const std::string step : {"0.96e-7", "1e-7", "0.99e-7"}) {
    Parts parts;
    parts.conditions = along("pull", "Body Force", "all", "z", "3e10");
    parts.verlet = key("Fixed dt", step);
    Simulation run(folder, parts);
    const double force = 3e10 * run.volume();
    double largest = 0;
    const Ledger end =
        run.go([&](const Ledger& now) { largest = larger(largest, std::abs(now.momentum[2] - force * now.time)); });
    EXPECT_EQ(end.time, 5e-6);
    EXPECT_NEAR(end.momentum[2], force * 5e-6, 1e-11 * force * 5e-6) << step;  // round-off, as above
    // Where the step changes, the mean of the velocities before and after is off by a quarter of the change.
    EXPECT_LT(largest, 0.25 * 1e-7 * force) << step;
    // And the energy of central differences changes by the square of the step over the time, 4e-4 of it.
    EXPECT_NEAR(end.external, end.kinetic, 4e-4 * end.kinetic) << step;
  }
}

// Times are sums of steps, with round-off: none of it may be left over for a last step of nearly no length, over which
// a prescribed motion would have a velocity without meaning.
TEST(Condition, NoStepIsTiny) {
  const RunFolder folder;
  for (const std::string& verlet : {key("Fixed dt", "1e-7"), key("Fixed dt", "0.5e-7"), key("Safety Factor", "0.8")}) {
    for (const std::string initial_time : {"0", "1e-3", "-2e-6", "10", "70", "100"}) {
      Parts parts;
      parts.conditions = along("pull", "Prescribed Displacement", "foot", "z", "0");
      parts.times = key("Initial Time", initial_time) +
                    key("Final Time", std::to_string(std::stod(initial_time) * 1e6 + 5) + "e-6");
      parts.verlet = verlet;
      Simulation run(folder, parts);
      double shortest = 1;
      run.go([&](const Ledger& now) { shortest = std::min(shortest, now.dt); });
      EXPECT_GT(shortest, 1e-9) << verlet << initial_time;
    }
  }
}

// Points that are not at the end of a body have no mirror image: they are held, and a warning says so.
TEST(Condition, SymmetryPlaneWithinABodyKeepsItsPoints) {
  const RunFolder folder;
  Parts parts;
  parts.node_sets = key("diagonal", "(x + y - 4e-3)*(x + y - 4e-3) &lt; 1e-12");
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-30*(1 + 100*x)") +
                     along("drift", "Initial Velocity", "all", "x", "7") +
                     plane("low", "Symmetry Plane", "all", "0 0 0", "0 0 2") +
                     plane("slant", "Symmetry Plane", "diagonal", "0 0 0", "1 1 0");
  Simulation run(folder, parts);
  EXPECT_NE(run.advice.warnings.find("Boundary Conditions > slant: points of the set are up to 0.00283 m away"),
            std::string::npos);
  EXPECT_EQ(run.advice.warnings.find("Boundary Conditions > low"), std::string::npos) << "plane strain is meant";
  double largest = 0;
  run.go([&](const Ledger&) {
    largest = larger(largest, worst(run, every, [&](int i) { return run.body().displacement(i)[2]; }));
    largest = larger(largest, worst(
                                  run, [&](int i) { return run.in_set(i, "diagonal"); },
                                  [&](int i) {
                                    const Vector u = run.body().displacement(i);
                                    return u[0] + u[1];
                                  }));
  });
  EXPECT_LT(largest, 1e-12 * 6e-3);  // of the block's size: some 50 additions to places, each rounded to 1e-16
  // The points do move along their planes, and off them where nothing holds them.
  EXPECT_GT(
      worst(
          run, [&](int i) { return run.in_set(i, "diagonal"); }, [&](int i) { return run.body().displacement(i)[0]; }),
      1e-6);
  const auto off_the_plane = [&](int i) { return run.body().displacement(i)[0] + run.body().displacement(i)[1]; };
  EXPECT_GT(worst(
                run, [&](int i) { return !run.in_set(i, "diagonal"); }, off_the_plane),
            1e-6);
}

// A pulse, smooth and some forty spacings long, runs up a column in uniaxial strain. The energy in it when the pulse
// would be on its way back is the square of the part that the end reflects. Between points of a lattice the speed of a
// wave of this length is 1 % below that of the continuum; the end is matched to the latter: half a percent is
// reflected.
// The last `stiff_layers` are 6.25 times as stiff. `width`: of the cells, which are 1 mm high, mm.
double reflected_part(const std::string& end, int stiff_layers = 0, const std::string& verlet = "", double width = 1) {
  const Lattice lattice{.nx = 2, .ny = 2, .nz = 100, .plate_layers = stiff_layers};
  const RunFolder folder(lattice);
  write_stretched(folder, lattice, {width, width, 1});
  Parts parts = stiff_layers > 0 ? stiff_ended_bar(copper(), "18.72e9") : Parts();
  const double modulus = stiff_layers > 0 ? 18.72e9 : 117e9;             // E, Pa
  const double speed = std::sqrt(modulus * 0.65 / (1.35 * 0.3) / 8930);  // c_p, m/s
  const double duration = 40e-3 / speed;                                 // of the pulse, s
  const std::string t0 = std::to_string(1e6 * duration) + "e-6";
  parts.conditions =
      along("x", "Prescribed Displacement", "all", "x", "0") + along("y", "Prescribed Displacement", "all", "y", "0") +
      along("pulse", "Prescribed Velocity", "foot", "z",
            "if (t &lt; " + t0 + ") { value = 1 - cos(6.283185307179586*t/" + t0 + "); } else { value = 0; }") +
      end;
  parts.node_sets = key("last", "z &gt; 99e-3");
  parts.verlet += verlet;
  parts.times = key("Final Time", std::to_string(1e6 * 180e-3 / speed) + "e-6");
  Simulation run(folder, parts);
  double most = 0;
  const Ledger at_end = run.go([&](const Ledger& now) { most = larger(most, now.kinetic + now.elastic); });
  EXPECT_LT(at_end.balance_error, 1e-3);
  EXPECT_TRUE(stiff_layers == 0 || run.solver.most_substeps() > 1);
  return std::sqrt((at_end.kinetic + at_end.elastic) / most);
}

TEST(Condition, NonReflectingEndLetsAPulsePass) {
  EXPECT_GT(reflected_part(""), 0.99) << "a free end reflects all";
  EXPECT_LT(reflected_part(
                section("open", key("Type", "Non-Reflecting End") + key("Node Set", "last") + key("Normal", "0 0 1"))),
            0.02);
}

// The end damps the layer by its thickness, which is no edge of a cube here.
TEST(Condition, NonReflectingEndLetsAPulsePassThroughCellsThatAreNoCubes) {
  const std::string end =
      section("open", key("Type", "Non-Reflecting End") + key("Node Set", "last") + key("Normal", "0 0 1"));
  EXPECT_LT(reflected_part(end, 0, "", 0.5), 0.02);
}

// Where the column goes on 6.25 times as stiff, and so with 2.5 times the impedance, (2.5 - 1) / (2.5 + 1) of a wave
// comes back; the rest leaves through the end of what is stiff. There are substeps there, with one layer at the end
// that has half the inertia.
TEST(Condition, NonReflectingEndLetsAPulsePassThroughPointsWithSubsteps) {
  const std::string end =
      section("open", key("Type", "Non-Reflecting End") + key("Node Set", "last") + key("Normal", "0 0 1"));
  EXPECT_NEAR(reflected_part(end, 12), 1.5 / 3.5, 0.01);  // half a percent as above, and the jump between two points
}

// Mass is added to the layer at the end, which has half the inertia: as much as a seventh of a layer, which reflects 1
// %.
TEST(Condition, NonReflectingEndLetsAPulsePassThroughPointsWithAddedMass) {
  const std::string end =
      section("open", key("Type", "Non-Reflecting End") + key("Node Set", "last") + key("Normal", "0 0 1"));
  EXPECT_LT(reflected_part(end, 0, key("Mass Scaling dt", "1.3e-7")), 0.03);  // and 1.3 % as without
}

// A block is struck by a load on the middle of its top, and its other faces let waves leave: alone, where two of them
// meet at an edge, and three at a corner. A soil's box has five. The loads over, energy only goes.
void expect_energy_to_fall(const std::string& material, const std::vector<std::string>& faces, int n = 6) {
  const RunFolder folder(Lattice{.nx = n, .ny = n, .nz = n, .spacing = 6e-3 / n});
  const std::string first = std::to_string(6.0 / n) + "e-3", last = std::to_string(6 - 6.0 / n) + "e-3";
  Parts parts;
  parts.materials = material;
  parts.blocks =
      section("soil", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "2.015"));
  const std::map<std::string, std::pair<std::string, std::string>> all{{"left", {"x &lt; " + first, "-1 0 0"}},
                                                                       {"right", {"x &gt; " + last, "1 0 0"}},
                                                                       {"front", {"y &lt; " + first, "0 -3 0"}},
                                                                       {"back", {"y &gt; " + last, "0 1 0"}},
                                                                       {"below", {"z &lt; " + first, "0 0 -1"}}};
  parts.node_sets =
      key("hit", "z &gt; 5e-3 &amp;&amp; fabs(x - 3e-3) &lt; 1.1e-3 &amp;&amp; fabs(y - 3e-3) &lt; 1.1e-3");
  parts.conditions = along("blow", "Body Force", "hit", "z", "if (t &lt; 1e-6) { value = -1e10; } else { value = 0; }");
  for (const std::string& face : faces) {
    parts.node_sets += key(face, all.at(face).first);
    parts.conditions +=
        section(face, key("Type", "Non-Reflecting End") + key("Node Set", face) + key("Normal", all.at(face).second));
  }
  parts.times = key("Final Time", "40e-6");  // a shear wave crosses the block thirteen times
  Simulation run(folder, parts);
  double put_in = 0, least = 0, rise = 0;
  const Ledger end = run.go([&](const Ledger& now) {
    const double energy = now.kinetic + now.elastic + now.stabilization;
    if (now.time < 1.2e-6) {
      put_in = least = std::max(put_in, energy);
      return;
    }
    rise = larger(rise, energy - least), least = std::min(least, energy);
  });
  // Steps that are halved and subcycled once in a while swing by so much of the energy.
  EXPECT_LT(rise, 0.01 * put_in) << faces.size() << material;
  EXPECT_LT(end.balance_error, 1e-3) << faces.size() << material;  // as of other runs
  const double left = end.kinetic + end.elastic + end.stabilization;
  EXPECT_GT(left, -1e-3 * put_in);
  if (faces.empty()) {
    EXPECT_GT(left, 0.9 * put_in);
  } else {
    EXPECT_LT(left, (faces.size() == 1 ? 0.4 : 0.2) * put_in) << faces.size() << material;
  }
}

TEST(Condition, NonReflectingEndsThatMeetLetEnergyFallOnly) {
  const std::string ordinary = changed(copper(), "Elastic Correspondence", "Elastic");
  const std::string quadratic = changed(copper(), key("Density", "8930"),
                                        key("Density", "8930") + key("Formulation", "Quadratic Correspondence"));
  const std::vector<std::string> all{"left", "front", "below", "right", "back"};
  const auto expect = [&](const std::string& material, const std::vector<int>& counts) {
    for (const int count : counts) expect_energy_to_fall(material, {all.begin(), all.begin() + count});
  };
  expect(copper(), {0, 1, 2, 3, 5});
  // With more points those at the corner would take substeps, in which the work of dampers is 5 % of the energy too
  // much.
  expect_energy_to_fall(copper(), {"left", "front", "below"}, 12);
  expect(ordinary, {2, 5});
  expect(quadratic, {2, 5});
}

// A set of two layers, ends on both sides of one layer, and one given twice.
TEST(Condition, NonReflectingEndIsOneLayerAndLeavesInertia) {
  const RunFolder folder;
  const auto error = [&](const std::vector<std::string>& ends, const std::string& set) {
    Parts parts;
    parts.node_sets = key("end", set);
    for (const std::string& normal : ends) {
      parts.conditions += section("e" + std::to_string(parts.conditions.size()),
                                  key("Type", "Non-Reflecting End") + key("Node Set", "end") + key("Normal", normal));
    }
    try {
      Simulation run(folder, parts);
    } catch (const Error& thrown) {
      return std::string(thrown.what());
    }
    return std::string();
  };
  EXPECT_EQ(error({"0 0 1"}, "z &gt; 5e-3"), "");
  EXPECT_EQ(error({"0 0 -1"}, "z &gt; 5e-3"), "");
  EXPECT_NE(error({"0 0 1"}, "z &gt; 4e-3")
                .find("Boundary Conditions > e0 > Node Set: 16 of its points have others of the body on both sides "
                      "along Normal, one of them at (0.0005, 0.0005, 0.0045) m; expected one layer"),
            std::string::npos)
      << error({"0 0 1"}, "z &gt; 4e-3");
  for (const char* second : {"0 0 1", "0 0 -1"}) {
    EXPECT_NE(error({"0 0 1", second}, "z &gt; 5e-3")
                  .find("16 points, one of them at (0.0005, 0.0005, 0.0055) m, are of "
                        "other ends, too, and together these leave nothing"),
              std::string::npos)
        << second;
  }
}

TEST(Condition, InitialVelocityIsAFunctionOfThePlace) {
  const RunFolder folder;
  Parts parts;
  parts.times = key("Initial Time", "2e-3") + key("Final Time", "2.001e-3");
  parts.conditions = along("a", "Initial Velocity", "all", "x", "-1e3*y") +
                     along("b", "Initial Velocity", "all", "y", "1e3*x + 500*t") +
                     along("c", "Initial Velocity", "foot", "z", "-5");
  Simulation run(folder, parts);
  const auto error = [&](int i) {
    const Vector X = run.reference(i);
    const Vector wanted(-1e3 * X[1], 1e3 * X[0] + 1, run.in_set(i, "foot") ? -5 : 0);
    return (run.body().velocity[i] - wanted).norm();
  };
  EXPECT_LE(worst(run, every, error), 8 * epsilon * 5);  // two operations on numbers up to 5
  run.solver.advance_velocity(run.deck.solver.final_time);
  const Ledger start = run.solver.ledger();
  // Nothing is strained yet: what the first kick adds is the round-off of places, 1e-16 of 6 mm, over a spacing, times
  // the speed of sound.
  EXPECT_LE(worst(run, every, error), 1e-11);
  EXPECT_EQ(start.time, 2e-3);
  EXPECT_EQ(start.balance_error, 0);
}

// The action of a wall on a body, step by step.
class Wall {
 public:
  // `offset`: of the wall along its normal, m.
  Wall(Simulation& run, const Vector& normal, double offset = 0) : run_(run), normal_(normal), offset_(offset) {}

  // At every step, after the kick.
  void look(const Ledger& now) {
    // A body's velocities are about its time as if the step before were as long as the next: so is the push on it.
    const double kick = now.dt, both = previous_dt_ + now.dt, part = previous_dt_ / both;
    previous_dt_ = now.dt;
    const Body& body = run_.body();
    Vector push = Vector::Zero();
    for (int i = 0; i < body.owned(); ++i) {
      const Vector gained = body.mass(i) * (body.velocity[i] - body.previous_velocity[i]);
      const Vector from_wall = gained - kick * body.domain.volume(i) * body.force_density[i];
      push += from_wall;
      hardest_pull_ = std::max(hardest_pull_, -normal_.dot(from_wall));
      lowest_ = std::min(lowest_, normal_.dot(body.current(i)) - offset_);
    }
    body.domain.communicator.sum(std::span(push.data(), 3));
    push *= 0.5 * both / kick;
    impulse_ = before_ + part * push;
    before_ += push;
    worst_balance_ = larger(worst_balance_, now.balance_error);
  }

  // Over all ranks and steps so far.
  double lowest() const { return run_.body().domain.communicator.min(lowest_); }              // m, above the wall
  double hardest_pull() const { return run_.body().domain.communicator.max(hardest_pull_); }  // on a point, kg m/s
  const Vector& impulse() const { return impulse_; }  // until now: of the last push the part of the step before it
  double worst_balance() const { return worst_balance_; }

 private:
  Simulation& run_;
  Vector normal_, impulse_ = Vector::Zero(), before_ = Vector::Zero();
  double offset_, previous_dt_ = 0, lowest_ = 1, hardest_pull_ = 0, worst_balance_ = 0;
};

TEST(RigidPlane, BlockBouncesOff) {
  Lattice lattice;
  lattice.nz = 12;
  const RunFolder folder(lattice);
  Parts parts;
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-20") +
                     plane("wall", "Rigid Plane", "all", "0 0 -0.1e-3", "0 0 3");
  parts.times = key("Final Time", "15e-6");
  Simulation run(folder, parts);
  Wall wall(run, Vector::UnitZ(), 0.4e-3);  // where points are when their cells, of 1 mm, touch
  const Ledger end = run.go([&](const Ledger& now) { wall.look(now); });
  const double thrown = 20 * run.mass();
  EXPECT_GE(wall.lowest(), -1e-12 * 12e-3);                                  // of the block's size
  EXPECT_LT(wall.lowest(), 1e-9);                                            // it did touch
  EXPECT_LE(wall.hardest_pull(), 1e-13 * thrown);                            // round-off of a point's impulse
  EXPECT_NEAR(end.momentum[2], wall.impulse()[2] - thrown, 1e-11 * thrown);  // round-off of a sum over some 100 steps
  // The bar is short and thick: some of the energy stays in vibrations.
  EXPECT_GT(end.momentum[2], 0.5 * thrown);
  EXPECT_LE(end.momentum[2], thrown);
  EXPECT_LT(wall.worst_balance(), 1e-3);
}

// A wall that is not in line with the lattice: points touch one after another.
TEST(RigidPlane, SlantingWallPushesAlongItsNormalOnly) {
  const RunFolder folder;
  Parts parts;
  parts.conditions =
      along("flight", "Initial Velocity", "all", "z", "-20") + plane("wall", "Rigid Plane", "all", "0 0 0", "1 0 3");
  parts.times = key("Final Time", "40e-6");
  Simulation run(folder, parts);
  const Vector normal = Vector(1, 0, 3).normalized();
  Wall wall(run, normal);
  const Ledger end = run.go([&](const Ledger& now) { wall.look(now); });
  const double thrown = 20 * run.mass();
  EXPECT_GE(wall.lowest(), -1e-12 * 6e-3);  // of the block's size
  EXPECT_LE(wall.hardest_pull(), 1e-13 * thrown);
  const Vector& impulse = wall.impulse();
  EXPECT_GT(normal.dot(impulse), 0.1 * thrown);
  EXPECT_LT((impulse - normal.dot(impulse) * normal).norm(), 1e-11 * thrown);             // round-off: no friction
  EXPECT_LT((end.momentum + thrown * Vector::UnitZ() - impulse).norm(), 1e-11 * thrown);  // round-off of a sum
  EXPECT_LT(wall.worst_balance(), 1e-3);
}

TEST(RigidPlane, LeavesAloneWhatFliesAway) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "20") +
                     plane("wall", "Rigid Plane", "all", "0 0 0.5e-3", "0 0 1");  // the lowest points lie on it
  Simulation run(folder, parts);
  const Ledger end = run.go();
  EXPECT_EQ(end.tools, 0);
  EXPECT_NEAR(end.momentum[2], 20 * run.mass(), 1e-11 * 20 * run.mass());  // round-off of a sum
}

// A coarse Taylor bar of copper, 3.2 mm in radius and 32.4 mm long, at 227 m/s.
Parts taylor_parts() {
  Parts parts;
  parts.materials = copper(key("Yield Stress", "400e6") +
                           section("Hardening", key("Type", "Linear") + key("Hardening Modulus", "100e6")));
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.2e-3"));
  parts.conditions =
      along("flight", "Initial Velocity", "all", "z", "-227") + plane("wall", "Rigid Plane", "all", "0 0 0", "0 0 1");
  parts.times = key("Final Time", "10e-6");
  parts.verlet = key("Subcycling", "false");  // Wall sees velocities once a step
  return parts;
}

Lattice taylor_lattice() {
  Lattice lattice;
  lattice.spacing = 0.0324 / 30;
  lattice.nx = lattice.ny = 6;
  lattice.nz = 30;
  const double center = 3 * lattice.spacing;
  lattice.inside = [center](double x, double y) { return std::hypot(x - center, y - center) <= 0.0032; };
  return lattice;
}

TEST(TaylorImpact, EnergyAndMomentumAreAccountedFor) {
  const RunFolder folder(taylor_lattice());
  Simulation run(folder, taylor_parts());
  Wall wall(run, Vector::UnitZ());
  const Ledger end = run.go([&](const Ledger& now) { wall.look(now); });
  const double thrown = 227 * run.mass();
  EXPECT_LT(wall.worst_balance(), 1e-2);
  EXPECT_GT(end.dissipated, 0.1 * end.kinetic);  // it is a plastic impact
  EXPECT_GT(wall.impulse()[2], 0.1 * thrown);
  EXPECT_NEAR(end.momentum[2], wall.impulse()[2] - thrown, 1e-11 * thrown);  // round-off of a sum over some 100 steps
  EXPECT_GE(wall.lowest(), -1e-12 * 0.0324);                                 // of the bar's length
  EXPECT_LE(wall.hardest_pull(), 1e-13 * thrown);                            // round-off of a point's impulse
}

}  // namespace
}  // namespace strut::regression
