#include "deck/sections/written_files.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "deck/problems.hpp"

namespace strut::deck {

namespace {

namespace fs = std::filesystem;

bool same(const fs::path& one, const fs::path& other) {
  std::error_code failure;
  if (fs::equivalent(one, other, failure)) return true;
  failure.clear();
  const fs::path a = fs::weakly_canonical(one, failure), b = fs::weakly_canonical(other, failure);
  return !failure && !a.empty() && a == b;
}

// Why the file cannot be written, or nothing.
std::string obstacle(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code failure;
  if (!fs::is_directory(folder, failure)) return "there is no folder '" + folder.string() + "'";
  const fs::path asked = fs::exists(file, failure) ? file : folder;
  return access(asked.c_str(), W_OK) == 0 ? "" : "'" + asked.string() + "': " + std::strerror(errno);
}

void check_replaceable(const WrittenFile& written, const std::vector<ReadFile>& read, Problems& problems) {
  const std::string expected = "; expected a file that may be replaced";
  for (const ReadFile& one : read) {
    if (!same(written.file, one.file)) continue;
    return problems.add(written.path, "'" + written.file.string() + "' is " + one.what + expected);
  }
  std::error_code failure;
  const fs::file_status status = fs::status(written.file, failure);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return problems.add(written.path, "'" + written.file.string() + "' is a folder or a device" + expected);
  }
  const std::string why_not = obstacle(written.file);
  if (!why_not.empty()) problems.add(written.path, "'" + written.file.string() + "': cannot create it: " + why_not);
}

}  // namespace

void check_files(const std::vector<WrittenFile>& written, const std::vector<ReadFile>& read, Problems& problems) {
  for (const WrittenFile& one : written) check_replaceable(one, read, problems);
  for (auto one = written.begin(); one != written.end(); ++one) {
    for (auto other = written.begin(); other != one; ++other) {
      if (!same(one->file, other->file)) continue;
      problems.add(one->path, "'" + one->file.string() + "' is " + other->owner + "'s file, too; expected another");
    }
  }
}

}  // namespace strut::deck
