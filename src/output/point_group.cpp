#include "output/point_group.hpp"

#include <algorithm>
#include <vector>

#include "base/errors.hpp"

namespace strut {

PointGroup::PointGroup(const PointCloud& cloud, const std::string& name, const std::string& path) {
  const auto place = [&name](const std::vector<std::string>& names) {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
  };
  set_ = place(cloud.set_names);
  if (set_ >= 0) return;
  block_ = place(cloud.block_names);
  if (block_ >= 0) return;
  std::vector<std::string> valid = cloud.set_names;
  valid.insert(valid.end(), cloud.block_names.begin(), cloud.block_names.end());
  throw Error(path + ": there is no node set or block '" + name + "'" + did_you_mean(name, valid) + "; there are " +
              joined(valid));
}

std::int64_t PointGroup::points(const PointCloud& cloud) const {
  std::int64_t count = 0;
  for (int i = 0; i < static_cast<int>(cloud.size()); ++i) count += counts(cloud, i);
  return count;
}

}  // namespace strut
