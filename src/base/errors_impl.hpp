#pragma once

#include "base/parallel/communicator.hpp"

namespace strut {

template <class Action>
void run_on_root(const Communicator& communicator, Action&& action) {
  std::string problem;
  if (communicator.rank() == 0) {
    try {
      action();
    } catch (const std::exception& error) {
      problem = error.what();
      if (problem.empty()) problem = "unknown error";
    }
  }
  raise_together(communicator, problem);
}

}  // namespace strut
