// The elements of a file become material points.
#include <array>
#include <cmath>
#include <numeric>

#include "base/communicator.hpp"
#include "base/errors.hpp"
#include "io/distribute.hpp"
#include "io/elements.hpp"
#include "io/exodus.hpp"
#include "io/exodus_file.hpp"
#include "io/mesh_read.hpp"

namespace strut::io {

namespace {

constexpr std::size_t most_sets = 64;  // one bit each

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw Error(path.string() + ": " + what);
}

// Bit k of a node: it is in set k.
std::vector<std::uint64_t> sets_of_nodes(const Mesh& mesh) {
  std::vector<std::uint64_t> sets(mesh.nodes.size(), 0);
  for (std::size_t k = 0; k < mesh.node_sets.size(); ++k) {
    for (const int node : mesh.node_sets[k].nodes) sets[node] |= std::uint64_t{1} << k;
  }
  return sets;
}

template <std::size_t size>
std::array<Vector, size> corners(const Mesh& mesh, const Mesh::Block& block, std::size_t element) {
  std::array<Vector, size> nodes;
  for (std::size_t n = 0; n < size; ++n) nodes[n] = mesh.nodes[block.nodes[element * size + n]];
  return nodes;
}

ElementPoint point_of(const Mesh& mesh, const Mesh::Block& block, std::size_t element) {
  if (block.type == "HEX8") return hexahedron(corners<8>(mesh, block, element));
  if (block.type == "TET4") return tetrahedron(corners<4>(mesh, block, element));
  return {mesh.nodes[block.nodes[element]], block.volumes[element]};
}

// The whole mesh as one cloud.
class Converter {
 public:
  Converter(const std::filesystem::path& path, const Mesh& mesh)
      : path_(path), mesh_(mesh), node_sets_(sets_of_nodes(mesh)) {}

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
      add_point(point_of(mesh_, block, e), sets);
    }
  }

  void add_point(const ElementPoint& point, std::uint64_t sets) {
    if (!(point.volume > 0) || !std::isfinite(point.volume)) {
      fail(path_, "block '" + cloud_.block_names.back() + "', element " + std::to_string(cloud_.volumes.size() + 1) +
                      ": volume " + std::to_string(point.volume) +
                      " m³, expected a positive one (inside out, flat or damaged?)");
    }
    cloud_.positions.push_back(point.centroid);
    cloud_.volumes.push_back(point.volume);
    cloud_.blocks.push_back(static_cast<int>(cloud_.block_names.size()) - 1);
    cloud_.sets.push_back(sets);
  }

  const std::filesystem::path& path_;
  const Mesh& mesh_;
  PointCloud cloud_;
  std::vector<std::uint64_t> node_sets_;
};

PointCloud read_cloud(const std::filesystem::path& path) {
  const ExodusFile file = ExodusFile::open(path);
  const std::size_t sets = file.node_sets().size();
  if (sets > most_sets) {
    fail(path, std::to_string(sets) + " node sets, at most " + std::to_string(most_sets) + " are supported");
  }
  PointCloud cloud = Converter(path, mesh_of(file)).convert();
  cloud.element_ids = file.element_numbers();
  return cloud;
}

}  // namespace

PointCloud read_exodus(const std::filesystem::path& file, const Communicator& communicator) {
  PointCloud whole;
  run_on_root(communicator, [&] { whole = read_cloud(file); });
  return distribute(whole, communicator);
}

}  // namespace strut::io
