// A run that goes wrong without a point that fails: it ends where the deck says, with the point, the place, the time
// and a likely cause, and a last frame; or it is told of once and goes on.
#include <gtest/gtest.h>

#include <iomanip>
#include <sstream>
#include <tuple>

#include "regression/stretched.hpp"
#include "run/monitor.hpp"
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

Outcome outcome(const RunFolder& folder, Parts parts, const std::string& solver = "Verlet", Start start = Start::anew) {
  const std::string here = folder.operator/("").string();
  parts.output = key("Output Filename", here + "result.e") + key("Output Frequency", "100000") +
                 section("Output Variables", key("Displacement", "true"));
  parts.history = key("Filename", here + "history.csv") + key("Frequency", "1") + section("Variables", "");
  Outcome outcome;
  testing::internal::CaptureStdout();
  try {
    run(folder.write("deck.xml", changed(parts.text(), "\"Verlet\"", "\"" + solver + "\"")), folder.world, start);
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
  EXPECT_LE(o.warnings(), 4) << "of the fixed step, the first percent, the limit, kinetic energy: " << o.said;
}

// One step, twenty times the stable one: too early for the lines of the history that count, but the end of the run.
TEST(Monitor, LooksAtTheEnergyAtTheEndHoweverEarlyItIs) {
  const RunFolder folder;
  Parts parts;
  parts.conditions =
      along("flight", "Initial Velocity", "all", "z", "-100") + plane("wall", "Rigid Plane", "all", "0 0 0", "0 0 1");
  parts.materials = copper(key("Yield Stress", "400e6"));
  parts.times = key("Final Time", "5e-6");
  parts.verlet = key("Fixed dt", "5e-6");
  expect_words(outcome(folder, parts).error, {"at t = 5e-06 s", "balance of energy", "Watch > Balance Error"});
}

// A solid whose sides are held, stretched by e^x = 1.3: ½ x² e^x is taken for what it stores, the work is
// (x − 1) e^x + 1, by its modulus and volume, so that 8 % of the former come out of nothing.
TEST(Monitor, KnowsWhatALawOfRatesStoresWrongly) {
  const RunFolder folder;
  Parts parts;
  parts.materials = changed(copper(), "0.35", "0");
  parts.conditions = along("pull", "Prescribed Displacement", "all", "z", "300*z*t") +
                     along("sides", "Prescribed Displacement", "all", "xy", "0");
  parts.times = key("Final Time", "1e-3");
  parts.watch = key("Balance Error", "1");
  const Outcome o = outcome(folder, parts);
  if (folder.world.rank() != 0) return;
  const double x = std::log(1.3), stored = 0.5 * x * x * 1.3, work = (x - 1) * 1.3 + 1;
  std::ostringstream error;
  error << std::setprecision(2) << 100 * (stored - work) / stored;
  expect_words(o.said,
               {"error of " + error.str(), "out of nothing", "changed by a factor of up to 1.3:", "errs by up to 8.7"});
}

// A body whose energy leaves through its end: the error at the end is a part of the largest energy, also where no line
// and no frame is written on the way.
TEST(Monitor, KnowsTheLargestEnergyWhereNothingIsWritten) {
  const auto error_at_end = [](const std::string& history) {
    const RunFolder folder({.nx = 2, .ny = 2, .nz = 20});
    Parts parts;
    parts.conditions =
        along("blow", "Body Force", "foot", "z", "if (t &lt; 2e-6) { value = 1e10; } else { value = 0; }") +
        section("end", key("Type", "Non-Reflecting End") + key("Node Set", "top") + key("Normal", "0 0 1"));
    parts.times = key("Final Time", "30e-6");
    parts.history = history.empty() ? "" : key("Filename", folder.operator/("history.csv").string()) + history;
    testing::internal::CaptureStdout();
    run(folder.write("deck.xml", parts.text()), folder.world);
    const std::string said = testing::internal::GetCapturedStdout(), words = "balance error ";
    const std::size_t at = said.find(words);
    return folder.world.rank() == 0 ? std::stod(said.substr(at + words.size())) : 1;
  };
  // Between two looks, a two-hundredth of the run, the largest energy changes by a few percent.
  EXPECT_NEAR(error_at_end("") / error_at_end(key("Frequency", "1") + section("Variables", "")), 1, 0.1);
}

// The messages of a monitor about these balances, one after the other, `error` being a fraction of the largest energy;
// whether it ends the run; after the uncounted lines of a start.
struct Told {
  std::vector<std::string> lines;
  bool ended = false;
};

Told told_of(const std::vector<double>& gained, double kinetic = 1, double fracture = 0, double elastic = 0) {
  const RunFolder folder;
  Simulation run(folder, {});
  Told told;
  const deck::Watch limits{.stops = true, .balance_error = 0.5};
  Monitor monitor(limits, 1, run.body(), [&](const std::string& line) { told.lines.push_back(line); });
  const auto check = [&](double part, bool last) {
    const Ledger ledger{.kinetic = kinetic,
                        .elastic = elastic,
                        .fracture = fracture,
                        .gained = part,
                        .largest = 1,
                        .balance_error = std::abs(part)};
    monitor.check_energy(ledger, last);
  };
  for (int n = 0; n < 10; ++n) check(0, false);
  try {
    for (std::size_t n = 0; n < gained.size(); ++n) check(gained[n], n + 1 == gained.size());
  } catch (const Error&) {
    told.ended = true;
  }
  if (run.world().rank() != 0) {
    EXPECT_EQ(told.lines.size(), 0u);
  }
  told.lines.resize(static_cast<std::size_t>(run.world().max(static_cast<double>(told.lines.size()))));
  return told;
}

TEST(Monitor, ToldIsAnErrorOfTheBalanceFromOnePercentOn) {
  EXPECT_EQ(told_of({0.009, -0.009, 0.009}).lines.size(), 0u);
  EXPECT_EQ(told_of({0.011}).lines.size(), 1u);
  EXPECT_EQ(told_of({-0.011, -0.02, 0.03, -0.015}).lines.size(), 1u) << "once, not in each line";
  EXPECT_EQ(told_of({-0.011, -0.02, -0.3}).lines.size(), 2u) << "and at the end, if it has grown since";
}

// This one has seen no step in time, as in equilibria; EnergyFromNowhereEndsTheRunWithAFrame is explicit.
TEST(Monitor, CausesOfAnErrorOfTheBalanceAreThoseOfTheSolver) {
  const std::vector<std::string> lines = told_of({0.011}).lines;
  ASSERT_EQ(lines.size(), 1u);
  if (lines[0].empty()) return;  // another rank
  expect_words(lines[0], {"out of nothing: the run is too coarse in time", "Likely causes: too few load steps"});
  for (const char* const word : {"unstable", "Fixed dt", "Subcycling", "fly off"})
    EXPECT_EQ(lines[0].find(word), std::string::npos) << lines[0];
}

TEST(Monitor, EnergyOutOfNothingEndsTheRunEarlierThanLostEnergy) {
  EXPECT_TRUE(told_of({0.11, 0}).ended);
  EXPECT_FALSE(told_of({-0.49, 0}).ended);
  EXPECT_TRUE(told_of({-0.51, 0}).ended);
}

TEST(Monitor, NegativeKineticEnergyIsTold) {
  EXPECT_EQ(told_of({0, 0, 0}, -1e-6).lines.size(), 0u);
  EXPECT_EQ(told_of({0, 0, 0}, -0.1).lines.size(), 1u);
}

TEST(Monitor, BreaksThatGiveEnergyAreTold) {
  EXPECT_EQ(told_of({0, 0, 0}, 1, -0.009).lines.size(), 0u);
  EXPECT_EQ(told_of({0, 0, 0}, 1, -0.011).lines.size(), 1u);
}

TEST(Monitor, LawsThatGiveMoreThanTheyStoredAreTold) {
  EXPECT_EQ(told_of({0, 0, 0}, 1, 0, -0.009).lines.size(), 0u);
  EXPECT_EQ(told_of({0, 0, 0}, 1, 0, -0.011).lines.size(), 1u);
}

// The rank that tells may have no points, as the first of two has none here that expand.
TEST(Monitor, ThermalExpansionIsACauseOnWhicheverRankItIs) {
  const RunFolder folder;
  Simulation run(folder, {});
  if (run.world().rank() + 1 == run.world().size()) run.body().expansion.use(run.body().owned());
  std::vector<std::string> lines;
  const deck::Watch limits{.stops = true, .balance_error = 0.5};
  Monitor monitor(limits, 1, run.body(), [&](const std::string& line) { lines.push_back(line); });
  for (int n = 0; n < 10; ++n) monitor.check_energy({.kinetic = 1, .largest = 1}, false);
  monitor.check_energy({.kinetic = 1, .gained = -0.02, .largest = 1, .balance_error = 0.02}, true);
  if (run.world().rank() != 0) return;
  ASSERT_EQ(lines.size(), 1u);
  expect_words(lines[0], {"balance of energy", "thermal expansion"});
}

// A bar that nothing acts on holds energies of round-off, which balance by chance alone.
TEST(Monitor, RoundOffIsNoErrorOfTheBalance) {
  const RunFolder folder;
  const Simulation run(folder, {});
  double largest = energy_of_round_off(run.scene.body);
  const double modulus = 117e9 / (1 + 0.35) / (1 - 2 * 0.35) * (1 - 0.35), volume = 96e-9;
  EXPECT_NEAR(largest, 0.5 * modulus * volume * 1e-24, 1e-12 * largest);
  Ledger ledger;
  ledger.balance(1e-3 * largest, 0, largest);
  EXPECT_NEAR(ledger.balance_error, 1e-3, 1e-12);
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

// Pieces of one point each, which no bond and no touch hold: of no stiffness, beyond the 1000 steps after which the
// critical time step is estimated anew.
TEST(Monitor, BodyInPiecesGoesOnWithItsStep) {
  const RunFolder folder({.nx = 2, .ny = 2, .nz = 2});
  Parts parts;
  parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                      key("Damage Model", "apart"));
  parts.damage = section("apart", key("Damage Model", "Critical Stretch") + key("Critical Stretch", "1e-3"));
  for (const std::string axis : {"x", "y", "z"})
    parts.conditions += along(axis, "Initial Velocity", "all", axis, "1e5*" + axis);
  parts.times = key("Final Time", "4e-4");
  Simulation run(folder, parts);
  double first = 0;
  const Ledger end = run.go([&first](const Ledger& now) { first = first > 0 ? first : now.dt; });
  EXPECT_GT(run.solver.steps(), 1500);
  EXPECT_NEAR(end.dt, first, 0.01 * first);  // equal steps to the end
  EXPECT_GT(end.kinetic, 0);
  EXPECT_LT(end.balance_error, 1e-2);
}

TEST(Monitor, PointsThatNothingLimitsNeedAFixedStep) {
  const RunFolder folder;
  folder.write("points.txt", "0 0 0 1 1e-9\n0.01 0 0 1 1e-9\n");
  Parts parts;
  parts.mesh_type = "Text File", parts.mesh_file = "points.txt", parts.degenerate = "Keep";
  parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
  parts.conditions = along("flight", "Initial Velocity", "all", "x", "1");
  expect_words(outcome(folder, parts).error, {"Solver > Verlet", "nothing limits the time step", "Fixed dt"});
  parts.verlet = key("Fixed dt", "1e-7");
  EXPECT_EQ(outcome(folder, parts).error, "");
}

// Numbers that only a slip of the exponent makes.
TEST(Monitor, NumbersBeyondAllReasonAreToldForWhatTheyAre) {
  const RunFolder folder;
  const auto error = [&](const std::string& density, const std::string& speed) {
    Parts parts;
    parts.materials = changed(copper(), "8930", density);
    parts.conditions = along("flight", "Initial Velocity", "all", "z", speed);
    return outcome(folder, parts).error;
  };
  expect_words(error("1e300", "1"), {"nothing limits the time step", "or stiffness is negligible beside the Density"});
  expect_words(error("1e-300", "1"), {"Solver > Verlet: steps of", "less stiffness beside the Density"});
  expect_words(error("8930", "1e308"), {"energies are too large for a number", "a speed"});
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

// Two cubes of 3 cells, pressed slowly. By 0.25 a contact gives way like four layers of cells, of which they have five
// that strain; by 250 a thousandth of that.
TEST(Monitor, SurfacesThatGiveWayMoreThanBodiesAreToldOfAtTheEnd) {
  const RunFolder folder;
  const auto told = [&](const std::string& factor) {
    Parts parts = thrown(
        folder, section("Models", section("m", key("Contact Model", "Surface") + key("Stiffness Factor", factor))) +
                    section("Interactions", section("General Contact", key("Contact Model", "m"))));
    folder.write("points.txt", cubes(1, {0, 0, 0}, 3, 3, 3, 1e-3) + cubes(2, {0, 0, 3e-3}, 3, 3, 3, 1e-3));
    parts.node_sets = key("low", "z &lt; 1e-3") + key("high", "z &gt; 5e-3");
    parts.conditions = along("hold", "Prescribed Displacement", "low", "xyz", "0") +
                       along("press", "Prescribed Displacement", "high", "z", "-1e-5*t/5e-6") +
                       along("guide", "Prescribed Displacement", "high", "xy", "0");
    parts.times = key("Final Time", "5e-6");
    parts.verlet = key("Number of Load Steps", "2");
    const Outcome o = outcome(folder, parts, "QuasiStatic");
    EXPECT_EQ(o.error, "");
    return o.said;
  };
  const std::string soft = told("0.25"), stiff = told("250"), text = "contact between surfaces held up to ";
  if (folder.world.rank() != 0) return;
  expect_words(soft, {text, "a Stiffness Factor "});
  EXPECT_EQ(soft.find(text), soft.rfind(text)) << soft;
  EXPECT_EQ(stiff.find(text), std::string::npos);
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

// A block that flies at a plane whose set holds another body's points: it goes through; by a set of its own it does
// not.
TEST(Monitor, PointsThatASetOfAToolLeavesOutAreToldOfWhereTheyGoThroughIt) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0, 0, 0}, 3, 3, 3, 1e-3) + cubes(2, {9e-3, 0, 1e-3}, 3, 3, 3, 1e-3));
  Parts parts = thrown_block("");
  const std::string words = "the tool 'floor' stops the points of its Node Set only: others have gone through";
  for (const std::string set : {"block_1", "block_2", "all"}) {
    parts.conditions = along("flight", "Initial Velocity", "block_2", "z", "-100") +
                       plane("floor", "Rigid Plane", set, "0 0 0", "0 0 1");
    const Outcome o = outcome(folder, parts);
    EXPECT_EQ(o.error, "");
    const bool is_told = folder.world.max(o.said.find(words) != std::string::npos ? 1.0 : 0.0) > 0;
    EXPECT_EQ(is_told, set == "block_1") << set << "\n" << o.said;
  }
}

// A body flies through the plane in which another one ends, or a foot of this one is driven through it; away from it
// nothing is told.
TEST(Monitor, PointsThatGoThroughASymmetryPlaneAreToldOfWithoutContact) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0, 0, 0}, 3, 3, 3, 1e-3) + cubes(1, {3e-3, 0, 1e-3}, 1, 3, 2, 1e-3) +
                                 cubes(2, {9e-3, 0, 1e-3}, 3, 3, 3, 1e-3));
  Parts parts = thrown_block("");
  parts.node_sets = key("foot", "(z &lt; 1.0e-3) * (x &lt; 5.0e-3)") + key("toe", "(x &gt; 3e-3) * (x &lt; 4e-3)");
  const std::string words = "points have gone through a Symmetry Plane";
  for (const auto& [set, speed, end] : {std::tuple("block_2", "-100", "has no mirror image"),
                                        {"block_2", "100", ""},
                                        {"toe", "-100", "Contact does not see mirror images"}}) {
    parts.conditions =
        along("flight", set == std::string("toe") ? "Prescribed Velocity" : "Initial Velocity", set, "z", speed) +
        plane("s", "Symmetry Plane", "foot", "0 0 0", "0 0 1");
    const Outcome o = outcome(folder, parts);
    EXPECT_EQ(o.error, "");
    const std::size_t at = o.said.find(words);
    const bool is_told =
        folder.world.max(at != std::string::npos && o.said.find(end, at) != std::string::npos ? 1.0 : 0.0) > 0;
    EXPECT_EQ(is_told, end != std::string()) << set << speed << o.said;
  }
}

// A blade between two columns of points goes between them, and no force tells; one of 1.6 spacings does not. Also
// where columns are 4 mm apart, and layers 1 mm.
TEST(Monitor, ToolBetweenPointsThatAreBondedIsToldOf) {
  const Lattice lattice{.nx = 6};
  const RunFolder folder(lattice);
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
  write_stretched(folder, lattice, {4, 1, 1});
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "8.1e-3"));
  EXPECT_TRUE(press("10.3e-3", "13.7e-3"));
  EXPECT_FALSE(press("8.8e-3", "15.2e-3"));
}

// By 6 mm in a load step a thick box goes in between points, too.
TEST(Monitor, ToolThatALoadStepTakesBetweenPointsIsToldOfAsSuch) {
  const RunFolder folder(Lattice{.nx = 6});
  Parts parts;
  parts.conditions = along("foot", "Prescribed Displacement", "foot", "xyz", "0") +
                     section("block", key("Type", "Rigid Box") + key("Lower Corner", "-4e-3 -1 3.9e-3") +
                                          key("Upper Corner", "-2e-3 1 20e-3") + key("Travel X", "6e-3*t"));
  parts.times = key("Final Time", "1");
  parts.verlet = key("Number of Load Steps", "1");
  const Outcome o = outcome(folder, parts, "QuasiStatic");
  EXPECT_EQ(o.error, "");
  const auto told = [&](const std::string& words) {
    return folder.world.max(o.said.find(words) != std::string::npos ? 1.0 : 0.0) > 0;
  };
  EXPECT_TRUE(told("the tool 'block' stands between points that are bonded to each other"));
  EXPECT_TRUE(told("as does one that goes too far in a load step; expected more load steps, a finer mesh or"));
}

// A box around a bar pushes several of its points to one place, where the bonds of an ordinary solid have no direction:
// the energies are no numbers any more before a strain is none.
TEST(Monitor, ForcesThatAreNoNumbersNameThePoint) {
  const RunFolder folder;
  Parts parts;
  parts.materials = section("copper", key("Material Model", "Elastic") + key("Density", "8930") +
                                          key("Young's Modulus", "117e9") + key("Poisson's Ratio", "0.35"));
  parts.conditions = section("box", key("Type", "Rigid Box") + key("Lower Corner", "-1 -1 -1") +
                                        key("Upper Corner", "1 1 1") + key("Travel Z", "0"));
  const Outcome o = outcome(folder, parts);
  expect_words(o.error, {"at t = ", "element ", "reference position", "is not a number", "in one place"});
  EXPECT_EQ(o.error.find("balance"), std::string::npos) << o.error;
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

// Contact that holds is no interpenetration, by points that meet corners or middles; nor are bodies that stand in each
// other.
TEST(Monitor, BodiesThatPressEachOtherDoNotPass) {
  const RunFolder folder;
  for (const double aside : {0.0, 0.5e-3}) {
    const Outcome o = outcome(folder, thrown(folder, contact_of({{"block_1", "block_2"}}, "1e-3", "1e12"), aside));
    EXPECT_EQ(o.error, "");
    EXPECT_EQ(o.said.find("pass through"), std::string::npos) << o.said;  // coarse as it is, its balance is told of
  }
  Parts parts = thrown(folder, contact_of({{"block_1", "block_2"}}, "0.6e-3", "1e12"));
  folder.write("points.txt", cubes(1, {0, 0, 0}, 3, 3, 3, 1e-3) + cubes(2, {0.5e-3, 0.5e-3, 0.5e-3}, 3, 3, 3, 1e-3));
  parts.conditions.clear();
  EXPECT_EQ(outcome(folder, parts).error, "");
}

// Two blocks of 4 x 4 x 3 cells whose nodes are the points; the upper one, a gap above, is thrown along an axis.
// `width`: of the cells, which are 1 mm high, mm.
Parts thrown_nodes(const RunFolder& folder, double aside, double gap, const std::string& axis,
                   const std::string& contact, double width = 1) {
  io::Mesh mesh = Lattice{4, 4, 3}.mesh();
  io::Mesh::Block above{"block_2", "HEX8", mesh.blocks[0].nodes, {}};
  const std::vector<Vector> below = mesh.nodes;
  for (const Vector& X : below) mesh.nodes.push_back(X + Vector(aside, aside, 3e-3 + gap));
  for (int& node : above.nodes) node += static_cast<int>(below.size());
  for (Vector& node : mesh.nodes) node.head<2>() *= width;
  mesh.blocks[0].name = "block_1";
  mesh.blocks.push_back(above);
  run_on_root(folder.world, [&] { io::write_mesh(folder / "two.g", mesh); });
  Parts parts = thrown_block(contact);
  parts.mesh_type = "Exodus", parts.mesh_file = "two.g", parts.points = "Nodes";
  parts.conditions = along("flight", "Initial Velocity", "block_2", axis, "-20");
  parts.watch = key("Beyond Limits", "Continue");
  return parts;
}

bool passes_through(const RunFolder& folder, Parts parts, const std::string& final_time) {
  parts.times = key("Final Time", final_time);
  const Outcome o = outcome(folder, parts);
  EXPECT_EQ(o.error, "");
  return folder.world.max(o.said.find("pass through each other") != std::string::npos &&
                                  o.said.find("WARNING: at t = ") != std::string::npos
                              ? 1.0
                              : 0.0) > 0;
}

// Nodes are on the faces that meet: one on another, or a corner on a face.
TEST(Monitor, FacesOfNodesThatPressEachOtherDoNotPass) {
  const RunFolder folder;
  const auto contact = [](const std::string& keys) {
    return section("Models", section("m", key("Contact Model", "Surface") + keys)) +
           section("Interactions", section("General Contact", key("Contact Model", "m")));
  };
  const std::string soft = key("Stiffness Factor", "1e-7") + key("Largest Overlap", "0");
  for (const double aside : {0.0, 0.5e-3}) {
    EXPECT_FALSE(passes_through(folder, thrown_nodes(folder, aside, 1e-4, "z", contact("")), "12e-6")) << aside;
    EXPECT_TRUE(passes_through(folder, thrown_nodes(folder, aside, 1e-4, "z", contact(soft)), "80e-6")) << aside;
  }
}

// Blocks of four cells: near the rim of such a face the fraction of the other body's material is that of an edge.
TEST(Monitor, NarrowSurfacesOfNodesAreToldOf) {
  const RunFolder folder;
  const std::string surfaces = section("Models", section("m", key("Contact Model", "Surface"))) +
                               section("Interactions", section("General Contact", key("Contact Model", "m")));
  const auto told = [&](Parts parts) {
    const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
    return told_at_the_start(deck, folder.world).warnings.find("contact by surfaces is weak near edges") !=
           std::string::npos;
  };
  EXPECT_TRUE(told(thrown_nodes(folder, 0, 1e-4, "z", surfaces)));
  EXPECT_FALSE(told(thrown_nodes(folder, 0, 1e-4, "z", "")));
  Parts elements = thrown_nodes(folder, 0, 1e-4, "z", surfaces);
  elements.points = "Elements";
  EXPECT_FALSE(told(elements));
}

// By half a spacing at the most, along each other or towards each other, and off the edge of the other one.
TEST(Monitor, FacesOfNodesThatOnlyComeNearDoNotPass) {
  const RunFolder folder;
  EXPECT_FALSE(passes_through(folder, thrown_nodes(folder, 0, 1e-3, "z", ""), "40e-6"));
  EXPECT_TRUE(passes_through(folder, thrown_nodes(folder, 0, 1e-3, "z", ""), "60e-6"));
  for (const double gap : {0.1e-3, 0.3e-3})
    EXPECT_FALSE(passes_through(folder, thrown_nodes(folder, 0, gap, "x", ""), "220e-6")) << gap;
}

// Flat cells, 4 mm wide: 0.2 mm apart, and inside of each other.
TEST(Monitor, FacesOfFlatCellsThatOnlyComeNearDoNotPass) {
  const RunFolder folder;
  Parts parts = thrown_nodes(folder, 0, 2e-3, "z", "", 4);
  parts.points = "Elements";
  for (int block = 0; block < 2; ++block) parts.blocks = changed(parts.blocks, "2.01e-3", "8.1e-3");
  EXPECT_FALSE(passes_through(folder, parts, "90e-6"));
  EXPECT_TRUE(passes_through(folder, parts, "160e-6"));
}

// Flat tetrahedra whose centers are one above the other, 0.25 mm from the faces: a tool far away, for which the edges
// of cells are read, is nothing to them.
TEST(Monitor, FacesOfFlatTetrahedraThatOnlyComeNearDoNotPass) {
  const RunFolder folder;
  Parts parts = thrown_nodes(folder, -0.25e-3, 2e-3, "z", "", 4);
  run_on_root(folder.world, [&] { io::write_mesh(folder / "two.g", in_tetrahedra(io::read_mesh(folder / "two.g"))); });
  parts.points = "Elements";
  for (int block = 0; block < 2; ++block) parts.blocks = changed(parts.blocks, "2.01e-3", "4.1e-3");
  EXPECT_FALSE(passes_through(folder, parts, "95e-6"));
  parts.conditions += plane("far", "Rigid Plane", "all", "0 0 -5e-3", "0 0 1");
  EXPECT_FALSE(passes_through(folder, parts, "95e-6"));
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

// An ordinary solid bears it: bonds have a length however its points lie.
TEST(Monitor, InvertedPointsOfOrdinarySolidsAreToldOf) {
  const RunFolder folder;
  Parts parts;
  parts.materials = changed(parts.materials, "Elastic Correspondence", "Elastic");
  parts.watch = key("Beyond Limits", "Continue");
  parts.conditions = along("all", "Prescribed Displacement", "all", "z", "-2.2e5*z*t") +
                     along("sides", "Prescribed Displacement", "all", "xy", "0");
  const std::vector<std::string> words = {"WARNING: at t = ", "a point of an ordinary solid is turned inside out",
                                          "Jacobian is -0.", "element ", "(told once)"};
  for (const std::string solver : {"Verlet", "QuasiStatic"}) {
    if (solver == "QuasiStatic") parts.verlet = "";
    parts.times = key("Final Time", "5e-6");
    const Outcome o = outcome(folder, parts, solver);
    EXPECT_EQ(o.error, "");
    EXPECT_EQ(folder.world.sum(o.said.find("inside out") != std::string::npos ? 1.0 : 0.0), 1);
    if (o.said.find("inside out") != std::string::npos) expect_words(o.said, words);
    parts.times = key("Final Time", "4.5e-6");
    EXPECT_EQ(outcome(folder, parts, solver).said.find("inside out"), std::string::npos);
  }
}

// Copper that flows at 50 MPa is drawn along z at 1e5 1/s: F_zz = 1 + 1e5 t, which the deck prescribes at every point;
// its width shrinks to 1/√F_zz, which adds 0.016 to |F|: it passes 8 at 6.98e-5 s.
TEST(Monitor, PointsThatAreDrawnApartWithoutTearingAreToldOf) {
  const RunFolder folder;
  Parts parts;
  parts.materials = copper(key("Yield Stress", "50e6"));
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "1e5*z") +
                     along("pull", "Prescribed Velocity", "all", "z", "1e5*z");
  parts.times = key("Final Time", "6.9e-5");
  const Outcome before = outcome(folder, parts);
  EXPECT_EQ(before.error, "");
  parts.times = key("Final Time", "7.2e-5");
  const Outcome o = outcome(folder, parts);
  EXPECT_EQ(o.error, "");
  EXPECT_EQ(before.said.find("drawn"), std::string::npos) << before.said;
  const bool tells = o.said.find("drawn") != std::string::npos;
  EXPECT_GE(folder.world.sum(tells ? 1.0 : 0.0), 1) << "a rank that has such a point";
  if (!tells) return;
  expect_words(o.said, {"WARNING: at t = ", "neighbors have been drawn 8.0", "spacings apart", "element ",
                        " of block bar, reference position (", "no Damage Model", "told once"});
}

// Two bodies that are alike to the last bit, one on each of two ranks: one of them is told of.
TEST(Monitor, OfBodiesThatAreAlikeOneIsToldOf) {
  const RunFolder folder;
  const double h = std::ldexp(1, -10);
  folder.write("points.txt", cubes(1, {0, 0, 0}, 3, 3, 3, h) + cubes(2, {128 * h, 0, 0}, 3, 3, 3, h));
  Parts parts;
  parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
  parts.conditions = along("pull", "Prescribed Displacement", "all", "z", "9e6*z*t") +
                     along("sides", "Prescribed Displacement", "all", "xy", "0");
  parts.times = key("Final Time", "1e-6");
  parts.watch = key("Balance Error", "1") + key("Beyond Limits", "Continue");
  const Outcome o = outcome(folder, parts);
  EXPECT_EQ(o.error, "");
  EXPECT_EQ(folder.world.sum(o.said.find("drawn") != std::string::npos ? 1.0 : 0.0), 1);
}

// A quadratic cell holds while one of its integration points does: it is told of when all have failed, whichever was
// first, at its upper or lower end.
TEST(Monitor, CellsThatHoldInPartHaveNotFailed) {
  const auto told = [](const std::string& way) {
    const RunFolder folder;
    folder.write("points.txt", cubes(1, {0, 0, 0}, 4, 4, 6, 1e-3));
    Parts parts;
    parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
    parts.materials = section(
        "copper", key("Material Model", "Metal Foam Correspondence") + key("Formulation", "Quadratic Correspondence") +
                      key("Density", "150") + key("Young's Modulus", "300e6") + key("Poisson's Ratio", "0") +
                      key("Plastic Poisson's Ratio", "0") + key("Plateau Stress", "1e9") +
                      key("Linear Hardening", "0") + key("Locking Stress", "2e6") + key("Locking Exponent", "8") +
                      key("Densification Strain", "1.0") + key("Failure Strain", "0.01"));
    parts.conditions = along("sides", "Prescribed Displacement", "all", "xy", "0") +
                       along("way", "Prescribed Displacement", "all", "z", way + "*t");
    parts.times = key("Final Time", "1");
    parts.verlet = key("Number of Load Steps", "2");
    const Outcome o = outcome(folder, parts, "QuasiStatic");
    EXPECT_EQ(o.error, "");
    return folder.world.any(o.said.find("points have failed (Failure Strain)") != std::string::npos);
  };
  // A strain of 0.01 within the last cells, above or below their centers, or over all of them.
  EXPECT_FALSE(told("z^2*0.005/5.6e-3"));
  EXPECT_FALSE(told("(6e-3 - z)^2*(-0.005)/5.6e-3"));
  EXPECT_TRUE(told("z^2*0.005/4.5e-3"));
  EXPECT_TRUE(told("(6e-3 - z)^2*(-0.005)/4.5e-3"));
}

// A roll reaches the bar at rest after some thirty rows, and is thinner than the points are apart. In that row nothing
// is known of the energy yet but the round-off of a difference: v of half an impulse, squared, less the same.
TEST(Monitor, ABodyThatHasJustBeenStruckIsInBalance) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = section("roll", key("Type", "Rigid Cylinder") + key("Point", "2e-3 0 6.35e-3") +
                                         key("Axis", "0 1 0") + key("Radius", "0.25e-3") + key("Travel Z", "-10*t"));
  parts.times = key("Final Time", "3e-5");
  for (const std::string model : {"Elastic", "Elastic Correspondence"}) {
    parts.materials = changed(copper(), "Elastic Correspondence", model);
    const Outcome o = outcome(folder, parts);
    EXPECT_EQ(o.error, "") << model;
    EXPECT_EQ(o.said.find("balance of energy has an error"), std::string::npos) << o.said;
  }
}

// Halves of two layers, one thrown from the other: at 20 m/s the first step leads beyond the opening at which the crack
// has taken its energy, at 1 m/s some twenty do. Bonds by their energy break in the step after it, with more than
// theirs.
TEST(Monitor, CracksThatStepsLeapOverAreToldOf) {
  const auto said_at = [](const std::string& model, const std::string& speed, const std::string& step) {
    const RunFolder folder;
    folder.write("points.txt", cubes(1, {0, 0, 0}, 3, 3, 4, 1e-3));
    Parts parts;
    parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
    parts.materials =
        section("brittle", key("Material Model", model == "Bond Energy" ? "Elastic" : "Elastic Correspondence") +
                               key("Density", "1000") + key("Young's Modulus", "1e9") + key("Poisson's Ratio", "0.25"));
    parts.blocks = section("body", key("Block Names", "all") + key("Material", "brittle") +
                                       key("Horizon Factor", "1.75") + key("Damage Model", "crack"));
    parts.damage = section("crack", key("Damage Model", model) + key("Fracture Energy", "5"));
    parts.node_sets = key("foot", "z &lt; 2e-3") + key("head", "z &gt; 2e-3");
    parts.conditions = along("hold", "Prescribed Displacement", "foot", "xyz", "0") +
                       along("throw", "Prescribed Velocity", "head", "z", speed);
    parts.times = key("Final Time", "1.5e-5");
    parts.verlet = step;
    const std::string first = outcome(folder, parts).said;
    parts.times = key("Final Time", "2e-5");  // no bond breaks in what follows, but the checkpoint knows of them
    return first + outcome(folder, parts, "Verlet", Start::continued).said;
  };
  const std::string told = "steps were too long for the cracks";
  for (const std::string model : {"Cohesive Crack", "Critical Stretch", "Bond Energy"}) {
    const std::string fast = said_at(model, "20", ""), finer = said_at(model, "20", key("Fixed dt", "3e-8")),
                      slow = said_at(model, "1", "");
    EXPECT_EQ(finer.find(told), std::string::npos) << finer;
    EXPECT_EQ(slow.find(told), std::string::npos) << slow;
    if (fast.empty()) continue;  // another rank than the first
    EXPECT_NE(fast.find(told), fast.rfind(told)) << fast;
    expect_words(fast, {told, model == "Bond Energy" ? "an estimated 2" : "an estimated 0 of the energy",
                        "expected a Fixed dt of "});
  }
}

// A soft body whose points move against their neighbors, beside one that stores much more.
TEST(Monitor, TellsOfSpringsThatHoldMuchOfOneBody) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0, 0, 0}, 6, 6, 6, 1e-3) + cubes(2, {0.02, 0, 0}, 6, 6, 6, 1e-3));
  Parts parts = thrown_block("");
  parts.materials += section("lead", key("Material Model", "Elastic Plastic Correspondence") + key("Density", "8930") +
                                         key("Young's Modulus", "117e9") + key("Poisson's Ratio", "0.35") +
                                         key("Yield Stress", "1e8"));
  parts.blocks = changed(parts.blocks, key("Block Names", "block_1") + key("Material", "copper"),
                         key("Block Names", "block_1") + key("Material", "lead"));
  parts.conditions = along("noise", "Initial Velocity", "block_1", "z", "20*sin(3141.59265*x)") +
                     along("pull", "Initial Velocity", "block_2", "z", "2e4*z");
  parts.times = key("Final Time", "2e-6");
  const std::string said = outcome(folder, parts).said;
  if (folder.world.rank() == 0)
    expect_words(said, {"the springs of the stabilization hold ", " % of the energy that the body of block block_1 "});
}

}  // namespace
}  // namespace strut::regression
