// The nodes of a mesh become material points, with the parts of the elements around them.
#include <cmath>

#include "base/errors.hpp"
#include "io/elements.hpp"
#include "io/mesh_points.hpp"

namespace strut::io {

namespace {

// What the elements around a node leave at it, in the order of the file.
struct Share {
  double volume = 0;  // m³, the node's parts
  double around = 0;  // m³, of the whole elements
  int elements = 0;
  int block = -1;  // of the first of them
};

class Shares {
 public:
  Shares(const Mesh& mesh, const std::string& file) : mesh_(mesh), file_(file), shares_(mesh.nodes.size()) {}

  std::vector<Share> collect() {
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      const Mesh::Block& block = mesh_.blocks[b];
      if (block.type == "HEX8") add_block<8>(static_cast<int>(b), hexahedron_parts);
      if (block.type == "TET4") add_block<4>(static_cast<int>(b), tetrahedron_parts);
      if (block.type == "SPHERE" && block.elements() > 0) {
        throw Error(file_ + ": block '" + block.name +
                    "' has spheres; points at nodes need hexahedra (HEX8) or tetrahedra (TET4), points at elements "
                    "may be any of the three");
      }
    }
    return std::move(shares_);
  }

 private:
  template <std::size_t size, class Parts>
  void add_block(int index, const Parts& parts_of) {
    // A cube around each node: as many hexahedra as nodes fill a body, but six times as many tetrahedra.
    constexpr double cells = size == 4 ? 6 : 1;
    const Mesh::Block& block = mesh_.blocks[index];
    for (std::size_t e = 0; e < block.elements(); ++e) {
      const std::array<double, size> parts = parts_of(corners<size>(mesh_, block, e));
      double volume = 0;
      for (const double part : parts) volume += part;
      check_volume(volume, block, ++elements_, file_);
      for (std::size_t n = 0; n < size; ++n) {
        Share& share = shares_[block.nodes[e * size + n]];
        share.volume += parts[n];
        share.around += cells * volume;
        ++share.elements;
        if (share.block < 0) share.block = index;
      }
    }
  }

  const Mesh& mesh_;
  const std::string& file_;
  std::vector<Share> shares_;
  std::size_t elements_ = 0;  // so far
};

// A block all of whose nodes belong to blocks before it would be gone without a word.
void check_blocks_have_points(const PointCloud& cloud, const std::string& file) {
  std::vector<char> found(cloud.block_names.size(), 0);
  for (const int block : cloud.blocks) found[block] = 1;
  for (std::size_t b = 0; b < found.size(); ++b) {
    if (found[b]) continue;
    throw Error(
        file + ": block '" + cloud.block_names[b] +
        "' would have no point: all its nodes belong to blocks before it. Put it first in the file, refine it, or "
        "use Points \"Elements\"");
  }
}

}  // namespace

PointCloud points_at_nodes(const Mesh& mesh, const std::vector<std::int64_t>& numbers, const std::string& file) {
  const std::vector<Share> shares = Shares(mesh, file).collect();
  const std::vector<std::uint64_t> sets = sets_of_nodes(mesh);
  PointCloud cloud;
  cloud.at = PointsAt::nodes;
  for (const Mesh::Block& block : mesh.blocks) cloud.block_names.push_back(block.name);
  for (const Mesh::NodeSet& set : mesh.node_sets) cloud.set_names.push_back(set.name);
  for (std::size_t n = 0; n < shares.size(); ++n) {
    const Share& share = shares[n];
    if (share.elements == 0) continue;  // a node of no element
    if (!(share.volume > 0)) {
      throw Error(file + ": node " + std::to_string(numbers[n]) + ": its parts of the elements around it add up to " +
                  std::to_string(share.volume) + " m³, expected a positive volume (elements too distorted?)");
    }
    cloud.ids.push_back(static_cast<std::int64_t>(n));
    cloud.element_ids.push_back(numbers[n]);
    cloud.positions.push_back(mesh.nodes[n]);
    cloud.volumes.push_back(share.volume);
    cloud.spacings.push_back(std::cbrt(share.around / share.elements));
    cloud.blocks.push_back(share.block);
    cloud.sets.push_back(sets[n]);
  }
  check_blocks_have_points(cloud, file);
  return cloud;
}

}  // namespace strut::io
