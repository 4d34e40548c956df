// Totals over time, a line a row: CSV with a header, numbers with all their digits, so that two runs can be compared.
#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "base/communicator.hpp"

namespace strut::io {

// Collective; rank 0 writes.
class HistoryFile {
 public:
  // Replaces a file of that name. Throws Error on all ranks: the file cannot be created, a name holds a comma, a quote
  // or a line break.
  HistoryFile(const std::filesystem::path& path, const Communicator& communicator,
              std::vector<std::string> column_names);

  // Rank 0's row is written and flushed; the others' rows only have to be there. Throws Error on all ranks: the row has
  // not one value per column, the disk is full.
  void write(std::span<const double> row);

 private:
  void write_line(const std::string& line);

  std::filesystem::path path_;
  Communicator communicator_;
  std::size_t columns_;
  std::ofstream file_;  // open on rank 0
};

}  // namespace strut::io
