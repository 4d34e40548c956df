// One open Exodus II file. The only files that know exodusII.h are this one's source; here stand plain C++ types.
// Every call checks what the library returns and throws Error with the file, what was being done, and the cause.
// Serial: rank 0 alone holds a file. Indices of blocks, sets, variables and steps count from 0 here.
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
    std::string name;  // empty where the file has none
    std::string type;  // as the file spells it
    std::int64_t elements = 0;
    std::int64_t nodes_per_element = 0;
    std::vector<std::string> attributes;  // their names; may be empty texts
  };
  struct NodeSet {
    std::int64_t id = 0;
    std::string name;
    std::int64_t nodes = 0;
  };
  enum class On { nodes, elements };  // what a variable is defined on

  static constexpr std::size_t longest_name = 127;

  enum class Access { read, write };
  // `frames`: so many of a result must be whole; what is left of others is not to be read.
  static ExodusFile open(const std::filesystem::path& path, Access access = Access::read,
                         std::int64_t frames = all_records);
  // Replaces a file of that name. `largest_variable`: bytes of what is largest in it, of a frame where it has frames.
  static ExodusFile create(const std::filesystem::path& path, std::int64_t largest_variable = 0);
  ~ExodusFile();
  ExodusFile(ExodusFile&& other) noexcept;
  ExodusFile& operator=(ExodusFile&&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // Reading.
  Sizes sizes() const;
  std::vector<Block> blocks() const;
  std::vector<NodeSet> node_sets() const;
  // Parts of what may be large: `count` entries from number `begin` on.
  std::array<std::vector<double>, 3> coordinates(std::int64_t begin, std::int64_t count) const;
  // Node numbers from 1, element by element.
  std::vector<std::int64_t> connectivity(const Block& block, std::int64_t begin, std::int64_t count) const;
  std::vector<double> attribute(const Block& block, int index, std::int64_t begin, std::int64_t count) const;
  std::vector<std::int64_t> nodes_of(const NodeSet& set, std::int64_t begin, std::int64_t count) const;  // from 1
  // The file's map of elements or nodes, else 1, 2, …
  std::vector<std::int64_t> numbers(On on, std::int64_t begin, std::int64_t count) const;
  std::vector<double> times() const;
  std::vector<std::string> variable_names(On on) const;
  std::vector<double> nodal_values(int step, int variable) const;  // of all nodes
  std::vector<double> nodal_values(int step, int variable, std::int64_t begin, std::int64_t count) const;
  // NaN for elements of blocks on which the variable is not defined. Of one block, or of all.
  std::vector<double> element_values(int step, int variable, const Block& block, std::int64_t begin,
                                     std::int64_t count) const;
  std::vector<double> element_values(int step, int variable) const;

  // Writing, in the order of these lines: what defines the layout before what fills it, entry by entry from number
  // `begin` on.
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
  static int entity(On on);  // as the library counts them
  void check(int code, std::string_view doing) const;
  void put_attribute_names(const Block& block) const;
  std::int64_t inquire(int what, std::string_view doing) const;
  std::int64_t plausible(std::int64_t count, std::int64_t bytes, const std::string& what) const;

  std::filesystem::path path_;
  int handle_ = -1;
  std::int64_t largest_ = 0;  // bytes of data that a file of this size can hold
};

}  // namespace strut::io
