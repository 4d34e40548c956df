#include "deck/sections/written_files.hpp"

#include "deck/problems.hpp"

namespace strut::deck {

namespace {

// The reason why the file cannot be written, in view of the other written files; or nothing.
std::string problem_of(const WrittenFile& written, const std::vector<ReadFile>& read) {
  for (const ReadFile& one : read) {
    if (!same_file(written.file, one.file)) continue;
    return "'" + written.file.string() + "' is " + one.what + "; expected a file that may be replaced";
  }
  return obstacle(written.file, written.kind);
}

}  // namespace

void check_files(const std::vector<WrittenFile>& written, const std::vector<ReadFile>& read, Problems& problems) {
  std::string told;  // the path with the last reported problem: one for each is enough
  for (const WrittenFile& one : written) {
    const std::string problem = one.path == told ? "" : problem_of(one, read);
    if (problem.empty()) continue;
    problems.add(one.path, problem);
    told = one.path;
  }
  for (auto one = written.begin(); one != written.end(); ++one) {
    for (auto other = written.begin(); other != one; ++other) {
      if (!same_file(one->file, other->file)) continue;
      problems.add(one->path, "'" + one->file.string() + "' is " + other->owner + "'s file, too; expected another");
    }
  }
}

}  // namespace strut::deck
