// --check: what it says of the time, and of what cannot be written.
#include <gtest/gtest.h>

#include <chrono>
#include <regex>

#include "regression/bodies.hpp"
#include "run/report.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

// The output of --check on rank 0.
std::string checked(const RunFolder& folder, const Parts& parts) {
  const auto deck = folder.write("deck.xml", parts.text());
  testing::internal::CaptureStdout();
  check(deck, folder.world);
  return testing::internal::GetCapturedStdout();
}

// The numbers of the pattern's groups.
std::vector<double> numbers_in(const std::string& text, const std::string& pattern) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(pattern))) ADD_FAILURE() << pattern << " in:\n" << text;
  std::vector<double> all;
  for (std::size_t k = 1; k < found.size(); ++k) all.push_back(std::stod(found[k]));
  return all;
}

// "1.3 s", "4 min 10 s", "2 h 3 min", s.
double seconds_of(const std::string& duration) {
  const std::map<std::string, double> units = {{"s", 1}, {"min", 60}, {"h", 3600}};
  std::istringstream words(duration);
  double sum = 0, number = 0;
  for (std::string unit; words >> number >> unit;) sum += number * units.at(unit);
  return sum;
}

// The forecast of a run of `steps` steps, each of which is predicted to take `least` to `most` s: the product, at most
// twice of it, to the rounding of as_duration.
void expect_estimate(const std::string& told, double steps, double least, double most) {
  std::smatch found;
  ASSERT_TRUE(std::regex_search(told, found, std::regex("estimated time (.+) to (.+?)( \\(|\n)"))) << told;
  const auto rounding = [](double s) { return s < 60 ? 0.05 : s < 3600 ? 0.5 : 30; };
  const double low = steps * least, high = 2 * steps * most;
  EXPECT_NEAR(seconds_of(found[1]), low, 1.01 * rounding(low) + 1e-4 * low) << told;  // numbers of six digits
  EXPECT_NEAR(seconds_of(found[2]), high, 1.01 * rounding(high) + 1e-4 * high) << told;
}

// Seconds that a run of the deck takes.
double seconds_of_run(const RunFolder& folder, const std::string& deck) {
  const auto start = std::chrono::steady_clock::now();
  testing::internal::CaptureStdout();
  run(folder / deck, folder.world);
  testing::internal::GetCapturedStdout();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

constexpr double longer = 1000;  // than a run that is made is one that is told of: seconds hide nothing of it

// A run takes about the predicted time: a machine may be busy, but not ten times as busy a moment later. A forgotten
// factor (the number of steps, a unit) is larger. `seconds`: of a run of so many times fewer of the same steps.
void expect_told_time(const std::string& told, double seconds) {
  std::smatch found;
  ASSERT_TRUE(std::regex_search(told, found, std::regex("estimated time (.+) to (.+?)( \\(|\n)"))) << told;
  EXPECT_LT(seconds_of(found[1]), 10 * longer * seconds) << told;
  EXPECT_GT(seconds_of(found[2]), longer * seconds / 10) << told;
}

// A body that flies as a whole is skipped: its first steps say nothing of those after the impact.
TEST(Check, TellsTheTimeOfStepsInWhichAllMove) {
  const RunFolder folder({.nx = 12, .ny = 12, .nz = 20});
  Parts parts;
  parts.materials = copper(key("Yield Stress", "400e6"));
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-20") +
                     plane("floor", "Rigid Plane", "all", "0 0 -1e-3", "0 0 1");
  double moving = 1e9, first = 1e9;  // s, the least of some: a busy machine pauses within steps
  for (int tries = 0; tries < 5; ++tries) {
    const std::string told = checked(folder, parts);
    if (folder.world.rank() != 0) continue;
    const auto times = numbers_in(told, "\\(([-+.e0-9]+) s a step in which all points move, measured; ([-+.e0-9]+) s");
    if (times.size() != 2) continue;  // told above
    moving = std::min(moving, times[0]), first = std::min(first, times[1]);
    expect_estimate(told, numbers_in(told, "about ([0-9]+) steps")[0], times[0], times[0]);
  }
  if (folder.world.rank() != 0) return;
  // Skipped are forces, some hundred times what is left: ten is safe on a busy machine.
  EXPECT_GT(moving, 10 * first);
}

TEST(Check, TellsTheTimeThatARunTakes) {
  const RunFolder folder({.nx = 12, .ny = 12, .nz = 20});
  Parts parts;
  parts.materials = copper(key("Yield Stress", "400e6"));
  parts.conditions =
      along("flight", "Initial Velocity", "all", "z", "-20") + plane("floor", "Rigid Plane", "all", "0 0 0", "0 0 1");
  parts.times = key("Final Time", "5e-2");
  const std::string told = checked(folder, parts);
  parts.times = key("Final Time", "5e-5");
  folder.write("short.xml", parts.text());
  const double seconds = seconds_of_run(folder, "short.xml");
  if (folder.world.rank() == 0) expect_told_time(told, seconds);
}

// Bodies that touch have shorter steps than those that a run begins with.
TEST(Check, KnowsTheStepsOfARunThatGoesOn) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0, 0, 0}, 3, 3, 3, 1e-3) + cubes(2, {0, 0, 3.05e-3}, 3, 3, 3, 1e-3));
  const std::string checkpoint = (folder / "first.restart").string();
  Parts parts = thrown_block(contact_of({{"block_1", "block_2"}}, "1e-3", "1e16"));
  const auto told = [&](const std::string& from, const std::string& until, const std::string& more,
                        const auto& action) {
    parts.times = key("Initial Time", from) + key("Final Time", until);
    std::string text = parts.text();
    text.insert(text.rfind("</ParameterList>"), more);
    testing::internal::CaptureStdout();
    action(folder.write("deck.xml", text), folder.world);
    return testing::internal::GetCapturedStdout();
  };
  const auto whole = [](const auto& deck, const Communicator& world) { run(deck, world); };
  const auto only_check = [](const auto& deck, const Communicator& world) { check(deck, world); };
  const std::string step = "critical time step ([-+.e0-9]+) s";
  const std::string first = told("0", "2e-6", section("Restart", key("Filename", checkpoint)), whole);
  const std::string start = section("Start From", key("Checkpoint", checkpoint));
  const std::string checked = told("2e-6", "4e-6", start, only_check), done = told("2e-6", "4e-6", start, whole);
  if (folder.world.rank() != 0) return;
  ASSERT_FALSE(numbers_in(done, step).empty()) << done;
  EXPECT_LT(numbers_in(done, step)[0], 0.9 * numbers_in(first, step)[0]) << done;
  EXPECT_NEAR(numbers_in(checked, step)[0], numbers_in(done, step)[0], 1e-3 * numbers_in(done, step)[0]) << checked;
}

// The first load step is that of the run, with the friction that is there.
TEST(Check, LooksAtEquilibriaThatStartFromAnotherRun) {
  const RunFolder folder;
  const std::string checkpoint = (folder / "first.restart").string();
  Parts parts;
  parts.conditions =
      along("low", "Prescribed Displacement", "foot", "xyz", "0") +
      section("press", key("Type", "Rigid Plane") + key("Point", "0 0 5.5e-3") + key("Normal", "0 0 -1") +
                           key("Friction Coefficient", "0.3") + key("Travel Z", "-1e-5*t") + key("Travel X", "1e-5*t"));
  const auto told = [&](int start, const std::string& more, const auto& action) {
    parts.times = key("Initial Time", std::to_string(start)) + key("Final Time", std::to_string(start + 1));
    std::string text = changed(parts.text(), section("Verlet", parts.verlet),
                               section("QuasiStatic", key("Number of Load Steps", "2")));
    text.insert(text.rfind("</ParameterList>"), more);
    testing::internal::CaptureStdout();
    action(folder.write("deck.xml", text), folder.world);
    return testing::internal::GetCapturedStdout();
  };
  const auto whole = [](const auto& deck, const Communicator& world) { run(deck, world); };
  told(0, section("Restart", key("Filename", checkpoint) + key("Frequency", "1")), whole);
  const std::string start = section("Start From", key("Checkpoint", checkpoint));
  const std::string checked = told(1, start, [](const auto& deck, const Communicator& world) { check(deck, world); });
  const std::string done = told(1, start, whole);
  if (folder.world.rank() != 0) return;
  EXPECT_EQ(numbers_in(checked, "and ([0-9]+) iterations"), numbers_in(done, "step +1 .*? ([0-9]+) iterations"));
}

TEST(Check, TellsTheTimeOfEquilibria) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = along("low", "Prescribed Displacement", "foot", "xyz", "0") +
                     along("high", "Prescribed Displacement", "top", "z", "1e-2*t");
  const auto deck = [&](const std::string& final_time, const std::string& load_steps) {
    parts.times = key("Final Time", final_time);
    return changed(parts.text(), section("Verlet", parts.verlet),
                   section("QuasiStatic", key("Number of Load Steps", load_steps)));
  };
  const auto file = folder.write("long.xml", deck("1", "40000"));
  testing::internal::CaptureStdout();
  check(file, folder.world);
  const std::string told = testing::internal::GetCapturedStdout();
  folder.write("short.xml", deck("1e-3", "40"));
  const double seconds = seconds_of_run(folder, "short.xml");
  if (folder.world.rank() != 0) return;
  expect_told_time(told, seconds);
  EXPECT_EQ(numbers_in(told, "40000 load steps; the first one took ([0-9.]+) s and ([0-9]+) iterations").size(), 2u);
}

// --check prints the memory of rank 0 and the size of a frame, by which the result file grows.
TEST(Check, TellsMemoryAndTheSizeOfAFrame) {
  const RunFolder folder({.nx = 4, .ny = 4, .nz = 8});
  const auto size_with = [&](const std::string& final_time) {
    Parts parts;
    parts.times = key("Final Time", final_time);
    parts.verlet = key("Fixed dt", "1e-8");
    parts.output =
        key("Output Filename", (folder / "result.e").string()) + key("Output Frequency", "1") +
        section("Output Variables", key("Displacement", "true") + key("Cauchy_Stress", "true") + key("Volume", "true"));
    const auto deck = folder.write("deck.xml", parts.text());
    testing::internal::CaptureStdout();
    check(deck, folder.world);
    const std::string told = testing::internal::GetCapturedStdout();
    run(deck, folder.world);
    if (folder.world.rank() == 0) {
      EXPECT_GT(numbers_in(told, "most memory so far: rank 0 ([0-9.]+) MB").at(0), 5) << "a program of some MB";
    }
    return folder.world.rank() == 0 ? std::filesystem::file_size(folder / "result.e") : 0;
  };
  const std::uintmax_t few = size_with("4.5e-8"), more = size_with("9.5e-8");
  if (folder.world.rank() != 0) return;
  OutputVariables variables;
  for (const int components : {3, 6, 1}) variables.frame.push_back({.name = "", .components = components});
  EXPECT_EQ(static_cast<double>(more - few), 5 * frame_bytes(variables, 4 * 4 * 8));
}

// At the end of a run on several ranks, what each had of it.
TEST(ClosingReport, TellsTheSharesOfTheRanks) {
  const RunFolder folder({.nx = 4, .ny = 4, .nz = 8});
  const auto deck = folder.write("deck.xml", Parts().text());
  testing::internal::CaptureStdout();
  run(deck, folder.world);
  const std::string told = testing::internal::GetCapturedStdout();
  if (folder.world.rank() != 0) return;
  EXPECT_EQ(told.find("of a rank ") != std::string::npos, folder.world.size() > 1);
  if (folder.world.size() == 1) return;
  const auto points = numbers_in(told, "\npoints +([0-9]+) +([0-9]+) +([0-9]+)\n");
  const auto ghosts = numbers_in(told, "\nghosts +([0-9]+) +([0-9]+) +([0-9]+)\n");
  const auto work = numbers_in(told, "\ns beside halo exchanges +([0-9.]+) +([0-9.]+) +([0-9.]+)\n");
  EXPECT_EQ(points, (std::vector<double>(3, 64))) << "two halves";
  EXPECT_EQ(ghosts, (std::vector<double>(3, 32))) << "the horizon reaches two layers of 16 points";
  ASSERT_EQ(work.size(), 3u);
  EXPECT_LE(work[0], work[1]);
  EXPECT_LE(work[1], work[2]);
}

TEST(Check, RefusesFilesThatCannotBeWritten) {
  const RunFolder folder;
  Parts parts;
  const std::string here = (folder / "nowhere").string();
  parts.output = key("Output Filename", here + "/result.e");
  parts.history = key("Filename", here + "/history.csv");
  const auto deck = folder.write("deck.xml", parts.text());
  std::string said;
  try {
    check(deck, folder.world);
  } catch (const Error& error) {
    said = error.what();
  }
  for (const char* part : {"2 problems", "Output > Output Filename: '", "History > Filename: '",
                           "cannot create it: there is no folder '"}) {
    EXPECT_NE(said.find(part), std::string::npos) << part << " in: " << said;
  }
}

TEST(TimeLeft, IsToldFromTheSecondLineOn) {
  const Communicator world;
  Progress progress(world, 0, 0, 10);
  testing::internal::CaptureStdout();
  progress.show(0, 0, 1);
  progress.show(1, 1, 1);
  const std::string told = testing::internal::GetCapturedStdout();
  if (world.rank() != 0) return;
  EXPECT_EQ(told.find("unknown"), std::string::npos) << told;
  EXPECT_NE(told.find("10 %  t = 1 s  step 1  dt = 1 s  left: "), std::string::npos) << told;
}

}  // namespace
}  // namespace strut::regression
