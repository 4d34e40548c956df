// The log of a run: what is said on the terminal, line by line, to the last one.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/files.hpp"
#include "regression/bodies.hpp"
#include "run/log.hpp"

namespace strut::regression {
namespace {

// The lines of the file after the first, which says that it is a log, in alphabetical order.
std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  std::string line;
  EXPECT_TRUE(std::getline(file, line) && line.starts_with(log_mark)) << line;
  while (std::getline(file, line)) lines.push_back(line);
  std::sort(lines.begin(), lines.end());
  return lines;
}

TEST(Log, HasAllLinesAlsoOneThatHasNotEnded) {
  const RunFolder folder;
  const std::string rank = std::to_string(folder.world.rank());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  {
    const Log log(folder / "log", folder.world);
    std::cout << "one of " << rank << "\n\r 10 %\r 20 %" << std::flush;  // a bar, until an error ends the run
    std::cerr << "error of " << rank;
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "one of " + rank + "\n\r 10 %\r 20 %")
      << "on the terminal as it was said";
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "error of " + rank);
  folder.world.barrier();
  std::vector<std::string> expected(folder.world.size(), " 20 %");
  for (const std::string word : {"error of ", "one of "}) {
    for (int r = 0; r < folder.world.size(); ++r) expected.push_back(word + std::to_string(r));
  }
  EXPECT_EQ(lines_of(folder / "log"), expected);
  folder.world.barrier();  // before the folder goes
}

TEST(Log, OfARunThatGoesOnIsNotReplaced) {
  const RunFolder folder;
  {
    const Log log(folder / "log", folder.world);
    try {
      const Log other(folder / "log", folder.world);
      FAIL() << "two runs would write to it";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("--log: "), std::string::npos);
      EXPECT_NE(std::string(error.what()).find("another run is writing to it"), std::string::npos) << error.what();
    }
  }
  folder.world.barrier();
  const Log later(folder / "log", folder.world);  // that of one which has ended is
}

}  // namespace
}  // namespace strut::regression
