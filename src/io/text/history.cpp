#include "io/text/history.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "base/build_facts.hpp"
#include "base/errors.hpp"
#include "base/files.hpp"

namespace strut::io {

namespace {

void check_names(const std::vector<HistoryColumn>& columns) {
  for (const HistoryColumn& column : columns) {
    if (const std::string problem = history_name_problem(column.name); !problem.empty()) throw Error(problem);
  }
}

std::string joined_of(const std::vector<HistoryColumn>& columns, std::string HistoryColumn::*what) {
  std::vector<std::string> all;
  for (const HistoryColumn& column : columns) all.push_back(column.*what);
  return joined(all, ",");
}

}  // namespace

std::string history_name_problem(const std::string& name) {
  if (!name.empty() && name[0] != '#' && name.find_first_of(",\"\r\n") == std::string::npos) return "";
  return "'" + name +
         "' cannot be the name of a history column: it is empty, begins with # or holds , \" or a line break";
}

std::optional<double> last_time_of_history(const std::filesystem::path& file) {
  std::ifstream history(file);
  std::string line, last;
  if (!std::getline(history, line) || !line.starts_with(history_mark) || !std::getline(history, line)) return {};
  while (std::getline(history, line)) {
    if (!history.eof()) last = line;  // a row without its line break was cut off
  }
  if (last.empty()) return {};
  return std::strtod(last.c_str(), nullptr);
}

HistoryFile::HistoryFile(const std::filesystem::path& path, const Communicator& communicator,
                         const std::vector<HistoryColumn>& columns, std::int64_t bytes, double sum,
                         std::optional<double> uncounted)
    : path_(path), communicator_(communicator), columns_(columns.size()), bytes_(bytes) {
  run_on_root(communicator_, [&] {
    check_names(columns);
    lock_.emplace(path_, bytes_ > 0 ? FileLock::File::there : FileLock::File::made);
    const std::string header = joined_of(columns, &HistoryColumn::name);
    bytes_ > 0 ? go_on(header, sum, uncounted) : begin(joined_of(columns, &HistoryColumn::unit), header);
  });
}

void HistoryFile::begin(const std::string& units, const std::string& header) {
  errno = 0;
  file_.open(path_);
  if (!file_) throw Error(path_.string() + ": cannot create it: " + std::strerror(errno));
  write_line("# " + build_facts() + "; units: " + units);  // begins with history_mark
  write_line(header);
}

void HistoryFile::go_on(const std::string& header, double sum, std::optional<double> uncounted) {
  std::string facts, found;
  std::ifstream before(path_, std::ios::binary);
  if (std::getline(before, facts)) std::getline(before, found);
  const auto wrong = [this](const std::string& what) {
    throw Error(path_.string() + ": is not the history that the run left: it " + what);
  };
  if (std::filesystem::file_size(path_) < static_cast<std::uintmax_t>(bytes_) || !facts.starts_with(history_mark) ||
      found != header) {
    wrong("is shorter, or has other columns");
  }
  take(before.seekg(0));
  if (sum_.value() != sum) wrong("has other rows");
  if (uncounted) take_row(before, *uncounted);
  std::error_code failure;
  std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(bytes_), failure);
  if (!failure) file_.open(path_, std::ios::app);
  if (failure || !file_) throw Error(path_.string() + ": cannot go on with it: " + std::strerror(errno));
}

// Reads the rows that are kept.
void HistoryFile::take(std::istream& file) {
  std::string portion(std::size_t{1} << 16, '\0');
  for (std::int64_t left = bytes_; left > 0 && file; left -= std::ssize(portion)) {
    portion.resize(static_cast<std::size_t>(std::min(left, std::ssize(portion))));
    file.read(portion.data(), std::ssize(portion));
    sum_.add(portion);
  }
}

// Takes the next row, too, if it is of this time, and whole.
void HistoryFile::take_row(std::istream& file, double time) {
  std::string row;
  if (!std::getline(file, row) || file.eof() || std::strtod(row.c_str(), nullptr) != time) return;
  bytes_ += std::ssize(row) + 1;
  sum_.add(row);
  sum_.add("\n");
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
      line += (line.empty() ? "" : ",") + std::string(digits);
    }
    write_line(line);
  });
}

std::vector<double> HistoryFile::rows() const {
  std::vector<double> values;
  run_on_root(communicator_, [&] {
    std::ifstream file(path_);
    std::string line, value;
    for (int n = 0; std::getline(file, line); ++n) {
      std::istringstream cells(n < 2 ? "" : line);  // after the units and the names
      while (std::getline(cells, value, ',')) values.push_back(std::strtod(value.c_str(), nullptr));
    }
  });
  communicator_.broadcast(values);
  return values;
}

void HistoryFile::sync() const {
  run_on_root(communicator_, [this] { force_to_disk(path_); });
}

void HistoryFile::write_line(const std::string& line) {
  errno = 0;
  file_ << line << '\n' << std::flush;
  if (!file_) throw Error(path_.string() + ": cannot write to it: " + std::strerror(errno));
  bytes_ += std::ssize(line) + 1;
  sum_.add(line);
  sum_.add("\n");
}

}  // namespace strut::io
