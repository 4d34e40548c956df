// Errors that a user can act on. An Error has the whole text; raise_together makes every rank throw the same one, so
// that no rank waits for another that has failed.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/parallel/communicator.hpp"

namespace strut {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Collective. If `problem` is not empty on any rank, throws Error on all ranks with the distinct texts in rank order.
void raise_together(const Communicator& communicator, const std::string& problem);
void raise_first(const Communicator& communicator, const std::string& problem);  // with the first of these texts only

// Collective. Runs `action` on rank 0 only; its exception (any std::exception) becomes an Error on all ranks.
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

// " (did you mean 'Horizon'?)", or "" if nothing in `valid` is close to `name`.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& valid);

// "a, b, c"
std::string joined(const std::vector<std::string>& words, std::string_view separator = ", ");

}  // namespace strut
