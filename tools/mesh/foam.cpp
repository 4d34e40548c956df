#include "mesh/foam.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/errors.hpp"
#include "mechanics/expected_error.hpp"
#include "mesh/cells.hpp"
#include "mesh/voxels.hpp"

namespace strut::mesh {

namespace {

constexpr double fewest_voxels_in_a_cell = 4;  // per foam cell diameter: fewer cannot resolve struts and pores
constexpr double thin = 8;                     // voxels: thinner struts should not be stairs
constexpr double too_much = 1.05;              // times the wanted density: the pieces connected too late

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
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

// Struts thinner than a voxel are disconnected until the radius connects them, and then there are too many voxels.
void check(const Body& body, const Struts& struts, std::size_t wanted) {
  if (static_cast<double>(struts.voxels.size()) <= too_much * static_cast<double>(wanted)) return;
  throw Error("body '" + body.name +
              "': struts of this relative density would be thinner than the voxels; in one piece they are " +
              number(2 * struts.radius / body.spacing) + " spacings thick and have " +
              number(static_cast<double>(struts.voxels.size()) / static_cast<double>(wanted)) +
              " times the density: take a smaller spacing or larger cells");
}

std::string summary_of(const Body& body, const VoxelGrid& grid, const Skeleton& skeleton, const Struts& struts) {
  double length = 0;
  std::size_t edges = 0;
  for (const Edge& edge : skeleton.edges) {
    const double part = length_within(edge, grid.size);
    length += part;
    edges += part > 0 ? 1 : 0;
  }
  const double points = static_cast<double>(struts.voxels.size());
  const double thickness = 2 * struts.radius;
  const Vector h = grid.spacing();
  char text[1000];
  std::snprintf(text, sizeof text,
                "%s: open-cell foam, irregularity %g, seed %llu: %.0f %s of %d x %d x %d voxels\n"
                "  relative density %.6g (asked for %g) in one piece; %zu other pieces of %zu points in all dropped\n"
                "  %zu cells (seeds in the box), %zu edges in the box, their length %.6g m in all\n"
                "  struts %.4g spacings = %.4g m thick; spacing %.6g %.6g %.6g m (asked for %g)\n",
                body.name.c_str(), body.irregularity, static_cast<unsigned long long>(body.seed), points,
                body.cells > 0 ? "voxels" : "points", grid.cells[0], grid.cells[1], grid.cells[2],
                points / static_cast<double>(grid.count()), body.relative_density, struts.dropped_pieces,
                struts.dropped_voxels, skeleton.cells, edges, length, thickness / std::cbrt(h.prod()), thickness, h[0],
                h[1], h[2], body.spacing);
  if (body.cells > 0 || thickness >= thin * body.spacing) return text;
  return std::string(text) +
         "  note: struts so thin are stairs of whole voxels; by 'cells = 6' errors of their stiffness are some " +
         std::to_string(times_by_stairs) + " times smaller\n";
}

// The body in voxels, if these are gathered in cells.
Body drawn(Body body) {
  if (body.cells > 0) body.spacing /= body.cells;
  return body;
}

io::Mesh gathered_mesh(const Body& body, const Struts& struts, const VoxelGrid& grid, std::string& summary) {
  const Gathering gathering{body.cells, body.smallest_cell};
  const Cells cells = gathered(struts.voxels, {}, grid, gathering);
  summary += summary_of(cells, gathering);
  summary += resolution_of("struts", 2 * struts.radius / std::cbrt(cells.grid.spacing().prod()));
  return cell_mesh(cells);
}

}  // namespace

io::Mesh foam_mesh(const Body& body, std::string& summary) {
  const Body fine = drawn(body);
  check(fine);
  const VoxelGrid grid = grid_of(body.size, body.spacing, std::max(1, body.cells));
  const Skeleton skeleton = foam_skeleton(body.size, body.cell, body.irregularity, body.seed);
  const auto wanted = static_cast<std::size_t>(std::llround(body.relative_density * static_cast<double>(grid.count())));
  const Struts struts = struts_around(skeleton.edges, grid, wanted);
  check(fine, struts, wanted);
  summary = summary_of(fine, grid, skeleton, struts);
  if (body.cells > 0) return gathered_mesh(body, struts, grid, summary);
  return voxel_mesh(struts.voxels, grid);
}

std::string resolution_of(const std::string& members, double cells) {
  char text[100];
  std::snprintf(text, sizeof text, "  %s %.4g cells thick: by quadratic correspondence expect ", members.c_str(),
                cells);
  return text + expected_error_text(cells, "in the plateau, where metal flows") + " (docs/resolution.md)\n";
}

}  // namespace strut::mesh
