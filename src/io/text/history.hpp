// Totals over time, a line a row: CSV, numbers with all their digits, so that two runs can be compared. The first line
// begins with # and has version, build and the units of the columns; the second one has their names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/parallel/communicator.hpp"
#include "io/check_sum.hpp"
#include "io/file_lock.hpp"

namespace strut::io {

struct HistoryColumn {
  std::string name, unit;  // "1" for none
};

// Collective; rank 0 writes.
class HistoryFile {
 public:
  // Replaces a file of that name, or goes on with the first `bytes` of it, whose check sum they must have. Throws Error
  // on all ranks: the file cannot be created, another run writes to it, a name holds a comma, a quote or a line break;
  // it is shorter, or has other columns or rows.
  HistoryFile(const std::filesystem::path& path, const Communicator& communicator,
              const std::vector<HistoryColumn>& columns, std::int64_t bytes = 0, double sum = 0);

  // Rank 0's row is written and flushed; the others' rows only have to be there. Throws Error on all ranks: the row has
  // not one value per column, the disk is full.
  void write(std::span<const double> row);

  std::int64_t bytes() const { return bytes_; }  // so far, on rank 0
  double sum() const { return sum_.value(); }    // the check sum of them
  void sync() const;                             // collective: they are on the disk

 private:
  void begin(const std::string& units, const std::string& header);
  void go_on(const std::string& header, double sum);
  void take(std::istream& file);
  void write_line(const std::string& line);

  std::filesystem::path path_;
  Communicator communicator_;
  std::size_t columns_;
  std::int64_t bytes_;
  CheckSum sum_;
  std::optional<FileLock> lock_;
  std::ofstream file_;  // open on rank 0
};

}  // namespace strut::io
