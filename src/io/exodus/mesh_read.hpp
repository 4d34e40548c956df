// Reads the mesh of a file in parts, and checks each part.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/exodus/exodus.hpp"
#include "io/exodus/exodus_file.hpp"

namespace strut::io {

// The layout of a mesh, without the data that may be large.
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

// A mesh, read in parts: values from number `begin` on, to fill the span. All functions throw Error if a value is out
// of range.
class MeshSource {
 public:
  using Place = std::array<double, 3>;
  using On = ExodusFile::On;

  virtual ~MeshSource() = default;
  const MeshLayout& layout() const { return layout_; }
  virtual void places(std::int64_t begin, std::span<Place> values) const = 0;                      // of nodes, m
  virtual void nodes_of_set(std::size_t set, std::int64_t begin, std::span<int> nodes) const = 0;  // 0-based
  // Nodes of successive elements, 0-based; the portion must consist of whole elements.
  virtual void nodes_of_block(std::size_t block, std::int64_t begin, std::span<int> nodes) const = 0;
  virtual void sphere_volumes(std::size_t block, std::int64_t begin, std::span<double> values) const = 0;  // m³
  // partial_cell_attributes[attribute] for elements with partial cells.
  virtual void cell_attribute(std::size_t block, std::size_t attribute, std::int64_t begin,
                              std::span<double> values) const = 0;
  virtual void numbers(On on, std::int64_t begin, std::span<std::int64_t> values) const = 0;

 protected:
  MeshLayout layout_;
};

// The mesh of a file.
class MeshFile : public MeshSource {
 public:
  explicit MeshFile(ExodusFile file);  // throws Error if there is no mesh, or an unsupported element

  void places(std::int64_t begin, std::span<Place> values) const override;
  void nodes_of_set(std::size_t set, std::int64_t begin, std::span<int> nodes) const override;
  void nodes_of_block(std::size_t block, std::int64_t begin, std::span<int> nodes) const override;
  void sphere_volumes(std::size_t block, std::int64_t begin, std::span<double> values) const override;
  void cell_attribute(std::size_t block, std::size_t attribute, std::int64_t begin,
                      std::span<double> values) const override;
  void numbers(On on, std::int64_t begin, std::span<std::int64_t> values) const override;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void check_sizes() const;
  void take_blocks();
  void take_indices(const std::vector<std::int64_t>& numbers, const std::string& user, std::span<int> nodes) const;
  void check_names() const;
  void check_nameless(std::size_t block) const;
  int variable_volume(std::size_t block) const;

  ExodusFile file_;
  std::vector<ExodusFile::Block> blocks_;
  std::vector<ExodusFile::NodeSet> sets_;
  std::vector<std::vector<int>> cell_columns_;  // of each block: columns of its attributes in the file
};

// A mesh in memory, which must outlive it. A tool has made it: its values are not checked again.
class MeshInMemory : public MeshSource {
 public:
  explicit MeshInMemory(const Mesh& mesh);

  void places(std::int64_t begin, std::span<Place> values) const override;
  void nodes_of_set(std::size_t set, std::int64_t begin, std::span<int> nodes) const override;
  void nodes_of_block(std::size_t block, std::int64_t begin, std::span<int> nodes) const override;
  void sphere_volumes(std::size_t block, std::int64_t begin, std::span<double> values) const override;
  void cell_attribute(std::size_t block, std::size_t attribute, std::int64_t begin,
                      std::span<double> values) const override;
  void numbers(On on, std::int64_t begin, std::span<std::int64_t> values) const override;  // from 1

 private:
  const Mesh& mesh_;
};

// The member that partial_cell_attributes[attribute] names.
double& member(PartialCell& cell, std::size_t attribute);

}  // namespace strut::io
