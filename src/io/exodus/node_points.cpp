// Makes material points from the nodes of a mesh, with parts of the elements around them.
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "io/exodus/elements.hpp"
#include "io/exodus/mesh_points.hpp"
#include "io/exodus/surface.hpp"

namespace strut::io {

namespace {

// Sums of the elements around a node, in the order of the file.
struct NodeSum {
  double volume = 0;  // m³, the node's parts of the elements
  double around = 0;  // m³, of the whole elements
  int elements = 0;
  int block = -1;                             // block of the first of them
  std::vector<std::pair<int, double>> taken;  // m³, from elements of other blocks
  std::vector<std::int64_t> numbers;          // of the elements
};

class NodeSums {
 public:
  NodeSums(const MeshSlice& slice, const std::string& file)
      : slice_(slice), mesh_(slice.mesh), file_(file), sums_(slice.nodes.size()) {}

  std::vector<NodeSum> gatherv() {
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      const Mesh::Block& block = mesh_.blocks[b];
      if (block.type == "HEX8") add_block<8>(static_cast<int>(b), hexahedron_parts);
      if (block.type == "TET4") add_block<4>(static_cast<int>(b), tetrahedron_parts);
    }
    return std::move(sums_);
  }

 private:
  template <std::size_t size, class Parts>
  void add_block(int index, const Parts& parts_of) {
    // A cube around each node: in a body there are as many hexahedra as nodes, but six times as many tetrahedra.
    constexpr double cells = size == 4 ? 6 : 1;
    const Mesh::Block& block = mesh_.blocks[index];
    for (std::size_t e = 0; e < block.elements(); ++e) {
      const std::array<double, size> parts = parts_of(corners<size>(mesh_, block, e));
      double volume = 0;
      for (const double part : parts) volume += part;
      const std::int64_t element = slice_.elements[elements_++];
      check_volume(volume, block, element, file_);
      for (std::size_t n = 0; n < size; ++n) {
        NodeSum& sum = sums_[block.nodes[e * size + n]];
        sum.volume += parts[n];
        sum.around += cells * volume;
        ++sum.elements;
        if (sum.block < 0) sum.block = index;
        if (sum.block != index) sum.taken.emplace_back(index, parts[n]);
        if (sum.numbers.empty() || sum.numbers.back() != element) sum.numbers.push_back(element);
      }
    }
  }

  const MeshSlice& slice_;
  const Mesh& mesh_;
  const std::string& file_;
  std::vector<NodeSum> sums_;
  std::size_t elements_ = 0;  // processed so far
};

// The cell of each node, made of parts of the elements around it.
class Cells {
 public:
  Cells(const MeshSlice& slice, const std::vector<Mirror>& planes)
      : mesh_(slice.mesh),
        integrals_(slice.nodes.size()),
        surface_(slice.nodes.size(), Vector::Zero()),
        surface_moments_(slice.nodes.size(), Tensor::Zero()) {
    for (const Mesh::Block& block : mesh_.blocks) {
      if (block.type == "HEX8") add_block<8>(block, hexahedron_pieces);
      if (block.type == "TET4") add_block<4>(block, tetrahedron_pieces);
    }
    for (const Face& face : surface_of(mesh_)) {
      const std::uint32_t bits = planes_of(planes, face, mesh_);
      const Vector part = 1.0 / static_cast<double>(face.corners().size()) * face.area;
      for (std::size_t c = 0; c < face.corners().size(); ++c) {
        const auto node = static_cast<std::size_t>(face.nodes[c]);
        const Tensor moments = part * (face.middle_at(mesh_, c) - mesh_.nodes[node]).transpose();
        if (bits == 0) {
          surface_[node] += part, surface_moments_[node] += moments;
        } else {
          on_planes_[node].push_back({0, bits, part, moments});
        }
      }
    }
  }

  // The volume of the parts; for distorted elements it differs slightly from the point's volume ∫N dV.
  double volume(std::size_t node) const { return integrals_[node].volume; }

  void give(std::size_t node, PointCloud& cloud, FacesOnPlanes* apart) {
    cloud.shapes.push_back(cell_shape(integrals_[node]));
    cloud.shapes.back().surface = surface_[node];
    cloud.shapes.back().surface_moments = surface_moments_[node];
    if (const auto found = on_planes_.find(node); found != on_planes_.end()) {
      for (FaceOnPlanes& face : found->second) face.point = cloud.shapes.size() - 1, add_face(face, cloud, apart);
    }
  }

 private:
  template <std::size_t size, class Pieces>
  void add_block(const Mesh::Block& block, const Pieces& pieces_of) {
    for (std::size_t e = 0; e < block.elements(); ++e) {
      const std::array<Integrals, size> pieces = pieces_of(corners<size>(mesh_, block, e));
      for (std::size_t n = 0; n < size; ++n) integrals_[block.nodes[e * size + n]] += pieces[n];
    }
  }

  const Mesh& mesh_;
  std::vector<Integrals> integrals_;
  std::vector<Vector> surface_;
  std::vector<Tensor> surface_moments_;
  std::map<std::size_t, std::vector<FaceOnPlanes>> on_planes_;  // by node: parts of faces
};

void check_parts(double volume, std::int64_t number, const std::string& file) {
  if (volume > 0) return;
  throw Error(text_of(file, ": node ", number, ": its parts of the elements around it add up to ", volume,
                      " m³, expected a positive volume (elements too distorted?)"));
}

}  // namespace

PointCloud elements_of(const MeshSlice& slice, const NodeRange& own) {
  PointCloud cloud;
  std::size_t element = 0;
  for (std::size_t b = 0; b < slice.mesh.blocks.size(); ++b) {
    const Mesh::Block& block = slice.mesh.blocks[b];
    cloud.block_names.push_back(block.name);
    for (std::size_t e = 0; e < block.elements(); ++e, ++element) {
      const auto size = static_cast<std::size_t>(nodes_per_element(block.type));
      const std::int64_t first = slice.nodes[block.nodes[e * size]];
      if (first < own.begin || first >= own.end) continue;
      const ElementPoint point = block.type == "HEX8" ? hexahedron(corners<8>(slice.mesh, block, e))
                                                      : tetrahedron(corners<4>(slice.mesh, block, e));
      cloud.ids.push_back(slice.elements[element]), cloud.element_ids.push_back(slice.elements[element] + 1);
      cloud.positions.push_back(point.centroid), cloud.volumes.push_back(point.volume);
      cloud.blocks.push_back(static_cast<int>(b));
    }
  }
  return cloud;
}

PointCloud points_at_nodes(const MeshSlice& slice, const NodeRange& own, const std::vector<std::int64_t>& numbers,
                           const std::string& file, bool with_cells, const std::vector<Mirror>& planes,
                           FacesOnPlanes* apart) {
  check_corners(slice, file);
  std::vector<NodeSum> sums = NodeSums(slice, file).gatherv();
  std::optional<Cells> cells;
  if (with_cells) cells.emplace(slice, planes);
  PointCloud cloud;
  cloud.at = PointsAt::nodes;
  for (const MeshLayout::Block& block : slice.layout.blocks) cloud.block_names.push_back(block.name);
  for (const MeshLayout::NodeSet& set : slice.layout.node_sets) cloud.set_names.push_back(set.name);
  cloud.taken_volumes.assign(cloud.block_names.size() * cloud.block_names.size(), 0);
  for (std::size_t n = 0; n < sums.size(); ++n) {
    if (slice.nodes[n] < own.begin || slice.nodes[n] >= own.end) continue;
    NodeSum& sum = sums[n];
    const std::int64_t number = numbers[static_cast<std::size_t>(slice.nodes[n] - own.begin)];
    check_parts(sum.volume, number, file);
    if (with_cells) {
      check_parts(cells->volume(n), number, file);
      cells->give(n, cloud, apart);
    }
    for (const auto& [block, volume] : sum.taken) {
      cloud.taken_volumes[sum.block * cloud.block_names.size() + block] += volume;
    }
    cloud.ids.push_back(slice.nodes[n]);
    cloud.element_ids.push_back(number);
    cloud.positions.push_back(slice.mesh.nodes[n]);
    cloud.volumes.push_back(sum.volume);
    cloud.spacings.push_back(std::cbrt(sum.around / sum.elements));
    cloud.blocks.push_back(sum.block);
    cloud.sets.push_back(slice.sets[n]);
    cloud.shared_nodes.push_back(std::move(sum.numbers));
  }
  return cloud;
}

}  // namespace strut::io
