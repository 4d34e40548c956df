#include "mesh/arrays.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <sstream>

#include "base/errors.hpp"
#include "mesh/body.hpp"
#include "mesh/cells.hpp"
#include "mesh/resolution.hpp"

namespace strut::mesh {

namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are little-endian and read as they are");

constexpr const char* magic = "strut-mesh arrays 1";
constexpr std::size_t longest_line = 1000;
constexpr std::size_t chunk = 1 << 16;  // numbers per read
constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t most_voxels = most / 8;  // solid ones: the corners of cells are counted
constexpr int most_factor = 16;
constexpr std::size_t cell_numbers = io::partial_cell_attributes.size();

using Words = std::vector<std::string>;
using CellNumbers = std::array<double, cell_numbers>;

io::PartialCell cell_of(const CellNumbers& x) {
  io::PartialCell cell;
  cell.volume = x[0];
  cell.centroid = {x[1], x[2], x[3]};
  std::copy_n(x.begin() + 4, 6, cell.moments.begin());
  cell.surface = {x[10], x[11], x[12]};
  for (int n = 0; n < 9; ++n) cell.surface_moments(n / 3, n % 3) = x[13 + n];
  return cell;
}

// Content of a line "voxels".
struct VoxelHeader {
  std::string user;  // for messages
  std::string name;
  std::int64_t count = 0;
  VoxelGrid grid;
  Vector origin;
  Gathering gathering;
  bool grey = false;
  double thickness = 0;  // of members, voxels; 0: unknown
};

class ArraysReader {
 public:
  ArraysReader(std::istream& stream, std::string source) : stream_(stream), source_(std::move(source)) {}

  io::Mesh read(std::string* summary) {
    if (line() != magic) fail(std::string("it does not begin with the line '") + magic + "'");
    read_nodes(words());
    for (Words header = words(); header[0] != "end"; header = words()) read_part(header);
    if (stream_.peek() != std::istream::traits_type::eof()) fail("there are data after 'end'");
    for (const io::Mesh& body : bodies_) append(mesh_, body);
    if (summary != nullptr) *summary = summary_;
    const auto filled = [](const io::Mesh::Block& block) { return !block.nodes.empty(); };
    if (std::none_of(mesh_.blocks.begin(), mesh_.blocks.end(), filled)) fail("the mesh has no elements");
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(source_ + ": " + what); }

  // Without its end; text longer than any header is data left over by a wrong count.
  std::string line() {
    std::string text;
    char c = 0;
    while (text.size() < longest_line && stream_.get(c) && c != '\n') text.push_back(c);
    if (!stream_) fail(text.empty() ? "it ends where a line was expected ('end' closes it)" : "it ends within a line");
    return text;
  }

  Words words() {
    const std::string text = line();
    last_line_ = text.substr(0, 60);
    std::replace_if(
        last_line_.begin(), last_line_.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    std::istringstream stream(text);
    Words words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (words.empty()) words.emplace_back();
    return words;
  }

  [[noreturn]] void expected(const std::string& what) const {
    fail("expected " + what + ", found '" + last_line_ + "'");
  }

  std::int64_t count(const std::string& word) const {
    std::int64_t value = -1;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value < 0 || value > most) {
      fail("line '" + last_line_ + "': '" + word + "' is not a number from 0 to " + std::to_string(most));
    }
    return value;
  }

  // Calls take(number) for each of the next `numbers` numbers.
  template <class Number, class Take>
  void each(std::int64_t numbers, const std::string& user, const Take& take) {
    std::vector<Number> buffer(std::min<std::int64_t>(numbers, chunk));
    for (std::int64_t done = 0; done < numbers; done += std::ssize(buffer)) {
      buffer.resize(std::min<std::int64_t>(numbers - done, chunk));
      stream_.read(reinterpret_cast<char*>(buffer.data()),
                   static_cast<std::streamsize>(buffer.size() * sizeof(Number)));
      if (!stream_) {
        const std::int64_t got = done + stream_.gcount() / static_cast<std::int64_t>(sizeof(Number));
        fail(user + ": it ends after " + std::to_string(got) + " of " + std::to_string(numbers) + " numbers");
      }
      for (const Number number : buffer) take(number);
    }
  }

  void read_nodes(const Words& header) {
    if (header.size() != 2 || header[0] != "nodes") expected("'nodes N'");
    Vector node;
    int axis = 0;
    each<double>(3 * count(header[1]), "nodes", [&](double x) {
      if (!std::isfinite(x)) fail("node " + std::to_string(mesh_.nodes.size()) + ": a coordinate is not finite");
      node[axis++] = x;
      if (axis < 3) return;
      axis = 0;
      mesh_.nodes.push_back(node);
    });
  }

  void read_part(const Words& header) {
    if (header.size() == 5 && header[0] == "block") return read_block(header);
    if (header.size() == 3 && header[0] == "set") return read_set(header);
    if (header.size() == 3 && header[0] == "cells") return read_cells(header);
    if ((header.size() == 9 || header.size() == 10) && header[0] == "voxels") return read_voxels(header);
    expected(
        "'block NAME TYPE COUNT NPE', 'cells NAME COUNT', 'voxels NAME COUNT NX NY NZ N SMALLEST KIND "
        "[THICKNESS]', 'set NAME COUNT' or 'end'");
  }

  // The block of hexahedra with this name; it must have been read, and have no cells yet.
  io::Mesh::Block& block_for_cells(const std::string& name, std::int64_t count, const std::string& user) {
    const auto block = std::find_if(mesh_.blocks.begin(), mesh_.blocks.end(),
                                    [&](const io::Mesh::Block& b) { return b.name == name; });
    if (block == mesh_.blocks.end()) fail(user + ": there is no such block before them");
    if (block->type != "HEX8") fail(user + ": its elements are of type " + block->type + ", expected HEX8");
    if (!block->cells.empty()) fail(user + " come again");
    if (count != std::ssize(block->nodes) / 8) {
      fail(user + ": " + std::to_string(count) + " cells, expected one for each of its " +
           std::to_string(block->elements()) + " elements");
    }
    return *block;
  }

  void read_cells(const Words& header) {
    const std::string user = "cells of block '" + header[1] + "'";
    io::Mesh::Block& block = block_for_cells(header[1], count(header[2]), user);
    CellNumbers numbers;
    std::size_t read = 0;
    each<double>(std::ssize(block.nodes) / 8 * std::ssize(numbers), user, [&](double number) {
      const auto cell = [&] { return user + ", cell " + std::to_string(block.cells.size()) + ": "; };
      if (!std::isfinite(number)) fail(cell() + io::partial_cell_attributes[read] + " is not finite");
      if (read == 0 && !(number > 0)) {
        fail(cell() + "volume " + std::to_string(number) + ", expected one > 0 in m³");
      }
      numbers[read++] = number;
      if (read < numbers.size()) return;
      read = 0;
      block.cells.push_back(cell_of(numbers));
    });
  }

  VoxelHeader voxel_header(const Words& header) {
    VoxelHeader voxels;
    voxels.name = header[1];
    voxels.user = "voxels '" + header[1] + "'";
    voxels.count = count(header[2]);
    if (voxels.count > most_voxels) fail(voxels.user + ": at most " + std::to_string(most_voxels) + " are supported");
    std::int64_t all = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t cells = count(header[3 + axis]);
      if (cells < 1 || cells > most / all) {
        fail(voxels.user + ": a box of " + header[3] + " x " + header[4] + " x " + header[5] +
             " voxels, expected 1 to " + std::to_string(most) + " in all");
      }
      all *= cells;
      voxels.grid.cells[axis] = static_cast<int>(cells);
    }
    const std::int64_t factor = count(header[6]);
    if (factor < 1 || factor > most_factor) {
      fail(voxels.user + ": " + header[6] + " along an edge of a cell, expected 1 to " + std::to_string(most_factor));
    }
    voxels.gathering = {static_cast<int>(factor), fraction(header[7], voxels.user)};
    if (header[8] != "solid" && header[8] != "grey")
      fail(voxels.user + " are '" + header[8] + "', expected solid or grey");
    voxels.grey = header[8] == "grey";
    if (header.size() == 10) voxels.thickness = thickness(header[9], voxels.user);
    return voxels;
  }

  // Returns NaN if the word is no number.
  static double number(const std::string& word) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() ? value : std::nan("");
  }

  double thickness(const std::string& word, const std::string& user) const {
    const double value = number(word);
    if (value > 0 && std::isfinite(value)) return value;
    fail(user + ": the thickness is '" + word + "', expected voxels > 0");
  }

  double fraction(const std::string& word, const std::string& user) const {
    const double value = number(word);
    if (value >= 0 && value <= 0.9) return value;
    fail(user + ": the smallest cell is '" + word + "', expected a number from 0 to 0.9");
  }

  // Reads the edges of a voxel and the lower corner of the box.
  void read_place(VoxelHeader& voxels) {
    std::vector<double> numbers;
    each<double>(6, voxels.user, [&](double number) { numbers.push_back(number); });
    const Vector edges(numbers[0], numbers[1], numbers[2]);
    voxels.origin = {numbers[3], numbers[4], numbers[5]};
    voxels.grid.size = edges.array() * voxels.grid.cells.cast<double>();
    if (!(edges.minCoeff() > 0 && edges.prod() > 0) || !voxels.grid.size.allFinite() || !voxels.origin.allFinite()) {
      fail(voxels.user + ": expected three edges of a voxel > 0 and the lower corner of the box, in m");
    }
  }

  std::vector<int> read_solid(const VoxelHeader& voxels) {
    std::vector<int> solid;
    Eigen::Array3i at;
    int axis = 0;
    each<std::int32_t>(3 * voxels.count, voxels.user, [&](std::int32_t place) {
      const auto voxel = [&] { return voxels.user + ", voxel " + std::to_string(solid.size()); };
      if (place < 0 || place >= voxels.grid.cells[axis]) fail(voxel() + " is not in the box");
      at[axis++] = place;
      if (axis < 3) return;
      axis = 0;
      const int index = voxels.grid.index(at[0], at[1], at[2]);
      if (!solid.empty() && index <= solid.back()) fail(voxel() + " is out of order: x runs fastest, z slowest");
      solid.push_back(index);
    });
    return solid;
  }

  std::vector<double> read_fills(const VoxelHeader& voxels) {
    std::vector<double> fills;
    if (!voxels.grey) return fills;
    each<double>(voxels.count, voxels.user, [&](double fill) {
      if (!(fill > 0 && fill <= 1)) {
        fail(voxels.user + ", voxel " + std::to_string(fills.size()) + ": a part of " + std::to_string(fill) +
             " is solid, expected one > 0 to 1");
      }
      fills.push_back(fill);
    });
    return fills;
  }

  void read_voxels(const Words& header) {
    VoxelHeader voxels = voxel_header(header);
    if (!block_names_.insert(voxels.name).second) fail("two blocks are called '" + voxels.name + "'");
    read_place(voxels);
    const std::vector<int> solid = read_solid(voxels);
    const Cells cells = gathered(solid, read_fills(voxels), voxels.grid, voxels.gathering);
    if (cells.parts.empty()) fail(voxels.user + ": no cell is left of them");
    summary_ += summary_of(cells, voxels.gathering);
    if (voxels.thickness > 0)
      summary_ += resolution_of("members on the average", voxels.thickness / voxels.gathering.factor);
    io::Mesh body = cell_mesh(cells);
    shift(body, voxels.origin);
    give_names(body, voxels.name);
    bodies_.push_back(std::move(body));
  }

  // Names the block and the sets; faces that the material does not touch have no set.
  void give_names(io::Mesh& body, const std::string& name) {
    body.blocks[0].name = name;
    std::erase_if(body.node_sets, [](const io::Mesh::NodeSet& set) { return set.nodes.empty(); });
    for (io::Mesh::NodeSet& set : body.node_sets) {
      set.name = name + "_" + set.name;
      if (!set_names_.insert(set.name).second) fail("two sets are called '" + set.name + "'");
    }
  }

  void read_block(const Words& header) {
    const std::string user = "block '" + header[1] + "'";
    if (!block_names_.insert(header[1]).second) fail("two blocks are called '" + header[1] + "'");
    io::Mesh::Block& block = mesh_.blocks.emplace_back();
    block.name = header[1];
    block.type = header[2];
    const std::int64_t elements = count(header[3]);
    check_type(user, block.type, count(header[4]));
    block.nodes = indices(elements * io::nodes_per_element(block.type), user);
    if (block.type != "SPHERE") return;
    each<double>(elements, user + ", volumes", [&](double volume) {
      if (!(volume > 0) || !std::isfinite(volume)) {
        fail(user + ", element " + std::to_string(block.volumes.size()) + ": volume " + std::to_string(volume) +
             ", expected one > 0 in m³");
      }
      block.volumes.push_back(volume);
    });
  }

  void check_type(const std::string& user, const std::string& type, std::int64_t nodes) const {
    static const std::vector<std::string> types = {"HEX8", "TET4", "SPHERE"};
    if (std::find(types.begin(), types.end(), type) == types.end()) {
      fail(user + ": type '" + type + "', expected " + joined(types, " or ") + did_you_mean(type, types));
    }
    const int right = io::nodes_per_element(type);
    if (nodes == right) return;
    fail(user + ": " + type + " with " + std::to_string(nodes) + " nodes an element, expected " +
         std::to_string(right));
  }

  void read_set(const Words& header) {
    if (!set_names_.insert(header[1]).second) fail("two sets are called '" + header[1] + "'");
    mesh_.node_sets.push_back({header[1], indices(count(header[2]), "set '" + header[1] + "'")});
  }

  std::vector<int> indices(std::int64_t numbers, const std::string& user) {
    std::vector<int> nodes;
    each<std::int32_t>(numbers, user, [&](std::int32_t node) {
      if (node < 0 || node >= std::ssize(mesh_.nodes)) {
        fail(user + " refers to node " + std::to_string(node) + "; the nodes are 0 to " +
             std::to_string(std::ssize(mesh_.nodes) - 1));
      }
      nodes.push_back(node);
    });
    return nodes;
  }

  std::istream& stream_;
  std::string source_;
  std::string last_line_;
  io::Mesh mesh_;
  std::vector<io::Mesh> bodies_;  // of voxels: other parts of the stream do not count their nodes
  std::string summary_;
  std::set<std::string> block_names_, set_names_;
};

}  // namespace

io::Mesh read_arrays(std::istream& stream, const std::string& source, std::string* summary) {
  return ArraysReader(stream, source).read(summary);
}

}  // namespace strut::mesh
