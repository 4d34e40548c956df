// Actions of rank 0 within collective operations.
#pragma once

#include <exception>
#include <string>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"

namespace strut::io {

// Runs actions one after the other on rank 0. After one that fails, rank 0 skips the rest but still takes part in the
// collective calls between them, so that no rank waits for it; raise() then throws Error on all ranks.
class OnRoot {
 public:
  explicit OnRoot(const Communicator& communicator) : communicator_(communicator) {}

  template <class Action>
  void operator()(Action&& action) {
    if (communicator_.rank() != 0 || !problem_.empty()) return;
    try {
      action();
    } catch (const std::exception& error) {
      problem_ = error.what();
    }
  }
  const std::string& problem() const { return problem_; }
  void raise() const { raise_together(communicator_, problem_); }

 private:
  const Communicator& communicator_;
  std::string problem_;
};

}  // namespace strut::io
