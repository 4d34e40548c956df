// A run that goes wrong without a point that fails: it ends where the deck says, with the point, the place, the time
// and a likely cause, and a last frame; or it is told of once and goes on.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

struct Outcome {
  std::string error, said;  // said: on rank 0
  io::ExodusResult result;  // on rank 0

  int warnings() const {
    int count = 0;
    for (std::size_t at = 0; (at = said.find("WARNING", at)) != std::string::npos; ++at) ++count;
    return count;
  }
};

Outcome outcome(const RunFolder& folder, Parts parts) {
  const std::string here = folder.operator/("").string();
  parts.output = key("Output Filename", here + "result.e") + key("Output Frequency", "100000") +
                 section("Output Variables", key("Displacement", "true"));
  parts.history = key("Filename", here + "history.csv") + key("Frequency", "1") + section("Variables", "");
  Outcome outcome;
  testing::internal::CaptureStdout();
  try {
    run(folder.write("deck.xml", parts.text()), folder.world);
  } catch (const Error& error) {
    outcome.error = error.what();
  }
  outcome.said = testing::internal::GetCapturedStdout();
  if (folder.world.rank() == 0) outcome.result = io::read_result(folder / "result.e");
  return outcome;
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << "\nin: " << text;
}

// A bar whose points tremble, by a step 2 % above the stable one (3.09e-7 s): it takes some tens of steps to blow
// up, and its energy says so before any point is turned inside out.
Parts unstable() {
  Parts parts;
  parts.conditions = along("noise", "Initial Velocity", "all", "z", "sin(1e7*x*y + 1e6*z)");
  parts.times = key("Final Time", "1e-3");
  parts.verlet = key("Fixed dt", "3.15e-7");
  return parts;
}

TEST(Monitor, EnergyFromNowhereEndsTheRunWithAFrame) {
  const RunFolder folder;
  const Outcome o = outcome(folder, unstable());
  expect_words(o.error, {"at t = ", "balance of energy", "Watch > Balance Error", "Likely causes: a Fixed dt above"});
  if (folder.world.rank() != 0) return;
  const std::vector<double> lines = read_history(folder / "history.csv").at("Time");
  ASSERT_EQ(o.result.times.size(), 2u);
  EXPECT_EQ(o.result.times[1], lines.back()) << "the last frame is of the time at which it ended";
}

TEST(Monitor, GoesOnWhereTheDeckSaysSoAndIsToldOnce) {
  const RunFolder folder;
  Parts parts = unstable();
  parts.watch = key("Beyond Limits", "Continue");
  const Outcome o = outcome(folder, parts);
  EXPECT_EQ(o.error.find("balance"), std::string::npos) << o.error;
  expect_words(o.error, {"determinant"});  // what comes in the end
  if (folder.world.rank() != 0) return;
  expect_words(o.said, {"WARNING: at t = ", "balance of energy", "told once"});
  EXPECT_EQ(o.warnings(), 2) << "of the fixed step, and of this: " << o.said;
}

TEST(Monitor, StepThatCollapsesNamesThePointThatLimitsIt) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-300") +
                     along("foot", "Prescribed Displacement", "foot", "z", "0");
  parts.materials = copper(key("Yield Stress", "50e6"));
  parts.times = key("Final Time", "2e-5");
  parts.verlet = key("Subcycling", "false");
  parts.watch = key("Smallest Step", "0.8");
  const Outcome o = outcome(folder, parts);
  expect_words(o.error,
               {"at t = ", "the critical time step has fallen to ", "Watch > Smallest Step", "the stiffest is element ",
                " of block bar, reference position (", "now at (", "det F = 0.", "Likely causes: "});
  if (folder.world.rank() == 0) {
    EXPECT_EQ(o.result.times.size(), 2u);
  }
}

// Two blocks of 3 x 3 points, the second thrown at the first. `aside`: how far, m.
Parts thrown(const RunFolder& folder, const std::string& contact, double aside = 0, int layers = 3) {
  constexpr double h = 1e-3;
  folder.write("points.txt",
               cubes(1, {0, 0, (3 - layers) * h}, 3, 3, layers, h) + cubes(2, {aside, aside, 3.5 * h}, 3, 3, 3, h));
  return thrown_block(contact);
}

// A penalty that is not hopeless (test_weak_contact) and still cannot hold them.
TEST(Monitor, ContactThatIsPassedThroughNamesThePoint) {
  const RunFolder folder;
  Parts parts = thrown(folder, contact_of({{"block_1", "block_2"}}, "1e-3", "1e8"));
  parts.watch = key("Penetration", "0.7");
  const Outcome stopped = outcome(folder, parts);
  expect_words(stopped.error, {"at t = 1.", "contact is penetrated by 7", "Watch > Penetration", "element ",
                               " of block block_", "now at (", "Likely causes: a Spring Constant that is too small"});
  parts.watch += key("Beyond Limits", "Continue");
  EXPECT_EQ(outcome(folder, parts).error, "");
}

// A surface so soft that what the faces store up to 0.7 spacings is a third of the energy of the impact.
TEST(Monitor, SurfaceThatIsPenetratedIsToldOfByItsOwnKeys) {
  const RunFolder folder;
  const std::string soft =
      key("Contact Model", "Surface") + key("Stiffness Factor", "5e-4") + key("Largest Overlap", "0");
  Parts parts = thrown(folder, section("Models", section("m", soft)) +
                                   section("Interactions", section("General Contact", key("Contact Model", "m"))));
  parts.watch = key("Penetration", "0.7");
  const Outcome stopped = outcome(folder, parts);
  expect_words(stopped.error, {"contact is penetrated by 7", "% of a spacing", "a Stiffness Factor that is too small"});
  EXPECT_EQ(stopped.error.find("Spring Constant"), std::string::npos) << stopped.error;
}

// A hairpin whose legs are driven together, and no contact.
TEST(Monitor, BodyThatFoldsThroughItselfIsToldOf) {
  constexpr double h = 1e-3;
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0, 0, 0}, 12, 3, 3, h) + cubes(1, {0, 0, 7 * h}, 12, 3, 3, h) +
                                 cubes(1, {0, 0, 3 * h}, 3, 3, 4, h));
  Parts parts = thrown_block("");
  parts.blocks = section("pin", key("Block Names", "block_1") + key("Material", "copper") + key("Horizon", "2.01e-3"));
  parts.node_sets =
      key("lower", "(z &lt; 3.0e-3) * (x &gt; 8.0e-3)") + key("upper", "(z &gt; 7.0e-3) * (x &gt; 8.0e-3)");
  parts.conditions =
      along("up", "Initial Velocity", "lower", "z", "400") + along("down", "Initial Velocity", "upper", "z", "-400");
  parts.times = key("Final Time", "30e-6");
  const std::string words = "block block_1 passes through itself, for the deck declares no contact of it with itself";
  const Outcome folds = outcome(folder, parts);
  EXPECT_EQ(folds.error, "");
  parts.contact = section("Models", section("m", key("Contact Model", "Surface"))) +
                  section("Interactions", section("Self Contact", key("Contact Model", "m")));
  const Outcome touches = outcome(folder, parts);
  parts.contact.clear();
  parts.conditions = changed(changed(parts.conditions, "-400", "400"), "400", "-400");  // apart, by as much
  const Outcome parts_legs = outcome(folder, parts);
  EXPECT_EQ(touches.said.find("passes through"), std::string::npos) << touches.said;
  EXPECT_EQ(parts_legs.said.find("passes through"), std::string::npos) << parts_legs.said;
  if (folder.world.max(folds.said.find(words) != std::string::npos ? 1.0 : 0.0) == 0) ADD_FAILURE() << folds.said;
}

// A blade between two columns of points goes between them, and no force tells; one of 1.6 spacings does not.
TEST(Monitor, ToolBetweenPointsThatAreBondedIsToldOf) {
  const RunFolder folder(Lattice{.nx = 6});
  Parts parts;
  const auto press = [&](const std::string& low, const std::string& high) {
    parts.conditions = along("foot", "Prescribed Displacement", "foot", "xyz", "0") +
                       section("blade", key("Type", "Rigid Box") + key("Lower Corner", low + " -1 6e-3") +
                                            key("Upper Corner", high + " 1 1") + key("Travel Z", "-100*t"));
    parts.times = key("Final Time", "12e-6");
    const Outcome o = outcome(folder, parts);
    EXPECT_EQ(o.error, "");
    return folder.world.max(o.said.find("WARNING: at t = ") != std::string::npos &&
                                    o.said.find("the tool 'blade' stands between points that are bonded to each other: "
                                                "element ") != std::string::npos
                                ? 1.0
                                : 0.0) > 0;
  };
  EXPECT_TRUE(press("2.95e-3", "3.05e-3"));
  EXPECT_FALSE(press("2.2e-3", "3.8e-3"));
}

// Points that meet the middles of the squares of a face, with a radius below the distance to their corners, 0.707 of a
// spacing: no two of them touch.
TEST(Monitor, BodiesThatPassThroughEachOtherAreSeenWhateverTheRadius) {
  const RunFolder folder;
  for (const int layers : {3, 2}) {
    const Parts parts = thrown(folder, contact_of({{"block_1", "block_2"}}, "0.6e-3", "1e12"), 0.5e-3, layers);
    expect_words(outcome(folder, parts).error, {"at t = ", "blocks block_1 and block_2 pass through each other: ",
                                                "Watch > Passing", "element ", "now at (", "Likely causes: "});
  }
}

TEST(Monitor, BodiesThatPassThroughSoftSurfacesAreSeen) {
  const RunFolder folder;
  Parts parts = thrown(
      folder,
      section("Models", section("m", key("Contact Model", "Surface") + key("Stiffness Factor", "1e-7") +
                                         key("Largest Overlap", "0"))) +
          section("Interactions", section("pair", key("First Block", "block_1") + key("Second Block", "block_2") +
                                                      key("Contact Model", "m"))));
  parts.watch = key("Beyond Limits", "Continue");
  const Outcome o = outcome(folder, parts);
  EXPECT_EQ(o.error, "");
  const bool tells = o.said.find("blocks block_1 and block_2 pass through each other") != std::string::npos;
  EXPECT_EQ(folder.world.sum(tells ? 1.0 : 0.0), 1) << "the rank that has the point: " << o.said;
}

// Contact that holds is no passing, by points that meet corners or middles; nor are bodies that stand in each other.
TEST(Monitor, BodiesThatPressEachOtherDoNotPass) {
  const RunFolder folder;
  for (const double aside : {0.0, 0.5e-3}) {
    const Outcome o = outcome(folder, thrown(folder, contact_of({{"block_1", "block_2"}}, "1e-3", "1e12"), aside));
    EXPECT_EQ(o.error, "");
    if (folder.world.rank() == 0) {
      EXPECT_EQ(o.warnings(), 0) << o.said;
    }
  }
  Parts parts = thrown(folder, contact_of({{"block_1", "block_2"}}, "0.6e-3", "1e12"));
  folder.write("points.txt", cubes(1, {0, 0, 0}, 3, 3, 3, 1e-3) + cubes(2, {0.5e-3, 0.5e-3, 0.5e-3}, 3, 3, 3, 1e-3));
  parts.conditions.clear();
  EXPECT_EQ(outcome(folder, parts).error, "");
}

// A layer that is drawn through the others.
TEST(Monitor, InvertedPointsGoOnAsMassesWhereTheDeckSaysSo) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = along("foot", "Prescribed Displacement", "foot", "z", "5000*t");
  expect_words(outcome(folder, parts).error, {"turned inside out"});
  parts.watch = key("Inverted Points", "Continue") + key("Beyond Limits", "Continue");
  const Outcome o = outcome(folder, parts);
  EXPECT_EQ(o.error, "");
  if (folder.world.rank() == 0) {
    EXPECT_EQ(o.result.times.back(), 5e-6);
  }
}

}  // namespace
}  // namespace strut::regression
