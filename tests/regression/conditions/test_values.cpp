// A value of a condition that is no number any more while the run goes on ends the run, and is named.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

// Numbers until 3 µs, of 5.
const std::string ends = "sqrt(3e-6 - t)";

struct Case {
  std::string conditions, path;
};

std::string pushed(const std::string& keys) {
  return section("tool", key("Type", "Rigid Plane") + key("Point", "0 0 6e-3") + key("Normal", "0 0 -1") + keys);
}

const std::string foot = along("foot", "Prescribed Displacement", "foot", "xyz", "0");

const std::vector<Case> cases{
    {foot + along("a", "Prescribed Displacement", "top", "z", "1e-3*(" + ends + " - sqrt(3e-6))"), "a > Value"},
    {foot + along("a", "Prescribed Velocity", "top", "z", ends), "a > Value"},
    {along("a", "Prescribed Velocity", "all", "xyz", ends), "a > Value"},
    {foot + along("a", "Body Force", "top", "z", "1e6*" + ends), "a > Value"},
    {along("a", "Prescribed Velocity", "all", "xyz", "0") + along("b", "Body Force", "top", "z", ends), "b > Value"},
    {foot + pushed(key("Travel Z", "1e-3*(" + ends + " - sqrt(3e-6))")), "tool > Travel Z"},
};

// The error that ends the run, on every rank.
std::string error_of(const std::string& conditions, bool slowly, const std::string& frequency,
                     const std::string& times = key("Final Time", "5e-6")) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = conditions;
  parts.times = times;
  parts.verlet = slowly ? key("Number of Load Steps", "10") : "";
  parts.history = key("Filename", (folder / "history.csv").string()) + key("Frequency", frequency);
  std::string text = parts.text();
  if (slowly) text = changed(text, R"(name="Verlet")", R"(name="QuasiStatic")");
  testing::internal::CaptureStdout();
  std::string error;
  try {
    run(folder.write("deck.xml", text), folder.world);
  } catch (const Error& thrown) {
    error = thrown.what();
  }
  testing::internal::GetCapturedStdout();
  return error;
}

void expect_named(const Case& one, bool slowly, const std::string& frequency) {
  const std::string error = error_of(one.conditions, slowly, frequency);
  for (const std::string& part :
       {"Boundary Conditions > " + one.path + ": '", std::string(" is -nan at ("), std::string("t = 3")}) {
    EXPECT_NE(error.find(part), std::string::npos) << part << (slowly ? " slowly" : "") << " in:\n" << error;
  }
  EXPECT_EQ(error.find(" is -nan"), error.rfind(" is -nan")) << "told by one rank: " << error;
}

// Whether the ledger is looked at in each step, or never before the end.
TEST(ValueThatIsNoNumber, EndsExplicitStepsByItsName) {
  for (const Case& one : cases) {
    expect_named(one, false, "1");
    expect_named(one, false, "100000");
  }
  expect_named({pushed(key("Mass", "1") + key("Force Z", ends)), "tool > Force Z"}, false, "1");
}

TEST(ValueThatIsNoNumber, EndsEquilibriaByItsName) {
  for (const Case& one : cases) expect_named(one, true, "1");
}

// No step needs a value later than the final time.
TEST(ValueThatIsNoNumber, IsNoneUpToTheFinalTime) {
  for (const Case& one : cases) {
    EXPECT_EQ(error_of(one.conditions, false, "1", key("Final Time", "3e-6")), "") << one.path;
  }
}

TEST(ValueThatIsNoNumber, IsRefusedAtTheInitialTimeOfToolsToo) {
  const std::string error = error_of(pushed(key("Travel Z", "log(t)")), false, "1");
  EXPECT_NE(error.find("Boundary Conditions > tool > Travel Z: 'log(t)' is -inf"), std::string::npos) << error;
}

// One problem, whichever ranks have the points, and other conditions of all ranks besides.
TEST(ValueThatIsNoNumber, IsToldOnceOverAllRanks) {
  const std::string tool =
      changed(pushed(key("Node Set", "top") + key("Mass", "1") + key("Force Z", "sqrt(t - 1e-6)")), "tool", "hammer");
  const std::string of_tool = error_of(foot + tool + pushed(key("Mass", "1")), false, "1");
  EXPECT_NE(of_tool.find("deck.xml: 1 problem\n"), std::string::npos) << of_tool;
  EXPECT_NE(of_tool.find("hammer > Force Z: 'sqrt(t - 1e-6)' is -nan"), std::string::npos) << of_tool;
  const std::string of_load = error_of(along("a", "Body Force", "all", "z", "sqrt(x - 2e-3)"), false, "1");
  EXPECT_EQ(of_load.find("problem"), of_load.rfind("problem")) << of_load;
  EXPECT_EQ(of_load.find("is -nan"), of_load.rfind("is -nan")) << of_load;
}

// A velocity or a load without an integral; one with an integral, and a steep one, are none.
TEST(Value, ThatGoesToInfinityIsRefused) {
  const auto error = [](const std::string& type, const std::string& value, bool slowly) {
    return error_of(foot + along("a", type, "top", "z", value), slowly, "1");
  };
  for (const std::string value : {"1e-9/(t - 2.00123e-6)", "1e-3*tan(1e6*t)", "1e-18/(t - 2.00123e-6)^2"}) {
    for (const bool slowly : {false, true}) {
      const std::string found = error("Prescribed Velocity", value, slowly);
      EXPECT_NE(found.find("Boundary Conditions > a > Value: '" + value + "' goes to infinity at t = "),
                std::string::npos)
          << value << found;
    }
    EXPECT_NE(error("Body Force", value, false).find("goes to infinity"), std::string::npos) << value;
  }
  for (const std::string value :
       {"1e-6/sqrt(abs(t - 2.00123e-6))", "1e-3*exp(-(((t - 2.00123e-6)/3e-8)^2))", "1e-3*tan(1e5*t)"})
    EXPECT_EQ(error("Prescribed Velocity", value, false), "") << value;
  EXPECT_EQ(error_of(along("a", "Body Force", "all", "z", "(1 + t)/(z - 3e-3)"), false, "1"), "")
      << "no point is there";
}

// Far from 0 the digits of the time leave less room for a pulse than for a pole.
TEST(Value, ThatIsAShortPulseAtALateTimeIsFinite) {
  const auto error = [](const std::string& value) {
    return error_of(foot + along("a", "Body Force", "top", "z", value), false, "1",
                    key("Initial Time", "1000") + key("Final Time", "1000.00001"));
  };
  for (const std::string value :
       {"1e6*(abs(t - 1000.000005) &lt; 1e-6)", "table(t, 1000.000004, 0, 1000.000005, 1e6, 1000.000006, 0)",
        "1e6*exp(-(((t - 1000.000005)/1e-8)^2))"})
    EXPECT_EQ(error(value), "") << value;
  EXPECT_NE(error("1e-3/(t - 1000.000005)").find("goes to infinity at t = 1000.000005 s"), std::string::npos);
}

}  // namespace
}  // namespace strut::regression
