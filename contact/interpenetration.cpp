#include "contact/interpenetration.hpp"

#include <algorithm>
#include <limits>

#include "contact/laws/surface.hpp"
#include "topology/bounding_box.hpp"
#include "topology/nearby_ranks.hpp"
#include "topology/neighbors/cell_grid.hpp"

namespace strut::contact {

namespace {

// A position is inside a body from this fraction of ρ at the body's nearest point on. A body that presses on a face
// stays in front of its first layer of points, where ρ falls by half within half a spacing.
constexpr double as_deep = 0.95;
// The same with nodes, as a fraction of ρ half a spacing farther in: it is reached 0.7 spacings behind a face of nodes,
// 0.1 in a sheet of one cell.
constexpr double as_far_in = 0.9;

using Place = Vector (Domain::*)(int) const;

// The points of one block, over all ranks.
struct Extent {
  Eigen::AlignedBox3d box;
  std::int64_t points = 0;
};

std::vector<Extent> extents_of_blocks(const Domain& domain, Place place) {
  std::vector<Extent> all(domain.blocks.size());
  for (int i = 0; i < domain.owned; ++i) {
    Extent& extent = all[domain.cloud.blocks[i]];
    extent.box.extend((domain.*place)(i));
    ++extent.points;
  }
  for (Extent& extent : all) {
    extent.box = common_box(extent.box, domain.communicator);
    extent.points = domain.communicator.sum(extent.points);
  }
  return all;
}

// A point, in the form in which it is sent to other ranks.
struct Seen {
  double place[3], volume;
  Vector at() const { return {place[0], place[1], place[2]}; }
};

// The material of one body, for the smoothed volume fraction.
class Material {
 public:
  Material(const std::vector<Seen>& points, double spacing, PointsAt at)
      : spacing_(spacing), at_(at), smoothing_(reach()), places_(places_of(points)), grid_(places_, reach()) {
    for (const Seen& point : points) volumes_.push_back(point.volume);
  }

  // True if a position is as deep in the material as the nearest of its points. Nodes lie on the surface, where a body
  // that only touches it lies, too; with nodes, true if the volume fraction hardly grows within half a spacing inward.
  bool holds(const Vector& x) const {
    double nearest = spacing_ * spacing_;
    const Vector* point = nullptr;
    grid_.visit_near(x, [&](int j, const Vector& y) {
      const double r2 = (y - x).squaredNorm();
      if (r2 < nearest) nearest = r2, point = &places_[j];
    });
    if (!point) return false;
    return share(x) >= (at_ == PointsAt::nodes ? as_far_in * share(behind(x)) : as_deep * share(*point));
  }

 private:
  double reach() const { return reach_in_spacings * spacing_; }
  // Calls visit(volume, x - y, |x - y|²) for the points y around x.
  template <class Visit>
  void around(const Vector& x, Visit&& visit) const {
    grid_.visit_near(x, [&](int j, const Vector& y) {
      const Vector away = x - y;
      const double r2 = away.squaredNorm();
      if (r2 < reach() * reach()) visit(volumes_[j], away, r2);
    });
  }
  double share(const Vector& x) const {
    double sum = 0;
    around(x, [&](double volume, const Vector&, double r2) { sum += volume * smoothing_.value(r2); });
    return sum;
  }
  // The position half a spacing along the gradient of the volume fraction; well inside the body the direction does not
  // matter.
  Vector behind(const Vector& x) const {
    Vector inward = Vector::Zero();
    around(x, [&](double volume, const Vector& away, double r2) {
      inward += volume * smoothing_.slope_over_distance(r2) * away;
    });
    return x + 0.5 * spacing_ * inward.stableNormalized();
  }

  double spacing_;
  PointsAt at_;
  Smoothing smoothing_;
  std::vector<Vector> places_;
  CellGrid grid_;
  std::vector<double> volumes_;
};

// The material of a block: this rank's points within `box`, and those of other ranks near `mine`.
Material material_of(const Domain& domain, int block, Place place, const Eigen::AlignedBox3d& box,
                     const Eigen::AlignedBox3d& mine, double near) {
  std::vector<Seen> points;
  for (int i = 0; i < domain.owned; ++i) {
    const Vector x = (domain.*place)(i);
    if (domain.cloud.blocks[i] == block && box.contains(x)) points.push_back({{x[0], x[1], x[2]}, domain.volume(i)});
  }
  add_nearby(points, mine, near, domain.communicator);
  return {points, domain.blocks[block].spacing, domain.cloud.at};
}

// Collective. This rank's points of two blocks that are inside the other block.
std::vector<int> points_inside(const Domain& domain, int first, int second, const Eigen::AlignedBox3d& overlap,
                               Place place) {
  std::vector<int> tested;
  Eigen::AlignedBox3d mine;
  for (int i = 0; i < domain.owned; ++i) {
    const int block = domain.cloud.blocks[i];
    if ((block != first && block != second) || !overlap.contains((domain.*place)(i))) continue;
    tested.push_back(i);
    mine.extend((domain.*place)(i));
  }
  // Distance to the nearest point, and the material around that point.
  const double near = (1 + reach_in_spacings) * std::max(domain.blocks[first].spacing, domain.blocks[second].spacing);
  const Vector margin = Vector::Constant(near);
  const Eigen::AlignedBox3d around(overlap.min() - margin, overlap.max() + margin);
  const Material one = material_of(domain, first, place, around, mine, near);
  const Material other = material_of(domain, second, place, around, mine, near);
  std::erase_if(tested,
                [&](int i) { return !(domain.cloud.blocks[i] == first ? other : one).holds((domain.*place)(i)); });
  return tested;
}

// Collective. The point with the lowest id over all ranks.
int one_of(const std::vector<int>& points, const Domain& domain) {
  double lowest = std::numeric_limits<double>::max();
  int point = -1;
  for (const int i : points) {
    if (static_cast<double>(domain.id(i)) < lowest) lowest = static_cast<double>(domain.id(i)), point = i;
  }
  return domain.communicator.min(lowest) == lowest ? point : -1;
}

std::int64_t number_inside(const Domain& domain, int first, int second, const Eigen::AlignedBox3d& overlap,
                           Place place) {
  if (overlap.isEmpty()) return 0;
  const std::vector<int> inside = points_inside(domain, first, second, overlap, place);
  return domain.communicator.sum(static_cast<std::int64_t>(inside.size()));
}

std::optional<Interpenetration> interpenetration(const Domain& domain, const std::vector<Extent>& extents, int first,
                                                 int second, double limit) {
  const Eigen::AlignedBox3d overlap = extents[first].box.intersection(extents[second].box);
  const auto smaller = static_cast<double>(std::min(extents[first].points, extents[second].points));
  if (overlap.isEmpty()) return std::nullopt;
  std::vector<int> inside = points_inside(domain, first, second, overlap, &Domain::current);
  std::int64_t points = domain.communicator.sum(static_cast<std::int64_t>(inside.size()));
  if (!(static_cast<double>(points) > limit * smaller)) return std::nullopt;
  const std::vector<Extent> before = extents_of_blocks(domain, &Domain::reference);
  points -=
      number_inside(domain, first, second, before[first].box.intersection(before[second].box), &Domain::reference);
  const double part = static_cast<double>(points) / smaller;
  if (!(part > limit)) return std::nullopt;
  return Interpenetration{first, second, points, part, one_of(inside, domain)};
}

}  // namespace

std::optional<Interpenetration> find_interpenetration(const Domain& domain, const Contact& contact, double limit) {
  const int blocks = static_cast<int>(domain.blocks.size());
  const std::vector<Extent> extents = extents_of_blocks(domain, &Domain::current);
  for (int a = 0; a < blocks; ++a) {
    for (int b = a + 1; b < blocks; ++b) {
      if (domain.blocks[a].body == domain.blocks[b].body || !contact.between(a, b)) continue;
      if (const auto found = interpenetration(domain, extents, a, b, limit)) return found;
    }
  }
  return std::nullopt;
}

std::vector<Overlap> overlapping_blocks(const Domain& domain) {
  const int blocks = static_cast<int>(domain.blocks.size());
  const std::vector<Extent> extents = extents_of_blocks(domain, &Domain::current);
  std::vector<Overlap> all;
  for (int a = 0; a < blocks; ++a) {
    for (int b = a + 1; b < blocks; ++b) {
      if (domain.blocks[a].body == domain.blocks[b].body) continue;
      const Eigen::AlignedBox3d overlap = extents[a].box.intersection(extents[b].box);
      if (!overlap.isEmpty()) all.push_back({a, b, points_inside(domain, a, b, overlap, &Domain::current)});
    }
  }
  return all;
}

}  // namespace strut::contact
