#include "advice/mesh_nodes.hpp"

#include <algorithm>

#include "topology/pieces.hpp"

namespace strut {

MeshNodes::MeshNodes(const Domain& domain) : is_image_(domain.sites.size(), 0) {
  const auto& shared = domain.cloud.shared_nodes;
  double most = 0;
  for (const std::vector<std::int64_t>& nodes : shared) most = std::max(most, static_cast<double>(nodes.size()));
  nodes_.resize(static_cast<std::size_t>(domain.communicator.max(most)));
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    nodes_[k].assign(domain.sites.size(), none);
    for (int i = 0; i < domain.owned && !shared.empty(); ++i)
      if (k < shared[i].size()) nodes_[k][i] = shared[i][k];
    domain.halo.exchange(nodes_[k]);
  }
  for (const ImagePoint& image : domain.halo.images()) is_image_[image.ghost] = 1;
}

bool MeshNodes::has(int i, std::int64_t node) const {
  return std::ranges::any_of(nodes_, [&](const std::vector<std::int64_t>& column) { return column[i] == node; });
}

bool MeshNodes::may_join(int i, int j) const {
  if (!of_both(i, j) || is_image_[i] != 0 || is_image_[j] != 0) return true;
  for (const std::vector<std::int64_t>& column : nodes_) {
    if (column[i] == none) return false;
    if (has(j, column[i])) return true;
  }
  return false;
}

std::vector<std::int64_t> MeshNodes::parts(const Domain& domain) const {
  return piece_ids(domain, [this](int i, int j) { return may_join(i, j); });
}

}  // namespace strut
