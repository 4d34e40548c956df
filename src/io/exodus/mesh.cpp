// Writes a mesh made by a tool to a file.
#include <unistd.h>

#include <algorithm>
#include <array>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "io/exodus/elements.hpp"
#include "io/exodus/exodus.hpp"
#include "io/exodus/exodus_file.hpp"
#include "io/exodus/exodus_words.hpp"
#include "io/exodus/mesh_read.hpp"

namespace strut::io {

namespace {

template <class Item>
std::vector<std::int64_t> numbers(const std::vector<Item>& items, const std::string& prefix) {
  std::vector<std::string> names;
  for (const Item& item : items) names.push_back(item.name);
  return numbers_of(names, prefix);
}

std::vector<ExodusFile::Block> blocks_of(const Mesh& mesh) {
  const std::vector<std::int64_t> ids = numbers(mesh.blocks, "block_");
  std::vector<ExodusFile::Block> blocks;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const Mesh::Block& block = mesh.blocks[b];
    if (block.type == "SPHERE" && block.volumes.size() != block.nodes.size()) {
      throw Error("block '" + block.name + "' needs one volume for each sphere");
    }
    if (!block.cells.empty() && (block.type != "HEX8" || block.cells.size() != block.elements())) {
      throw Error("block '" + block.name + "' needs one cell for each HEX8 element, or none");
    }
    const int size = nodes_per_element(block.type);
    if (block.nodes.size() % size != 0) throw Error("the last element of block '" + block.name + "' lacks nodes");
    blocks.push_back({ids[b], block.name, block.type, std::ssize(block.nodes) / size, size, {}});
    if (block.type == "SPHERE") blocks.back().attributes = {"radius", "volume"};
    if (!block.cells.empty()) blocks.back().attributes = partial_cell_attributes;
  }
  return blocks;
}

std::vector<ExodusFile::NodeSet> node_sets_of(const Mesh& mesh) {
  const std::vector<std::int64_t> ids = numbers(mesh.node_sets, "nodelist_");
  std::vector<ExodusFile::NodeSet> sets;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    sets.push_back({ids[k], mesh.node_sets[k].name, std::ssize(mesh.node_sets[k].nodes)});
  }
  return sets;
}

std::vector<std::int64_t> counted_from_one(const std::vector<int>& nodes) {
  std::vector<std::int64_t> numbers(nodes.begin(), nodes.end());
  for (std::int64_t& number : numbers) ++number;
  return numbers;
}

void put_cells(const ExodusFile& file, const ExodusFile::Block& layout, const std::vector<PartialCell>& cells) {
  for (std::size_t k = 0; k < partial_cell_attributes.size(); ++k) {
    std::vector<double> values;
    for (PartialCell cell : cells) values.push_back(member(cell, k));
    file.put_attribute(layout, static_cast<int>(k), values);
  }
}

void put_elements(const ExodusFile& file, const ExodusFile::Block& layout, const Mesh::Block& block) {
  file.put_connectivity(layout, counted_from_one(block.nodes));
  if (!block.cells.empty()) put_cells(file, layout, block.cells);
  if (block.type != "SPHERE") return;
  std::vector<double> radii;
  for (const double volume : block.volumes) radii.push_back(sphere_radius(volume));
  file.put_attribute(layout, 0, radii);
  file.put_attribute(layout, 1, block.volumes);
}

// Bytes of the coordinates along an axis, or of the nodes or attributes of a block.
std::int64_t largest_variable(const std::vector<ExodusFile::Block>& blocks, std::int64_t nodes) {
  std::int64_t largest = 8 * nodes;
  for (const ExodusFile::Block& block : blocks) {
    largest = std::max(
        {largest, 4 * block.elements * block.nodes_per_element, 8 * block.elements * std::ssize(block.attributes)});
  }
  return largest;
}

std::filesystem::path part_of_mesh(const std::filesystem::path& file) {
  return part_of(destination(file).string() + "." + std::to_string(getpid()));
}

}  // namespace

int nodes_per_element(const std::string& type) {
  if (type == "HEX8") return 8;
  if (type == "TET4") return 4;
  if (type == "SPHERE") return 1;
  throw Error("elements of type '" + type + "' are not supported, expected HEX8, TET4 or SPHERE");
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh) {
  const std::vector<ExodusFile::Block> blocks = blocks_of(mesh);
  const std::vector<ExodusFile::NodeSet> sets = node_sets_of(mesh);
  std::int64_t elements = 0;
  for (const ExodusFile::Block& block : blocks) elements += block.elements;

  const ExodusFile file = ExodusFile::create(path, largest_variable(blocks, std::ssize(mesh.nodes)));
  file.put_sizes(mesh_title, {3, std::ssize(mesh.nodes), elements, std::ssize(blocks), std::ssize(sets)});
  file.put_provenance();
  file.put_blocks(blocks);
  file.put_node_sets(sets);

  std::array<std::vector<double>, 3> x;
  for (int k = 0; k < 3; ++k) {
    for (const Vector& node : mesh.nodes) x[k].push_back(node[k]);
  }
  file.put_coordinates(x);
  for (std::size_t b = 0; b < blocks.size(); ++b) put_elements(file, blocks[b], mesh.blocks[b]);
  for (std::size_t k = 0; k < sets.size(); ++k) {
    file.put_nodes_of(sets[k], counted_from_one(mesh.node_sets[k].nodes));
  }
  file.flush();
}

void check_replaceable(const std::filesystem::path& file) {
  for (const std::filesystem::path& one : {file, part_of_mesh(file)}) {
    if (const std::string why = obstacle(one, FileKind::mesh); !why.empty()) throw Error(why);
  }
}

void replace_mesh(const std::filesystem::path& file, const Mesh& mesh) {
  check_replaceable(file);
  const std::filesystem::path part = part_of_mesh(file);
  try {
    write_mesh(part, mesh);
    std::filesystem::rename(part, destination(file));
  } catch (const std::exception&) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw;
  }
}

}  // namespace strut::io
