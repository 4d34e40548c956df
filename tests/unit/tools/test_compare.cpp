// strut-compare: equal, different and incomparable results and histories.
#include <cmath>

#include "base/parallel/communicator.hpp"
#include "io/exodus/exodus.hpp"
#include "tool.hpp"

namespace strut {
namespace {

using Columns = std::vector<std::vector<double>>;

// Three points in two blocks with two frames: a vector, a scalar.
PointCloud cloud(double x = 0) {
  PointCloud points;
  points.ids = {0, 1, 2};
  points.element_ids = {1, 2, 3};
  points.positions = {{x, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  points.volumes = {1, 1, 1};
  points.blocks = {0, 0, 1};
  points.sets = {0, 0, 0};
  points.block_names = {"a", "b"};
  return points;
}

class CompareTool : public testing::ToolTest {
 protected:
  // `change` is added to the displacement z of point 2 in the second frame.
  std::string result(const std::string& name, double change = 0, int frames = 2, const char* scalar = "Damage") const {
    io::ExodusWriter writer(path(name), Communicator(), cloud(), {{"Displacement", 3, true}, {scalar, 1, false}});
    for (int frame = 0; frame < frames; ++frame) {
      Columns columns = {{0, 0, 0, 4, 0, 0, 0, 0, 0}, {0.5, 0.25, NAN}};
      if (frame == 1) columns[0][5] += change;
      writer.write(1e-6 * frame, columns);
    }
    return path(name);
  }
  testing::Outcome compare(const std::string& a, const std::string& b, const std::string& options = "") const {
    return run(std::string(STRUT_COMPARE) + " " + a + " " + b + " " + options);
  }
};

void expect_text(const testing::Outcome& outcome, const std::string& expected) {
  EXPECT_NE(outcome.text.find(expected), std::string::npos) << outcome.text;
}

TEST_F(CompareTool, EqualResults) {
  const testing::Outcome outcome = compare(result("a.e"), result("b.e"), "--relative 0");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  expect_text(outcome, "the same");
}

// The second body is longer by 1e-6 of its length, and has the same fields.
TEST_F(CompareTool, BodiesThatStandElsewhereDiffer) {
  const std::string a = result("a.e"), b = path("b.e");
  io::ExodusWriter(b, Communicator(), cloud(-2e-6), {{"Displacement", 3, true}, {"Damage", 1, false}});
  const testing::Outcome outcome = compare(a, b);
  EXPECT_EQ(outcome.status, 1);
  expect_text(outcome, "node 1 is at (0, 0, 0) m and at (-2e-06, 0, 0) m before anything moves");
  EXPECT_EQ(compare(a, b, "--relative 1.1e-6").text.find("before anything moves"), std::string::npos);
}

// The same points and fields; blocks without points do not count.
TEST_F(CompareTool, OtherBlocksDiffer) {
  const auto with_blocks = [this](const std::string& name, const std::vector<int>& blocks,
                                  const std::vector<std::string>& names) {
    PointCloud points = cloud();
    points.blocks = blocks, points.block_names = names;
    io::ExodusWriter(path(name), Communicator(), points, {{"Damage", 1, false}}).write(0, Columns{{0, 0, 0}});
    return path(name);
  };
  const std::string a = with_blocks("a.e", {0, 0, 1}, {"a", "b"});
  const testing::Outcome split_elsewhere = compare(a, with_blocks("b.e", {0, 1, 1}, {"a", "b"}));
  EXPECT_EQ(split_elsewhere.status, 1);
  expect_text(split_elsewhere, "the first has the blocks (elements) a (2), b (1), the second a (1), b (2)");
  EXPECT_EQ(compare(a, with_blocks("c.e", {0, 0, 1}, {"b", "a"})).status, 1);
  EXPECT_EQ(compare(a, with_blocks("d.e", {0, 0, 2}, {"a", "none", "b"})).status, 0);
}

TEST_F(CompareTool, ADifferenceIsMeasuredAgainstTheQuantityAndLocated) {
  const std::string a = result("a.e");
  const std::string b = result("b.e", 4e-6);
  const testing::Outcome outcome = compare(a, b);
  EXPECT_EQ(outcome.status, 1);
  expect_text(outcome, "! DisplacementZ");
  expect_text(outcome, "4e-06          1e-06  t = 1e-06 s, node 2");  // against DisplacementX, which is 4
  EXPECT_EQ(compare(a, b, "--relative 1.1e-6").status, 0);
  EXPECT_EQ(compare(a, b, "--relative 0.9e-6").status, 1);
  EXPECT_EQ(compare(a, b, "--absolute 5e-6").status, 0);
  EXPECT_EQ(compare(a, b, "--relative 0 --absolute 3e-6").status, 1);
}

TEST_F(CompareTool, NaNDiffersFromANumber) {
  EXPECT_EQ(compare(result("a.e"), result("b.e", NAN), "--relative 1 --absolute 1e30").status, 1);
}

TEST_F(CompareTool, InfiniteTimesAndPlacesDifferFromNumbers) {
  const auto result_at = [this](const std::string& name, double time, double x) {
    io::ExodusWriter(path(name), Communicator(), cloud(x), {{"Damage", 1, false}}).write(time, Columns{{0, 0, 0}});
    return path(name);
  };
  const std::string a = result_at("a.e", INFINITY, 0), b = result_at("b.e", 1, 0), c = result_at("c.e", 1, INFINITY);
  expect_text(compare(a, b), "frame 1 is at t = inf s and 1 s");
  expect_text(compare(b, a), "frame 1 is at t = 1 s and inf s");
  expect_text(compare(c, b), "node 1 is at (inf, 0, 0) m and at (0, 0, 0) m");
  EXPECT_EQ(compare(a, a).status, 0);
  EXPECT_EQ(compare(c, c).status, 0);
}

TEST_F(CompareTool, MissingVariablesAndFrames) {
  const std::string a = result("a.e");
  const testing::Outcome other_name = compare(a, result("b.e", 0, 2, "Wear"));
  EXPECT_EQ(other_name.status, 1);
  expect_text(other_name, "only the first has the element variable 'Damage'");
  expect_text(other_name, "only the second has the element variable 'Wear'");
  const testing::Outcome shorter = compare(a, result("c.e", 0, 1));
  EXPECT_EQ(shorter.status, 1);
  expect_text(shorter, "the first has 2 frames, the second 1");
}

TEST_F(CompareTool, Histories) {
  const std::string a = write("a.csv", "time,energy\n0,1\n1,2\n2,4\n");
  const std::string b = write("b.csv", "time,energy\n0,1\n1,2.00000004\n2,4\n");
  EXPECT_EQ(compare(a, a, "--relative 0").status, 0);
  const testing::Outcome outcome = compare(a, b);
  EXPECT_EQ(outcome.status, 1);
  expect_text(outcome, "4e-08          1e-08  row 2");
  EXPECT_EQ(compare(a, b, "--relative 1e-7").status, 0);
  EXPECT_EQ(compare(a, write("c.csv", "time,energy\n0,1\n")).status, 1);
  EXPECT_EQ(compare(a, write("d.csv", "time,work\n0,1\n1,2\n2,4\n")).status, 1);
  EXPECT_EQ(compare(a, write("spreadsheet.csv", "time, energy\r\n0, 1\r\n1, 2\r\n2, 4\r\n")).status, 0);
}

TEST_F(CompareTool, WhatCannotBeComparedEndsWithStatusTwo) {
  const std::string a = result("a.e");
  const std::string history = write("a.csv", "time\n0\n");
  for (const testing::Outcome& outcome :
       {compare(a, path("none.e")), compare(a, write("text.e", "no result")), compare(a, ""),
        compare(a, a, "--relativ 1"), compare(a, a, "--relative"), compare(a, a, "--relative -1"),
        compare(history, path("none.csv")), compare(history, write("bad.csv", "time\nsoon\n")),
        compare(history, write("ragged.csv", "time\n0,1\n")),
        compare(history, write("doubled.csv", "time,time\n0,1\n"))}) {
    EXPECT_EQ(outcome.status, 2) << outcome.text;
    EXPECT_TRUE(outcome.text.starts_with("strut-compare: ")) << outcome.text;
  }
}

}  // namespace
}  // namespace strut
