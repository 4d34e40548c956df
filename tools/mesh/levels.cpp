#include "mesh/levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/voxels.hpp"

namespace strut::mesh {

namespace {

// A Plateau border of arcs of the radius R has the area (√3 − π/2) R², and its corners are R/√3 from its middle.
const double circle_of_arcs = std::sqrt((std::numbers::sqrt3 - std::numbers::pi / 2) / std::numbers::pi);

// The level of a place at `across` from the edge, by the arcs of the cell that it lies in: the larger root R of
// |across − 2R/√3 c| = R, c towards the middle of the cell.
double level_in_border(const Vector& across, const std::array<Vector, 3>& films) {
  const double distance = across.norm();
  if (distance == 0) return 0;
  double cosines[3];
  for (int n = 0; n < 3; ++n) cosines[n] = std::clamp(films[n].dot(across) / distance, -1.0, 1.0);
  std::sort(cosines, cosines + 3);
  // The angles to the nearest two films; the cell between them is 120° wide in a foam at rest.
  const double near = std::acos(cosines[2]), other = std::acos(cosines[1]);
  const double from_middle = std::numbers::pi / 3 * std::max(0.0, other - near) / std::max(other + near, 1e-12);
  const double c = std::cos(from_middle);
  const double arcs = 1.5 * distance * (4 / std::numbers::sqrt3 * c + std::sqrt(std::max(0.0, 16 * c * c - 4) / 3));
  return circle_of_arcs * arcs;
}

class StrutLevel {
 public:
  StrutLevel(const Edge& edge, const StrutShape& shape) : edge_(edge), shape_(shape), along_(edge.b - edge.a) {
    inverse_square_ = along_.squaredNorm() > 0 ? 1 / along_.squaredNorm() : 0;
    is_round_ = !shape.three_cornered || edge.films[0].isZero(0);
    for (int n = 0; n < 3; ++n) {
      const Vector& film = edge.films[n];
      films_[n] = (film - film.dot(along_) * inverse_square_ * along_).normalized();
    }
  }

  double at(const Vector& x) const {
    const Vector from = x - edge_.a;
    const double t = from.dot(along_) * inverse_square_, within = std::clamp(t, 0.0, 1.0);
    const double ball = std::min((x - edge_.a).norm(), (x - edge_.b).norm()) / shape_.node;
    if (t != within && (shape_.node != 1 || !is_round_)) return ball;
    const Vector across = from - within * along_;
    if (is_round_) return std::min(ball, across.norm() / shape_.width(within));
    return std::min(ball, level_in_border(across, films_) / shape_.width(within));
  }

 private:
  const Edge& edge_;
  const StrutShape& shape_;
  Vector along_;
  double inverse_square_;
  bool is_round_;
  std::array<Vector, 3> films_;
};

// Lowers the levels of the voxels in the box around an edge and its `reach`. Edges are short compared with the grid,
// so that each meets few voxels, and each voxel the few edges near it.
void lower_levels(const Edge& edge, const StrutShape& shape, const VoxelGrid& grid, double reach,
                  std::vector<double>& levels) {
  const Vector h = grid.spacing();
  const StrutLevel level(edge, shape);
  // In cells, clamped before conversion to integers.
  const auto cells = [&](const Eigen::Array3d& x) {
    return (x / h.array()).floor().max(-1).min(grid.cells.cast<double>()).cast<int>().eval();
  };
  const Eigen::Array3i low = cells(edge.a.cwiseMin(edge.b).array() - reach).max(0);
  const Eigen::Array3i high = cells(edge.a.cwiseMax(edge.b).array() + reach).min(grid.cells - 1);
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        const Vector center((i + 0.5) * h[0], (j + 0.5) * h[1], (k + 0.5) * h[2]);
        double& least = levels[grid.index(i, j, k)];
        least = std::min(least, level.at(center));
      }
    }
  }
}

}  // namespace

double StrutShape::width(double t) const {
  if (node == 1) return 1;
  const double u = (2 * t - 1) * (2 * t - 1);
  return std::sqrt(1 + (node * node - 1) * (0.04 * u + 0.96 * u * u));
}

double StrutShape::reach() const {
  const double corner = three_cornered ? 1 / (std::numbers::sqrt3 * circle_of_arcs) : 1;
  return corner * std::max(1.0, node);
}

std::vector<Level> strut_levels(const std::vector<Edge>& edges, const StrutShape& shape, const VoxelGrid& grid,
                                double most) {
  std::vector<double> levels(grid.count(), std::numeric_limits<double>::infinity());
  for (const Edge& edge : edges) lower_levels(edge, shape, grid, most * shape.reach(), levels);
  std::vector<Level> found;
  for (std::size_t n = 0; n < levels.size(); ++n) {
    if (levels[n] <= most) found.push_back({levels[n], static_cast<int>(n)});
  }
  return found;
}

std::vector<Level> field_levels(const std::function<double(const Vector&)>& field, const VoxelGrid& grid) {
  std::vector<Level> levels;
  for (int n = 0; n < static_cast<int>(grid.count()); ++n) {
    const Vector center = (grid.cell(n).cast<double>() + 0.5) * grid.spacing().array();
    levels.push_back({field(center), n});
  }
  return levels;
}

}  // namespace strut::mesh
