#include "mesh/body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <numbers>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "io/exodus/elements.hpp"
#include "mesh/cells.hpp"
#include "mesh/foam.hpp"
#include "mesh/section.hpp"

namespace strut::mesh {

namespace {

constexpr double most_cells = 1e8;
constexpr double most_sparse_voxels = 1e9;  // of a foam or lattice, most of them void: 4 bytes each

// The radius at zmax divided by that at zmin.
double taper_of(const Body& body) { return body.shape == Body::Shape::cone ? body.top_radius / body.radius : 1; }

// Mean area of cross-sections whose width grows linearly by factors from `a` to `b`, relative to that at factor 1.
double mean_square(double a, double b) { return (a * a + a * b + b * b) / 3; }

double exact_volume(const Body& body) {
  if (body.shape == Body::Shape::box) return body.size.prod();
  return std::numbers::pi * body.radius * body.radius * body.length * mean_square(1, taper_of(body));
}

double height(const Body& body) { return body.shape == Body::Shape::box ? body.size.z() : body.length; }

// True if it consists of struts or sheets in a box.
bool has_members(const Body& body) { return body.shape == Body::Shape::foam || body.shape == Body::Shape::lattice; }

void check_cells(const Body& body, const Vector& extent) {
  const int factor = std::max(1, body.cells);
  const bool is_sparse = body.cells > 0 && has_members(body);
  const double most = is_sparse ? most_sparse_voxels : most_cells;
  const Vector cells = extent / body.spacing;
  if (cells.maxCoeff() * factor <= most && (cells.cwiseMax(1) * factor).prod() <= most) return;
  throw Error("body '" + body.name + "' would have more than " + (is_sparse ? "10⁹ " : "10⁸ ") +
              (body.cells > 0 ? "voxels" : "cells") + ": the spacing is too small");
}

void check_size(const Body& body) {
  const double across = 2 * std::max(body.radius, body.top_radius);
  check_cells(body, body.shape == Body::Shape::box ? body.size : Vector(across, across, body.length));
  // Cubes of a lattice have the thickness of a layer, which must be close to the requested spacing.
  if (body.shape != Body::Shape::box && body.length < body.spacing / 2) {
    throw Error("body '" + body.name + "' is shorter than half a cell: the spacing is too large");
  }
}

Section section_of(const Body& body, double layer) {
  if (body.shape == Body::Shape::box) return rectangle(body.size.x(), body.size.y(), body.spacing);
  // The cells of a cone have the requested width at half height.
  if (body.method == Body::Method::fitted) return fitted_disc(body.radius, layer / (0.5 + 0.5 * taper_of(body)));
  return lattice_disc(body.radius, layer, body.centered);  // cubes: the fitted spacing in the plane, too
}

// A section extruded between faces at these heights; `taper`: its width at the last over that at the first.
io::Mesh extruded(const Section& section, const std::vector<double>& levels, double taper) {
  const VoxelGrid grid{Vector::Zero(), {section.n, section.m, static_cast<int>(levels.size()) - 1}};
  std::vector<int> cells;
  for (int n = 0; n < static_cast<int>(grid.count()); ++n) {
    const Eigen::Array3i at = grid.cell(n);
    if (section.keeps(at[0], at[1])) cells.push_back(n);
  }
  return voxel_mesh(cells, grid, [&](const Eigen::Array3i& at) -> Vector {
    const double level = levels[at[2]], w = 1 + (taper - 1) * (level / levels.back());
    const Point p = w * section.place(at[0], at[1]);
    return {p.x(), p.y(), level};
  });
}

std::string thickness_of(const std::vector<double>& levels) {
  const std::size_t layers = levels.size() - 1;
  const double first = levels[1] - levels[0], last = levels[layers] - levels[layers - 1];
  if (last < 1.000001 * first) return text_of(levels.back() / static_cast<double>(layers), " m");
  return text_of(first, " to ", last, " m");
}

const char* shape_name(const Body& body) {
  if (body.shape == Body::Shape::box) return "box";
  return body.shape == Body::Shape::cone ? "cone" : "cylinder";
}

std::string summary_of(const Body& body, const Section& section, const std::vector<double>& levels) {
  const std::size_t layers = levels.size() - 1;
  std::size_t cells = 0;
  double area = 0;
  double smallest = INFINITY;
  for (int n = 0; n < section.n * section.m; ++n) {
    const int i = n % section.n, j = n / section.n;
    if (!section.keeps(i, j)) continue;
    ++cells;
    area += section.area(i, j);
    smallest = std::min(smallest, section.area(i, j));
  }
  const double taper = taper_of(body);
  area *= mean_square(1, taper);
  smallest *= std::min(1.0, taper * taper);
  const double mean = area / static_cast<double>(cells), volume = area * height(body), exact = exact_volume(body);
  const char* const method = body.method == Body::Method::fitted       ? "fitted"
                             : body.shape == Body::Shape::box          ? "lattice"
                             : body.centered == Body::Centered::corner ? "lattice, axis through a corner"
                                                                       : "lattice, axis through a point";
  return text_of(body.name, ": ", shape_name(body), ", ", method, ": ", cells * layers, " points = ", cells,
                 " in a layer x ", layers, " layers\n  spacing along z ", thickness_of(levels),
                 ", root of the mean area of a cell ", std::sqrt(mean), " m, of the smallest ", std::sqrt(smallest),
                 " m (asked for ", body.spacing, ")\n  volume ", volume, " m^3, exact ", exact, " m^3 (", std::fixed,
                 std::showpos, std::setprecision(3), 100 * (volume / exact - 1), " %)\n");
}

// A horizon in parts of the root of a cell's volume, such as 3.015, loses the neighbors at whole spacings along a
// longer edge; the shear moduli then depend on the direction by more than they do on a lattice of cubes.
std::string note_on_stretch(const Body& body) {
  if (body.shape != Body::Shape::box || body.grading > 1) return "";
  const Vector h = grid_of(body.size, body.spacing, 1).spacing();
  const double stretch = h.maxCoeff() / std::cbrt(h.prod());
  if (stretch < 1.005) return "";
  return text_of("  note: cells of ", h[0], " ", h[1], " ", h[2],
                 " m: a Horizon Factor of 3.015 counts the root of their volume, and loses neighbors at 3 spacings\n");
}

// Bodies have distinct names, but blocks and sets of a file may have the names of others.
template <class Item>
void check_new(const std::vector<Item>& items, const std::vector<Item>& more, const std::string& what) {
  for (const Item& item : more) {
    if (std::ranges::find(items, item.name, &Item::name) == items.end()) continue;
    throw Error("two " + what + " are called '" + item.name + "': give a body from a file a 'name' of its own");
  }
}

io::Mesh extruded(const Body& body, std::string& summary) {
  check_size(body);
  const std::vector<double> levels = levels_of(body, height(body));
  // Cells of a uniform cylinder are as wide as its layers are thick; with growing layers they have the spacing.
  const double across = body.grading > 1 ? body.spacing : height(body) / static_cast<double>(levels.size() - 1);
  const Section section = section_of(body, across);
  summary = summary_of(body, section, levels) + note_on_stretch(body);
  io::Mesh mesh = extruded(section, levels, taper_of(body));
  if (body.shape != Body::Shape::box) mesh.node_sets.resize(2);  // zmin and zmax
  return mesh;
}

// The voxels whose center is in the body: all for a box, or those of a cylinder around the center of the grid.
std::vector<int> voxels_in(const Body& body, const VoxelGrid& grid) {
  std::vector<int> voxels;
  const Vector h = grid.spacing();
  for (int n = 0; n < static_cast<int>(grid.count()); ++n) {
    const Vector x = (grid.cell(n).cast<double>() + 0.5) * h.array() - grid.size.array() / 2;
    if (body.shape == Body::Shape::box || x.head<2>().norm() <= body.radius) voxels.push_back(n);
  }
  return voxels;
}

// The grid of a cylinder: cubes, with a corner or a center on the axis.
VoxelGrid grid_around(const Body& body) {
  if (body.shape == Body::Shape::box) return grid_of(body.size, body.spacing, body.cells);
  const int layers = std::max(1, static_cast<int>(std::lround(body.length / body.spacing)));
  const double h = body.length / layers;
  const int across = cells_across(body.radius, h, body.centered);
  return {{across * h, across * h, body.length}, body.cells * Eigen::Array3i(across, across, layers)};
}

io::Mesh gathered_body(const Body& body, std::string& summary) {
  check_size(body);
  const VoxelGrid grid = grid_around(body);
  const std::vector<int> voxels = voxels_in(body, grid);
  if (voxels.empty()) throw Error("body '" + body.name + "' holds no voxel: the spacing is too large");
  const Gathering gathering{body.cells, body.smallest_cell};
  const Cells cells = gathered(voxels, {}, grid, gathering);
  const Vector h = cells.grid.spacing();
  summary = text_of(body.name, ": ", shape_name(body), " in cells of ", h[0], " ", h[1], " ", h[2], " m (asked for ",
                    body.spacing, "), exact volume ", exact_volume(body), " m^3\n") +
            summary_of(cells, gathering);
  io::Mesh mesh = cell_mesh(cells);
  if (body.shape == Body::Shape::cylinder) shift(mesh, {-grid.size[0] / 2, -grid.size[1] / 2, 0});
  return mesh;
}

io::Mesh read_body(const Body& body, std::string& summary) {
  io::Mesh mesh = io::read_mesh(body.file);
  if (body.named && mesh.blocks.size() != 1) {
    throw Error("body '" + body.name + "': " + body.file.string() + " has " + std::to_string(mesh.blocks.size()) +
                " blocks, which keep their names: leave out the key 'name'");
  }
  summary = body.name + ": the mesh " + body.file.string() + "\n";
  for (const io::Mesh::Block& block : mesh.blocks) {
    summary += "  block " + block.name + ": " + std::to_string(block.elements()) + " points\n";
  }
  return mesh;
}

io::Mesh shaped(const Body& body, std::string& summary) {
  if (body.shape == Body::Shape::file) return read_body(body, summary);
  if (has_members(body)) {
    check_cells(body, body.size);
    return body.shape == Body::Shape::foam ? foam_mesh(body, summary) : lattice_mesh(body, summary);
  }
  return body.cells > 0 ? gathered_body(body, summary) : extruded(body, summary);
}

// A sphere for each hexahedron, in the sets that any of its nodes is in: the same points.
io::Mesh spheres_of(const io::Mesh& hexahedra) {
  io::Mesh mesh;
  io::Mesh::Block& block = mesh.blocks.emplace_back();
  block.type = "SPHERE";
  const std::vector<int>& corners = hexahedra.blocks[0].nodes;
  for (std::size_t corner = 0; corner < corners.size(); corner += 8) {
    std::array<Vector, 8> nodes;
    for (std::size_t k = 0; k < 8; ++k) nodes[k] = hexahedra.nodes[corners[corner + k]];
    const io::ElementPoint point = io::hexahedron(nodes);
    block.nodes.push_back(static_cast<int>(mesh.nodes.size()));
    block.volumes.push_back(point.volume);
    mesh.nodes.push_back(point.centroid);
  }
  for (const io::Mesh::NodeSet& set : hexahedra.node_sets) {
    std::vector<char> marked(hexahedra.nodes.size(), 0);
    for (const int node : set.nodes) marked[node] = 1;
    io::Mesh::NodeSet& own = mesh.node_sets.emplace_back(io::Mesh::NodeSet{set.name, {}});
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      const int sphere = static_cast<int>(corner / 8);
      if (marked[corners[corner]] && (own.nodes.empty() || own.nodes.back() != sphere)) own.nodes.push_back(sphere);
    }
  }
  return mesh;
}

}  // namespace

io::Mesh mesh_of(const Body& body, std::string& summary) {
  io::Mesh mesh = shaped(body, summary);
  shift(mesh, body.origin);
  if (body.elements == Body::Elements::spheres) mesh = spheres_of(mesh);
  if (body.shape == Body::Shape::file && !body.named) return mesh;
  mesh.blocks[0].name = body.name;
  for (auto& set : mesh.node_sets) set.name = body.name + "_" + set.name;
  return mesh;
}

void shift(io::Mesh& mesh, const Vector& by) {
  for (Vector& node : mesh.nodes) node += by;
  for (io::Mesh::Block& block : mesh.blocks) {
    for (io::PartialCell& part : block.cells) part.centroid += by;
  }
}

void append(io::Mesh& mesh, const io::Mesh& body) {
  check_new(mesh.blocks, body.blocks, "blocks");
  check_new(mesh.node_sets, body.node_sets, "node sets");
  const int shift = static_cast<int>(mesh.nodes.size());
  const auto shifted = [&](std::vector<int> nodes) {
    for (int& node : nodes) node += shift;
    return nodes;
  };
  mesh.nodes.insert(mesh.nodes.end(), body.nodes.begin(), body.nodes.end());
  for (io::Mesh::Block block : body.blocks) {
    block.nodes = shifted(std::move(block.nodes));
    mesh.blocks.push_back(std::move(block));
  }
  for (const io::Mesh::NodeSet& set : body.node_sets) mesh.node_sets.push_back({set.name, shifted(set.nodes)});
}

io::Mesh mesh_of(const std::vector<Body>& bodies, std::string& summary) {
  io::Mesh mesh;
  for (const Body& body : bodies) {
    std::string of_body;
    append(mesh, mesh_of(body, of_body));
    summary += of_body;
  }
  if (bodies.size() == 1 && bodies[0].shape != Body::Shape::file) {  // sets begin with zmin and zmax
    mesh.node_sets.push_back({"foot", mesh.node_sets[0].nodes});
    mesh.node_sets.push_back({"top", mesh.node_sets[1].nodes});
  }
  return mesh;
}

}  // namespace strut::mesh
