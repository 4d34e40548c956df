// A log of a run: what it says on the terminal, in a file.
#pragma once

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>

#include "base/parallel/communicator.hpp"
#include "io/file_lock.hpp"

namespace strut {

// As long as it lives, what std::cout and std::cerr get on any rank goes to the file, too; at the end also a line that
// has not ended.
class Log {
 public:
  // Collective. Replaces the file, if it is a log; throws Error on all ranks where it is something else, cannot be
  // created, or is that of a run which goes on.
  Log(const std::filesystem::path& file, const Communicator& communicator);
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

 private:
  class Both;
  std::ofstream file_;
  std::optional<io::FileLock> lock_;  // on rank 0
  std::unique_ptr<Both> out_, errors_;
  std::streambuf *terminal_out_, *terminal_errors_;
};

}  // namespace strut
