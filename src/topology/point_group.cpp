#include "topology/point_group.hpp"

#include <algorithm>

#include "base/errors.hpp"

namespace strut {

PointGroup::PointGroup(const PointCloud& cloud, const std::string& name, const std::string& path) {
  if (name == "all") return;
  const auto place = [&name](const std::vector<std::string>& names) {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
  };
  set_ = place(cloud.set_names), block_ = place(cloud.block_names);
  if (set_ >= 0 && block_ >= 0) {
    throw Error(path + ": '" + name + "' is a node set and a block; expected a name that is one of them");
  }
  if (set_ >= 0 || block_ >= 0) return;
  std::vector<std::string> valid{"all"};
  valid.insert(valid.end(), cloud.set_names.begin(), cloud.set_names.end());
  valid.insert(valid.end(), cloud.block_names.begin(), cloud.block_names.end());
  throw Error(path + ": there is no node set or block '" + name + "'" + did_you_mean(name, valid) + "; there are " +
              joined(valid));
}

std::vector<int> PointGroup::points(const PointCloud& cloud) const {
  std::vector<int> points;
  for (int i = 0; i < static_cast<int>(cloud.size()); ++i) {
    if (counts(cloud, i)) points.push_back(i);
  }
  return points;
}

}  // namespace strut
