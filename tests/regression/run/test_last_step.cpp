// A signal ends a run early; in the very last step there is nothing left to end, and the run is complete.
#include <gtest/gtest.h>

#include <csignal>
#include <iostream>
#include <streambuf>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

// Replaces std::cout, and raises a signal when the run prints a text for the first time. The first progress is printed
// between the two halves of its first step.
class SignalAt : public std::streambuf {
 public:
  SignalAt(const char* text, int signal) : text_(text), signal_(signal), replaced_(std::cout.rdbuf(this)) {}
  ~SignalAt() override {
    std::cout.rdbuf(replaced_);
    std::signal(signal_, SIG_DFL);
  }

 private:
  int overflow(int character) override {
    char one = static_cast<char>(character);
    xsputn(&one, 1);
    return 0;
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    shown_.append(text, static_cast<std::size_t>(size));
    if (!raised_ && shown_.find(text_) != std::string::npos) {
      raised_ = true;
      std::raise(signal_);
    }
    return size;
  }

  const char* text_;
  int signal_;
  std::streambuf* replaced_;
  std::string shown_;
  bool raised_ = false;
};

// True if a run of so many equal steps stops because it is signalled.
bool signalled_run(const RunFolder& folder, const std::string& final_time,
                   const char* at = "left: ", int with = SIGTERM) {
  Parts parts;
  parts.times = key("Final Time", final_time);
  parts.verlet = key("Fixed dt", "1e-8");
  const std::filesystem::path deck = folder.write("deck.xml", parts.text());
  const SignalAt signal(at, with);
  return run(deck, folder.world);
}

TEST(Signal, InTheLastStepLeavesTheRunComplete) {
  const RunFolder folder;
  EXPECT_TRUE(signalled_run(folder, "1e-8"));
  EXPECT_FALSE(signalled_run(folder, "1e-6"));
}

// The end of a job, told to a run that still sets up: it goes on to its first step. Uncaught, it would end this
// process.
TEST(Signal, DuringSetUpIsKeptForTheFirstStep) {
  const RunFolder folder;
  EXPECT_FALSE(signalled_run(folder, "1e-6", "of memory", SIGUSR1));
}

// Else the tests above would hold whatever they do: a run is ended by its own signals alone.
TEST(Signal, OfAnEarlierRunIsForgotten) {
  const RunFolder folder;
  EXPECT_FALSE(signalled_run(folder, "1e-6"));
  EXPECT_TRUE(signalled_run(folder, "1e-6", "a text that no run says"));
}

// After a day, doubles are 15 ps apart, 1e-4 of a step; each step is rounded to them.
TEST(LastSteps, AreAsLongAsTheOthersWhenTimesAreLate) {
  constexpr double begin = 86400;
  const RunFolder folder;
  Parts parts;
  parts.times = key("Initial Time", "86400") + key("Final Time", "86400.000003");
  Simulation run(folder, parts);
  std::vector<double> steps;
  while (run.solver.time() < begin + 3e-6 - 1e-10) {
    run.solver.advance_velocity(begin + 3e-6);
    steps.push_back(run.solver.dt());
    run.solver.advance_position(false);
  }
  EXPECT_GT(steps.size(), 10u);
  for (const double dt : steps) EXPECT_NEAR(dt, steps[0], 2e-3 * steps[0]);
}

}  // namespace
}  // namespace strut::regression
