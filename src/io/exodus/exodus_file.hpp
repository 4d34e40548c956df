// One open Exodus II file. Only its sources include exodusII.h; this header has plain C++ types. Every call checks the
// library's return code, and throws Error with the file, the operation and the cause. Serial: only rank 0 holds a file.
// Indices of blocks, sets, variables and steps start from 0 here.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/netcdf/classic_netcdf.hpp"

namespace strut::io {

class ExodusFile {
 public:
  struct Sizes {
    std::int64_t dimensions = 3;
    std::int64_t nodes = 0;
    std::int64_t elements = 0;
    std::int64_t blocks = 0;
    std::int64_t node_sets = 0;
  };
  struct Block {
    std::int64_t id = 0;
    std::string name;  // empty if the file has none
    std::string type;  // as spelled in the file
    std::int64_t elements = 0;
    std::int64_t nodes_per_element = 0;
    std::vector<std::string> attributes;  // their names, possibly empty
  };
  struct NodeSet {
    std::int64_t id = 0;
    std::string name;
    std::int64_t nodes = 0;
  };
  enum class On { nodes, elements };  // the entities that a variable is defined on

  static constexpr std::size_t longest_name = 127;

  enum class Access { read, write };
  // `frames`: number of frames of a result that must be complete; later ones are not read.
  static ExodusFile open(const std::filesystem::path& path, Access access = Access::read,
                         std::int64_t frames = all_records);
  // Replaces a file of that name. `largest_variable`: bytes of the largest variable, in one frame if it has frames.
  static ExodusFile create(const std::filesystem::path& path, std::int64_t largest_variable = 0);
  ~ExodusFile();
  ExodusFile(ExodusFile&& other) noexcept;
  ExodusFile& operator=(ExodusFile&&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // Reading.
  Sizes sizes() const;
  std::vector<Block> blocks() const;
  std::vector<NodeSet> node_sets() const;
  // Parts of large data: `count` entries from number `begin` on.
  std::array<std::vector<double>, 3> coordinates(std::int64_t begin, std::int64_t count) const;
  // Node numbers from 1, element by element.
  std::vector<std::int64_t> connectivity(const Block& block, std::int64_t begin, std::int64_t count) const;
  std::vector<double> attribute(const Block& block, int index, std::int64_t begin, std::int64_t count) const;
  std::vector<std::int64_t> nodes_of(const NodeSet& set, std::int64_t begin, std::int64_t count) const;  // from 1
  // The file's map of elements or nodes, else 1, 2, …
  std::vector<std::int64_t> numbers(On on, std::int64_t begin, std::int64_t count) const;
  std::vector<double> times() const;
  std::vector<std::string> variable_names(On on) const;
  std::vector<double> nodal_values(int step, int variable) const;  // at all nodes
  std::vector<double> nodal_values(int step, int variable, std::int64_t begin, std::int64_t count) const;
  // NaN for elements of blocks without the variable. For one block, or for all.
  std::vector<double> element_values(int step, int variable, const Block& block, std::int64_t begin,
                                     std::int64_t count) const;
  std::vector<double> element_values(int step, int variable) const;

  // Writing, in the order of these functions: the layout before the data, entry by entry from number `begin`
  // on.
  void put_sizes(const std::string& title, const Sizes& sizes) const;
  void put_provenance() const;  // program, version, date
  void put_blocks(const std::vector<Block>& blocks) const;
  void put_node_sets(const std::vector<NodeSet>& sets) const;
  void put_variables(const std::vector<Block>& blocks, const std::vector<std::string>& nodal,
                     const std::vector<std::string>& element) const;
  void put_coordinates(const std::array<std::vector<double>, 3>& coordinates, std::int64_t begin = 0) const;
  void put_connectivity(const Block& block, std::span<const std::int64_t> nodes, std::int64_t begin = 0) const;
  void put_attribute(const Block& block, int index, std::span<const double> values, std::int64_t begin = 0) const;
  void put_nodes_of(const NodeSet& set, std::span<const std::int64_t> nodes, std::int64_t begin = 0) const;
  void put_element_numbers(std::span<const std::int64_t> numbers, std::int64_t begin = 0) const;
  void put_time(int step, double time) const;
  void put_nodal_values(int step, int variable, std::span<const double> values, std::int64_t begin = 0) const;
  void put_element_values(int step, int variable, const Block& block, std::span<const double> values,
                          std::int64_t begin = 0) const;
  void flush() const;

 private:
  ExodusFile(const std::filesystem::path& path, int handle) : path_(path), handle_(handle) {}
  static int entity(On on);  // the library's type of entity
  void check(int code, std::string_view doing) const;
  void put_attribute_names(const Block& block) const;
  std::int64_t inquire(int what, std::string_view doing) const;
  std::int64_t plausible(std::int64_t count, std::int64_t bytes, const std::string& what) const;

  std::filesystem::path path_;
  int handle_ = -1;
  std::int64_t largest_ = 0;  // bytes of data that a file of this size can hold
};

}  // namespace strut::io
