#include "deck/files.hpp"

#include <map>

#include "base/errors.hpp"
#include "base/math/table_files.hpp"

namespace strut::deck {

namespace {

// The paths of the keys that name each file.
using Users = std::map<std::string, std::vector<std::string>>;

void find_users(const List& list, const std::string& path, Users& users) {
  for (const Parameter& parameter : list.parameters) {
    for (const std::string& name : table_files(parameter.value)) users[name].push_back(path_to(path, parameter.name));
  }
  for (const List& section : list.lists) find_users(section, path_to(path, section.name), users);
}

// The reason why the file cannot be written, in view of the other written files; or nothing.
std::string problem_of(const WrittenFile& written, const std::vector<ReadFile>& read) {
  for (const ReadFile& one : read) {
    if (!same_file(written.file, one.file)) continue;
    return "'" + written.file.string() + "' is " + one.what + "; expected a file that may be replaced";
  }
  return obstacle(written.file, written.kind);
}

}  // namespace

std::vector<std::filesystem::path> fill_tables(std::string& text, const List& list, const std::filesystem::path& folder,
                                               Problems& problems) {
  Users users;
  find_users(list, "", users);
  std::vector<std::filesystem::path> files;
  for (const auto& [name, paths] : users) {
    files.push_back(folder / name);
    std::string numbers = "0, 0";  // after a problem: what else is wrong can be told
    try {
      numbers = numbers_in_table(files.back());
    } catch (const Error& error) {
      for (const std::string& path : paths) problems.add(path, error.what());
    }
    text = with_table(text, name, numbers);
  }
  return files;
}

void check_files(const std::vector<WrittenFile>& written, const std::vector<ReadFile>& read, Problems& problems) {
  std::string reported;  // the path with the last reported problem: one for each is enough
  for (const WrittenFile& one : written) {
    const std::string problem = one.path == reported ? "" : problem_of(one, read);
    if (problem.empty()) continue;
    problems.add(one.path, problem);
    reported = one.path;
  }
  for (auto one = written.begin(); one != written.end(); ++one) {
    for (auto other = written.begin(); other != one; ++other) {
      if (!same_file(one->file, other->file)) continue;
      problems.add(one->path, "'" + one->file.string() + "' is " + other->owner + "'s file, too; expected another");
    }
  }
}

}  // namespace strut::deck
