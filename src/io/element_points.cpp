// The elements of a mesh become material points.
#include <cmath>
#include <numeric>

#include "base/errors.hpp"
#include "io/elements.hpp"
#include "io/mesh_points.hpp"

namespace strut::io {

namespace {

ElementPoint point_of(const Mesh& mesh, const Mesh::Block& block, std::size_t element) {
  if (block.type == "HEX8") return hexahedron(corners<8>(mesh, block, element));
  if (block.type == "TET4") return tetrahedron(corners<4>(mesh, block, element));
  return {mesh.nodes[block.nodes[element]], block.volumes[element]};
}

// The whole mesh as one cloud.
class Converter {
 public:
  Converter(const Mesh& mesh, const std::string& file) : mesh_(mesh), file_(file), node_sets_(sets_of_nodes(mesh)) {}

  PointCloud convert() {
    for (const Mesh::NodeSet& set : mesh_.node_sets) cloud_.set_names.push_back(set.name);
    for (const Mesh::Block& block : mesh_.blocks) add_block(block);
    cloud_.ids.resize(cloud_.volumes.size());
    std::iota(cloud_.ids.begin(), cloud_.ids.end(), 0);
    return std::move(cloud_);
  }

 private:
  void add_block(const Mesh::Block& block) {
    cloud_.block_names.push_back(block.name);
    const std::size_t elements = block.elements();
    for (std::size_t e = 0; e < elements; ++e) {
      std::uint64_t sets = 0;
      const std::size_t size = block.nodes.size() / elements;
      for (std::size_t n = e * size; n < (e + 1) * size; ++n) sets |= node_sets_[block.nodes[n]];
      const ElementPoint point = point_of(mesh_, block, e);
      check_volume(point.volume, block, cloud_.volumes.size() + 1, file_);
      add_point(point, sets);
    }
  }

  void add_point(const ElementPoint& point, std::uint64_t sets) {
    cloud_.positions.push_back(point.centroid);
    cloud_.volumes.push_back(point.volume);
    cloud_.spacings.push_back(std::cbrt(point.volume));
    cloud_.blocks.push_back(static_cast<int>(cloud_.block_names.size()) - 1);
    cloud_.sets.push_back(sets);
  }

  const Mesh& mesh_;
  const std::string& file_;
  PointCloud cloud_;
  std::vector<std::uint64_t> node_sets_;
};

}  // namespace

PointCloud points_at_elements(const Mesh& mesh, const std::string& file) { return Converter(mesh, file).convert(); }

std::vector<std::uint64_t> sets_of_nodes(const Mesh& mesh) {
  std::vector<std::uint64_t> sets(mesh.nodes.size(), 0);
  for (std::size_t k = 0; k < mesh.node_sets.size(); ++k) {
    for (const int node : mesh.node_sets[k].nodes) sets[node] |= std::uint64_t{1} << k;
  }
  return sets;
}

void check_volume(double volume, const Mesh::Block& block, std::size_t number, const std::string& file) {
  if (volume > 0 && std::isfinite(volume)) return;
  throw Error(file + ": block '" + block.name + "', element " + std::to_string(number) + ": volume " +
              std::to_string(volume) + " m³, expected a positive one (inside out, flat or damaged?)");
}

}  // namespace strut::io
