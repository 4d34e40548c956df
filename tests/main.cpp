// main() of every GoogleTest program: starts the run time, lets rank 0 speak, and fails on all ranks when one fails.
// The other ranks say only which of their assertions failed. After --threads stands how many a rank has.
#include <gtest/gtest.h>

#include <iostream>
#include <sstream>
#include <string>

#include "base/parallel/communicator.hpp"
#include "base/parallel/threads.hpp"

namespace {

class FailuresOnly : public testing::EmptyTestEventListener {
 public:
  explicit FailuresOnly(int rank) : rank_(rank) {}

  void OnTestStart(const testing::TestInfo& test) override {
    test_ = std::string(test.test_suite_name()) + "." + test.name();
  }
  // UnitTest holds its lock here: asking it for the current test would wait for ever.
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    std::ostringstream text;  // one write, so that ranks do not mix their lines
    text << "rank " << rank_ << ": " << (result.file_name() ? result.file_name() : "unknown file") << ":"
         << result.line_number() << ": Failure in " << test_ << "\n"
         << result.message() << "\n";
    std::cerr << text.str() << std::flush;
  }

 private:
  int rank_;
  std::string test_ = "no test";
};

}  // namespace

int main(int argc, char** argv) {
  strut::Runtime runtime(argc, argv);
  testing::InitGoogleTest(&argc, argv);
  if (argc == 3 && std::string(argv[1]) == "--threads") {
    const std::string problem = strut::set_threads(std::stoi(argv[2]));
    if (!problem.empty()) return std::cerr << problem << "\n", 1;
  }
  const strut::Communicator world;
  if (world.rank() != 0) {
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new FailuresOnly(world.rank()));  // GoogleTest deletes it
  }
  const int failed = RUN_ALL_TESTS();
  return world.max(static_cast<double>(failed)) > 0 ? 1 : 0;
}
