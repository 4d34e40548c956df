#include "contact/interpenetration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/laws/surface.hpp"
#include "topology/bounding_box.hpp"
#include "topology/nearby_ranks.hpp"
#include "topology/neighbors/cell_grid.hpp"

namespace strut::contact {

namespace {

// A position is inside a body if ρ there is at least this fraction of ρ at the body's nearest point. A body that
// presses on a face stays in front of its first layer of points, where ρ falls by half within half a spacing.
constexpr double as_deep = 0.95;
// The same for points at nodes, as a fraction of ρ half a spacing farther inward: ρ reaches it 0.7 spacings behind a
// face, 0.1 in a sheet of one cell.
constexpr double as_far_in = 0.9;

// Where points are, now or in the reference state: between periodic sides moved by whole periods to within one from the
// origin, since bodies may have passed several.
class Places {
 public:
  static Places now(const Domain& domain) { return {domain, &Domain::current, domain.halo.stretch()}; }
  static Places in_reference(const Domain& domain) { return {domain, &Domain::reference, Vector::Ones()}; }

  Vector operator()(int i) const {
    Vector x = (domain_.*place_)(i);
    for (const Period& period : domain_.periods) {
      const double length = period.length * stretch_[period.axis];
      x[period.axis] -= length * std::floor(x[period.axis] / length);
    }
    return x;
  }
  // From there to the images behind periodic sides.
  const std::vector<Vector>& to_images() const { return to_images_; }
  // A box of places, as wide as the period: a block that a side divides goes on between its outermost points there.
  Eigen::AlignedBox3d widened(Eigen::AlignedBox3d box) const {
    for (const Period& period : domain_.periods) {
      if (!box.isEmpty()) box.min()[period.axis] = 0, box.max()[period.axis] = period.length * stretch_[period.axis];
    }
    return box;
  }

 private:
  using Place = Vector (Domain::*)(int) const;
  Places(const Domain& domain, Place place, const Vector& stretch) : domain_(domain), place_(place), stretch_(stretch) {
    if (domain.periods.empty()) return;
    const Images images(domain.periods, 0);
    for (const int image : images.of_body(0)) to_images_.push_back(images[image].stretched(stretch).shift);
  }

  const Domain& domain_;
  Place place_;
  Vector stretch_;
  std::vector<Vector> to_images_;
};

// The points of one block, over all ranks.
struct Extent {
  Eigen::AlignedBox3d box;
  std::int64_t points = 0;
};

std::vector<Extent> extents_of_blocks(const Domain& domain, const Places& place) {
  std::vector<Extent> all(domain.blocks.size());
  for (int i = 0; i < domain.owned; ++i) {
    Extent& extent = all[domain.cloud.blocks[i]];
    extent.box.extend(place(i));
    ++extent.points;
  }
  for (Extent& extent : all) {
    extent.box = place.widened(common_box(extent.box, domain.communicator));
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
    return volume_fraction(x) >=
           (at_ == PointsAt::nodes ? as_far_in * volume_fraction(behind(x)) : as_deep * volume_fraction(*point));
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
  double volume_fraction(const Vector& x) const {
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

// The material of a block: this rank's points and images within `box`, and those of other ranks near `mine`.
Material material_of(const Domain& domain, int block, const Places& place, const Eigen::AlignedBox3d& box,
                     const Eigen::AlignedBox3d& mine, double near) {
  std::vector<Seen> points;
  const auto add = [&](const Vector& x, int i) {
    if (box.contains(x)) points.push_back({{x[0], x[1], x[2]}, domain.volume(i)});
  };
  for (int i = 0; i < domain.owned; ++i) {
    if (domain.cloud.blocks[i] != block) continue;
    const Vector x = place(i);
    add(x, i);
    for (const Vector& to_image : place.to_images()) add(x + to_image, i);
  }
  add_nearby(points, mine, near, domain.communicator);
  return {points, domain.blocks[block].spacing, domain.cloud.at};
}

// Collective. This rank's points of two blocks that are inside the other block.
std::vector<int> points_inside(const Domain& domain, int first, int second, const Eigen::AlignedBox3d& overlap,
                               const Places& place) {
  std::vector<int> tested;
  Eigen::AlignedBox3d mine;
  for (int i = 0; i < domain.owned; ++i) {
    const int block = domain.cloud.blocks[i];
    if ((block != first && block != second) || !overlap.contains(place(i))) continue;
    tested.push_back(i);
    mine.extend(place(i));
  }
  // Distance to the nearest point, and the material around that point.
  const double near = (1 + reach_in_spacings) * std::max(domain.blocks[first].spacing, domain.blocks[second].spacing);
  const Vector margin = Vector::Constant(near);
  const Eigen::AlignedBox3d around(overlap.min() - margin, overlap.max() + margin);
  const Material one = material_of(domain, first, place, around, mine, near);
  const Material other = material_of(domain, second, place, around, mine, near);
  std::erase_if(tested, [&](int i) { return !(domain.cloud.blocks[i] == first ? other : one).holds(place(i)); });
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
                           const Places& place) {
  if (overlap.isEmpty()) return 0;
  const std::vector<int> inside = points_inside(domain, first, second, overlap, place);
  return domain.communicator.sum(static_cast<std::int64_t>(inside.size()));
}

std::optional<Interpenetration> interpenetration(const Domain& domain, const std::vector<Extent>& extents, int first,
                                                 int second, double limit) {
  const Eigen::AlignedBox3d overlap = extents[first].box.intersection(extents[second].box);
  const auto smaller = static_cast<double>(std::min(extents[first].points, extents[second].points));
  if (overlap.isEmpty()) return std::nullopt;
  std::vector<int> inside = points_inside(domain, first, second, overlap, Places::now(domain));
  std::int64_t points = domain.communicator.sum(static_cast<std::int64_t>(inside.size()));
  if (!(static_cast<double>(points) > limit * smaller)) return std::nullopt;
  const Places reference = Places::in_reference(domain);
  const std::vector<Extent> before = extents_of_blocks(domain, reference);
  points -= number_inside(domain, first, second, before[first].box.intersection(before[second].box), reference);
  const double part = static_cast<double>(points) / smaller;
  if (!(part > limit)) return std::nullopt;
  return Interpenetration{first, second, points, part, one_of(inside, domain)};
}

}  // namespace

std::optional<Interpenetration> find_interpenetration(const Domain& domain, const Contact& contact, double limit) {
  const int blocks = static_cast<int>(domain.blocks.size());
  const std::vector<Extent> extents = extents_of_blocks(domain, Places::now(domain));
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
  const Places now = Places::now(domain);
  const std::vector<Extent> extents = extents_of_blocks(domain, now);
  std::vector<Overlap> all;
  for (int a = 0; a < blocks; ++a) {
    for (int b = a + 1; b < blocks; ++b) {
      if (domain.blocks[a].body == domain.blocks[b].body) continue;
      const Eigen::AlignedBox3d overlap = extents[a].box.intersection(extents[b].box);
      if (!overlap.isEmpty()) all.push_back({a, b, points_inside(domain, a, b, overlap, now)});
    }
  }
  return all;
}

}  // namespace strut::contact
