// The elements of a mesh become material points.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "base/errors.hpp"
#include "io/exodus/elements.hpp"
#include "io/exodus/mesh_points.hpp"
#include "io/exodus/surface.hpp"

namespace strut::io {

namespace {

ElementPoint point_of(const Mesh& mesh, const Mesh::Block& block, std::size_t element) {
  if (block.type == "HEX8") return hexahedron(corners<8>(mesh, block, element));
  if (block.type == "TET4") return tetrahedron(corners<4>(mesh, block, element));
  return {mesh.nodes[block.nodes[element]], block.volumes[element]};
}

Symmetric moments_of(const Mesh& mesh, const Mesh::Block& block, std::size_t element) {
  if (block.type == "HEX8") return hexahedron_moments(corners<8>(mesh, block, element));
  if (block.type == "TET4") return tetrahedron_moments(corners<4>(mesh, block, element));
  return cube_moments(block.volumes[element]);
}

std::vector<std::int64_t> joints_of(const Mesh::Block& block, std::size_t element) {
  if (block.type == "SPHERE") return {};
  const std::size_t size = block.nodes.size() / block.elements();
  const auto first = block.nodes.begin() + static_cast<std::ptrdiff_t>(element * size);
  std::vector<std::int64_t> joints(first, first + static_cast<std::ptrdiff_t>(size));
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());  // an element that is collapsed to a wedge
  return joints;
}

bool is_of_a_body(const Symmetric& moments) {
  if (!moments.allFinite() || !(moments.head<3>().minCoeff() > 0)) return false;
  constexpr double rounding = 1 + 1e-9;
  for (int k = 0; k < 3; ++k) {  // xy, yz, zx
    if (moments[3 + k] * moments[3 + k] > rounding * moments[k] * moments[(k + 1) % 3]) return false;
  }
  return true;
}

void check_cell(const PartialCell& cell, const Mesh::Block& block, std::size_t number, const std::string& file) {
  std::ostringstream problem;
  if (!(cell.volume > 0) || !std::isfinite(cell.volume)) {
    problem << "volume " << cell.volume << " m³, expected a positive one";
  } else if (!cell.centroid.allFinite() || !cell.surface.allFinite() || !cell.surface_moments.allFinite()) {
    problem << "centroid (" << cell.centroid.transpose() << ") m and surface (" << cell.surface.transpose()
            << ") m², expected finite numbers";
  } else if (!is_of_a_body(cell.moments)) {
    problem << "moments xx yy zz xy yz zx (" << cell.moments.transpose()
            << ") m², which no body has: expected xx, yy and zz > 0, xy² ≤ xx·yy and so on";
  } else {
    return;
  }
  throw Error(file + ": block '" + block.name + "', element " + std::to_string(number) +
              ", attributes of its cell: " + problem.str());
}

// The whole mesh as one cloud.
class Converter {
 public:
  Converter(const Mesh& mesh, const std::string& file, bool with_cells)
      : mesh_(mesh), file_(file), with_cells_(with_cells), node_sets_(sets_of_nodes(mesh)) {}

  PointCloud convert() {
    for (const Mesh::NodeSet& set : mesh_.node_sets) cloud_.set_names.push_back(set.name);
    for (const Mesh::Block& block : mesh_.blocks) add_block(block);
    cloud_.ids.resize(cloud_.volumes.size());
    std::iota(cloud_.ids.begin(), cloud_.ids.end(), 0);
    if (with_cells_) add_surface();
    return std::move(cloud_);
  }

 private:
  void add_block(const Mesh::Block& block) {
    cloud_.block_names.push_back(block.name);
    const std::size_t elements = block.elements();
    for (std::size_t e = 0; e < elements; ++e) {
      std::uint64_t sets = 0;
      const std::size_t size = block.nodes.size() / elements;
      for (std::size_t n = e * size; n < (e + 1) * size; ++n) sets |= node_sets_[block.nodes[n]];
      ElementPoint point = point_of(mesh_, block, e);
      check_volume(point.volume, block, cloud_.volumes.size() + 1, file_);
      cloud_.spacings.push_back(std::cbrt(point.volume));
      if (!block.cells.empty()) {
        check_cell(block.cells[e], block, cloud_.volumes.size() + 1, file_);
        point = {block.cells[e].centroid, block.cells[e].volume};
      }
      add_point(point, sets);
      if (with_cells_) add_cell(block, e);
    }
  }

  void add_point(const ElementPoint& point, std::uint64_t sets) {
    cloud_.positions.push_back(point.centroid);
    cloud_.volumes.push_back(point.volume);
    cloud_.blocks.push_back(static_cast<int>(cloud_.block_names.size()) - 1);
    cloud_.sets.push_back(sets);
  }

  void add_cell(const Mesh::Block& block, std::size_t element) {
    CellShape& shape = cloud_.shapes.emplace_back();
    if (block.cells.empty()) {
      shape.moments = moments_of(mesh_, block, element);
    } else {
      shape.moments = block.cells[element].moments;
      shape.surface = block.cells[element].surface;
      shape.surface_moments = block.cells[element].surface_moments;
    }
    cloud_.joints.push_back(joints_of(block, element));
  }

  // Of whole elements: a cell brings its own.
  void add_surface() {
    for (const Face& face : surface_of(mesh_)) {
      const std::size_t point = static_cast<std::size_t>(face.element);
      if (!mesh_.blocks[cloud_.blocks[point]].cells.empty()) continue;
      CellShape& shape = cloud_.shapes[point];
      shape.surface += face.area;
      shape.surface_moments += face.area * (face.middle(mesh_) - cloud_.positions[point]).transpose();
    }
  }

  const Mesh& mesh_;
  const std::string& file_;
  const bool with_cells_;
  PointCloud cloud_;
  std::vector<std::uint64_t> node_sets_;
};

}  // namespace

PointCloud points_at_elements(const Mesh& mesh, const std::string& file, bool with_cells) {
  return Converter(mesh, file, with_cells).convert();
}

std::vector<std::uint64_t> sets_of_nodes(const Mesh& mesh) {
  std::vector<std::uint64_t> sets(mesh.nodes.size(), 0);
  for (std::size_t k = 0; k < mesh.node_sets.size(); ++k) {
    for (const int node : mesh.node_sets[k].nodes) sets[node] |= std::uint64_t{1} << k;
  }
  return sets;
}

void check_volume(double volume, const Mesh::Block& block, std::size_t number, const std::string& file) {
  if (volume > 0 && std::isfinite(volume)) return;
  throw Error(file + ": block '" + block.name + "', element " + std::to_string(number) + ": volume " +
              std::to_string(volume) + " m³, expected a positive one (inside out, flat or damaged?)");
}

}  // namespace strut::io
