#include "mesh/arrays.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <sstream>

#include "base/errors.hpp"

namespace strut::mesh {

namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are little-endian and read as they are");

constexpr const char* magic = "strut-mesh arrays 1";
constexpr std::size_t longest_line = 1000;
constexpr std::size_t chunk = 1 << 16;  // numbers that are read at once
constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();

using Words = std::vector<std::string>;

class ArraysReader {
 public:
  ArraysReader(std::istream& stream, std::string source) : stream_(stream), source_(std::move(source)) {}

  io::Mesh read() {
    if (line() != magic) fail(std::string("it does not begin with the line '") + magic + "'");
    read_nodes(words());
    for (Words header = words(); header[0] != "end"; header = words()) read_part(header);
    if (stream_.peek() != std::istream::traits_type::eof()) fail("there are data after 'end'");
    const auto filled = [](const io::Mesh::Block& block) { return !block.nodes.empty(); };
    if (std::none_of(mesh_.blocks.begin(), mesh_.blocks.end(), filled)) fail("the mesh has no elements");
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(source_ + ": " + what); }

  // Without its end; what is longer than any header is data that a wrong count has left.
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

  // Calls take(number) for each of the next `numbers`.
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
    expected("'block NAME TYPE COUNT NPE', 'set NAME COUNT' or 'end'");
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
  std::set<std::string> block_names_, set_names_;
};

}  // namespace

io::Mesh read_arrays(std::istream& stream, const std::string& source) { return ArraysReader(stream, source).read(); }

}  // namespace strut::mesh
