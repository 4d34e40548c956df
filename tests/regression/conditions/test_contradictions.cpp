// Conditions that contradict each other at a point, or throw it somewhere: refused, or a warning, when the deck is set
// up, by explicit steps and in equilibria alike. Conditions that agree act together.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "verification/larger.hpp"

namespace strut::regression {
namespace {

// A block of 4 × 4 × 6 points. The four at the edge of "foot" (z = 0.5 mm) and "side" (x = 0.5 mm) are in both.
Parts block(const std::string& conditions) {
  Parts parts;
  parts.node_sets = key("side", "x &lt; 1e-3");
  parts.conditions = conditions;
  return parts;
}

enum class Loading { sudden, slow };

std::string text_of(const Parts& parts, Loading loading) {
  return loading == Loading::sudden ? parts.text() : changed(parts.text(), R"(name="Verlet")", R"(name="QuasiStatic")");
}

struct Said {
  std::string error, warnings;
};

// On every rank the same.
Said said_of(Parts parts, Loading loading = Loading::sudden, const std::string& of_equilibria = "") {
  const RunFolder folder;
  if (loading == Loading::slow) parts.verlet = of_equilibria;
  Said said;
  try {
    const deck::Deck deck = deck::read(folder.write("deck.xml", text_of(parts, loading)), folder.world);
    said.warnings = told_at_the_start(deck, folder.world).warnings;
  } catch (const Error& error) {
    said.error = error.what();
  }
  std::string of_first = said.error + said.warnings;
  folder.world.broadcast(of_first);
  EXPECT_EQ(folder.world.sum(of_first == said.error + said.warnings ? 0.0 : 1.0), 0) << "ranks say different things";
  return said;
}

void expect_said(const std::string& said, const std::vector<std::string>& fragments, const std::string& of) {
  for (const std::string& fragment : fragments) {
    EXPECT_NE(said.find(fragment), std::string::npos) << "expected \"" << fragment << "\" of " << of << " in:\n"
                                                      << said;
  }
}

std::string velocity(const std::string& name, const std::string& set, const std::string& axes,
                     const std::string& value) {
  return along(name, "Prescribed Velocity", set, axes, value);
}
std::string displacement(const std::string& name, const std::string& set, const std::string& axes,
                         const std::string& value) {
  return along(name, "Prescribed Displacement", set, axes, value);
}
std::string cut(const std::string& name, const std::string& set, const std::string& normal) {
  return plane(name, "Symmetry Plane", set, "0 0 0", normal);
}

std::string heat(const std::string& value) {
  return section("a", key("Type", "Prescribed Temperature") + key("Value", value));
}
std::string sides(const std::string& value) {
  return section("a", key("Type", "Periodic Sides") + key("Coordinate", "z") + key("Lower", "0") +
                          key("Upper", "6e-3") + key("Stretch", value));
}

TEST(Contradiction, OfTwoConditionsIsAnErrorThatNamesBothAndTheirPoints) {
  const std::vector<std::string> contradictions{
      velocity("a", "foot", "z", "1") + velocity("b", "side", "z", "-1"),
      displacement("a", "foot", "z", "t*1e-3") + displacement("b", "side", "z", "0"),
      displacement("a", "foot", "z", "0") + velocity("b", "side", "z", "1e-3"),
      velocity("a", "foot", "xyz", "1") + cut("b", "side", "2 0 0"),
      cut("a", "side", "1 0 0") + velocity("b", "foot", "zx", "1"),
      velocity("a", "foot", "z", "1 + 1e2*y") + velocity("b", "side", "z", "1"),
      velocity("a", "foot", "yz", "1") + cut("b", "side", "0 1 1"),  // oblique: z alone would leave y free
  };
  for (const std::string& conditions : contradictions) {
    for (const Loading loading : {Loading::sudden, Loading::slow}) {
      expect_said(said_of(block(conditions), loading).error,
                  {"1 problem\n", "Boundary Conditions > b: contradicts 'a': both prescribe the motion of 4 points",
                   "(0.0005, 0.0005, 0.0005) m"},
                  conditions);
    }
  }
  expect_said(
      said_of(block(along("a", "Initial Velocity", "all", "z", "1") + along("b", "Initial Velocity", "foot", "z", "5")))
          .error,
      {"Boundary Conditions > b: contradicts 'a': both prescribe the initial velocity of 16 points"},
      "initial velocities");
}

// Pulses of a 50th to a 500th of the run, some of them at no time that the text names; jumps a 50 000th apart.
TEST(Contradiction, OfAMomentIsAnError) {
  const std::string pulse = "t &lt; 1e-7 ? 5 : 0";
  const std::vector<std::string> contradictions{
      velocity("a", "foot", "x", "0") + velocity("b", "side", "x", pulse),
      velocity("a", "foot", "x", pulse) + cut("b", "side", "1 0 0"),
      velocity("a", "foot", "x", "(" + pulse + ")*1e3*y") + velocity("b", "side", "x", "0"),
      displacement("a", "foot", "z", "0") +
          displacement("b", "side", "z", "(t > 3.14e-6 &amp;&amp; t &lt; 3.1401e-6) ? 1e-5 : 0"),
      displacement("a", "foot", "xyz", "0") +
          velocity("b", "side", "z", "table(t, 0, 0, 1e-6, 0, 1.01e-6, 5, 1.02e-6, 0)"),
      velocity("a", "foot", "z", "0") + velocity("b", "side", "z", "5*exp(-((1e8*t - 217)^2))"),
      velocity("a", "foot", "z", "t &lt; 2e-6 ? 0 : 5") + velocity("b", "side", "z", "t &lt; 2.0001e-6 ? 0 : 5"),
      velocity("a", "foot", "z", "(1e6*t)^2 &lt; 3 ? 0 : 5") +
          velocity("b", "side", "z", "(1e6*t)^2 &lt; 3.001 ? 0 : 5"),
  };
  for (const std::string& conditions : contradictions) {
    expect_said(said_of(block(conditions)).error,
                {"1 problem\n", "Boundary Conditions > b: contradicts 'a': both prescribe the motion of 4 points"},
                conditions);
  }
  // At one of ten load steps, and no more than a millionth of one before and after it.
  const std::string at_one = "abs(1e6*t - 2.5) &lt; 1e-6 ? 1e-5 : 0";
  expect_said(
      said_of(block(displacement("a", "foot", "z", "0") + displacement("b", "side", "z", at_one)), Loading::slow).error,
      {"Boundary Conditions > b: contradicts 'a'"}, at_one);
}

// Whole faces that are held twice, in the way that decks of quarters and of bars do.
TEST(Contradiction, IsNotInWhatAgrees) {
  const std::vector<std::string> agreeing{
      velocity("a", "foot", "z", "1") + velocity("b", "side", "z", "1"),
      displacement("a", "foot", "z", "1e-3*t") + displacement("b", "side", "z", "t*1e-3"),
      displacement("a", "foot", "z", "5*t") + velocity("b", "side", "z", "5"),
      displacement("a", "foot", "x", "t") + cut("b", "foot", "0 0 1"),
      cut("a", "foot", "0 0 1") + cut("b", "side", "1 0 0") + cut("c", "all", "0 1 0"),
      cut("a", "foot", "0 0 1") + cut("b", "foot", "0 1 1") + cut("c", "side", "0 -1 1"),
      velocity("a", "foot", "z", "1") + cut("b", "side", "0 1 1"),
      // Jumps at one time by several rules, sums across a jump, and round-off of values near 0.
      velocity("a", "foot", "z", "1e6*t &lt; 2.1 ? 0 : 5") + velocity("b", "side", "z", "t &lt;= 2.1e-6 ? 0 : 5"),
      displacement("a", "foot", "z", "t &lt; 2.1e-6 ? 0 : 5*(t - 2.1e-6)") +
          velocity("b", "side", "z", "t &lt; 2.1e-6 ? 0 : 5"),
      velocity("a", "foot", "z", "5e6*t - 10") + velocity("b", "side", "z", "5e6*(t - 2e-6)"),
      displacement("a", "foot", "z", "1e-5 - 1e-5*cos(1e5*t)") + displacement("b", "side", "z", "2e-5*sin(5e4*t)^2"),
  };
  for (const std::string& conditions : agreeing) {
    for (const Loading loading : {Loading::sudden, Loading::slow}) {
      EXPECT_EQ(said_of(block(conditions), loading).error, "") << conditions;
    }
  }
  // Initial and prescribed values do not contradict each other.
  EXPECT_EQ(
      said_of(block(along("a", "Initial Velocity", "all", "z", "-20") + displacement("b", "foot", "z", "0"))).error,
      "");
}

// More load steps than there are looks: the first one is before the first look.
TEST(Contradiction, IsNotInWhatAgreesOverManyLoadSteps) {
  const Parts parts = block(displacement("a", "foot", "z", "5*t") + velocity("b", "side", "z", "5"));
  for (const char* const steps : {"500", "510", "2000"})
    EXPECT_EQ(said_of(parts, Loading::slow, key("Number of Load Steps", steps)).error, "") << steps;
}

// Planes that are not across each other, and a plane that a prescribed motion makes points slide along: each acts in
// what the others leave free. The bodies' other points pull at them. No plane is at the end of the body, which would go
// on behind it as its mirror image.
TEST(Conditions, ThatAreNotAcrossEachOtherAreAllKept) {
  const RunFolder folder;
  const auto largest = [&](const std::string& conditions, const std::function<double(const Vector&)>& error) {
    Parts parts = block(conditions + along("pull", "Body Force", "all", "xyz", "1e12*t*(1 + 1e2*z)"));
    Simulation run(folder, parts);
    run.go();
    double most = 0;
    for (int i = 0; i < run.body().owned(); ++i) {
      if (run.in_set(i, "foot")) most = larger(most, std::abs(error(run.body().displacement(i))));
    }
    return folder.world.max(most);
  };
  constexpr double round_off = 100 * 1e-16 * 8e-3;  // some 50 additions to places below 8 mm, in two directions
  const std::string planes = plane("a", "Symmetry Plane", "foot", "0 0 -5e-3", "0 0 1") + cut("b", "foot", "0 1 1");
  EXPECT_LT(largest(planes, [](const Vector& u) { return u[2]; }), round_off);
  EXPECT_LT(largest(planes, [](const Vector& u) { return u[1]; }), round_off);
  EXPECT_GT(largest(planes, [](const Vector& u) { return u[0]; }), 1e-9);
  const std::string slide = velocity("a", "foot", "z", "1") + cut("b", "foot", "0 1 1");
  EXPECT_LT(largest(slide, [](const Vector& u) { return u[2] - 5e-6; }), round_off);
  EXPECT_LT(largest(slide, [](const Vector& u) { return u[1] + 5e-6; }), round_off);
}

// With sets that are numbers of points, as only Peridigm's decks have them, the last condition counts.
TEST(Contradiction, InADeckOfPeridigmLeavesTheLast) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = key("First Node Set", "1 2 3 4") + along("a", "Initial Velocity", "all", "z", "10") +
                     along("b", "Initial Velocity", "First Node Set", "z", "-5") +
                     along("f", "Body Force", "all", "x", "1e9") +
                     along("g", "Body Force", "First Node Set", "x", "3e9") + displacement("u", "all", "y", "t") +
                     displacement("v", "First Node Set", "y", "-t");
  Simulation run(folder, parts);
  expect_said(run.advice.warnings,
              {"Boundary Conditions > a: 4 of its points", "are of 'b', too", "Boundary Conditions > f: 4",
               "Boundary Conditions > u: 4"},
              "warnings");
  run.solver.advance_velocity(run.deck.solver.final_time);
  const Body& body = run.body();
  for (int i = 0; i < body.owned(); ++i) {
    const bool is_first = body.domain.cloud.element_ids[i] <= 4;
    EXPECT_EQ(body.force_density[i][0], is_first ? 3e9 : 1e9);
    EXPECT_EQ(body.velocity[i][2], is_first ? -5 : 10);
    EXPECT_NEAR(body.velocity[i][1], is_first ? -1 : 1, 1e-6);  // round-off of places over a step
  }
}

TEST(Displacement, ThatIsNotZeroAtTheStartIsAnErrorOfExplicitSteps) {
  const std::vector<std::string> where{"Boundary Conditions > a > Value: ", "at the initial time",
                                       "and 15 other points"};
  for (const auto& [value, shown] : {std::pair("1e-4", "0.0001 m"), std::pair("5*(t + 1e-3)", "0.005 m"),
                                     std::pair("1e-4*cos(1e4*t)", "0.0001 m")}) {
    const Said said = said_of(block(displacement("a", "foot", "z", value)));
    expect_said(said.error, where, value);
    expect_said(said.error, {shown}, value);
    const Said slowly = said_of(block(displacement("a", "foot", "z", value)), Loading::slow);
    EXPECT_EQ(slowly.error, "");
    expect_said(slowly.warnings, {"Boundary Conditions > a > Value is ", shown, "first load step"}, value);
  }
  Parts later = block(displacement("a", "foot", "z", "5*(t - 1e-3)"));
  later.times = key("Initial Time", "1e-3") + key("Final Time", "1.005e-3");
  EXPECT_EQ(said_of(later).error, "");
  later.conditions = displacement("a", "foot", "z", "5*t");
  expect_said(said_of(later).error, {"0.005 m at the initial time, t = 0.001 s"}, "another initial time");
}

// Steps sample a value at one time each: a rectangle of 20 steps may get 19 or 21 of them, a smooth pulse integrates to
// far less than a percent, and of a single jump only the time is off, by half a step.
TEST(Pulses, OfFewStepsAreTold) {
  const auto load = [](const std::string& value) { return along("a", "Body Force", "foot", "z", value); };
  const std::string pulse =
      "if (t &lt; 2e-6) { value = 0; } else if (t &lt; 4e-6) { value = 1e9; } else { value = 0; }";
  for (const std::string& sampled : {load(pulse), velocity("a", "foot", "z", pulse)}) {
    expect_said(said_of(block(sampled)).warnings,
                {"WARNING: Boundary Conditions > a > Value: jumps twice within 2e-06 s", "off by up to a step"},
                sampled);
  }
  Parts in_small_steps = block(load(pulse));
  in_small_steps.verlet = key("Fixed dt", "5e-9");
  EXPECT_EQ(said_of(in_small_steps).warnings.find("jumps twice"), std::string::npos);
  const std::string tool = section("punch", key("Type", "Rigid Plane") + key("Point", "0 0 -1e-3") +
                                                key("Normal", "0 0 1") + key("Mass", "1e-3") + key("Force Z", pulse));
  expect_said(said_of(block(tool)).warnings, {"WARNING: Boundary Conditions > punch > Force Z: jumps twice"}, "a tool");
  for (const char* value :
       {"1e9*exp(-(1e6*t - 3)^2)", "if (t &lt; 2e-6) { value = 0; } else { value = 1e9; }", "1e9"}) {
    EXPECT_EQ(said_of(block(load(value))).warnings.find("jumps"), std::string::npos) << value;
  }
}

// A pulse and a jump to and fro of a 5000th of the run, 20 steps, at times that the text names.
TEST(Pulses, ShorterThanSamplesOfARunAreTold) {
  const auto warnings_of = [](const std::string& condition) {
    Parts parts = block(condition);
    parts.times = key("Final Time", "1e-2");
    return said_of(parts).warnings;
  };
  const std::string pulse = "(t &gt; 5.0021e-3)*(1e6*t &lt; 5004.1)";
  expect_said(warnings_of(along("a", "Body Force", "foot", "z", pulse + "*1e9")),
              {"WARNING: Boundary Conditions > a > Value: jumps twice within 2e-06 s"}, "a load");
  expect_said(warnings_of(displacement("a", "foot", "z", pulse + "*1e-4")),
              {"WARNING: Boundary Conditions > a > Value: jumps by 0.0001 m"}, "a displacement");
}

// The third block is a grain of one point, which is dropped. Without substeps the step is that of the stiffest block.
TEST(Pulses, AreToldBesideABlockWithoutPoints) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0, 0, 0}, 4, 4, 4, 1e-3) + cubes(2, {9e-3, 0, 0}, 1, 1, 1, 1e-3));
  Parts parts = block("");
  parts.mesh_type = "Text File", parts.mesh_file = (folder / "points.txt").string(), parts.degenerate = "Drop Any";
  parts.verlet = key("Subcycling", "false");
  const std::string pulse = "(t &gt; 2e-6)*(t &lt; 4e-6)";
  parts.conditions = along("a", "Body Force", "block_1", "z", pulse + "*1e9");
  expect_said(said_of(parts).warnings, {"jumps twice within 2e-06 s"}, "a load");
  parts.conditions = displacement("a", "block_1", "z", pulse + "*1e-4");
  expect_said(said_of(parts).warnings, {"jumps by 0.0001 m"}, "a displacement");
}

// A load of equilibria that the explicit steps begin without jumps once.
TEST(Pulses, ThatActedBeforeTheStepsAreNone) {
  const RunFolder folder;
  Parts parts = block(along("a", "Body Force", "foot", "z", "t &lt;= 1e-5 ? 1e5*t : 0"));
  parts.verlet = "";
  const std::string text =
      changed(changed(parts.text(), R"(name="Verlet")", R"(name="QuasiStatic")"), "<ParameterList>\n",
              "<ParameterList>\n" + section("Solver 2", key("Final Time", "2e-5")));
  const std::string warnings =
      told_at_the_start(deck::read(folder.write("deck.xml", text), folder.world), folder.world).warnings;
  EXPECT_EQ(warnings.find("jumps twice"), std::string::npos) << warnings;
}

const std::string to_and_fro = "100*sin(3.14159265358979e6*4*t)";

// Load steps at 0.5, 1, … µs, ten of them.
TEST(Values, BetweenLoadStepsAreTold) {
  for (const char* value :
       {"1e-12/(2.2e-6 - t) - 1e-12/2.2e-6", "1e-4*sin(3.14159265358979e6*2*t)",
        "table(t, 0, 0, 1.25e-6, 1e-4, 5e-6, 0)", "table(t, 0, 0, 1e-6, 1e-4, 1.25e-6, 5e-5, 1.5e-6, 1e-4, 5e-6, 0)",
        "(t &gt; 2.23e-6)*(t &lt; 2.24e-6)*1e-4",
        "(x &gt; 1e-3 &amp;&amp; x &lt; 3e-3 ? 1 : 0)*table(t, 0, 0, 1.25e-6, 1e-4, 5e-6, 0)"}) {
    expect_said(said_of(block(displacement("a", "foot", "z", value)), Loading::slow).warnings,
                {"WARNING: Boundary Conditions > a > Value: reaches", "between two load steps", "10 load steps"},
                value);
  }
  for (const char* value : {"1e-4*sin(1.2566370614e6*t)", "1e-4*sqrt(4e-6 - t)", "1e-4*sin(1e6*t)", "5*t",
                            "1e-4*exp(1e6*t) - 1e-4", "table(t, 0, 0, 1.5e-6, 1e-4, 5e-6, 0)"}) {
    const std::string warnings = said_of(block(displacement("a", "foot", "z", value)), Loading::slow).warnings;
    EXPECT_EQ(warnings.find("between two load steps"), std::string::npos) << value;
  }
  // The integral of a velocity counts.
  expect_said(said_of(block(velocity("a", "foot", "z", to_and_fro)), Loading::slow).warnings,
              {"a > Value: its integral reaches", "between two load steps"}, to_and_fro);
  for (const char* value : {"5*t*(4e-6 - t)", "table(t, 2.1e-6, 0, 2.2e-6, 100, 2.3e-6, 0)"}) {
    const std::string warnings = said_of(block(velocity("a", "foot", "z", value)), Loading::slow).warnings;
    EXPECT_EQ(warnings.find("between two load steps"), std::string::npos) << value << warnings;
  }
  // Temperatures and the distance of sides count from those at the start.
  const std::string wave = "sin(3.14159265358979e6*2*t)", slow = "sin(1e6*t)";
  for (const auto& condition : {heat("293 + 50*" + wave), sides("1 + 1e-3*" + wave)}) {
    expect_said(said_of(block(condition), Loading::slow).warnings, {"changes by", "between two load steps"}, condition);
  }
  for (const auto& condition : {heat("293 + 50*" + slow), sides("1 + 1e-3*" + slow)}) {
    EXPECT_EQ(said_of(block(condition), Loading::slow).warnings.find("between two load steps"), std::string::npos);
  }
}

// 1600 waves that pass 18 rows each, and 50 pulses of 3 % of a wave. All rows of a long table count.
TEST(Values, ThatDoTooMuchInALoadStepAreTold) {
  const std::string waves = "1e-3*table(sin(2e9*t), -0.8, 0, -0.6, 1, -0.4, 0, -0.2, 1, 0, 0, 0.2, 1, 0.4, 0, 0.6, 1)";
  const std::string pulses = "1e-4*(sin(6.2831853e7*t) &gt; 0.995)";
  std::string table = "table(t";
  for (int n = 0; n < 30000; ++n) table += ", " + std::to_string(n) + "e-10, " + std::to_string(n % 7 % 2) + "e-3";
  const auto warnings = [](const std::string& value, const std::string& load_steps) {
    return said_of(block(velocity("a", "foot", "z", value)), Loading::slow, key("Number of Load Steps", load_steps))
        .warnings;
  };
  const std::string told = "WARNING: Boundary Conditions > a > Value: has pulses or turns that are too many";
  for (const std::string& value : {waves, pulses}) expect_said(warnings(value, "1"), {told}, value);
  for (const std::string& value : {waves, pulses}) EXPECT_EQ(warnings(value, "50").find(told), std::string::npos);
  for (const std::string& value :
       {table + ")", std::string("1e-6/sqrt(abs(t - 2.00123e-6))"), to_and_fro,
        std::string("1e-3*exp(-(((t - 1.5e-6)/5e-9)^2))"), std::string("1e-3*abs(sin(9.676e7*t))")})
    EXPECT_EQ(warnings(value, "1").find(told), std::string::npos) << value;
}

// A ramp that ends within a load step: its rate is not that of the step.
TEST(Values, BesideTheLineBetweenLoadStepsAreToldIfTheRateCounts) {
  const auto warnings = [](const std::string& rate, const std::string& value) {
    Parts parts = block(displacement("a", "foot", "z", value));
    parts.materials =
        copper(key("Yield Stress", "50e6") +
               section("Rate", key("Type", rate) +
                                   (rate == "None" ? "" : key("Reference Rate", "1e-3") + key("Exponent", "0.01"))));
    return said_of(parts, Loading::slow).warnings;
  };
  const std::string ramp = "table(t, 0, 0, 1e-8, 1e-4, 5e-6, 1e-4)";
  expect_said(warnings("Power Law", ramp), {"a > Value: reaches 0.0001 at t = 1e-08 s", "may depend on its rate"},
              ramp);
  EXPECT_EQ(warnings("None", ramp).find("between two load steps"), std::string::npos);
  for (const char* value : {"20*t", "table(t, 0, 0, 1e-6, 1e-4, 5e-6, 1e-4)", "1e-4*sin(6.2831853e5*t)"})
    EXPECT_EQ(warnings("Power Law", value).find("between two load steps"), std::string::npos) << value;
}

TEST(Displacement, ThatJumpsIsTold) {
  const std::string jump = "if (t &lt; 2e-6) { value = 0; } else { value = 1e-4; }";
  expect_said(said_of(block(displacement("a", "foot", "z", jump))).warnings,
              {"WARNING: Boundary Conditions > a > Value: jumps by 0.0001 m, 0.1 spacings, at t = 2e-06 s"}, jump);
  const std::string tool = section(
      "roll", key("Type", "Rigid Plane") + key("Point", "0 0 -1e-3") + key("Normal", "0 0 1") + key("Travel Z", jump));
  expect_said(said_of(block(tool)).warnings, {"WARNING: Boundary Conditions > roll > Travel Z: jumps"}, "a tool");
  // Steps are some 0.2 µs long: this is done within a tenth of one. In the longer run it is so between two samples.
  const std::string ramp = "1e-4*min(max(t/2e-8 - 100.05, 0), 1)";
  for (const char* end : {"5e-6", "5e-3"}) {
    Parts parts = block(displacement("a", "foot", "z", ramp));
    parts.times = key("Final Time", end);
    expect_said(said_of(parts).warnings,
                {"WARNING: Boundary Conditions > a > Value: jumps by 0.0001 m, 0.1 spacings, at t = 2.0"}, end);
  }
  // Steady, though some hundredths of a spacing in each step; over some steps; no displacement.
  for (const std::string& smooth :
       {displacement("a", "foot", "z", "200*t"), displacement("a", "foot", "z", "200*max(t - 2e-6, 0)"),
        displacement("a", "foot", "z", "1e-4*erf(1e6*t)"), velocity("a", "foot", "z", jump)}) {
    EXPECT_EQ(said_of(block(smooth)).warnings.find("so suddenly"), std::string::npos) << smooth;
  }
}

TEST(Strains, ThatJumpAreTold) {
  const auto said = [](const std::string& condition) {
    Parts parts = block(condition);
    parts.materials = copper(key("Yield Stress", "50e6") + key("Thermal Expansion Coefficient", "1e-5"));
    return said_of(parts).warnings;
  };
  expect_said(said(heat("293 + (t &gt; 2e-6)*100")),
              {"a > Value: jumps by 100 K, a strain of 0.001, at t = 2e-06 s: within one step"}, "heat");
  expect_said(said(sides("1 + (t &gt; 2e-6)*0.01")),
              {"a > Stretch: jumps by 0.01, the distance of the sides by 6e-05 m, 0.06 spacings, at t = 2e-06 s"},
              "sides");
  for (const std::string& slow : {heat("293 + 2e8*t"), heat("293 + (t &gt; 2e-6)*5"), sides("1 + 2e4*t")}) {
    EXPECT_EQ(said(slow).find("so suddenly"), std::string::npos) << slow;
  }
}

}  // namespace
}  // namespace strut::regression
