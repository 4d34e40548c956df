#include "mechanics/thin_members.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace strut {

namespace {

// Of Crofton's formula, by the squared length of the direction: along edges, diagonals of faces and of cells. The sum
// over the 26 directions is 1.
constexpr std::array<double, 4> weights = {0, 0.0457779, 0.0369806, 0.0351956};

// The lattice direction to a neighbor, or zero: not one of the 26.
Eigen::Array3i direction_of(const Vector& xi) {
  const Eigen::Array3i direction = xi.array().round().cast<int>();
  const bool is_near = (xi - direction.cast<double>().matrix()).cwiseAbs().maxCoeff() < 0.3;
  return is_near && direction.abs().maxCoeff() == 1 ? direction : Eigen::Array3i::Zero();
}

// The surface at a point, in spacings².
double surface_at(const Domain& domain, int i) {
  std::array<bool, 27> found{};
  const double h = domain.cloud.spacings[i];
  domain.families.for_each(i, [&](int j) {
    const Eigen::Array3i d = direction_of((domain.reference(j) - domain.reference(i)) / h);
    found[(d[2] + 1) * 9 + (d[1] + 1) * 3 + d[0] + 1] = true;
  });
  double sum = 0;
  for (int n = 0; n < 27; ++n) {
    const int length2 = std::abs(n % 3 - 1) + std::abs(n / 3 % 3 - 1) + std::abs(n / 9 - 1);
    if (!found[n] && length2 > 0) sum += 4 * weights[length2] / std::sqrt(length2);
  }
  return sum;
}

struct Entry {
  double thickness, kept;
};

double interpolated(const std::array<Entry, 4>& table, double thickness) {
  const auto above = std::find_if(table.begin(), table.end(), [&](const Entry& e) { return e.thickness >= thickness; });
  if (above == table.begin()) return table.front().kept;
  if (above == table.end()) return 1 - (1 - table.back().kept) * table.back().thickness / thickness;
  const Entry &b = *above, &a = *(above - 1);
  return a.kept + (b.kept - a.kept) * (thickness - a.thickness) / (b.thickness - a.thickness);
}

}  // namespace

double thickness_of(const Domain& domain, int block) {
  const PointCloud& cloud = domain.cloud;
  double sums[] = {0, 0};  // in spacings
  for (int i = 0; i < domain.owned; ++i) {
    if (cloud.blocks[i] != block) continue;
    const double h = cloud.spacings[i];
    sums[0] += domain.volume(i) / (h * h * h);
    sums[1] += cloud.shapes.empty() ? surface_at(domain, i) : cloud.shapes[i].surface.norm() / (h * h);
  }
  domain.communicator.sum(sums);
  return sums[1] > 0 ? 4 * sums[0] / sums[1] : 0;
}

double bending_stiffness_kept(Formulation formulation, double horizon, double thickness) {
  if (!(thickness > 0) || formulation == Formulation::ordinary) return 1;
  if (formulation == Formulation::quadratic) {
    return interpolated({{{2, 0.87}, {3, 0.94}, {4, 0.945}, {6, 0.97}}}, thickness);
  }
  if (horizon < 2.4) return interpolated({{{2, 0.08}, {3, 0.26}, {4, 0.51}, {6, 0.74}}}, thickness);
  return interpolated({{{2, 0.08}, {3, 0.19}, {4, 0.31}, {6, 0.51}}}, thickness);
}

}  // namespace strut
