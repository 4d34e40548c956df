#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

#include "base/communicator.hpp"
#include "base/errors.hpp"
#include "io/distribute.hpp"
#include "io/elements.hpp"
#include "io/exodus.hpp"
#include "io/exodus_file.hpp"

namespace strut::io {

namespace {

constexpr std::size_t most_sets = 64;  // one bit each

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

// "HEX8", "hex", "HEXAHEDRON": codes spell the types as they like.
bool is_type(const ExodusFile::Block& block, const std::string& start, std::int64_t nodes) {
  return upper(block.type).starts_with(start) && block.nodes_per_element == nodes;
}

// Reads a whole file into one cloud.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : file_(ExodusFile::open(path)) {}

  PointCloud read() {
    check_sizes();
    read_nodes();
    read_sets();
    const std::vector<ExodusFile::Block> blocks = file_.blocks();
    for (const ExodusFile::Block& block : blocks) read_block(block);
    const auto elements = static_cast<std::int64_t>(cloud_.volumes.size());
    if (elements != file_.sizes().elements) fail("its blocks do not hold the number of elements that it states");
    cloud_.element_ids = file_.element_numbers();
    cloud_.ids.resize(cloud_.volumes.size());
    std::iota(cloud_.ids.begin(), cloud_.ids.end(), 0);
    return std::move(cloud_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(file_.path().string() + ": " + what); }

  void check_sizes() const {
    const ExodusFile::Sizes sizes = file_.sizes();
    if (sizes.dimensions != 3) fail("the mesh has " + std::to_string(sizes.dimensions) + " dimensions, expected 3");
    if (sizes.elements < 1 || sizes.blocks < 1) fail("the mesh has no elements");
  }

  void read_nodes() {
    const auto x = file_.coordinates();
    nodes_.reserve(x[0].size());
    for (std::size_t n = 0; n < x[0].size(); ++n) {
      nodes_.emplace_back(x[0][n], x[1][n], x[2][n]);
      if (!nodes_.back().allFinite()) fail("node " + std::to_string(n + 1) + ": a coordinate is not a finite number");
    }
  }

  std::size_t node_index(std::int64_t number, const std::string& user) const {
    if (number < 1 || number > static_cast<std::int64_t>(nodes_.size())) {
      fail(user + " refers to node " + std::to_string(number) + " of " + std::to_string(nodes_.size()) +
           " (damaged file?)");
    }
    return static_cast<std::size_t>(number - 1);
  }

  void read_sets() {
    const std::vector<ExodusFile::NodeSet> sets = file_.node_sets();
    if (sets.size() > most_sets) {
      fail(std::to_string(sets.size()) + " node sets, at most " + std::to_string(most_sets) + " are supported");
    }
    node_sets_.assign(nodes_.size(), 0);
    for (std::size_t k = 0; k < sets.size(); ++k) {
      cloud_.set_names.push_back(sets[k].name.empty() ? "nodelist_" + std::to_string(sets[k].id) : sets[k].name);
      const std::string user = "node set '" + cloud_.set_names.back() + "'";
      for (const std::int64_t node : file_.nodes_of(sets[k]))
        node_sets_[node_index(node, user)] |= std::uint64_t{1} << k;
    }
  }

  void read_block(const ExodusFile::Block& block) {
    const std::string name = block.name.empty() ? "block_" + std::to_string(block.id) : block.name;
    cloud_.block_names.push_back(name);
    if (block.elements == 0) return;
    if (is_type(block, "HEX", 8)) {
      read_elements<8>(block, [](auto nodes, std::size_t) { return hexahedron(nodes); });
    } else if (is_type(block, "TET", 4)) {
      read_elements<4>(block, [](auto nodes, std::size_t) { return tetrahedron(nodes); });
    } else if (is_type(block, "SPHERE", 1)) {
      const std::vector<double> volumes = sphere_volumes(block);
      read_elements<1>(block, [&](auto nodes, std::size_t e) { return ElementPoint{nodes[0], volumes[e]}; });
    } else {
      fail("block '" + name + "': element type " + block.type + " with " + std::to_string(block.nodes_per_element) +
           " nodes is not supported, expected HEX8, TET4 or SPHERE");
    }
  }

  // `point_of(nodes, e)`: the material point of element e of the block.
  template <std::size_t size, class PointOf>
  void read_elements(const ExodusFile::Block& block, const PointOf& point_of) {
    const std::vector<std::int64_t> connectivity = file_.connectivity(block);
    const std::string user = "block '" + cloud_.block_names.back() + "'";
    for (std::size_t e = 0; e < static_cast<std::size_t>(block.elements); ++e) {
      std::array<Vector, size> nodes;
      std::uint64_t sets = 0;
      for (std::size_t n = 0; n < size; ++n) {
        const std::size_t node = node_index(connectivity[e * size + n], user);
        nodes[n] = nodes_[node];
        sets |= node_sets_[node];
      }
      add_point(point_of(std::span<const Vector, size>(nodes), e), sets);
    }
  }

  void add_point(const ElementPoint& point, std::uint64_t sets) {
    if (!(point.volume > 0) || !std::isfinite(point.volume)) {
      fail("block '" + cloud_.block_names.back() + "', element " + std::to_string(cloud_.volumes.size() + 1) +
           ": volume " + std::to_string(point.volume) + " m³, expected a positive one (inside out, flat or damaged?)");
    }
    cloud_.positions.push_back(point.centroid);
    cloud_.volumes.push_back(point.volume);
    cloud_.blocks.push_back(static_cast<int>(cloud_.block_names.size()) - 1);
    cloud_.sets.push_back(sets);
  }

  // Attributes radius and volume, or the radius alone; results of other codes hold an element variable instead.
  std::vector<double> sphere_volumes(const ExodusFile::Block& block) const {
    if (block.attributes.size() >= 2) return file_.attribute(block, 1);
    if (block.attributes.size() == 1) {
      std::vector<double> values = file_.attribute(block, 0);
      std::transform(values.begin(), values.end(), values.begin(), sphere_volume);
      return values;
    }
    const std::vector<std::string> names = file_.variable_names(ExodusFile::On::elements);
    const auto variable = std::find(names.begin(), names.end(), "Volume");
    if (variable == names.end() || file_.times().empty()) {
      fail("block '" + cloud_.block_names.back() +
           "': its spheres have no volume, expected the attributes radius and volume (or an element variable Volume)");
    }
    const std::vector<double> all = file_.element_values(0, static_cast<int>(variable - names.begin()));
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(cloud_.volumes.size());
    return {begin, begin + block.elements};
  }

  ExodusFile file_;
  PointCloud cloud_;
  std::vector<Vector> nodes_;
  std::vector<std::uint64_t> node_sets_;  // bit k: the node is in set k
};

}  // namespace

PointCloud read_exodus(const std::filesystem::path& file, const Communicator& communicator) {
  PointCloud whole;
  run_on_root(communicator, [&] { whole = Reader(file).read(); });
  return distribute(whole, communicator);
}

}  // namespace strut::io
