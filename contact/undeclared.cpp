// Interpenetration of material without a declared contact: of points at surfaces that have come too close.
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "contact/interpenetration.hpp"
#include "contact/own_surface.hpp"
#include "topology/bounding_box.hpp"
#include "topology/cell_edges.hpp"
#include "topology/nearby_ranks.hpp"
#include "topology/neighbors/cell_grid.hpp"

namespace strut::contact {

namespace {

constexpr double near = 0.5;  // times the smaller of the shortest edges of two cells

// Pairs of blocks without declared contact.
class Uncovered {
 public:
  Uncovered(const Domain& domain, const Contact& contact) : blocks_(domain.blocks.size()), pairs_(blocks_ * blocks_) {
    for (std::size_t a = 0; a < blocks_; ++a) {
      for (std::size_t b = 0; b < blocks_; ++b) {
        pairs_[a * blocks_ + b] = !contact.between(static_cast<int>(a), static_cast<int>(b));
        any_ |= pairs_[a * blocks_ + b];
      }
    }
  }
  bool any() const { return any_; }
  bool has(int a, int b) const { return pairs_[a * blocks_ + b]; }

 private:
  std::size_t blocks_;
  std::vector<char> pairs_;
  bool any_ = false;
};

// A point, in the form in which it is sent to other ranks.
struct Seen {
  double current[3], reference[3], inward[3], edge, horizon, block, index;
  Vector at() const { return Vector::Map(current); }
};

// Vector from a node into its body, Σ V (y_j − y_i) over its family; zero for centers of cells, which need none.
Vector inward_at(const Domain& domain, int i) {
  Vector sum = Vector::Zero();
  if (domain.cloud.at == PointsAt::elements) return sum;
  domain.families.for_each(i, [&](int j) { sum += domain.volume(j) * (domain.current(j) - domain.current(i)); });
  return sum;
}

// The shortest edge of a point's cell; where edges are not known, the nearest neighbor tells.
double edge_of(const Domain& domain, int i) {
  double edge = edges_of_cell(domain, i).shortest;
  if (has_known_edges(domain, i)) return edge;
  domain.families.for_each(i,
                           [&](int j) { edge = std::min(edge, (domain.reference(j) - domain.reference(i)).norm()); });
  return edge;
}

std::vector<Seen> at_surfaces(const Domain& domain) {
  std::vector<Seen> points;
  for (int i = 0; i < domain.owned; ++i) {
    if (!is_at_surface(domain, i)) continue;
    const Vector y = domain.current(i), X = domain.reference(i), inward = inward_at(domain, i);
    points.push_back({{y[0], y[1], y[2]},
                      {X[0], X[1], X[2]},
                      {inward[0], inward[1], inward[2]},
                      edge_of(domain, i),
                      domain.horizon(i),
                      static_cast<double>(domain.cloud.blocks[i]),
                      static_cast<double>(i)});
  }
  return points;
}

void shift(Seen& point, const Vector& now, const Vector& reference) {
  Eigen::Map<Vector>(point.current) += now, Eigen::Map<Vector>(point.reference) += reference;
}

// Moves points by whole periods into the first period from the origin: bodies may have passed several periods.
void fold(const Domain& domain, std::vector<Seen>& points) {
  for (const Period& period : domain.periods) {
    const Vector along = period.length * Vector::Unit(period.axis), now = domain.halo.stretch().cwiseProduct(along);
    for (Seen& point : points) {
      const double count = -std::floor(point.current[period.axis] / now[period.axis]);
      shift(point, count * now, count * along);
    }
  }
}

// The images of folded points behind periodic sides within `reach` of all of them.
std::vector<Seen> images_of(const Domain& domain, std::span<const Seen> points, double reach) {
  std::vector<Seen> all;
  if (domain.periods.empty()) return all;
  Eigen::AlignedBox3d cell;
  for (const Seen& point : points) cell.extend(point.at());
  cell = common_box(cell, domain.communicator);
  const Images images(domain.periods, 0);
  for (const int image : images.of_body(0)) {
    const Reflection& by = images[image];
    for (Seen point : points) {
      shift(point, by.stretched(domain.halo.stretch()).shift, by.shift);
      if (cell.squaredExteriorDistance(point.at()) <= reach * reach) all.push_back(point);
    }
  }
  return all;
}

// True if the point lies behind the face at the node `face`: within the cone of this cosine around the inward normal,
// so that points beside an edge or a corner of that body do not count.
bool is_behind(const Seen& point, const Seen& face) {
  constexpr double straight = 0.85;  // the cosine; of the corner of a cube it is 0.82 at the most
  const Vector apart = point.at() - face.at(), inward = Vector::Map(face.inward);
  return apart.dot(inward) > straight * apart.norm() * inward.norm();
}

// True if two points within `near` of each other started so far apart that they must have passed through the material
// between them.
bool has_passed(const Domain& domain, const Uncovered& uncovered, const Seen& a, const Seen& b) {
  const int one = static_cast<int>(a.block), other = static_cast<int>(b.block);
  if (!uncovered.has(one, other)) return false;
  // Centers of cells that are so near are half a spacing behind each other's faces; nodes are on the faces.
  if (domain.cloud.at == PointsAt::nodes && !(is_behind(b, a) && is_behind(a, b))) return false;
  const double first = (Vector::Map(a.reference) - Vector::Map(b.reference)).norm();
  return domain.blocks[one].body == domain.blocks[other].body ? first > a.horizon + b.horizon
                                                              : first > std::min(a.edge, b.edge);
}

// True if points that started two horizons (in one body) or an edge (in two) apart cannot have come close.
bool hardly_moved(const Domain& domain) {
  Eigen::AlignedBox3d displacements;
  double edge = std::numeric_limits<double>::max();
  for (int i = 0; i < domain.owned; ++i) {
    displacements.extend(Vector(domain.current(i) - domain.reference(i)));
    edge = std::min(edge, edges_of_cell(domain, i).shortest);
  }
  displacements = common_box(displacements, domain.communicator);
  return displacements.isEmpty() || displacements.diagonal().norm() < (1 - near) * domain.communicator.min(edge);
}

// Counts the passed points of this rank, which are the first `mine` of `all`.
Interpenetration passed_points(const Domain& domain, const Uncovered& uncovered, std::size_t mine,
                               const std::vector<Seen>& all, double reach) {
  Interpenetration found;
  if (mine == 0) return found;
  const std::vector<Vector> places = places_of(all);
  const CellGrid grid(places, reach);
  for (std::size_t k = 0; k < mine; ++k) {
    const Seen* partner = nullptr;
    grid.visit_near(places[k], [&](int j, const Vector& place) {
      const double least = near * std::min(all[k].edge, all[j].edge);
      const bool is_near = (place - places[k]).squaredNorm() < least * least;
      if (is_near && has_passed(domain, uncovered, all[k], all[j])) partner = &all[j];
    });
    if (!partner) continue;
    ++found.points;
    found.point = static_cast<int>(all[k].index);
    found.first = static_cast<int>(std::min(all[k].block, partner->block));
    found.second = static_cast<int>(std::max(all[k].block, partner->block));
  }
  return found;
}

}  // namespace

std::optional<Interpenetration> find_undeclared(const Domain& domain, const Contact& contact) {
  const Uncovered uncovered(domain, contact);
  if (!uncovered.any() || hardly_moved(domain)) return std::nullopt;
  std::vector<Seen> all = at_surfaces(domain);
  fold(domain, all);
  const std::size_t mine = all.size();
  double edge = 0;
  for (const Seen& point : all) edge = std::max(edge, point.edge);
  const Communicator& ranks = domain.communicator;
  const double reach = near * ranks.max(edge);
  const Eigen::AlignedBox3d box = box_around(places_of(all));
  const std::vector<Seen> images = images_of(domain, all, reach);
  all.insert(all.end(), images.begin(), images.end());
  add_nearby(all, box, reach, ranks);
  Interpenetration found = passed_points(domain, uncovered, mine, all, reach);
  found.points = ranks.sum(found.points);
  if (found.points == 0) return std::nullopt;
  if (ranks.first_rank(found.point >= 0) != ranks.rank()) found.point = -1;
  return found;
}

}  // namespace strut::contact
