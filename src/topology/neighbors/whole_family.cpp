#include "topology/neighbors/whole_family.hpp"

#include <algorithm>

namespace strut {

std::size_t largest_whole_family(const Domain& domain) {
  std::size_t most = 0;
  for (int i = 0; i < domain.owned; ++i) {
    most = std::max(most, domain.families.size(i) + domain.families.broken[i].size());
  }
  return static_cast<std::size_t>(domain.communicator.max(static_cast<double>(most)));
}

}  // namespace strut
