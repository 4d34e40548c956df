// Differences between Peridigm's reader of decks and ours.
#include <algorithm>
#include <functional>
#include <set>

#include "base/numbers.hpp"
#include "deck/peridigm/peridigm.hpp"

namespace strut::deck {

namespace {

namespace fs = std::filesystem;

// Teuchos keeps the last of several parameters with one name.
void keep_last_of_doubles(List& list, const std::string& path, Problems& problems) {
  for (List& one : list.lists) keep_last_of_doubles(one, path_to(path, one.name), problems);
  std::set<std::string> seen, reported;
  std::vector<Parameter> kept;
  for (auto one = list.parameters.rbegin(); one != list.parameters.rend(); ++one) {
    if (seen.insert(one->name).second) {
      kept.push_back(*one);
    } else if (reported.insert(one->name).second) {
      problems.note(path_to(path, one->name), "is given more than once: the last one counts, as in Peridigm");
    }
  }
  std::reverse(kept.begin(), kept.end());
  list.parameters = kept;
}

// Teuchos' and muParser's readers want \{ for a brace.
void take_braces(List& list) {
  for (List& one : list.lists) take_braces(one);
  for (Parameter& one : list.parameters) {
    for (const char* brace : {"\\{", "\\}"}) {
      for (std::size_t at; (at = one.value.find(brace)) != std::string::npos;) one.value.erase(at, 1);
    }
  }
}

// A file of the working folder, where the deck's folder has none of this name.
void look_in_working_folder(Parameter& file, const std::string& path, const fs::path& folder, Problems& problems) {
  std::error_code ignored;
  if (file.value.empty() || !fs::is_regular_file(fs::absolute(file.value), ignored) ||
      fs::exists(folder / file.value, ignored))
    return;
  problems.note(path, "is that of the working folder, as in Peridigm: the deck's folder has no '" + file.value + "'");
  file.value = fs::absolute(file.value).string();
}

void look_in_working_folder(List& deck, const fs::path& folder, Problems& problems) {
  List *mesh = find_list(deck, "Discretization"), *conditions = find_list(deck, "Boundary Conditions");
  Parameter* file = mesh ? find_parameter(*mesh, "Input Mesh File") : nullptr;
  if (file) look_in_working_folder(*file, "Discretization > Input Mesh File", folder, problems);
  for (List& filter : sections_of(deck, {"Discretization", "Bond Filters"})) {
    Parameter* shells = find_parameter(filter, "File Name");
    const std::string path = "Discretization > Bond Filters > " + filter.name + " > File Name";
    if (shells) look_in_working_folder(*shells, path, folder, problems);
  }
  if (!conditions) return;
  for (Parameter& set : conditions->parameters) {
    if (set.name.find("Node Set") == std::string::npos) continue;
    look_in_working_folder(set, "Boundary Conditions > " + set.name, folder, problems);
  }
}

}  // namespace

void read_as_peridigm(List& deck, const fs::path& folder, Problems& problems) {
  keep_last_of_doubles(deck, "", problems);
  take_braces(deck);
  look_in_working_folder(deck, folder, problems);
}

}  // namespace strut::deck
