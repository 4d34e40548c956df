// Runs a tool of this project as a user would, in a folder of its own. For tests on one rank.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace strut::testing {

struct Outcome {
  int status = -1;   // exit status; -1: it did not exit by itself
  std::string text;  // what it printed; where it failed, its errors too
};

class ToolTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "strut-tool-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }

  Outcome run(const std::string& command) const {
    const int code = std::system((command + " > " + path("output") + " 2> " + path("errors")).c_str());
    const int status = WIFEXITED(code) ? WEXITSTATUS(code) : -1;
    // Open MPI may write about the machine to stderr, which is no output of the tool.
    return {status, status == 0 ? content("output") : content("output") + content("errors")};
  }

 private:
  std::string content(const std::string& name) const {
    std::ifstream file(path(name));
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path folder_;
};

}  // namespace strut::testing
