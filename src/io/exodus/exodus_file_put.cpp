// The writing part of ExodusFile.
#include <exodusII.h>

#include <algorithm>
#include <ctime>

#include "base/build_facts.hpp"
#include "io/exodus/exodus_file.hpp"
#include "io/exodus/exodus_words.hpp"

namespace strut::io {

namespace {

void check_names(const std::filesystem::path& path, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (name.size() > ExodusFile::longest_name) {
      fail_at(path, "write the name '" + name + "'",
              "it is longer than " + std::to_string(ExodusFile::longest_name) + " characters");
    }
  }
}

template <class Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items) names.push_back(item.name);
  return names;
}

// Lines of at most `most` characters, broken between words if possible.
std::vector<std::string> wrapped(std::string text, std::size_t most) {
  std::vector<std::string> lines;
  while (text.size() > most) {
    const std::size_t space = text.rfind(' ', most);
    const std::size_t end = space == std::string::npos || space == 0 ? most : space;
    lines.push_back(text.substr(0, end));
    text.erase(0, end == space ? end + 1 : end);
  }
  lines.push_back(text);
  return lines;
}

}  // namespace

void ExodusFile::put_sizes(const std::string& title, const Sizes& sizes) const {
  check(ex_put_init(handle_, title.substr(0, MAX_LINE_LENGTH).c_str(), sizes.dimensions, sizes.nodes, sizes.elements,
                    sizes.blocks, sizes.node_sets, 0),
        "write its sizes");
}

void ExodusFile::put_provenance() const {
  const std::time_t now = std::time(nullptr);
  char date[MAX_STR_LENGTH + 1] = {};
  char time[MAX_STR_LENGTH + 1] = {};
  std::tm local = {};
  localtime_r(&now, &local);
  std::strftime(date, sizeof date, "%Y/%m/%d", &local);
  std::strftime(time, sizeof time, "%H:%M:%S", &local);
  std::string name = "strut";
  std::string number = strut_version();
  char* record[1][4] = {{name.data(), number.data(), date, time}};
  check(ex_put_qa(handle_, 1, record), "write its QA record");
  std::vector<std::string> lines = wrapped("written by " + build_facts(), MAX_LINE_LENGTH);
  std::vector<char*> pointers;
  for (std::string& line : lines) pointers.push_back(line.data());
  check(ex_put_info(handle_, static_cast<int>(pointers.size()), pointers.data()), "write its info records");
}

void ExodusFile::put_blocks(const std::vector<Block>& blocks) const {
  check_names(path_, names_of(blocks));
  for (const Block& block : blocks) {
    const auto attributes = static_cast<std::int64_t>(block.elements > 0 ? block.attributes.size() : 0);
    check(ex_put_block(handle_, EX_ELEM_BLOCK, block.id, block.type.c_str(), block.elements, block.nodes_per_element, 0,
                       0, attributes),
          "write block " + quoted(block.name, block.id));
  }
  NameTable names(names_of(blocks), longest_name);
  if (!blocks.empty()) check(ex_put_names(handle_, EX_ELEM_BLOCK, names.data()), "write the names of blocks");
  for (const Block& block : blocks) put_attribute_names(block);
  char axes[3][2] = {"x", "y", "z"};
  char* axis_names[3] = {axes[0], axes[1], axes[2]};
  check(ex_put_coord_names(handle_, axis_names), "write the names of the axes");
}

void ExodusFile::put_attribute_names(const Block& block) const {
  if (block.attributes.empty() || block.elements == 0) return;
  NameTable names(block.attributes, longest_name);
  check(ex_put_attr_names(handle_, EX_ELEM_BLOCK, block.id, names.data()),
        "write the names of the attributes of block " + quoted(block.name, block.id));
}

void ExodusFile::put_node_sets(const std::vector<NodeSet>& sets) const {
  check_names(path_, names_of(sets));
  for (const NodeSet& set : sets) {
    check(ex_put_set_param(handle_, EX_NODE_SET, set.id, set.nodes, 0), "write node set " + quoted(set.name, set.id));
  }
  NameTable names(names_of(sets), longest_name);
  if (!sets.empty()) check(ex_put_names(handle_, EX_NODE_SET, names.data()), "write the names of node sets");
}

void ExodusFile::put_variables(const std::vector<Block>& blocks, const std::vector<std::string>& nodal,
                               const std::vector<std::string>& element) const {
  for (const On on : {On::nodes, On::elements}) {
    const std::vector<std::string>& list = on == On::nodes ? nodal : element;
    if (list.empty()) continue;
    check_names(path_, list);
    const int count = static_cast<int>(list.size());
    NameTable names(list, longest_name);
    check(ex_put_variable_param(handle_, static_cast<ex_entity_type>(entity(on)), count),
          "write the number of variables");
    check(ex_put_variable_names(handle_, static_cast<ex_entity_type>(entity(on)), count, names.data()),
          "write the names of variables");
  }
  if (element.empty() || blocks.empty()) return;
  std::vector<int> defined;  // by blocks; an empty block has no variables
  for (const Block& block : blocks) defined.insert(defined.end(), element.size(), block.elements > 0 ? 1 : 0);
  check(ex_put_truth_table(handle_, EX_ELEM_BLOCK, static_cast<int>(blocks.size()), static_cast<int>(element.size()),
                           defined.data()),
        "write which blocks variables are defined on");
}

void ExodusFile::put_coordinates(const std::array<std::vector<double>, 3>& x, std::int64_t begin) const {
  const auto count = static_cast<std::int64_t>(x[0].size());
  check(ex_put_partial_coord(handle_, begin + 1, count, x[0].data(), x[1].data(), x[2].data()),
        "write the coordinates");
}

void ExodusFile::put_connectivity(const Block& block, std::span<const std::int64_t> nodes, std::int64_t begin) const {
  if (nodes.empty()) return;
  const std::int64_t count = std::ssize(nodes) / block.nodes_per_element;
  check(ex_put_partial_elem_conn(handle_, block.id, begin + 1, count, nodes.data()),
        "write the elements of block " + quoted(block.name, block.id));
}

void ExodusFile::put_attribute(const Block& block, int index, std::span<const double> values,
                               std::int64_t begin) const {
  if (values.empty()) return;
  check(ex_put_partial_one_attr(handle_, EX_ELEM_BLOCK, block.id, begin + 1, std::ssize(values), index + 1,
                                values.data()),
        "write the attributes of block " + quoted(block.name, block.id));
}

void ExodusFile::put_nodes_of(const NodeSet& set, std::span<const std::int64_t> nodes, std::int64_t begin) const {
  if (nodes.empty()) return;
  check(ex_put_partial_set(handle_, EX_NODE_SET, set.id, begin + 1, std::ssize(nodes), nodes.data(), nullptr),
        "write the nodes of node set " + quoted(set.name, set.id));
}

void ExodusFile::put_element_numbers(std::span<const std::int64_t> numbers, std::int64_t begin) const {
  if (numbers.empty()) return;
  check(ex_put_partial_id_map(handle_, EX_ELEM_MAP, begin + 1, std::ssize(numbers), numbers.data()),
        "write the numbers of elements");
}

void ExodusFile::put_time(int step, double time) const {
  check(ex_put_time(handle_, step + 1, &time), "write the time of step " + std::to_string(step + 1));
}

void ExodusFile::put_nodal_values(int step, int variable, std::span<const double> values, std::int64_t begin) const {
  check(ex_put_partial_var(handle_, step + 1, EX_NODAL, variable + 1, 1, begin + 1, std::ssize(values), values.data()),
        "write step " + std::to_string(step + 1));
}

void ExodusFile::put_element_values(int step, int variable, const Block& block, std::span<const double> values,
                                    std::int64_t begin) const {
  if (values.empty()) return;
  check(ex_put_partial_var(handle_, step + 1, EX_ELEM_BLOCK, variable + 1, block.id, begin + 1, std::ssize(values),
                           values.data()),
        "write step " + std::to_string(step + 1));
}

void ExodusFile::flush() const { check(ex_update(handle_), "flush it to disk"); }

}  // namespace strut::io
