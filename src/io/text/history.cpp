#include "io/text/history.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/build_facts.hpp"
#include "base/errors.hpp"
#include "io/to_disk.hpp"

namespace strut::io {

namespace {

void check_names(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (name.empty() || name.find_first_of(",\"\r\n") != std::string::npos) {
      throw Error("'" + name + "' cannot be the name of a history column: it is empty or holds , \" or a line break");
    }
  }
}

// Who wrote the file is told by the name of a column of zeros: every reader of tables takes that, and hardly any a
// comment.
std::string last_column() {
  std::string name = build_facts();
  std::replace(name.begin(), name.end(), ',', ';');
  std::erase(name, '"');
  return name;
}

}  // namespace

HistoryFile::HistoryFile(const std::filesystem::path& path, const Communicator& communicator,
                         std::vector<std::string> column_names, std::int64_t bytes)
    : path_(path), communicator_(communicator), columns_(column_names.size()), bytes_(bytes) {
  run_on_root(communicator_, [&] {
    check_names(column_names);
    lock_.emplace(path_, bytes_ > 0 ? FileLock::File::there : FileLock::File::made);
    const std::string header = joined(column_names, ",");
    bytes_ > 0 ? go_on(header) : begin(header);
  });
}

void HistoryFile::begin(const std::string& header) {
  errno = 0;
  file_.open(path_);
  if (!file_) throw Error(path_.string() + ": cannot create it: " + std::strerror(errno));
  write_line(header + "," + last_column());
}

void HistoryFile::go_on(const std::string& header) {
  std::string found;
  std::getline(std::ifstream(path_), found);
  if (std::filesystem::file_size(path_) < static_cast<std::uintmax_t>(bytes_) ||
      !found.starts_with(header + ",strut")) {
    throw Error(path_.string() + ": is not the history that the run left: it is shorter, or has other columns");
  }
  std::error_code failure;
  std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(bytes_), failure);
  if (!failure) file_.open(path_, std::ios::app);
  if (failure || !file_) throw Error(path_.string() + ": cannot go on with it: " + std::strerror(errno));
}

void HistoryFile::write(std::span<const double> row) {
  run_on_root(communicator_, [&] {
    if (row.size() != columns_) {
      throw Error(path_.string() + ": a row of " + std::to_string(row.size()) + " values for " +
                  std::to_string(columns_) + " columns");
    }
    std::string line;
    for (const double value : row) {
      char digits[32];
      std::snprintf(digits, sizeof digits, "%.17g", value);
      line += digits;
      line += ',';
    }
    write_line(line + "0");
  });
}

void HistoryFile::sync() const {
  run_on_root(communicator_, [this] { force_to_disk(path_); });
}

void HistoryFile::write_line(const std::string& line) {
  errno = 0;
  file_ << line << '\n' << std::flush;
  if (!file_) throw Error(path_.string() + ": cannot write to it: " + std::strerror(errno));
  bytes_ += std::ssize(line) + 1;
}

}  // namespace strut::io
