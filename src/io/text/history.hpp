// The history: totals over time, one row per line, as CSV with all digits, so that two runs can be compared. The first
// line begins with # and gives version, build and units of the columns; the second one gives their names.
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
  std::string name, unit;  // "1" if it has none
};

// The reason why this cannot be the name of a column; "" if it can.
std::string history_name_problem(const std::string& name);

// The time of the last row of a history, s; nothing if the file has none.
std::optional<double> last_time_of_history(const std::filesystem::path& file);

// Collective; rank 0 writes.
class HistoryFile {
 public:
  // Replaces a file of that name, or continues after its first `bytes`, which must have the checksum `sum`, and after
  // the row that follows there, if it is of the time `uncounted`, s. Throws Error on all ranks if the file cannot be
  // created, if another run writes to it, if a name contains a comma, a quote or a line break, or if the file is
  // shorter or has other columns or rows.
  HistoryFile(const std::filesystem::path& path, const Communicator& communicator,
              const std::vector<HistoryColumn>& columns, std::int64_t bytes = 0, double sum = 0,
              std::optional<double> uncounted = {});

  // Writes and flushes rank 0's row; the other ranks' rows are ignored. Throws Error on all ranks if the row does not
  // have one value per column, or if the disk is full.
  void write(std::span<const double> row);

  std::vector<double> rows() const;  // collective: all values so far, row by row, on all ranks

  std::int64_t bytes() const { return bytes_; }  // written so far, on rank 0
  double sum() const { return sum_.value(); }    // their checksum
  void sync() const;                             // collective: forces the rows to the disk

 private:
  void begin(const std::string& units, const std::string& header);
  void go_on(const std::string& header, double sum, std::optional<double> uncounted);
  void take(std::istream& file);
  void take_row(std::istream& file, double time);
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
