// A file's mesh to memory: all indices within range, coordinates finite.
#include "io/exodus/mesh_read.hpp"

#include <algorithm>
#include <cctype>
#include <limits>

#include "base/errors.hpp"
#include "io/exodus/elements.hpp"
#include "io/netcdf/trial_read.hpp"

namespace strut::io {

namespace {

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

// "HEX8", "hex", "HEXAHEDRON": codes spell the types as they like. "" for a type that is not supported.
std::string type_of(const ExodusFile::Block& block) {
  const std::string type = upper(block.type);
  if (type.starts_with("HEX") && block.nodes_per_element == 8) return "HEX8";
  if (type.starts_with("TET") && block.nodes_per_element == 4) return "TET4";
  if (type.starts_with("SPHERE") && block.nodes_per_element == 1) return "SPHERE";
  return "";
}

class Reader {
 public:
  explicit Reader(const ExodusFile& file) : file_(file) {}

  Mesh read() {
    check_sizes();
    read_nodes();
    read_sets();
    const std::vector<ExodusFile::Block> blocks = file_.blocks();
    std::int64_t elements = 0;
    for (const ExodusFile::Block& block : blocks) elements += block.elements;
    if (elements != file_.sizes().elements) fail("its blocks do not hold the number of elements that it states");
    for (const ExodusFile::Block& block : blocks) read_block(block);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(file_.path().string() + ": " + what); }

  void check_sizes() const {
    const ExodusFile::Sizes sizes = file_.sizes();
    if (sizes.dimensions != 3) fail("the mesh has " + std::to_string(sizes.dimensions) + " dimensions, expected 3");
    if (sizes.elements < 1 || sizes.blocks < 1) fail("the mesh has no elements");
    if (sizes.nodes > std::numeric_limits<int>::max()) fail("more than 2·10⁹ nodes are not supported");
  }

  void read_nodes() {
    const auto x = file_.coordinates(0, file_.sizes().nodes);
    mesh_.nodes.reserve(x[0].size());
    for (std::size_t n = 0; n < x[0].size(); ++n) {
      mesh_.nodes.emplace_back(x[0][n], x[1][n], x[2][n]);
      if (!mesh_.nodes.back().allFinite()) {
        fail("node " + std::to_string(n + 1) + ": a coordinate is not a finite number");
      }
    }
  }

  std::vector<int> indices(const std::vector<std::int64_t>& numbers, const std::string& user) const {
    std::vector<int> nodes;
    nodes.reserve(numbers.size());
    for (const std::int64_t number : numbers) {
      if (number < 1 || number > std::ssize(mesh_.nodes)) {
        fail(user + " refers to node " + std::to_string(number) + " of " + std::to_string(mesh_.nodes.size()) +
             " (damaged file?)");
      }
      nodes.push_back(static_cast<int>(number - 1));
    }
    return nodes;
  }

  void read_sets() {
    for (const ExodusFile::NodeSet& set : file_.node_sets()) {
      const std::string name = set.name.empty() ? "nodelist_" + std::to_string(set.id) : set.name;
      mesh_.node_sets.push_back({name, indices(file_.nodes_of(set, 0, set.nodes), "node set '" + name + "'")});
    }
  }

  void read_block(const ExodusFile::Block& block) {
    const std::string name = block.name.empty() ? "block_" + std::to_string(block.id) : block.name;
    const std::string type = type_of(block);
    if (type.empty() && block.elements > 0) {
      fail("block '" + name + "': element type " + block.type + " with " + std::to_string(block.nodes_per_element) +
           " nodes is not supported, expected HEX8, TET4 or SPHERE");
    }
    mesh_.blocks.push_back({name, type.empty() ? "SPHERE" : type, {}, {}, {}});
    if (block.elements == 0) return;
    mesh_.blocks.back().nodes = indices(file_.connectivity(block, 0, block.elements), "block '" + name + "'");
    if (type == "SPHERE") mesh_.blocks.back().volumes = sphere_volumes(block);
    if (type == "HEX8") mesh_.blocks.back().cells = partial_cells(block);
    elements_ += block.elements;
  }

  // None where not all of their attributes are there: other codes have attributes of their own.
  std::vector<PartialCell> partial_cells(const ExodusFile::Block& block) const {
    std::vector<int> columns;
    for (const char* name : partial_cell_attributes) {
      const auto found = std::find(block.attributes.begin(), block.attributes.end(), name);
      if (found == block.attributes.end()) return {};
      columns.push_back(static_cast<int>(found - block.attributes.begin()));
    }
    std::vector<PartialCell> cells(block.elements);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::vector<double> values = file_.attribute(block, columns[k], 0, block.elements);
      for (std::size_t e = 0; e < cells.size(); ++e) member(cells[e], k) = values[e];
    }
    return cells;
  }

  // Attributes radius and volume, or the radius alone; results of other codes hold an element variable instead.
  std::vector<double> sphere_volumes(const ExodusFile::Block& block) const {
    if (block.attributes.size() >= 2) return file_.attribute(block, 1, 0, block.elements);
    if (block.attributes.size() == 1) {
      std::vector<double> values = file_.attribute(block, 0, 0, block.elements);
      std::transform(values.begin(), values.end(), values.begin(), sphere_volume);
      return values;
    }
    const std::vector<std::string> names = file_.variable_names(ExodusFile::On::elements);
    const auto variable = std::find(names.begin(), names.end(), "Volume");
    if (variable == names.end() || file_.times().empty()) {
      fail("block '" + mesh_.blocks.back().name +
           "': its spheres have no volume, expected the attributes radius and volume (or an element variable Volume)");
    }
    const std::vector<double> all = file_.element_values(0, static_cast<int>(variable - names.begin()));
    return {all.begin() + elements_, all.begin() + elements_ + block.elements};
  }

  const ExodusFile& file_;
  Mesh mesh_;
  std::int64_t elements_ = 0;  // of the blocks before
};

}  // namespace

double& member(PartialCell& cell, std::size_t attribute) {
  if (attribute == 0) return cell.volume;
  if (attribute < 4) return cell.centroid[static_cast<int>(attribute) - 1];
  if (attribute < 10) return cell.moments[static_cast<int>(attribute) - 4];
  const int number = static_cast<int>(attribute) - 10;
  if (number < 3) return cell.surface[number];
  return cell.surface_moments((number - 3) / 3, (number - 3) % 3);
}

Mesh mesh_of(const ExodusFile& file) { return Reader(file).read(); }

Mesh read_mesh(const std::filesystem::path& file) {
  return read_after_trial(file, [&] { return mesh_of(ExodusFile::open(file)); });
}

}  // namespace strut::io
