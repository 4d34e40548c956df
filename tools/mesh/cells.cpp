#include "mesh/cells.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "mesh/groups.hpp"

namespace strut::mesh {

namespace {

using Triple = Eigen::Array3i;
using Upper = std::array<int, 3>;  // a voxel's neighbours along x, y, z as places in the list, -1: void

// What is solid: voxels by their places in a list.
struct Material {
  const std::vector<int>& voxels;
  const std::vector<double>& fills;
  const VoxelGrid& grid;
  std::vector<Upper> upper;
  std::vector<Upper> joined;  // the same, where they hang together

  double fill(int voxel) const { return fills.empty() ? 1 : fills[voxel]; }
  int size() const { return static_cast<int>(voxels.size()); }
};

// Both the voxels and their neighbours ascend, so that one walk along the list finds all; no array of the grid's size.
std::vector<Upper> upper_neighbours(const std::vector<int>& voxels, const VoxelGrid& grid) {
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

// For each voxel the fullest one that it has a face in common with, -1: none is fuller than it is.
std::vector<int> fullest_neighbours(const std::vector<double>& fills, const std::vector<Upper>& upper) {
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

// Grey voxels that are less than half full are the rims of struts, and hang on their fullest neighbour alone: two
// struts whose rims meet are still two.
std::vector<Upper> joined_neighbours(const std::vector<double>& fills, std::vector<Upper> upper) {
  if (fills.empty()) return upper;
  const std::vector<int> fullest = fullest_neighbours(fills, upper);
  for (int v = 0; v < static_cast<int>(upper.size()); ++v) {
    for (int& w : upper[v]) {
      if (w < 0 || (fills[v] >= 0.5 && fills[w] >= 0.5) || fullest[v] == w || fullest[w] == v) continue;
      w = -1;
    }
  }
  return upper;
}

VoxelGrid coarse_grid(const VoxelGrid& fine, int factor) {
  const Triple cells = (fine.cells + factor - 1) / factor;
  return {fine.spacing().array() * factor * cells.cast<double>(), cells};
}

Vector lower_corner(const VoxelGrid& grid, int place) {
  return grid.cell(place).cast<double>() * grid.spacing().array();
}

// A cell in the making.
struct Piece {
  int place;
  double filled = 0;  // voxels: whole numbers but for grey ones, so that sizes compare exactly
  io::PartialCell part;
};

// Sums over the voxels of a piece, in voxels from the lower corner of its place: exact for whole ones.
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
    const Tensor central = second / filled - mean * mean.transpose() + Tensor::Identity() / 12;  // and of a voxel
    part.volume = filled * h.prod();
    part.centroid = corner + Vector((mean.array() + 0.5) * h.array());
    part.moments = symmetric_part(h.asDiagonal() * central * h.asDiagonal());
  }
};

// The pieces by place, and for each voxel the one that it is in.
struct Pieces {
  std::vector<Piece> list;
  std::vector<int> of;
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

Pieces connected_within(const Material& material, const VoxelGrid& coarse, int factor) {
  const std::vector<int> places = places_of(material, coarse, factor);
  Groups groups(material.voxels.size());
  for (int v = 0; v < material.size(); ++v) {
    for (const int w : material.joined[v]) {
      if (w >= 0 && places[v] == places[w]) groups.join(v, w);
    }
  }
  std::vector<std::pair<int, int>> firsts;  // place and first voxel of each piece
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

void add_volumes(const Material& material, const VoxelGrid& coarse, int factor, Pieces& pieces) {
  std::vector<Sums> sums(pieces.list.size());
  for (int v = 0; v < material.size(); ++v) {
    const Triple at = material.grid.cell(material.voxels[v]);
    sums[pieces.of[v]].add(at - at / factor * factor, material.fill(v));
  }
  for (std::size_t p = 0; p < sums.size(); ++p) {
    Piece& piece = pieces.list[p];
    piece.filled = sums[p].filled;
    sums[p].put_into(piece.part, lower_corner(coarse, piece.place), material.grid.spacing());
  }
}

// Of two voxels that are filled differently, the emptier one has the surface between them: it runs through that one.
void add_surfaces(const Material& material, Pieces& pieces) {
  const Vector h = material.grid.spacing();
  std::vector<std::array<bool, 3>> has_lower(material.voxels.size(), {false, false, false});
  // `side`: 0 or 1, the face of voxel v along the axis that the area is on.
  const auto add = [&](int v, int axis, double outward, int side) {
    io::PartialCell& part = pieces.list[pieces.of[v]].part;
    Vector at = material.grid.cell(material.voxels[v]).cast<double>() + 0.5;
    at[axis] += side - 0.5;
    const double area = outward * h.prod() / h[axis];
    part.surface[axis] += area;
    part.surface_moments.row(axis) += area * (at.cwiseProduct(h) - part.centroid).transpose();
  };
  for (int v = 0; v < material.size(); ++v) {
    const double fill = material.fill(v);
    for (int axis = 0; axis < 3; ++axis) {
      if (!has_lower[v][axis]) add(v, axis, -fill, 0);
      const int w = material.upper[v][axis];
      if (w >= 0) has_lower[w][axis] = true;
      const double beyond = w < 0 ? 0 : material.fill(w);
      const bool is_in_upper = w >= 0 && beyond < fill;
      add(is_in_upper ? w : v, axis, fill - beyond, is_in_upper ? 0 : 1);
    }
  }
}

// For each piece those that have a face in common with it.
std::vector<std::set<int>> links_of(const Material& material, const Pieces& pieces) {
  std::vector<std::set<int>> links(pieces.list.size());
  for (int v = 0; v < material.size(); ++v) {
    for (const int w : material.joined[v]) {
      if (w < 0 || pieces.of[v] == pieces.of[w]) continue;
      links[pieces.of[v]].insert(pieces.of[w]);
      links[pieces.of[w]].insert(pieces.of[v]);
    }
  }
  return links;
}

void absorb(io::PartialCell& part, const io::PartialCell& other) {
  const double volume = part.volume + other.volume;
  const double a = part.volume / volume, b = other.volume / volume;
  const Vector apart = other.centroid - part.centroid;
  part.moments = a * part.moments + b * other.moments + a * b * symmetric_part(apart * apart.transpose());
  // About the common centroid, which lies b apart from the one and −a apart from the other.
  part.surface_moments += other.surface_moments + (a * other.surface - b * part.surface) * apart.transpose();
  part.centroid += b * apart;
  part.volume = volume;
  part.surface += other.surface;
}

// Merges the small pieces into their neighbours. Nodes can join cells only whose places touch: what would tear material
// apart, because a merged cell has a contact beyond, waits until its neighbours have changed.
class Merging {
 public:
  Merging(Pieces& pieces, std::vector<std::set<int>> links, const VoxelGrid& grid, double limit)
      : list_(pieces.list), links_(std::move(links)), grid_(grid), limit_(limit), alive_(list_.size(), true) {}

  void run(Cells& cells) {
    for (std::size_t p = 0; p < list_.size(); ++p) note(static_cast<int>(p));
    while (!small_.empty()) {
      const int piece = small_.begin()->second;
      small_.erase(small_.begin());
      if (links_[piece].empty()) {
        drop(piece, cells);
      } else if (const Choice choice = choice_for(piece); choice.into >= 0) {
        merge(piece, choice, cells);
      }
    }
    put_into(cells);
  }

 private:
  struct Choice {
    int into = -1;  // a piece; -1: none is possible
    int place = 0;  // of both, merged
  };

  void note(int piece) {
    if (alive_[piece] && list_[piece].filled < limit_) small_.emplace(list_[piece].filled, piece);
  }

  // Whether a piece at `place` would touch all those that `piece` has contacts with, `other` aside.
  bool reaches(int place, int piece, int other) const {
    const Triple at = grid_.cell(place);
    return std::all_of(links_[piece].begin(), links_[piece].end(), [&](int linked) {
      return linked == other || ((grid_.cell(list_[linked].place) - at).abs() <= 1).all();
    });
  }

  double extent_with(int piece, int other) const {
    io::PartialCell both = list_[other].part;
    absorb(both, list_[piece].part);
    return both.moments.head<3>().sum();
  }

  Choice choice_for(int piece) const {
    const Choice choice = most_compact(piece, [&](int other) { return list_[other].place; });
    return choice.into >= 0 ? choice : most_compact(piece, [&](int) { return list_[piece].place; });
  }

  template <class Place>
  Choice most_compact(int piece, const Place& place_with) const {
    Choice best;
    double least = 0;
    for (const int other : links_[piece]) {
      const int place = place_with(other);
      if (!reaches(place, piece, other) || !reaches(place, other, piece)) continue;
      const double extent = extent_with(piece, other);
      if (best.into >= 0 && extent >= least) continue;
      best = {other, place};
      least = extent;
    }
    return best;
  }

  void drop(int piece, Cells& cells) {
    alive_[piece] = false;
    ++cells.dropped;
    cells.dropped_volume += list_[piece].part.volume;
  }

  void merge(int piece, const Choice& choice, Cells& cells) {
    const int into = choice.into;
    small_.erase({list_[into].filled, into});
    absorb(list_[into].part, list_[piece].part);
    list_[into].filled += list_[piece].filled;
    list_[into].place = choice.place;
    for (const int other : links_[piece]) {
      links_[other].erase(piece);
      if (other == into) continue;
      links_[other].insert(into);
      links_[into].insert(other);
    }
    links_[piece].clear();
    alive_[piece] = false;
    ++cells.merged;
    note_around(into);
  }

  // It, and those that may have waited for a change of it.
  void note_around(int piece) {
    note(piece);
    for (const int other : links_[piece]) {
      note(other);
      for (const int further : links_[other]) note(further);
    }
  }

  void put_into(Cells& cells) const {
    std::vector<std::pair<int, int>> order;  // place and piece
    for (int p = 0; p < static_cast<int>(list_.size()); ++p) {
      if (alive_[p]) order.emplace_back(list_[p].place, p);
    }
    std::sort(order.begin(), order.end());
    std::vector<int> number(list_.size(), -1);
    for (const auto& [place, piece] : order) {
      number[piece] = static_cast<int>(cells.parts.size());
      cells.parts.push_back(list_[piece].part);
      cells.places.push_back(place);
      cells.small += list_[piece].filled < limit_ ? 1 : 0;
    }
    for (const auto& [place, piece] : order) {
      for (const int other : links_[piece]) {
        if (number[piece] < number[other]) cells.contacts.push_back({number[piece], number[other]});
      }
    }
  }

  std::vector<Piece>& list_;
  std::vector<std::set<int>> links_;
  const VoxelGrid& grid_;
  double limit_;
  std::vector<char> alive_;
  std::set<std::pair<double, int>> small_;  // by size, those to be looked at
};

}  // namespace

double Cells::volume() const {
  double sum = 0;
  for (const io::PartialCell& part : parts) sum += part.volume;
  return sum;
}

Cells gathered(const std::vector<int>& voxels, const std::vector<double>& fills, const VoxelGrid& grid,
               const Gathering& gathering) {
  const int factor = gathering.factor;
  const std::vector<Upper> upper = upper_neighbours(voxels, grid);
  const Material material{voxels, fills, grid, upper, joined_neighbours(fills, upper)};
  Cells cells;
  cells.grid = coarse_grid(grid, factor);
  Pieces pieces = connected_within(material, cells.grid, factor);
  add_volumes(material, cells.grid, factor, pieces);
  add_surfaces(material, pieces);
  const double limit = gathering.smallest * factor * factor * factor;
  Merging(pieces, links_of(material, pieces), cells.grid, limit).run(cells);
  return cells;
}

}  // namespace strut::mesh
