#include "mesh/foam.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numeric>
#include <sstream>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "mechanics/expected_error.hpp"
#include "mesh/cells.hpp"
#include "mesh/lattices.hpp"
#include "mesh/voxels.hpp"

namespace strut::mesh {

namespace {

constexpr double fewest_voxels_in_a_cell = 4;  // per foam cell diameter: fewer cannot resolve struts and pores
constexpr double thin = 8;                     // voxels: thinner struts should not be stairs
constexpr double too_much = 1.05;              // times the wanted density: the pieces connected too late

std::string number(double value) { return text_of(std::setprecision(4), value); }

double volume_of(const Struts& struts) {
  if (struts.fills.empty()) return static_cast<double>(struts.voxels.size());
  return std::accumulate(struts.fills.begin(), struts.fills.end(), 0.0);
}

void check(const Body& body) {
  if (body.cell < fewest_voxels_in_a_cell * body.spacing) {
    throw Error("body '" + body.name + "': a cell of " + number(body.cell) + " m has fewer than 4 spacings of " +
                number(body.spacing) + " m across");
  }
  if (body.size.minCoeff() < body.cell) {
    throw Error("body '" + body.name + "': the box is smaller than a cell of " + number(body.cell) + " m");
  }
}

// Struts thinner than a voxel are disconnected until the radius connects them, and then there are too many voxels. In a
// regular skeleton many voxels are equally far from the edges, and whole ones come together.
void check(const Body& body, const Struts& struts, std::size_t wanted) {
  if (volume_of(struts) <= too_much * static_cast<double>(wanted)) return;
  const bool is_thin = !body.is_solid() && 2 * struts.radius < body.spacing;
  throw Error("body '" + body.name + "': " +
              (is_thin ? "struts of this relative density would be thinner than the voxels"
                       : "many voxels are equally far from the edges and come together") +
              "; in one piece they " +
              (body.is_solid() ? "" : "are " + number(2 * struts.radius / body.spacing) + " spacings thick and ") +
              "have " + number(volume_of(struts) / static_cast<double>(wanted)) +
              " times the density: take a smaller spacing" +
              (is_thin ? " or larger cells" : ", or 'cells = 6', which holds them in part"));
}

std::string summary_of(const Body& body, const VoxelGrid& grid, const Skeleton& skeleton, const Struts& struts) {
  double length = 0;
  std::size_t edges = 0;
  for (const Edge& edge : skeleton.edges) {
    const double part = length_within(edge, grid.size);
    length += part;
    edges += part > 0 ? 1 : 0;
  }
  const double thickness = 2 * struts.radius;
  const Vector h = grid.spacing();
  const std::string text = text_of(
      body.name, ": open-cell foam, irregularity ", body.irregularity, ", seed ", body.seed, ": ", struts.voxels.size(),
      body.cells > 0 ? " voxels of " : " points of ", grid.cells[0], " x ", grid.cells[1], " x ", grid.cells[2],
      " voxels\n  relative density ", volume_of(struts) / static_cast<double>(grid.count()), " (asked for ",
      body.relative_density, ") in one piece; ", struts.dropped_pieces, " other pieces of ", struts.dropped_voxels,
      " points in all dropped\n  ", skeleton.cells, " cells (seeds in the box), ", edges,
      " edges in the box, their length ", length, " m in all\n  struts ", number(thickness / std::cbrt(h.prod())),
      " spacings = ", number(thickness), " m thick; spacing ", h[0], " ", h[1], " ", h[2], " m (asked for ",
      body.spacing, ")\n");
  if (body.cells > 0 || thickness >= thin * body.spacing) return text;
  return text_of(
      text, "  note: struts so thin are stairs of whole voxels; by 'cells = 6' errors of their stiffness are some ",
      times_by_stairs, " times smaller\n");
}

// The body in voxels, if these are gathered in cells.
Body drawn(Body body) {
  if (body.cells > 0) body.spacing /= body.cells;
  return body;
}

// Whole voxels at one level are kept or left out together; cells hold them in part.
Struts as_meshed(const Body& body, Struts struts) {
  if (body.cells == 0) struts.fills.clear();
  return struts;
}

bool is_periodic(const Body& body) { return body.periodic[0] || body.periodic[1] || body.periodic[2]; }

// A lattice repeats after whole cells.
void check_periods(const Body& body) {
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = body.size[axis] / body.cell;
    if (!body.periodic[axis] || std::abs(cells - std::round(cells)) < 1e-6 * cells) continue;
    throw Error("body '" + body.name + "': periodic along " + "xyz"[axis] + ", but " + number(cells) + " cells of " +
                number(body.cell) + " m long: expected a whole number of cells");
  }
}

std::string axes_of(const Body& body) {
  std::string text = is_periodic(body) ? ", periodic along" : "";
  for (int axis = 0; axis < 3; ++axis) text += body.periodic[axis] ? std::string(" ") + "xyz"[axis] : "";
  return text;
}

// The lines on sizes, stretch, periods and sections, where the recipe asks for them.
std::string summary_of_more(const Body& body, const Skeleton& skeleton) {
  std::string text;
  if (body.sizes > 0 || body.relax > 0 || body.stretch != Vector::Ones() || is_periodic(body)) {
    text += "  volumes of the cells: standard deviation " + number(100 * skeleton.scatter) +
            " % of their mean; stretched by " + number(skeleton.stretch[0]) + " " + number(skeleton.stretch[1]) + " " +
            number(skeleton.stretch[2]) + axes_of(body) + "\n";
  }
  if (body.node_thickness > 1 || body.three_cornered) {
    text += std::string("  ") + (body.three_cornered ? "three-cornered" : "round") +
            " struts: the thickness is that of a circle as large as the section in the middle; at nodes " +
            number(body.node_thickness) + " times that\n";
  }
  return text;
}

io::Mesh mesh_of_members(const Body& body, const Struts& struts, const std::string& members, const VoxelGrid& grid,
                         std::string& summary) {
  if (body.cells == 0) return voxel_mesh(struts.voxels, grid);
  const Gathering gathering{body.cells, body.smallest_cell};
  const Cells cells = gathered(struts.voxels, struts.fills, grid, gathering);
  summary += summary_of(cells, gathering);
  if (struts.radius > 0) summary += resolution_of(members, 2 * struts.radius / std::cbrt(cells.grid.spacing().prod()));
  return cell_mesh(cells);
}

VoxelGrid grid_of_body(const Body& body) {
  VoxelGrid grid = grid_of(body.size, body.spacing, std::max(1, body.cells));
  grid.periodic = body.periodic;
  return grid;
}

std::size_t wanted_of(const Body& body, const VoxelGrid& grid) {
  return static_cast<std::size_t>(std::llround(body.relative_density * static_cast<double>(grid.count())));
}

std::string summary_of_lattice(const Body& body, const VoxelGrid& grid, const Struts& struts) {
  const Vector count = body.size / body.cell, h = grid.spacing();
  std::ostringstream text;
  text.precision(6);
  text << body.name << ": " << body.lattice << " lattice, " << count.transpose() << " cells of " << body.cell << " m"
       << axes_of(body) << ": " << struts.voxels.size() << (body.cells > 0 ? " voxels of " : " points of ")
       << grid.cells.transpose() << "\n  relative density " << volume_of(struts) / static_cast<double>(grid.count());
  if (body.relative_density > 0) text << " (asked for " << body.relative_density << ")";
  text << " in one piece; " << struts.dropped_pieces << " other pieces of " << struts.dropped_voxels
       << " in all dropped\n";
  text << "  ";
  if (has_struts(body.lattice)) text << lattice_cell(body.lattice).size() << " struts a cell, ";
  if (!body.is_solid())
    text << 2 * struts.radius / std::cbrt(h.prod()) << " voxels = " << 2 * struts.radius << " m thick; ";
  text << "spacing " << h.transpose() << " m\n";
  return text.str();
}

Struts lattice_members(const Body& body, const VoxelGrid& grid) {
  const bool struts = has_struts(body.lattice);
  const StrutShape shape{.node = body.node_thickness};
  const auto edges = [&] { return lattice_edges(body.lattice, body.size, body.cell); };
  if (body.thickness > 0) {
    const double half = body.thickness / 2;
    return largest_piece_below(
        struts ? strut_levels(edges(), shape, grid, half) : field_levels(surface_field(body.lattice, body.cell), grid),
        grid, half);
  }
  if (struts) return struts_around(edges(), grid, wanted_of(body, grid), shape);
  return largest_piece(field_levels(surface_field(body.lattice, body.cell), grid), grid, wanted_of(body, grid),
                       grid.spacing().minCoeff());
}

}  // namespace

io::Mesh lattice_mesh(const Body& body, std::string& summary) {
  const Body fine = drawn(body);
  check(fine);
  check_periods(body);
  const VoxelGrid grid = grid_of_body(body);
  Struts struts = as_meshed(body, lattice_members(body, grid));
  if (body.relative_density > 0) check(fine, struts, wanted_of(body, grid));
  summary = summary_of_lattice(fine, grid, struts);
  if (body.is_solid()) struts.radius = 0;  // a value of the field
  return mesh_of_members(body, struts, has_struts(body.lattice) ? "struts" : "sheets", grid, summary);
}

io::Mesh foam_mesh(const Body& body, std::string& summary) {
  const Body fine = drawn(body);
  check(fine);
  const VoxelGrid grid = grid_of_body(body);
  const Skeleton skeleton = foam_skeleton(
      body.size, {body.cell, body.irregularity, body.seed, body.sizes, body.relax, body.stretch, is_periodic(body)});
  const std::size_t wanted = wanted_of(body, grid);
  const StrutShape shape{.node = body.node_thickness, .three_cornered = body.three_cornered};
  const Struts struts = as_meshed(body, struts_around(skeleton.edges, grid, wanted, shape));
  check(fine, struts, wanted);
  summary = summary_of(fine, grid, skeleton, struts) + summary_of_more(body, skeleton);
  return mesh_of_members(body, struts, "struts", grid, summary);
}

std::string resolution_of(const std::string& members, double cells) {
  return text_of("  ", members, " ", number(cells), " cells thick: by quadratic correspondence expect ",
                 expected_error_text(cells, "in the plateau, where metal flows"), " (docs/resolution.md)\n");
}

}  // namespace strut::mesh
