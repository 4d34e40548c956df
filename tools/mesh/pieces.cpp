#include "mesh/pieces.hpp"

#include <algorithm>
#include <utility>

#include "base/union_find.hpp"

namespace strut::mesh {

namespace {

using Triple = Eigen::Array3i;

// Voxels and their neighbors both ascend, so that one pass over the list finds all without an array of the grid's size.
std::vector<Upper> upper_neighbors(const std::vector<int>& voxels, const VoxelGrid& grid) {
  std::vector<Upper> upper(voxels.size(), {-1, -1, -1});
  const Upper stride = {1, grid.cells[0], grid.cells[0] * grid.cells[1]};
  for (int axis = 0; axis < 3; ++axis) {
    std::size_t ahead = 0;
    for (std::size_t v = 0; v < voxels.size(); ++v) {
      if (grid.cell(voxels[v])[axis] + 1 == grid.cells[axis]) continue;
      const int wanted = voxels[v] + stride[axis];
      while (ahead < voxels.size() && voxels[ahead] < wanted) ++ahead;
      if (ahead < voxels.size() && voxels[ahead] == wanted) upper[v][axis] = static_cast<int>(ahead);
    }
  }
  return upper;
}

// For each voxel the fullest one with a common face, -1: none is fuller than it is.
std::vector<int> fullest_neighbors(const std::vector<double>& fills, const std::vector<Upper>& upper) {
  std::vector<int> fullest(upper.size(), -1);
  const auto offer = [&](int to, int other) {
    if (fills[other] > (fullest[to] < 0 ? fills[to] : fills[fullest[to]])) fullest[to] = other;
  };
  for (int v = 0; v < static_cast<int>(upper.size()); ++v) {
    for (const int w : upper[v]) {
      if (w < 0) continue;
      offer(v, w);
      offer(w, v);
    }
  }
  return fullest;
}

// Grey voxels less than half full are the surface of struts, and are connected only to their fullest neighbor: two
// struts whose surfaces meet remain separate.
std::vector<Upper> joined_neighbors(const std::vector<double>& fills, std::vector<Upper> upper) {
  if (fills.empty()) return upper;
  const std::vector<int> fullest = fullest_neighbors(fills, upper);
  for (int v = 0; v < static_cast<int>(upper.size()); ++v) {
    for (int& w : upper[v]) {
      if (w < 0 || (fills[v] >= 0.5 && fills[w] >= 0.5) || fullest[v] == w || fullest[w] == v) continue;
      w = -1;
    }
  }
  return upper;
}

Vector lower_corner(const VoxelGrid& grid, int place) {
  return grid.cell(place).cast<double>() * grid.spacing().array();
}

// Sums over the voxels of a piece, in voxels from the lower corner of its cell: exact for whole voxels.
struct Sums {
  double filled = 0;
  Vector first = Vector::Zero();
  Tensor second = Tensor::Zero();

  void add(const Triple& at, double fill) {
    const Vector x = at.cast<double>();
    filled += fill;
    first += fill * x;
    second += fill * x * x.transpose();
  }
  void put_into(io::PartialCell& part, const Vector& corner, const Vector& h) const {
    const Vector mean = first / filled;
    const Tensor central = second / filled - mean * mean.transpose() + Tensor::Identity() / 12;  // with that of a voxel
    part.volume = filled * h.prod();
    part.centroid = corner + Vector((mean.array() + 0.5) * h.array());
    part.moments = symmetric_part(h.asDiagonal() * central * h.asDiagonal());
  }
};

std::vector<int> places_of(const Material& material, const VoxelGrid& coarse, int factor) {
  std::vector<int> places;
  places.reserve(material.voxels.size());
  for (const int voxel : material.voxels) {
    const Triple at = material.grid.cell(voxel) / factor;
    places.push_back(coarse.index(at[0], at[1], at[2]));
  }
  return places;
}

void set_volumes(const Material& material, const VoxelGrid& coarse, int factor, Pieces& pieces) {
  std::vector<Sums> sums(pieces.list.size());
  for (int v = 0; v < material.size(); ++v) {
    if (pieces.of[v] < 0) continue;
    const Triple corner = factor * coarse.cell(pieces.list[pieces.of[v]].place);
    sums[pieces.of[v]].add(material.grid.cell(material.voxels[v]) - corner, material.fill(v));
  }
  for (std::size_t p = 0; p < sums.size(); ++p) {
    Piece& piece = pieces.list[p];
    piece.part = {};
    piece.filled = sums[p].filled;
    sums[p].put_into(piece.part, lower_corner(coarse, piece.place), material.grid.spacing());
  }
}

// The surface between two voxels with different fills belongs to the emptier one, through which it runs. Dropped voxels
// are void: unconnected grey ones can have common faces with kept ones.
void add_surfaces(const Material& material, Pieces& pieces) {
  const Vector h = material.grid.spacing();
  std::vector<std::array<bool, 3>> has_lower(material.voxels.size(), {false, false, false});
  // `side`: 0 or 1, the face of voxel v across the axis.
  const auto add = [&](int v, int axis, double outward, int side) {
    io::PartialCell& part = pieces.list[pieces.of[v]].part;
    Vector at = material.grid.cell(material.voxels[v]).cast<double>() + 0.5;
    at[axis] += side - 0.5;
    const double area = outward * h.prod() / h[axis];
    part.surface[axis] += area;
    part.surface_moments.row(axis) += area * (at.cwiseProduct(h) - part.centroid).transpose();
  };
  const auto is_kept = [&](int v) { return v >= 0 && pieces.of[v] >= 0; };
  for (int v = 0; v < material.size(); ++v) {
    for (int axis = 0; axis < 3 && is_kept(v); ++axis) {
      const int w = material.beyond(v, axis);
      if (is_kept(w)) has_lower[w][axis] = true;
    }
  }
  for (int v = 0; v < material.size(); ++v) {
    if (!is_kept(v)) continue;
    const double fill = material.fill(v);
    for (int axis = 0; axis < 3; ++axis) {
      if (!has_lower[v][axis]) add(v, axis, -fill, 0);
      const int w = material.beyond(v, axis);
      const double beyond = is_kept(w) ? material.fill(w) : 0;
      const bool is_in_upper = is_kept(w) && beyond < fill;
      add(is_in_upper ? w : v, axis, fill - beyond, is_in_upper ? 0 : 1);
    }
  }
}

}  // namespace

int Material::beyond(int v, int axis) const {
  if (!grid.periodic[axis] || grid.cell(voxels[v])[axis] + 1 < grid.cells[axis]) return upper[v][axis];
  const int stride = axis == 0 ? 1 : axis == 1 ? grid.cells[0] : grid.cells[0] * grid.cells[1];
  const int wanted = voxels[v] - (grid.cells[axis] - 1) * stride;
  const auto place = std::lower_bound(voxels.begin(), voxels.end(), wanted);
  return place != voxels.end() && *place == wanted ? static_cast<int>(place - voxels.begin()) : -1;
}

Material material_of(const std::vector<int>& voxels, const std::vector<double>& fills, const VoxelGrid& grid) {
  const std::vector<Upper> upper = upper_neighbors(voxels, grid);
  return {voxels, fills, grid, upper, joined_neighbors(fills, upper)};
}

Pieces connected_within(const Material& material, const VoxelGrid& coarse, int factor) {
  const std::vector<int> places = places_of(material, coarse, factor);
  UnionFind groups(material.voxels.size());
  for (int v = 0; v < material.size(); ++v) {
    for (const int w : material.joined[v]) {
      if (w >= 0 && places[v] == places[w]) groups.join(v, w);
    }
  }
  std::vector<std::pair<int, int>> firsts;  // position and first voxel of each piece
  for (int v = 0; v < material.size(); ++v) {
    if (groups.first(v) == v) firsts.emplace_back(places[v], v);
  }
  std::sort(firsts.begin(), firsts.end());
  Pieces pieces;
  pieces.of.resize(material.voxels.size());
  for (const auto& [place, first] : firsts) {
    pieces.of[first] = static_cast<int>(pieces.list.size());
    pieces.list.push_back({place});
  }
  for (int v = 0; v < material.size(); ++v) pieces.of[v] = pieces.of[groups.first(v)];
  return pieces;
}

void measure(const Material& material, const VoxelGrid& coarse, int factor, Pieces& pieces) {
  set_volumes(material, coarse, factor, pieces);
  add_surfaces(material, pieces);
}

std::vector<std::set<int>> links_of(const Material& material, const Pieces& pieces) {
  std::vector<std::set<int>> links(pieces.list.size());
  for (int v = 0; v < material.size(); ++v) {
    for (const int w : material.joined[v]) {
      if (w < 0 || pieces.of[v] < 0 || pieces.of[v] == pieces.of[w]) continue;
      links[pieces.of[v]].insert(pieces.of[w]);
      links[pieces.of[w]].insert(pieces.of[v]);
    }
  }
  return links;
}

void renumber(Pieces& pieces) {
  std::vector<char> used(pieces.list.size(), 0);
  for (const int piece : pieces.of) {
    if (piece >= 0) used[piece] = 1;
  }
  std::vector<std::pair<int, int>> order;  // position and piece
  for (int p = 0; p < static_cast<int>(used.size()); ++p) {
    if (used[p]) order.emplace_back(pieces.list[p].place, p);
  }
  std::sort(order.begin(), order.end());
  std::vector<int> number(used.size(), -1);
  std::vector<Piece> list;
  for (const auto& [place, piece] : order) {
    number[piece] = static_cast<int>(list.size());
    list.push_back(pieces.list[piece]);
  }
  pieces.list = std::move(list);
  for (int& piece : pieces.of) piece = piece < 0 ? -1 : number[piece];
}

void absorb(io::PartialCell& part, const io::PartialCell& other) {
  const double volume = part.volume + other.volume;
  const double a = part.volume / volume, b = other.volume / volume;
  const Vector apart = other.centroid - part.centroid;
  part.moments = a * part.moments + b * other.moments + a * b * symmetric_part(apart * apart.transpose());
  // Relative to the common centroid, which is b · apart from the first one and −a · apart from the other.
  part.surface_moments += other.surface_moments + (a * other.surface - b * part.surface) * apart.transpose();
  part.centroid += b * apart;
  part.volume = volume;
  part.surface += other.surface;
}

}  // namespace strut::mesh
