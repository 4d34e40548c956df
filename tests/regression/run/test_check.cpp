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
