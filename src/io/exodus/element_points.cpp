// Makes material points from the elements of a mesh.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "io/exodus/elements.hpp"
#include "io/exodus/mesh_points.hpp"
#include "io/exodus/side_faces.hpp"

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

bool is_of_a_body(const Symmetric& moments) {
  if (!moments.allFinite() || !(moments.head<3>().minCoeff() > 0)) return false;
  constexpr double rounding = 1 + 1e-9;
  for (int k = 0; k < 3; ++k) {  // xy, yz, zx
    if (moments[3 + k] * moments[3 + k] > rounding * moments[k] * moments[(k + 1) % 3]) return false;
  }
  return true;
}

void check_cell(const PartialCell& cell, const Mesh::Block& block, std::int64_t element, const std::string& file) {
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
  throw Error(file + ": block '" + block.name + "', element " + std::to_string(element + 1) +
              ", attributes of its cell: " + problem.str());
}

class Converter {
 public:
  Converter(const MeshSlice& slice, const std::string& file, bool with_cells)
      : slice_(slice), mesh_(slice.mesh), file_(file), with_cells_(with_cells) {}

  PointCloud convert() {
    for (const MeshLayout::NodeSet& set : slice_.layout.node_sets) cloud_.set_names.push_back(set.name);
    for (const Mesh::Block& block : mesh_.blocks) add_block(block);
    cloud_.ids = slice_.elements;
    return std::move(cloud_);
  }

 private:
  void add_block(const Mesh::Block& block) {
    cloud_.block_names.push_back(block.name);
    const std::size_t elements = block.elements();
    for (std::size_t e = 0; e < elements; ++e) {
      std::uint64_t sets = 0;
      const std::size_t size = block.nodes.size() / elements;
      for (std::size_t n = e * size; n < (e + 1) * size; ++n) sets |= slice_.sets[block.nodes[n]];
      ElementPoint point = point_of(mesh_, block, e);
      check_volume(point.volume, block, slice_.elements[cloud_.volumes.size()], file_);
      cloud_.spacings.push_back(std::cbrt(point.volume));
      if (!block.cells.empty()) {
        check_cell(block.cells[e], block, slice_.elements[cloud_.volumes.size()], file_);
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
  }

  const MeshSlice& slice_;
  const Mesh& mesh_;
  const std::string& file_;
  const bool with_cells_;
  PointCloud cloud_;
};

}  // namespace

PointCloud points_at_elements(const MeshSlice& slice, const std::string& file, bool with_cells) {
  check_corners(slice, file);
  return Converter(slice, file, with_cells).convert();
}

void add_shared_nodes(const MeshSlice& slice, const std::vector<Mirror>& planes, const std::vector<std::int64_t>& seams,
                      PointCloud& cloud) {
  for (const Mesh::Block& block : slice.mesh.blocks) {
    const std::size_t size = block.type == "SPHERE" ? 0 : nodes_per_element(block.type);
    for (std::size_t e = 0; e < block.elements(); ++e) {
      const double spacing = cloud.spacings[cloud.shared_nodes.size()];
      std::vector<std::int64_t>& shared = cloud.shared_nodes.emplace_back();
      for (std::size_t n = e * size; n < (e + 1) * size; ++n) {
        const int node = block.nodes[n];
        shared.push_back(shared_node_at(slice.mesh.nodes[node], slice.nodes[node], planes, spacing, seams[node]));
      }
      std::sort(shared.begin(), shared.end());
      shared.erase(std::unique(shared.begin(), shared.end()), shared.end());  // an element collapsed to a wedge
    }
  }
}

void add_surfaces(const MeshSlice& slice, const std::vector<Mirror>& planes, const std::vector<std::int64_t>& seams,
                  const Communicator& communicator, PointCloud& cloud, FacesOnPlanes* apart) {
  for (const Face& face : without_continued(surface_of(slice, communicator), slice, planes, seams, communicator)) {
    const std::size_t point = static_cast<std::size_t>(face.element);
    if (!slice.mesh.blocks[cloud.blocks[point]].cells.empty()) continue;
    add_face({point, planes_of(planes, face, slice.mesh), face.area,
              face.area * (face.middle(slice.mesh) - cloud.positions[point]).transpose()},
             cloud, apart);
  }
}

void check_corners(const MeshSlice& slice, const std::string& file) {
  constexpr int most = 5;
  std::ostringstream text;
  int found = 0;
  std::size_t element = 0;
  for (const Mesh::Block& block : slice.mesh.blocks) {
    for (std::size_t e = 0; e < block.elements(); ++e, ++element) {
      if (block.type != "HEX8") continue;
      const std::array<Vector, 8> nodes = corners<8>(slice.mesh, block, e);
      const int corner = folded_corner(nodes);
      if (corner < 0 || !(hexahedron(nodes).volume > 0)) continue;  // inverted elements are reported by their volume
      if (++found > most) break;
      text << (found == 1 ? "" : ", ") << slice.elements[element] + 1 << " of block '" << block.name << "' (corner "
           << corner + 1 << ")";
    }
  }
  if (found == 0) return;
  throw Error(file + ": hexahedra that are folded at a corner (its Jacobian is negative): element " + text.str() +
              (found > most ? ", …" : "") +
              "; expected corners whose edges are right-handed (nodes in another order?)");
}

void check_volume(double volume, const Mesh::Block& block, std::int64_t element, const std::string& file) {
  if (volume > 0 && std::isfinite(volume)) return;
  throw Error(text_of(file, ": block '", block.name, "', element ", element + 1, ": volume ", volume,
                      " m³, expected a positive one (inside out, flat or damaged?)"));
}

}  // namespace strut::io
