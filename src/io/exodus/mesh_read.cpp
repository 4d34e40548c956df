#include "io/exodus/mesh_read.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/errors.hpp"
#include "base/numbers.hpp"
#include "io/exodus/elements.hpp"
#include "io/exodus/exodus_words.hpp"

namespace strut::io {

namespace {

// "HEX8", "hex", "HEXAHEDRON": the spelling of types depends on the code. "" for an unsupported type.
std::string type_of(const ExodusFile::Block& block) {
  const std::string type = upper(block.type);
  if (type.starts_with("HEX") && block.nodes_per_element == 8) return "HEX8";
  if (type.starts_with("TET") && block.nodes_per_element == 4) return "TET4";
  if (type.starts_with("SPHERE") && block.nodes_per_element == 1) return "SPHERE";
  return "";
}

// The index of the attribute with a name such as "Volume", "SPHERE_VOLUME", "radius". The name alone comes before one
// that ends with it, which may be another quantity ("free_volume").
std::optional<int> attribute_of(const ExodusFile::Block& block, const std::string& wanted) {
  for (std::size_t k = 0; k < block.attributes.size(); ++k) {
    if (upper(block.attributes[k]) == wanted) return static_cast<int>(k);
  }
  for (std::size_t k = 0; k < block.attributes.size(); ++k) {
    if (upper(block.attributes[k]).ends_with(wanted)) return static_cast<int>(k);
  }
  return std::nullopt;
}

// Indices of the attributes of partial cells. Empty if some are missing: other codes have attributes of their own, but
// no moments. `missing`: the first missing one, if a block has some moments.
std::vector<int> cell_columns(const ExodusFile::Block& block, std::string& missing) {
  std::vector<int> columns;
  bool has_moments = false;
  for (const std::string& name : partial_cell_attributes) {
    const auto found = std::find(block.attributes.begin(), block.attributes.end(), name);
    const bool is_there = found != block.attributes.end();
    if (is_there) columns.push_back(static_cast<int>(found - block.attributes.begin()));
    if (!is_there && missing.empty()) missing = name;
    has_moments = has_moments || (is_there && name.find("moment_") != std::string::npos);
  }
  if (!has_moments) missing.clear();
  return columns.size() == partial_cell_attributes.size() ? columns : std::vector<int>();
}

}  // namespace

MeshFile::MeshFile(ExodusFile file) : file_(std::move(file)) {
  check_sizes();
  layout_.nodes = file_.sizes().nodes;
  layout_.elements = file_.sizes().elements;
  sets_ = file_.node_sets();
  for (const ExodusFile::NodeSet& set : sets_) {
    layout_.node_sets.push_back({set.name.empty() ? "nodelist_" + std::to_string(set.id) : set.name, set.nodes});
  }
  take_blocks();
  check_names();
}

void MeshFile::check_names() const {
  for (const std::string& problem :
       {said_twice("block", blocks_, layout_.blocks), said_twice("node set", sets_, layout_.node_sets)}) {
    if (!problem.empty()) fail(problem);
  }
}

void MeshFile::fail(const std::string& what) const { throw Error(file_.path().string() + ": " + what); }

void MeshFile::check_sizes() const {
  const ExodusFile::Sizes sizes = file_.sizes();
  if (sizes.dimensions != 3) fail("the mesh has " + std::to_string(sizes.dimensions) + " dimensions, expected 3");
  if (sizes.elements < 1 || sizes.blocks < 1) fail("the mesh has no elements");
  if (sizes.nodes > std::numeric_limits<int>::max()) fail("more than 2·10⁹ nodes are not supported");
}

void MeshFile::take_blocks() {
  blocks_ = file_.blocks();
  std::int64_t elements = 0;
  for (const ExodusFile::Block& block : blocks_) elements += block.elements;
  if (elements != layout_.elements) fail("its blocks do not hold the number of elements that it states");
  for (const ExodusFile::Block& block : blocks_) {
    const std::string name = block.name.empty() ? "block_" + std::to_string(block.id) : block.name;
    const std::string type = type_of(block);
    if (type.empty() && block.elements > 0) {
      fail("block '" + name + "': element type " + block.type + " with " + std::to_string(block.nodes_per_element) +
           " nodes is not supported, expected HEX8, TET4 or SPHERE");
    }
    std::string missing;
    cell_columns_.push_back(type == "HEX8" ? cell_columns(block, missing) : std::vector<int>());
    if (!missing.empty()) {
      fail("block '" + name + "' has attributes of partly filled elements, but not '" + missing + "'; expected all " +
           std::to_string(partial_cell_attributes.size()) + ", or none");
    }
    layout_.blocks.push_back({name, type.empty() ? "SPHERE" : type, block.elements, !cell_columns_.back().empty()});
  }
}

void MeshFile::places(std::int64_t begin, std::span<Place> values) const {
  const auto x = file_.coordinates(begin, std::ssize(values));
  for (std::size_t n = 0; n < values.size(); ++n) {
    values[n] = {x[0][n], x[1][n], x[2][n]};
    if (!std::all_of(values[n].begin(), values[n].end(), [](double c) { return std::isfinite(c); })) {
      fail("node " + std::to_string(begin + static_cast<std::int64_t>(n) + 1) +
           ": a coordinate is not a finite number");
    }
  }
}

void MeshFile::take_indices(const std::vector<std::int64_t>& numbers, const std::string& user,
                            std::span<int> nodes) const {
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (numbers[n] < 1 || numbers[n] > layout_.nodes) {
      fail(user + " refers to node " + std::to_string(numbers[n]) + " of " + std::to_string(layout_.nodes) +
           " (damaged file?)");
    }
    nodes[n] = static_cast<int>(numbers[n] - 1);
  }
}

void MeshFile::nodes_of_set(std::size_t set, std::int64_t begin, std::span<int> nodes) const {
  take_indices(file_.nodes_of(sets_[set], begin, std::ssize(nodes)), "node set '" + layout_.node_sets[set].name + "'",
               nodes);
}

void MeshFile::nodes_of_block(std::size_t block, std::int64_t begin, std::span<int> nodes) const {
  const int size = nodes_per_element(layout_.blocks[block].type);
  take_indices(file_.connectivity(blocks_[block], begin / size, std::ssize(nodes) / size),
               "block '" + layout_.blocks[block].name + "'", nodes);
}

// The element variable that results of other codes have instead of attributes.
int MeshFile::variable_volume(std::size_t block) const {
  const std::vector<std::string> names = file_.variable_names(ExodusFile::On::elements);
  const auto variable = std::find(names.begin(), names.end(), "Volume");
  if (variable == names.end() || file_.times().empty()) {
    fail("block '" + layout_.blocks[block].name +
         "': its spheres have no volume, expected the attributes radius and volume (or an element variable Volume)");
  }
  return static_cast<int>(variable - names.begin());
}

// Finds attributes by name; if no name is known, radius and volume by position, or the radius
// alone.
void MeshFile::sphere_volumes(std::size_t block, std::int64_t begin, std::span<double> values) const {
  const ExodusFile::Block& read_from = blocks_[block];
  std::optional<int> volume = attribute_of(read_from, "VOLUME"), radius = attribute_of(read_from, "RADIUS");
  if (!volume && !radius && !read_from.attributes.empty()) {
    check_nameless(block);
    read_from.attributes.size() == 1 ? radius = 0 : volume = 1;
  }
  const std::int64_t count = std::ssize(values);
  const std::vector<double> read = volume   ? file_.attribute(read_from, *volume, begin, count)
                                   : radius ? file_.attribute(read_from, *radius, begin, count)
                                            : file_.element_values(0, variable_volume(block), read_from, begin, count);
  std::copy(read.begin(), read.end(), values.begin());
  if (!volume && radius) std::transform(values.begin(), values.end(), values.begin(), sphere_volume);
}

// An attribute with a name must not be interpreted by its position.
void MeshFile::check_nameless(std::size_t block) const {
  const std::vector<std::string>& names = blocks_[block].attributes;
  const auto says_something = [](const std::string& name) { return !name.empty() && !upper(name).starts_with("ATTR"); };
  if (std::none_of(names.begin(), names.end(), says_something)) return;
  fail("block '" + layout_.blocks[block].name + "': its spheres have the attributes " + joined(names) +
       "; expected one of the name radius (m) or volume (m³)");
}

void MeshFile::cell_attribute(std::size_t block, std::size_t attribute, std::int64_t begin,
                              std::span<double> values) const {
  const std::vector<double> read =
      file_.attribute(blocks_[block], cell_columns_[block][attribute], begin, std::ssize(values));
  std::copy(read.begin(), read.end(), values.begin());
}

void MeshFile::numbers(On on, std::int64_t begin, std::span<std::int64_t> values) const {
  const std::vector<std::int64_t> read = file_.numbers(on, begin, std::ssize(values));
  std::copy(read.begin(), read.end(), values.begin());
}

const std::vector<std::string> partial_cell_attributes = to_words(
    "volume centroid_x centroid_y centroid_z moment_xx moment_yy moment_zz moment_xy moment_yz moment_zx surface_x "
    "surface_y surface_z surface_moment_xx surface_moment_xy surface_moment_xz surface_moment_yx surface_moment_yy "
    "surface_moment_yz surface_moment_zx surface_moment_zy surface_moment_zz");

double& member(PartialCell& cell, std::size_t attribute) {
  if (attribute == 0) return cell.volume;
  if (attribute < 4) return cell.centroid[static_cast<int>(attribute) - 1];
  if (attribute < 10) return cell.moments[static_cast<int>(attribute) - 4];
  const int number = static_cast<int>(attribute) - 10;
  if (number < 3) return cell.surface[number];
  return cell.surface_moments((number - 3) / 3, (number - 3) % 3);
}

Mesh read_mesh(const std::filesystem::path& path) {
  const MeshFile file(ExodusFile::open(path));
  const MeshLayout& layout = file.layout();
  Mesh mesh;
  std::vector<MeshFile::Place> places(static_cast<std::size_t>(layout.nodes));
  file.places(0, places);
  for (const MeshFile::Place& place : places) mesh.nodes.emplace_back(place.data());
  for (std::size_t k = 0; k < layout.node_sets.size(); ++k) {
    mesh.node_sets.push_back({layout.node_sets[k].name, std::vector<int>(layout.node_sets[k].nodes)});
    file.nodes_of_set(k, 0, mesh.node_sets.back().nodes);
  }
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    const auto& [name, type, elements, partly_filled] = layout.blocks[b];
    Mesh::Block& block = mesh.blocks.emplace_back(Mesh::Block{name, type, {}, {}, {}});
    block.nodes.resize(elements * nodes_per_element(type));
    file.nodes_of_block(b, 0, block.nodes);
    std::vector<double> values(elements);
    block.cells.resize(partly_filled ? elements : 0);
    for (std::size_t k = 0; partly_filled && k < partial_cell_attributes.size(); ++k) {
      file.cell_attribute(b, k, 0, values);
      for (std::size_t e = 0; e < values.size(); ++e) member(block.cells[e], k) = values[e];
    }
    if (type == "SPHERE" && elements > 0) file.sphere_volumes(b, 0, values), block.volumes = values;
  }
  return mesh;
}

}  // namespace strut::io
