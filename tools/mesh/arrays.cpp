#include "mesh/arrays.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <limits>

#include "base/errors.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"
#include "mesh/body.hpp"
#include "mesh/cells.hpp"
#include "mesh/foam.hpp"

namespace strut::mesh {

namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are little-endian and read as they are");

constexpr const char* magic = "strut-mesh arrays 1";
constexpr std::size_t longest_line = 1000;
constexpr std::int64_t chunk = 1 << 16;  // numbers per read
constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t most_voxels = most / 8;  // solid ones: the corners of cells are counted
constexpr int most_factor = 16;

// Takes bodies and their numbers one after the other.
class ArraysReader {
 public:
  ArraysReader(std::istream& stream, const std::string& source) : stream_(stream), source_(source) {}

  io::Mesh read(std::string* summary) {
    if (line() != magic) fail(std::string("it does not begin with the line '") + magic + "'");
    if (line() != "nodes 0") fail("expected the line 'nodes 0', then voxels");
    io::Mesh mesh;
    for (std::string header = line(); header != "end"; header = line()) append(mesh, read_voxels(header));
    if (stream_.peek() != std::istream::traits_type::eof()) fail("there are data after 'end'");
    if (mesh.blocks.empty()) fail("the mesh has no elements");
    if (summary != nullptr) *summary = summary_;
    return mesh;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(source_ + ": " + what); }
  [[noreturn]] void fail_here(const std::string& what) const { fail(user_ + what); }

  // The next line without its end; text longer than any header is data left over by a wrong count.
  std::string line() {
    std::string text;
    char c = 0;
    while (text.size() < longest_line && stream_.get(c) && c != '\n') text.push_back(c);
    if (!stream_) fail(text.empty() ? "it ends where a line was expected ('end' closes it)" : "it ends within a line");
    return text;
  }

  template <class Number>
  std::vector<Number> numbers(std::int64_t count) {
    std::vector<Number> found;
    for (std::int64_t done = 0; done < count; done = std::ssize(found)) {
      found.resize(std::min(count, done + chunk));
      const std::size_t bytes = (found.size() - done) * sizeof(Number);
      if (!stream_.read(reinterpret_cast<char*>(&found[done]), static_cast<std::streamsize>(bytes))) {
        const std::int64_t got = done + stream_.gcount() / static_cast<std::int64_t>(sizeof(Number));
        fail_here(text_of(": it ends after ", got, " of ", count, " numbers"));
      }
    }
    return found;
  }

  // The number that a word of a header is.
  template <class Number>
  Number number(const std::string& word, Number low, Number high, const std::string& what) const {
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc() && end == word.data() + word.size() && value >= low && value <= high) return value;
    fail_here(text_of(": ", what, " is '", word, "', expected ", low, " to ", high));
  }

  std::vector<std::string> words_of(const std::string& header) const {
    const std::vector<std::string> words = to_words(header);
    if ((words.size() == 9 || words.size() == 10) && words[0] == "voxels") return words;
    std::string shown = header.substr(0, 60);
    std::ranges::replace_if(
        shown, [](char c) { return c < ' ' || c > '~'; }, '?');
    fail("expected 'voxels NAME COUNT NX NY NZ N SMALLEST KIND [THICKNESS]' or 'end', found '" + shown + "'");
  }

  VoxelGrid grid_of(const std::vector<std::string>& words) const {
    VoxelGrid grid;
    std::int64_t all = 1;
    for (int axis = 0; axis < 3; ++axis) {
      grid.cells[axis] = number(words[3 + axis], 1, static_cast<int>(most / all), "the box's size in voxels");
      all *= grid.cells[axis];
    }
    return grid;
  }

  // Sets the grid's size, and returns the lower corner of the box.
  Vector read_place(VoxelGrid& grid) {
    const std::vector<double> place = numbers<double>(6);
    const Vector edges(place.data()), origin(place.data() + 3);
    grid.size = edges.array() * grid.cells.cast<double>();
    if (edges.minCoeff() > 0 && edges.prod() > 0 && grid.size.allFinite() && origin.allFinite()) return origin;
    fail_here(": expected three edges of a voxel > 0 and the lower corner of the box, in m");
  }

  std::vector<int> read_solid(std::int64_t count, const VoxelGrid& grid) {
    const std::vector<std::int32_t> places = numbers<std::int32_t>(3 * count);
    std::vector<int> solid;
    for (std::int64_t v = 0; v < count; ++v) {
      const Eigen::Array3i at(&places[3 * v]);
      if ((at < 0).any() || (at >= grid.cells).any()) fail_here(text_of(", voxel ", v, " is not in the box"));
      const int index = grid.index(at[0], at[1], at[2]);
      if (!solid.empty() && index <= solid.back()) {
        fail_here(text_of(", voxel ", v, " is out of order: x runs fastest, z slowest"));
      }
      solid.push_back(index);
    }
    return solid;
  }

  std::vector<double> read_fills(const std::string& kind, std::int64_t count) {
    if (kind != "solid" && kind != "grey") fail_here(" are '" + kind + "', expected solid or grey");
    std::vector<double> fills = numbers<double>(kind == "grey" ? count : 0);
    const auto wrong = std::ranges::find_if_not(fills, [](double fill) { return fill > 0 && fill <= 1; });
    if (wrong == fills.end()) return fills;
    fail_here(text_of(", voxel ", wrong - fills.begin(), ": a part of ", *wrong, " is solid, expected one > 0 to 1"));
  }

  io::Mesh read_voxels(const std::string& header) {
    const std::vector<std::string> words = words_of(header);
    user_ = "voxels '" + words[1] + "'";
    const auto count = number<std::int64_t>(words[2], 0, most_voxels, "their number");
    VoxelGrid grid = grid_of(words);
    const Gathering gathering = {number(words[6], 1, most_factor, "their number along an edge of a cell"),
                                 number(words[7], 0.0, 0.9, "the smallest cell")};
    const double thickness = words.size() == 10 ? number(words[9], 1e-3, 1e9, "the thickness in voxels") : 0;
    const Vector origin = read_place(grid);
    const std::vector<int> solid = read_solid(count, grid);
    const Cells cells = gathered(solid, read_fills(words[8], count), grid, gathering);
    if (cells.parts.empty()) fail_here(": no cell is left of them");
    summary_ += summary_of(cells, gathering);
    if (thickness > 0) summary_ += resolution_of("members on the average", thickness / gathering.factor);
    io::Mesh body = cell_mesh(cells);
    shift(body, origin);
    body.blocks[0].name = words[1];
    // Faces that the material does not touch have no set.
    std::erase_if(body.node_sets, [](const io::Mesh::NodeSet& set) { return set.nodes.empty(); });
    for (io::Mesh::NodeSet& set : body.node_sets) set.name = words[1] + "_" + set.name;
    return body;
  }

  std::istream& stream_;
  const std::string& source_;
  std::string user_;  // of the data that are read, for messages
  std::string summary_;
};

}  // namespace

io::Mesh read_arrays(std::istream& stream, const std::string& source, std::string* summary) {
  return ArraysReader(stream, source).read(summary);
}

}  // namespace strut::mesh
