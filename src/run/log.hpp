// Copies the terminal output of a run to a log file.
#pragma once

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>

#include "base/parallel/communicator.hpp"
#include "io/file_lock.hpp"

namespace strut {

// While it exists, std::cout and std::cerr of any rank go to the file, too; at the end also an incomplete
// line.
class Log {
 public:
  // Collective. Replaces the file if it is a log. Throws Error on all ranks if it is another file, cannot be created,
  // or belongs to a run in progress.
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
