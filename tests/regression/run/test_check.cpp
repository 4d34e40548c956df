// --check: what it says of the time, and of what cannot be written.
#include <gtest/gtest.h>

#include <regex>

#include "regression/bodies.hpp"
#include "run/report.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

// What it prints, on rank 0.
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

// A body that flies as a whole is skipped: its first steps say nothing of those after the impact.
TEST(Check, TellsTheTimeOfStepsInWhichAllMove) {
  const RunFolder folder({.nx = 12, .ny = 12, .nz = 20});
  Parts parts;
  parts.materials = copper(key("Yield Stress", "400e6"));
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-20") +
                     plane("floor", "Rigid Plane", "all", "0 0 -1e-3", "0 0 1");
  const std::string told = checked(folder, parts);
  if (folder.world.rank() != 0) return;
  EXPECT_EQ(numbers_in(told, "estimated time ([0-9.]+) s to ([0-9.]+) s").size(), 2u);
  const auto times = numbers_in(told, "\\(([-+.e0-9]+) s a step in which all points move, measured; ([-+.e0-9]+) s");
  // Skipped are forces, some hundred times what is left: ten is safe on a busy machine.
  ASSERT_EQ(times.size(), 2u);
  EXPECT_GT(times[0], 10 * times[1]) << told;
}

TEST(Check, TellsTheTimeOfEquilibria) {
  const RunFolder folder;
  Parts parts;
  parts.conditions = along("low", "Prescribed Displacement", "foot", "xyz", "0") +
                     along("high", "Prescribed Displacement", "top", "z", "1e-5*t");
  std::string deck =
      changed(parts.text(), section("Verlet", parts.verlet), section("QuasiStatic", key("Number of Load Steps", "4")));
  const auto file = folder.write("deck.xml", changed(deck, "5e-6", "1"));
  testing::internal::CaptureStdout();
  check(file, folder.world);
  const std::string told = testing::internal::GetCapturedStdout();
  if (folder.world.rank() != 0) return;
  EXPECT_EQ(numbers_in(told, "4 load steps; the first one took ([0-9.]+) s and ([0-9]+) iterations").size(), 2u);
  EXPECT_EQ(numbers_in(told, "estimated time ([0-9.]+) s to ([0-9.]+) s").size(), 2u);
}

// What rank 0 has taken is told, and the size of a frame, by which the result file grows.
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
  const auto work = numbers_in(told, "\ns at work, not waiting +([0-9.]+) +([0-9.]+) +([0-9.]+)\n");
  EXPECT_EQ(points, (std::vector<double>(3, 64))) << "two halves";
  EXPECT_EQ(ghosts, (std::vector<double>(3, 32))) << "the horizon reaches two layers of 16 points";
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
