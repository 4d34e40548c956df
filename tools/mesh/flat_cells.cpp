#include "mesh/flat_cells.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "mesh/merging.hpp"

namespace strut::mesh {

namespace {

// Requirements of a run: number of neighbors, and their mean square distance in any direction, in spacings²
// (src/mechanics/formulation/cell_fit.hpp).
constexpr std::size_t least_neighbors = 4;
constexpr double least_spread = 0.02;

// In spacings. A longer merged cell reduces the critical time step (for a foam of a recipe by 1 % at 3, by 8 % at
// 4).
constexpr double longest = 3;

class FlatCells {
 public:
  FlatCells(const Material& material, const Gathering& gathering, Pieces& pieces, Cells& cells)
      : material_(material), gathering_(gathering), pieces_(pieces), cells_(cells) {}

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

void mend_flat_cells(const Material& material, const Gathering& gathering, Pieces& pieces, Cells& cells) {
  FlatCells(material, gathering, pieces, cells).mend();
}

}  // namespace strut::mesh
