// A run that goes on writes the row and the frame at its checkpoint anew: they are the same to the last byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/errors.hpp"
#include "output/observables.hpp"
#include "regression/scenes.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Restored : public testing::TestWithParam<AnyScene> {};

// The last checkpoint of a run stands before its last row and frame; here these have all that can be asked for.
TEST_P(Restored, RunWritesTheSameRowAndFrame) {
  const RunFolder folder;
  folder.write("points.txt", points_of_scenes());
  AnyScene scene = GetParam();
  std::string variables;
  {
    const deck::Deck deck = deck::read(folder.write("deck.xml", scene.text()), folder.world);
    for (const std::string& name : names_of(observables(set_up(deck, folder.world).body)))
      variables += key(name, "true");
  }
  scene.parts.output = key("Output Filename", (folder / "run.e").string()) + key("Output Frequency", "5") +
                       section("Output Variables", variables);
  std::string columns;
  for (const char* name :
       {"Contact_Force_X(block_1:block_2)", "Contact_Force_Z(block_2:block_1)", "Max_Velocity", "Max_Force",
        "Max_Von_Mises_Stress", "Min_Dilatation", "Mean_Displacement_Z", "Max_Damage"}) {
    columns += key(name, "true");
  }
  columns += scene.is_static ? key("Reaction_X(drag)", "true") + key("Reaction_Z(plate)", "true")
                             : key("Reaction_Z(wall)", "true") + key("Reaction_Z(punch)", "true");
  scene.parts.history =
      key("Filename", (folder / "run.csv").string()) + key("Frequency", "1") + section("Variables", columns);
  const auto deck =
      folder.write("deck.xml", scene.text(section("Restart", key("Filename", (folder / "run.restart").string()))));
  testing::internal::CaptureStdout();
  EXPECT_TRUE(run(deck, folder.world));
  const std::string history = bytes_of(folder / "run.csv"), result = bytes_of(folder / "run.e");
  folder.world.barrier();
  EXPECT_TRUE(run(deck, folder.world, Start::continued));
  const std::string told = testing::internal::GetCapturedStdout();
  if (folder.world.rank() == 0) {
    EXPECT_NE(told.find("going on from"), std::string::npos) << told;
  }
  EXPECT_EQ(bytes_of(folder / "run.csv"), history);
  EXPECT_TRUE(bytes_of(folder / "run.e") == result);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Restored, testing::ValuesIn(all_scenes()),
                         [](const auto& scene) { return scene.param.name; });

// Another final time changes the default intervals; other keys the given ones. What is written stays.
TEST(Continued, RowAndFrameAtTheCheckpointStayWhenTimesOfOutputChange) {
  for (const auto& [before, now] : {std::pair<std::string, std::string>{"", ""},
                                    {key("Frequency", "2"), key("Frequency", "3")},
                                    {key("Interval", "2e-6"), key("Interval", "3e-6")}}) {
    const RunFolder folder;
    folder.write("points.txt", points_of_scenes());
    AnyScene scene = all_scenes().front();
    const auto deck = [&](const std::string& when, const std::string& end) {
      const std::string frames = when.empty() ? "" : changed(when, "name=\"", "name=\"Output ");
      scene.parts.output = key("Output Filename", (folder / "run.e").string()) + frames +
                           section("Output Variables", key("Displacement", "true"));
      scene.parts.history = key("Filename", (folder / "run.csv").string()) + when + section("Variables", "");
      scene.parts.times = key("Final Time", end);
      scene.parts.verlet = key("Fixed dt", "2e-8");
      return folder.write("deck.xml",
                          scene.text(section("Restart", key("Filename", (folder / "run.restart").string()))));
    };
    testing::internal::CaptureStdout();
    EXPECT_TRUE(run(deck(before, "4e-6"), folder.world));
    folder.world.barrier();
    EXPECT_TRUE(run(deck(now, "8e-6"), folder.world, Start::continued));
    testing::internal::GetCapturedStdout();
    for (const std::vector<double>& times :
         {read_history(folder / "run.csv").at("Time"), io::read_result(folder / "run.e").times}) {
      EXPECT_EQ(std::ranges::count_if(times, [](double t) { return std::abs(t - 4e-6) < 1e-12; }), 1) << before;
    }
  }
}

// Profiles need the shapes of cells, which the run has not had before, and probes are node sets.
TEST(Continued, HistoryOfAProfileAndAProbeMayBeginAndEnd) {
  const RunFolder folder;
  Parts parts;
  parts.verlet = key("Fixed dt", "1e-7");
  const std::string solver = "<ParameterList name=\"Solver\">",
                    restart = section("Restart", key("Filename", (folder / "run.restart").string()));
  const std::string history =
      key("Filename", (folder / "run.csv").string()) +
      section("Variables", key("Mean_Coordinate_Z(slices)", "true") + key("Displacement_Z(tip)", "true")) +
      section("Profiles", section("slices", key("Layers", "3"))) +
      section("Probes", section("tip", key("Point", "2e-3 2e-3 6e-3")));
  const auto go_on = [&](const std::string& with, const std::string& end, Start start) {
    parts.history = with, parts.times = key("Final Time", end);
    std::string told;
    testing::internal::CaptureStdout();
    try {
      run(folder.write("deck.xml", changed(parts.text(), solver, restart + solver)), folder.world, start);
    } catch (const Error& error) {
      told = error.what();
    }
    testing::internal::GetCapturedStdout();
    EXPECT_EQ(told, "") << end;
    folder.world.barrier();
  };
  go_on("", "1e-6", Start::anew);
  go_on(history, "2e-6", Start::continued);
  EXPECT_NEAR(read_history(folder / "run.csv").at("Time").back(), 2e-6, 1e-12);
  go_on("", "3e-6", Start::continued);
}

// A run in parts: what each has of Output and History. The state is kept in the working folder, under the deck's name.
class InParts : public testing::Test {
 protected:
  const RunFolder folder;
  const std::string output = key("Output Filename", (folder / "run.e").string()) + key("Output Frequency", "3") +
                             section("Output Variables", key("Displacement", "true"));
  const std::string history =
      key("Filename", (folder / "run.csv").string()) + key("Frequency", "3") + section("Variables", "");

  std::string told(const std::string& frames, const std::string& rows, const std::string& end,
                   Start start = Start::continued) const {
    Parts parts;
    parts.verlet = key("Fixed dt", "1e-7");
    parts.output = frames, parts.history = rows, parts.times = key("Final Time", end);
    testing::internal::CaptureStdout();
    EXPECT_TRUE(run(folder.write("parted.xml", parts.text()), folder.world, start)) << end;
    folder.world.barrier();
    return testing::internal::GetCapturedStdout();
  }
  void TearDown() override {
    folder.world.barrier();
    for (const char* const name : {"parted.restart", "parted.restart.old"}) std::filesystem::remove(name);
  }
};

// Parts that write no frames would leave nothing by themselves; what the first one has kept must not be lost by them.
TEST_F(InParts, TheStateOfAFinishedRunIsKept) {
  told(output, history, "1e-6", Start::anew);
  for (const char* const end : {"1e-6", "2e-6"}) {
    told("", history, end);
    EXPECT_TRUE(std::filesystem::exists("parted.restart")) << end;
  }
  const std::string last = told(output, history, "3e-6");
  if (folder.world.rank() == 0) {
    EXPECT_NE(last.find("going on from parted.restart, t = 2e-06 s"), std::string::npos) << last;
  }
}

// The row and the frame at a checkpoint are written after it.
TEST_F(InParts, RowsAndFramesBeforeAPauseStay) {
  told(output, history, "1e-6", Start::anew);
  for (const char* const end : {"2e-6", "3e-6"}) told("", "", end);
  told(output, history, "4e-6");
  for (const std::vector<double>& times :
       {read_history(folder / "run.csv").at("Time"), io::read_result(folder / "run.e").times}) {
    const auto next = std::ranges::upper_bound(times, 1.05e-6);
    ASSERT_TRUE(next != times.begin() && next != times.end());
    EXPECT_NEAR(next[-1], 1e-6, 1e-12);
    EXPECT_NEAR(next[0], 3e-6, 1e-12);
    EXPECT_TRUE(std::ranges::is_sorted(times));
  }
}

}  // namespace
}  // namespace strut::regression
