// Makes hexahedra from cells; they share nodes where the material of the cells is connected.
#include <algorithm>
#include <iomanip>

#include "base/text.hpp"
#include "base/union_find.hpp"
#include "mesh/cells.hpp"

namespace strut::mesh {

namespace {

using Triple = Eigen::Array3i;

// Corner `k` of the n-th cell has the number 8 n + k until nodes are numbered.
UnionFind joined_corners(const Cells& cells) {
  UnionFind corners(8 * cells.places.size());
  for (const auto& [a, b] : cells.contacts) {
    const Triple apart = cells.grid.cell(cells.places[b]) - cells.grid.cell(cells.places[a]);
    for (int k = 0; k < 8; ++k) {
      for (int l = 0; l < 8; ++l) {
        if ((hexahedron_corners[k] == apart + hexahedron_corners[l]).all()) corners.join(8 * a + k, 8 * b + l);
      }
    }
  }
  return corners;
}

void add_hexahedra(io::Mesh& mesh, const Cells& cells) {
  UnionFind corners = joined_corners(cells);
  std::vector<int> numbers(8 * cells.places.size(), -1);
  for (std::size_t n = 0; n < cells.places.size(); ++n) {
    for (int k = 0; k < 8; ++k) {
      int& number = numbers[corners.first(static_cast<int>(8 * n) + k)];
      if (number < 0) {
        const Triple at = cells.grid.cell(cells.places[n]) + hexahedron_corners[k];
        number = static_cast<int>(mesh.nodes.size());
        mesh.nodes.emplace_back(at.cast<double>() * cells.grid.spacing().array());
        add_to_sets(mesh, number, at, cells.grid.cells);
      }
      mesh.blocks[0].nodes.push_back(number);
    }
  }
}

}  // namespace

std::vector<std::vector<int>> neighbors_of(const Cells& cells) {
  UnionFind corners = joined_corners(cells);
  std::vector<std::vector<int>> users(8 * cells.places.size());
  for (int corner = 0; corner < static_cast<int>(users.size()); ++corner) {
    users[corners.first(corner)].push_back(corner / 8);
  }
  std::vector<std::vector<int>> neighbors(cells.places.size());
  for (const std::vector<int>& around : users) {
    for (const int a : around) {
      for (const int b : around) {
        if (a != b) neighbors[a].push_back(b);
      }
    }
  }
  for (std::vector<int>& near : neighbors) {
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
  }
  return neighbors;
}

io::Mesh cell_mesh(const Cells& cells) {
  io::Mesh mesh = empty_mesh();
  mesh.blocks[0].cells = cells.parts;
  add_hexahedra(mesh, cells);
  return mesh;
}

std::string summary_of(const Cells& cells, const Gathering& gathering) {
  const double kept = cells.volume();
  const double lost = cells.dropped == 0 ? 0 : cells.dropped_volume / (cells.dropped_volume + kept);
  const int n = gathering.factor;
  const Triple& places = cells.grid.cells;
  return text_of(
      "  ", n, " x ", n, " x ", n, " voxels to a cell: ", cells.parts.size(), " cells in ", places[0], " x ", places[1],
      " x ", places[2], " places, volume ", kept, " m^3\n  pieces of less than ", gathering.smallest,
      " of a cell: ", cells.merged, " merged into neighbors, ", cells.small, " kept that alone join others,\n    ",
      cells.dropped, " without neighbors dropped (", std::setprecision(3), 100 * lost,
      " % of the volume)\n  cells whose neighbors hardly span space: ", cells.cut, " cut in two layers, ",
      cells.flat_merged, " merged,\n    ", cells.flat, " kept that a run by quadratic correspondence leaves out (",
      100 * cells.flat_volume / kept, " % of the volume)\n");
}

}  // namespace strut::mesh
