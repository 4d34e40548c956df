#include "mesh/cells.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "mesh/pieces.hpp"

namespace strut::mesh {

namespace {

VoxelGrid coarse_grid(const VoxelGrid& fine, int factor) {
  const Eigen::Array3i cells = (fine.cells + factor - 1) / factor;
  return {fine.spacing().array() * factor * cells.cast<double>(), cells};
}

// The length of a bar with these moments, in spacings.
double length_of(const io::PartialCell& part, const Vector& spacing) {
  const auto scale = spacing.cwiseInverse().asDiagonal();
  const Tensor moments = scale * to_tensor(part.moments) * scale;
  return std::sqrt(12 * Eigen::SelfAdjointEigenSolver<Tensor>(moments, Eigen::EigenvaluesOnly).eigenvalues()[2]);
}

// Merges pieces of a body into their neighbors, one by one. Nodes can join only cells at touching positions. So a merge
// is not made if the merged cell would have a contact farther away, which would separate material.
class Merging {
 public:
  // `links`: for each piece, those that it can be merged into.
  Merging(Pieces& pieces, std::vector<std::set<int>> links, const VoxelGrid& grid)
      : pieces_(pieces),
        list_(pieces.list),
        links_(std::move(links)),
        grid_(grid),
        alive_(list_.size(), true),
        into_(list_.size(), -1) {}

  using Allowed = std::function<bool(int)>;
  // Merges a piece into the one of its links that is `allowed`, gives the most compact result, and is no longer than
  // `longest` cells. The result is at the position of that link or, if only that keeps its neighbors, of the piece.
  // Returns the piece that contains both, or -1.
  int merge(
      int piece, double longest = INFINITY, const Allowed& allowed = [](int) { return true; }) {
    Choice choice = most_compact(piece, longest, allowed, false);
    if (choice.into < 0) choice = most_compact(piece, longest, allowed, true);
    if (choice.into >= 0) join(piece, choice);
    return choice.into;
  }
  void drop(int piece) { alive_[piece] = false; }

  bool alive(int piece) const { return alive_[piece]; }
  const std::set<int>& links(int piece) const { return links_[piece]; }

  // Assigns the voxels of merged pieces to the pieces that contain them.
  void finish() {
    for (int& piece : pieces_.of) {
      while (piece >= 0 && into_[piece] >= 0) piece = into_[piece];
      if (piece >= 0 && !alive_[piece]) piece = -1;
    }
  }

 private:
  struct Choice {
    int into = -1;  // a piece; -1: none is possible
    int place = 0;  // of the merged piece
  };

  // True if a piece at `place` would touch all pieces that `piece` has contacts with, except `other`.
  bool reaches(int place, int piece, int other) const {
    const Eigen::Array3i at = grid_.cell(place);
    return std::all_of(links_[piece].begin(), links_[piece].end(), [&](int linked) {
      return linked == other || ((grid_.cell(list_[linked].place) - at).abs() <= 1).all();
    });
  }

  Choice most_compact(int piece, double longest, const Allowed& allowed, bool is_at_piece) const {
    Choice best;
    double least = 0;
    for (const int other : links_[piece]) {
      const int place = list_[is_at_piece ? piece : other].place;
      if (!allowed(other) || !reaches(place, piece, other) || !reaches(place, other, piece)) continue;
      io::PartialCell both = list_[other].part;
      absorb(both, list_[piece].part);
      const double extent = both.moments.head<3>().sum();
      if (best.into >= 0 && extent >= least) continue;
      if (std::isfinite(longest) && length_of(both, grid_.spacing()) > longest) continue;
      best = {other, place};
      least = extent;
    }
    return best;
  }

  void join(int piece, const Choice& choice) {
    const int into = choice.into;
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
    into_[piece] = into;
  }

  Pieces& pieces_;
  std::vector<Piece>& list_;
  std::vector<std::set<int>> links_;
  const VoxelGrid& grid_;
  std::vector<char> alive_;
  std::vector<int> into_;  // the piece that a merged piece became part of
};

// Merges small pieces into their neighbors. A piece that cannot be merged waits until its neighbors have changed.
class SmallPieces {
 public:
  SmallPieces(const Material& material, const VoxelGrid& grid, double limit, Pieces& pieces)
      : list_(pieces.list), merging_(pieces, links_of(material, pieces), grid), limit_(limit) {}

  void merge(Cells& cells) {
    for (std::size_t p = 0; p < list_.size(); ++p) note(static_cast<int>(p));
    while (!small_.empty()) {
      const auto [filled, piece] = *small_.begin();
      small_.erase(small_.begin());
      if (!merging_.alive(piece) || list_[piece].filled != filled) continue;  // has been merged since
      merging_.links(piece).empty() ? drop(piece, cells) : merge(piece, cells);
    }
    for (std::size_t p = 0; p < list_.size(); ++p) cells.small += is_small(static_cast<int>(p)) ? 1 : 0;
    merging_.finish();
  }

 private:
  bool is_small(int piece) const { return merging_.alive(piece) && list_[piece].filled < limit_; }

  void note(int piece) {
    if (is_small(piece)) small_.emplace(list_[piece].filled, piece);
  }

  void drop(int piece, Cells& cells) {
    merging_.drop(piece);
    ++cells.dropped;
    cells.dropped_volume += list_[piece].part.volume;
  }

  void merge(int piece, Cells& cells) {
    const int into = merging_.merge(piece);
    if (into < 0) return;
    ++cells.merged;
    // Notes this piece, and those that may have waited for its change.
    note(into);
    for (const int other : merging_.links(into)) {
      note(other);
      for (const int further : merging_.links(other)) note(further);
    }
  }

  std::vector<Piece>& list_;
  Merging merging_;
  double limit_;
  std::set<std::pair<double, int>> small_;  // by size, pieces still to be processed
};

// Requirements of a run: number of neighbors, and their mean square distance in any direction, in spacings²
// (src/mechanics/formulation/cell_fit.hpp).
constexpr std::size_t least_neighbors = 4;
constexpr double least_spread = 0.02;

// In spacings. A longer merged cell reduces the critical time step (for a foam of a recipe by 1 % at 3, by 8 % at
// 4).
constexpr double longest = 3;

// Cells whose neighbors hardly span space: they are cut into two layers, or merged. The deformation of a cell follows
// from the motion of its neighbors. If these are all in one plane, as in a strut that a wall of the box cuts along its
// length, it is undetermined along the normal, and a run drops the cell. If the cells are cut in two along the normal,
// they are each other's neighbors on either side of the plane.
class FlatCells {
 public:
  FlatCells(const Material& material, const Gathering& gathering, Pieces& pieces, Cells& cells)
      : material_(material), gathering_(gathering), pieces_(pieces), cells_(cells) {}

  // Sets the cells from the pieces, and changes both where cells are flat.
  void mend() {
    update();
    if (gathering_.smallest > 0) {
      while (cut()) update();
      while (merge()) update();
    }
    count_left_out();
  }

 private:
  void update() {
    renumber(pieces_);
    measure(material_, cells_.grid, gathering_.factor, pieces_);
    links_ = links_of(material_, pieces_);
    cells_.parts.clear(), cells_.places.clear(), cells_.contacts.clear();
    for (int n = 0; n < static_cast<int>(pieces_.list.size()); ++n) {
      cells_.parts.push_back(pieces_.list[n].part);
      cells_.places.push_back(pieces_.list[n].place);
      for (const int other : links_[n]) {
        if (n < other) cells_.contacts.push_back({n, other});
      }
    }
    near_ = neighbors_of(cells_);
    alive_.assign(cells_.parts.size(), 1);
    find();
  }

  void find() {
    flat_.clear();
    normal_.assign(cells_.parts.size(), -1);
    for (int n = 0; n < static_cast<int>(cells_.parts.size()); ++n) {
      if (!alive_[n]) continue;
      const auto neighbors = std::count_if(near_[n].begin(), near_[n].end(), [&](int j) { return alive_[j] != 0; });
      const Eigen::SelfAdjointEigenSolver<Tensor> eigen(spread(n));
      const Vector squares = eigen.eigenvalues();  // ascending
      if (neighbors >= static_cast<std::ptrdiff_t>(least_neighbors) && squares[0] >= least_spread) continue;
      flat_.push_back(n);
      if (squares[0] < least_spread && squares[1] >= least_spread) {
        eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&normal_[n]);
      }
    }
  }

  // The mean of ξ⊗ξ over the neighbors, in spacings².
  Tensor spread(int cell) const {
    Tensor sum = Tensor::Zero();
    double volume = 0;
    for (const int j : near_[cell]) {
      if (!alive_[j]) continue;
      const Vector xi = (cells_.parts[j].centroid - cells_.parts[cell].centroid).cwiseQuotient(cells_.grid.spacing());
      sum += cells_.parts[j].volume * xi * xi.transpose();
      volume += cells_.parts[j].volume;
    }
    return volume > 0 ? Tensor(sum / volume) : sum;
  }

  // Halves must not be thinner than the smallest cell, so that they do not limit the critical time step.
  bool is_cut(int cell) const {
    const int axis = normal_[cell];
    if (axis < 0) return false;
    const double thickness = std::sqrt(12 * cells_.parts[cell].moments[axis]) / cells_.grid.spacing()[axis];
    const double one_layer = 1.0 / gathering_.factor;  // of voxels: it cannot be halved
    return thickness >= std::max(2 * gathering_.smallest, 1.5 * one_layer);
  }

  bool cut() {
    std::vector<int> upper(cells_.parts.size(), -1);
    const std::size_t before = pieces_.list.size();
    for (const int n : flat_) {
      if (!is_cut(n)) continue;
      upper[n] = static_cast<int>(pieces_.list.size());
      pieces_.list.push_back({cells_.places[n]});
      ++cells_.cut;
    }
    give_upper_halves(upper);
    return pieces_.list.size() > before;
  }

  void give_upper_halves(const std::vector<int>& upper) {
    const Vector h = material_.grid.spacing();
    for (int v = 0; v < material_.size(); ++v) {
      const int n = pieces_.of[v];
      if (n < 0 || upper[n] < 0) continue;
      const int axis = normal_[n];
      const double at = (material_.grid.cell(material_.voxels[v])[axis] + 0.5) * h[axis];
      // A layer of voxels at the exact middle stays below, whatever the round-off.
      if (at > cells_.parts[n].centroid[axis] + 1e-6 * h[axis]) pieces_.of[v] = upper[n];
    }
  }

  // Merges flat cells into cells that are not flat: a wire of flat cells would only become one of long ones. It begins
  // with those that have the fewest contacts, from the tips inward. A cell whose neighbor has changed waits for the
  // next round, because it may have enough neighbors now.
  bool merge() {
    Merging merging(pieces_, links_, cells_.grid);
    std::stable_sort(flat_.begin(), flat_.end(), [&](int a, int b) { return links_[a].size() < links_[b].size(); });
    std::vector<char> waits(cells_.parts.size(), 0), is_flat(cells_.parts.size(), 0);
    for (const int n : flat_) is_flat[n] = 1;
    const std::size_t before = cells_.flat_merged;
    for (const int n : flat_) {
      if (waits[n]) continue;
      const int into = merging.merge(n, longest, [&](int other) { return !waits[other] && !is_flat[other]; });
      if (into < 0) continue;
      ++cells_.flat_merged;
      waits[into] = 1;
      for (const int other : merging.links(into)) waits[other] = 1;
    }
    merging.finish();
    return cells_.flat_merged > before;
  }

  // A cell that a run drops is no neighbor of others, which may then be dropped, too.
  void count_left_out() {
    while (!flat_.empty()) {
      for (const int n : flat_) {
        alive_[n] = 0;
        cells_.flat_volume += cells_.parts[n].volume;
      }
      cells_.flat += flat_.size();
      find();
    }
  }

  const Material& material_;
  const Gathering& gathering_;
  Pieces& pieces_;
  Cells& cells_;
  std::vector<std::set<int>> links_;
  std::vector<std::vector<int>> near_;  // cells that share a node
  std::vector<int> flat_;
  std::vector<int> normal_;  // axis of a cell whose neighbors are in a plane, else -1
  std::vector<char> alive_;  // kept by a run
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
  const Material material = material_of(voxels, fills, grid);
  Cells cells;
  cells.grid = coarse_grid(grid, factor);
  Pieces pieces = connected_within(material, cells.grid, factor);
  measure(material, cells.grid, factor, pieces);
  SmallPieces(material, cells.grid, gathering.smallest * factor * factor * factor, pieces).merge(cells);
  FlatCells(material, gathering, pieces, cells).mend();
  return cells;
}

}  // namespace strut::mesh
