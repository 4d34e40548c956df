#include "io/exodus/mesh_slice.hpp"

#include <algorithm>
#include <utility>

#include "base/parallel/gather_scatter.hpp"
#include "io/on_root.hpp"
#include "io/slices.hpp"

namespace strut::io {

namespace {

static_assert(largest_portion % 8 == 0);  // portions begin and end with elements of 8, 4 and 1 nodes

class SliceReader {
 public:
  SliceReader(const MeshSource* file, const MeshLayout& layout, const Communicator& communicator)
      : file_(file), communicator_(communicator), ranks_(communicator.size()) {
    slice_.layout = layout;
    for (const MeshLayout::Block& block : layout.blocks) slice_.mesh.blocks.push_back({block.name, block.type, {}, {}});
  }

  MeshSlice read(bool around_nodes) {
    const std::vector<MeshSource::Place> places = places_of_nodes();
    const std::vector<std::uint64_t> sets = sets_of_nodes();
    std::int64_t first = 0;
    for (std::size_t b = 0; b < slice_.layout.blocks.size(); ++b) {
      read_block(b, first, around_nodes);
      first += slice_.layout.blocks[b].elements;
    }
    number_nodes();
    take_nodes(places, sets);
    return std::move(slice_);
  }

 private:
  // Reads this rank's slice of the nodes.
  std::vector<MeshSource::Place> places_of_nodes() {
    return dealt<MeshSource::Place>(slice_counts(slice_.layout.nodes, ranks_),
                                    [this](std::int64_t begin, auto values) { file_->places(begin, values); });
  }

  std::vector<std::uint64_t> sets_of_nodes() {
    const std::int64_t first = slice_begin(slice_.layout.nodes, ranks_, communicator_.rank());
    const std::int64_t end = slice_begin(slice_.layout.nodes, ranks_, communicator_.rank() + 1);
    std::vector<std::uint64_t> sets(static_cast<std::size_t>(end - first), 0);
    OnRoot on_root(communicator_);
    for (std::size_t k = 0; k < slice_.layout.node_sets.size(); ++k) {
      const auto count = static_cast<std::size_t>(slice_.layout.node_sets[k].nodes);
      for (std::size_t begin = 0; begin < count; begin += largest_portion) {
        std::vector<int> nodes(std::min(largest_portion, count - begin));
        on_root([&] { file_->nodes_of_set(k, static_cast<std::int64_t>(begin), nodes); });
        communicator_.broadcast(nodes);
        for (const int node : nodes) {
          if (node >= first && node < end) sets[static_cast<std::size_t>(node - first)] |= std::uint64_t{1} << k;
        }
      }
    }
    on_root.raise();
    return sets;
  }

  // `first`: the block's first element in the file. For now, its nodes are stored by their indices in the file.
  void read_block(std::size_t b, std::int64_t first, bool around_nodes) {
    const MeshLayout::Block& layout = slice_.layout.blocks[b];
    Mesh::Block& block = slice_.mesh.blocks[b];
    const std::vector<std::int64_t> counts = counts_in_slices(first, layout.elements);
    const int size = nodes_per_element(layout.type);
    std::vector<std::int64_t> nodes_counts = counts;
    for (std::int64_t& count : nodes_counts) count *= size;
    block.nodes =
        dealt<int>(nodes_counts, [&](std::int64_t begin, auto nodes) { file_->nodes_of_block(b, begin, nodes); });
    std::vector<std::int64_t> elements(
        static_cast<std::size_t>(counts[static_cast<std::size_t>(communicator_.rank())]));
    std::int64_t element = std::max(first, slice_begin(slice_.layout.elements, ranks_, communicator_.rank()));
    for (std::int64_t& one : elements) one = element++;
    if (around_nodes) {
      bring_to_nodes(size, block.nodes, elements);
    } else {
      read_values(b, counts, block);
    }
    slice_.elements.insert(slice_.elements.end(), elements.begin(), elements.end());
  }

  // The number of a block's elements in the slice of each rank.
  std::vector<std::int64_t> counts_in_slices(std::int64_t first, std::int64_t elements) const {
    std::vector<std::int64_t> counts;
    for (int rank = 0; rank < ranks_; ++rank) {
      const std::int64_t begin = std::max(first, slice_begin(slice_.layout.elements, ranks_, rank));
      const std::int64_t end = std::min(first + elements, slice_begin(slice_.layout.elements, ranks_, rank + 1));
      counts.push_back(std::max<std::int64_t>(0, end - begin));
    }
    return counts;
  }

  void read_values(std::size_t b, const std::vector<std::int64_t>& counts, Mesh::Block& block) {
    if (block.type == "SPHERE") {
      block.volumes =
          dealt<double>(counts, [&](std::int64_t begin, auto values) { file_->sphere_volumes(b, begin, values); });
    }
    if (!slice_.layout.blocks[b].partly_filled) return;
    block.cells.resize(block.elements());
    for (std::size_t k = 0; k < partial_cell_attributes.size(); ++k) {
      const std::vector<double> values = dealt<double>(
          counts, [&](std::int64_t begin, auto attribute) { file_->cell_attribute(b, k, begin, attribute); });
      for (std::size_t e = 0; e < values.size(); ++e) member(block.cells[e], k) = values[e];
    }
  }

  // Sends elements to the ranks whose slices contain any of their nodes.
  void bring_to_nodes(int size, std::vector<int>& nodes, std::vector<std::int64_t>& elements) const {
    std::vector<int> ranks, ranks_of_nodes;
    std::vector<std::size_t> leaving;  // element to send
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const auto before = std::ssize(ranks);
      for (int n = 0; n < size; ++n) {
        const int rank = slice_owner(slice_.layout.nodes, ranks_, nodes[e * size + n]);
        if (std::find(ranks.begin() + before, ranks.end(), rank) != ranks.end()) continue;
        ranks.push_back(rank), leaving.push_back(e);
        ranks_of_nodes.insert(ranks_of_nodes.end(), size, rank);
      }
    }
    elements = Routes(communicator_, ranks).there([&](int k) { return elements[leaving[k]]; });
    nodes =
        Routes(communicator_, ranks_of_nodes).there([&](int k) { return nodes[leaving[k / size] * size + k % size]; });
  }

  // Numbers the nodes of the mesh's elements in the order of the file. Nodes belong to several elements: duplicates
  // within a portion are removed at once.
  void number_nodes() {
    std::vector<std::int64_t>& used = slice_.nodes;
    const auto tidy = [&used](std::size_t begin) {
      const auto from = used.begin() + static_cast<std::ptrdiff_t>(begin);
      std::sort(from, used.end());
      used.erase(std::unique(from, used.end()), used.end());
    };
    for (const Mesh::Block& block : slice_.mesh.blocks) {
      const std::span<const int> nodes(block.nodes);
      for (std::size_t n = 0; n < nodes.size(); n += largest_portion) {
        const auto portion = nodes.subspan(n, std::min(largest_portion, nodes.size() - n));
        const std::size_t before = used.size();
        used.insert(used.end(), portion.begin(), portion.end());
        tidy(before);
      }
    }
    tidy(0);
    used.shrink_to_fit();
    for (Mesh::Block& block : slice_.mesh.blocks) {
      for (int& node : block.nodes) {
        node = static_cast<int>(std::lower_bound(used.begin(), used.end(), node) - used.begin());
      }
    }
  }

  // Gets the nodes from the ranks whose slices contain them.
  void take_nodes(const std::vector<MeshSource::Place>& places, const std::vector<std::uint64_t>& sets) {
    const Slices owners(communicator_, slice_.nodes, slice_.layout.nodes);
    const std::int64_t first = slice_begin(slice_.layout.nodes, ranks_, communicator_.rank());
    const auto fetched = [&]<class T>(const std::vector<T>& own) {
      std::vector<T> asked_for, values(slice_.nodes.size());
      for (const std::int64_t node : owners.ids()) asked_for.push_back(own[static_cast<std::size_t>(node - first)]);
      owners.rows_from_slices<T>(asked_for, 1, values);
      return values;
    };
    for (const MeshSource::Place& place : fetched(places)) slice_.mesh.nodes.emplace_back(place.data());
    slice_.sets = fetched(sets);
  }

  // Sends each rank its part of a list of the file (scatterv); throws errors on all ranks.
  template <class T, class Read>
  std::vector<T> dealt(const std::vector<std::int64_t>& counts, const Read& read) const {
    OnRoot on_root(communicator_);
    std::vector<T> mine = scatterv<T>(
        communicator_, counts, [&](std::int64_t begin, std::span<T> values) { on_root([&] { read(begin, values); }); });
    on_root.raise();
    return mine;
  }

  const MeshSource* file_;
  const Communicator& communicator_;
  const int ranks_;
  MeshSlice slice_;
};

}  // namespace

MeshSlice slice_of_elements(const MeshSource* file, const MeshLayout& layout, const Communicator& communicator) {
  return SliceReader(file, layout, communicator).read(false);
}

MeshSlice elements_around_slice(const MeshSource* file, const MeshLayout& layout, const Communicator& communicator) {
  return SliceReader(file, layout, communicator).read(true);
}

MeshLayout broadcast_layout(const MeshLayout& layout, const Communicator& communicator) {
  std::vector<std::string> names;  // of blocks, their types, then sets
  std::vector<std::int64_t> numbers{layout.nodes, layout.elements, std::ssize(layout.blocks)};
  for (const MeshLayout::Block& block : layout.blocks) {
    names.insert(names.end(), {block.name, block.type});
    numbers.insert(numbers.end(), {block.elements, block.partly_filled ? 1 : 0});
  }
  for (const MeshLayout::NodeSet& set : layout.node_sets) {
    names.push_back(set.name);
    numbers.push_back(set.nodes);
  }
  names = broadcast_names(names, communicator);
  communicator.broadcast(numbers);
  MeshLayout all;
  all.nodes = numbers[0], all.elements = numbers[1];
  const auto blocks = static_cast<std::size_t>(numbers[2]);
  for (std::size_t b = 0; b < blocks; ++b) {
    all.blocks.push_back({names[2 * b], names[2 * b + 1], numbers[3 + 2 * b], numbers[4 + 2 * b] != 0});
  }
  for (std::size_t k = 2 * blocks; k < names.size(); ++k) all.node_sets.push_back({names[k], numbers[3 + k]});
  return all;
}

}  // namespace strut::io
