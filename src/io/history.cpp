#include "io/history.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/errors.hpp"

namespace strut::io {

namespace {

void check_names(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (name.empty() || name.find_first_of(",\"\r\n") != std::string::npos) {
      throw Error("'" + name + "' cannot be the name of a history column: it is empty or holds , \" or a line break");
    }
  }
}

}  // namespace

HistoryFile::HistoryFile(const std::filesystem::path& path, const Communicator& communicator,
                         std::vector<std::string> column_names)
    : path_(path), communicator_(communicator), columns_(column_names.size()) {
  run_on_root(communicator_, [&] {
    check_names(column_names);
    errno = 0;
    file_.open(path_);
    if (!file_) throw Error(path_.string() + ": cannot create it: " + std::strerror(errno));
    write_line(joined(column_names, ","));
  });
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
      if (!line.empty()) line += ',';
      line += digits;
    }
    write_line(line);
  });
}

void HistoryFile::write_line(const std::string& line) {
  errno = 0;
  file_ << line << '\n' << std::flush;
  if (!file_) throw Error(path_.string() + ": cannot write to it: " + std::strerror(errno));
}

}  // namespace strut::io
