// A file's mesh, in parts, each checked as it is read.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/exodus/exodus.hpp"
#include "io/exodus/exodus_file.hpp"

namespace strut::io {

// What there is in a mesh, without what may be large.
struct MeshLayout {
  struct Block {
    std::string name;
    std::string type;  // "HEX8", "TET4" or "SPHERE"
    std::int64_t elements = 0;
    bool partly_filled = false;  // its elements have cells (PartialCell)
  };
  struct NodeSet {
    std::string name;
    std::int64_t nodes = 0;
  };
  std::int64_t nodes = 0, elements = 0;
  std::vector<Block> blocks;
  std::vector<NodeSet> node_sets;
};

// The values from number `begin` on, as many as there is room for. All throw Error: what is read is not within range.
class MeshFile {
 public:
  using Place = std::array<double, 3>;

  explicit MeshFile(ExodusFile file);  // throws Error: no mesh, or elements that are not supported

  const MeshLayout& layout() const { return layout_; }
  void places(std::int64_t begin, std::span<Place> values) const;                      // of nodes, m
  void nodes_of_set(std::size_t set, std::int64_t begin, std::span<int> nodes) const;  // 0-based
  // Of elements one after the other, 0-based; begins and ends with an element.
  void nodes_of_block(std::size_t block, std::int64_t begin, std::span<int> nodes) const;
  void sphere_volumes(std::size_t block, std::int64_t begin, std::span<double> values) const;  // m³
  // partial_cell_attributes[attribute] of elements that have cells.
  void cell_attribute(std::size_t block, std::size_t attribute, std::int64_t begin, std::span<double> values) const;
  void numbers(ExodusFile::On on, std::int64_t begin, std::span<std::int64_t> values) const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void check_sizes() const;
  void take_blocks();
  void take_indices(const std::vector<std::int64_t>& numbers, const std::string& user, std::span<int> nodes) const;
  void check_names() const;
  void check_nameless(std::size_t block) const;
  int variable_volume(std::size_t block) const;

  ExodusFile file_;
  MeshLayout layout_;
  std::vector<ExodusFile::Block> blocks_;
  std::vector<ExodusFile::NodeSet> sets_;
  std::vector<std::vector<int>> cell_columns_;  // of each block: where its attributes are in the file
};

// All that the functions above can be asked for, in portions that are forgotten.
void read_through(const MeshFile& mesh);

// What partial_cell_attributes[attribute] is the name of.
double& member(PartialCell& cell, std::size_t attribute);

}  // namespace strut::io
