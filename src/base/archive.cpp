#include "base/archive.hpp"

#include <algorithm>
#include <stdexcept>

namespace strut {

namespace {

template <class Named>
auto find(Named& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&name](const auto& one) { return one.name == name; });
  return found;
}

[[noreturn]] void missing(const std::string& name) {
  throw std::logic_error("a snapshot that is restored has no '" + name + "'");
}

}  // namespace

void Archive::points(const std::string& group, const std::vector<std::int64_t>& ids) {
  auto found = find(snapshot_.groups, group);
  if (found == snapshot_.groups.end()) {
    if (restores_) missing(group);
    found = snapshot_.groups.insert(found, {group, ids, {}});
  }
  group_ = static_cast<std::size_t>(found - snapshot_.groups.begin());
}

Snapshot::Column& Archive::column(const std::string& name, int width) {
  Snapshot::Group& group = snapshot_.groups.at(group_);
  if (!restores_) {
    group.columns.push_back({name, width, std::vector<double>(group.ids.size() * static_cast<std::size_t>(width))});
    return group.columns.back();
  }
  const auto found = find(group.columns, name);
  if (found == group.columns.end()) missing(group.name + " > " + name);
  return *found;
}

double& Archive::entry(std::map<std::string, double>& entries, const std::string& name) const {
  if (!restores_) return entries[name];
  const auto found = entries.find(name);
  if (found == entries.end()) missing(name);
  return found->second;
}

}  // namespace strut
