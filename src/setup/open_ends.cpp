#include "setup/open_ends.hpp"

#include <algorithm>
#include <map>

#include "setup/found_points.hpp"
#include "topology/cell_edges.hpp"
#include "topology/mirror_planes.hpp"

namespace strut {

namespace {

// Neighbors farther than this along the normal are in another layer, in thicknesses of a layer.
constexpr double next_layer = 0.5;

// The extent of a point's family along a direction, in thicknesses of a layer.
struct Extent {
  double ahead = 0, behind = 0, sum = 0;
  bool is_inside() const { return ahead > next_layer && behind > next_layer; }
};

Extent extent_along(const Vector& direction, const Domain& domain, int i) {
  Extent extent;
  const double thickness = edge_of_cell(domain, i, direction);
  domain.families.for_each(i, [&](int j) {
    const double along = direction.dot(domain.reference(j) - domain.reference(i)) / thickness;
    extent.ahead = std::max(extent.ahead, along), extent.behind = std::max(extent.behind, -along);
    extent.sum += along;
  });
  return extent;
}

// The computed fraction of a point's cell: a half on a symmetry plane, whose other half belongs to the image.
double part_between_planes(const Domain& domain, int i) {
  std::vector<Vector> outward;
  for (const Mirror& mirror : planes_through(domain, i)) {
    double side = 0;
    domain.families.for_each(i, [&](int j) {
      if (Images::image(domain.id(j)) == 0) side += mirror.distance(domain.reference(j));
    });
    outward.push_back(side > 0 ? Vector(-mirror.normal) : mirror.normal);
  }
  return part_within(outward);
}

struct EndsOfPoint {
  std::vector<Vector> normals;  // outward
  std::vector<bool> inside;     // whether the body goes on beyond the end
  std::vector<int> places;      // indices in the deck
};

std::map<int, EndsOfPoint> ends_of(const Conditions& conditions, const Body& body) {
  std::map<int, EndsOfPoint> ends;
  conditions.visit([&](const NonReflectingEnd& end) {
    for (const NonReflectingEnd::Drag& drag : end.drags) {
      const Extent extent = extent_along(end.normal, body.domain, drag.point);
      EndsOfPoint& of_point = ends[drag.point];
      of_point.inside.push_back(extent.is_inside());
      of_point.normals.push_back(extent.sum > 0 ? Vector(-end.normal) : end.normal);
      of_point.places.push_back(end.index);
    }
  });
  return ends;
}

}  // namespace

void take_off_what_is_beyond_ends(const Conditions& conditions, Body& body) {
  for (const auto& [i, of_point] : ends_of(conditions, body)) {
    const double whole_cell = part_between_planes(body.domain, i) * std::pow(body.domain.cloud.spacings[i], 3);
    body.density[i] *= std::min(1.0, part_within(of_point.normals) * whole_cell / body.domain.volume(i));
  }
}

void check_open_ends(const deck::Deck& deck, const Conditions& conditions, const Body& body, deck::Problems& problems) {
  std::vector<std::vector<int>> inside(deck.conditions.size()), without_inertia(deck.conditions.size());
  for (const auto& [i, of_point] : ends_of(conditions, body)) {
    for (std::size_t e = 0; e < of_point.places.size(); ++e) {
      if (of_point.inside[e]) inside[of_point.places[e]].push_back(i);
    }
    if (part_within(of_point.normals) == 0) without_inertia[of_point.places.back()].push_back(i);
  }
  const std::vector<FoundPoints> inner = found_points(body, inside), empty = found_points(body, without_inertia);
  for (std::size_t c = 0; c < deck.conditions.size(); ++c) {
    const std::string path = "Boundary Conditions > " + deck.conditions[c].name + " > ";
    if (inner[c].count > 0) {
      problems.add(path + "Node Set", std::to_string(inner[c].count) +
                                          " of its points have others of the body on both sides along Normal, "
                                          "one of them at " +
                                          place_text(inner[c].one) + "; expected one layer, that of the end's surface");
    }
    if (empty[c].count > 0) {
      problems.add(path + "Normal",
                   std::to_string(empty[c].count) + " points, one of them at " + place_text(empty[c].one) +
                       ", are of other ends, too, and together these leave nothing of their inertia; expected at most "
                       "three ends at a point, whose normals are not in one plane");
    }
  }
}

}  // namespace strut
