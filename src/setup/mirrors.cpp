#include "setup/mirrors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "base/errors.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "base/text.hpp"
#include "conditions/symmetry_plane.hpp"
#include "setup/blocks.hpp"
#include "setup/periods.hpp"
#include "topology/cloud.hpp"

namespace strut {

namespace {

// Distance from the plane to the point of a cell at it, over the extent of the cell beyond its point along the normal:
// 1 for a hexahedron, 0.75 for a tetrahedron with a face on the plane, 2.2 with a corner; 3 one layer behind.
constexpr double nearest = 0.5, farthest_of_nearest = 1.5, farthest = 2.6;

double distance_in_extents(const PointCloud& cloud, const Mirror& plane, std::size_t i) {
  return std::abs(plane.distance(cloud.positions[i])) /
         reach_of_cell(cloud, cloud.volumes[i], static_cast<int>(i), plane.normal);
}

bool is_whole(const PointCloud& cloud, std::size_t i) {
  const double whole = std::pow(cloud.spacings[i], 3);
  return std::abs(cloud.volumes[i] - whole) < 1e-6 * whole;
}

bool has_node_on(const Mirror& plane, const PointCloud& cloud, std::size_t i) {
  const auto is_on = [&](std::int64_t node) { return (node >> (first_plane_bit + plane.bit) & 1) != 0; };
  return !cloud.shared_nodes.empty() && std::ranges::any_of(cloud.shared_nodes[i], is_on);
}

// Statistics of the points of a body relative to a plane.
struct Place {
  double points = 0, in_set = 0;                  // numbers of points
  double before = 0, behind = 0;                  // numbers of points off the plane, on either side of it
  double distances = 0;                           // sum for those in the set, in units of the extent of their cells
  double least = HUGE_VAL, most = 0, most_m = 0;  // for those in the set; most_m in m
  double off = 0;                                 // number of those in the set that are off the plane
  double apart = 0;  // number of those in the set whose bonds need a node on the plane, but that have none
  double gap = 0;    // m, the largest between the plane and such a whole element
  double free = 0;   // number at the plane, but not in the set
};

bool is_in(const PointCloud& cloud, const std::string& set, std::size_t i) {
  const auto name = std::find(cloud.set_names.begin(), cloud.set_names.end(), set);
  if (name == cloud.set_names.end()) return false;
  return (cloud.sets[i] >> (name - cloud.set_names.begin()) & 1) != 0;
}

class PlaneSearch {
 public:
  PlaneSearch(const PointCloud& cloud, const Mirror& plane, const std::string& set,
              const std::vector<BlockBonds>& bonds, const Communicator& communicator)
      : cloud_(cloud), plane_(plane), set_(set), bonds_(bonds), communicator_(communicator) {}

  Place place() const {
    Place found;
    over_body([&](std::size_t i) { classify(i, found); });
    double sums[] = {found.points, found.in_set, found.before, found.behind, found.distances, found.off, found.apart};
    double most[] = {-found.least, found.most, found.most_m, found.gap};
    communicator_.sum(sums), communicator_.max(most);
    found = {sums[0], sums[1], sums[2], sums[3], sums[4], -most[0], most[1], most[2], sums[5], sums[6], most[3]};
    const double mean = found.in_set > 0 ? found.distances / found.in_set : 0;
    double free = 0;
    over_body([&](std::size_t i) {
      free += !is_in(cloud_, set_, i) && is_at_plane(i) && distance(i) <= mean + on_plane ? 1 : 0;
    });
    found.free = communicator_.sum(free);
    return found;
  }

 private:
  template <class Visit>
  void over_body(const Visit& visit) const {
    for (std::size_t i = 0; i < cloud_.size(); ++i) {
      if (bonds_[cloud_.blocks[i]].body == plane_.body) visit(i);
    }
  }
  // A node's in spacings, an element's in units of the extent of its cell. A partly filled element
  // that has a node on the plane counts as at it, even if only its far side is filled.
  double distance(std::size_t i) const {
    if (cloud_.at == PointsAt::nodes) return std::abs(plane_.distance(cloud_.positions[i])) / cloud_.spacings[i];
    const double in_extents = distance_in_extents(cloud_, plane_, i);
    const bool may_end_before = !is_whole(cloud_, i) && has_node_on(plane_, cloud_, i);
    return may_end_before ? std::clamp(in_extents, nearest, farthest_of_nearest) : in_extents;
  }
  void classify(std::size_t i, Place& found) const {
    const double signed_distance = plane_.distance(cloud_.positions[i]);
    ++found.points;
    const bool is_off = !plane_.holds(cloud_.positions[i], cloud_.spacings[i]);
    if (is_off) ++(signed_distance > 0 ? found.before : found.behind);
    if (!is_in(cloud_, set_, i)) return;
    found.off += is_off ? 1 : 0;
    const double here = distance(i);
    ++found.in_set;
    found.distances += here;
    found.least = std::min(found.least, here), found.most = std::max(found.most, here);
    if (cloud_.at == PointsAt::nodes || here > farthest_of_nearest)
      found.most_m = std::max(found.most_m, std::abs(signed_distance));
    if (cloud_.shapes.empty() || cloud_.at == PointsAt::nodes) return;
    if (here < farthest_of_nearest) look_for_nodes(i, found);
  }
  // False for a partly filled element that is not at the plane itself, but into which a small one at it was merged.
  bool is_at_plane(std::size_t i) const {
    return cloud_.at == PointsAt::nodes || is_whole(cloud_, i) || has_node_on(plane_, cloud_, i);
  }
  // Partly filled elements may be cut by the plane, if their bonds need no common nodes.
  void look_for_nodes(std::size_t i, Place& found) const {
    const BlockBonds& block = bonds_[cloud_.blocks[i]];
    const bool whole = is_whole(cloud_, i);
    if (!(whole || block.visible_only || block.touching) || cloud_.shared_nodes[i].empty() ||
        has_node_on(plane_, cloud_, i))
      return;
    ++found.apart;
    const double reach = reach_of_cell(cloud_, cloud_.volumes[i], static_cast<int>(i), plane_.normal);
    if (whole) found.gap = std::max(found.gap, std::abs(std::abs(plane_.distance(cloud_.positions[i])) - reach));
  }

  const PointCloud& cloud_;
  const Mirror& plane_;
  const std::string& set_;
  const std::vector<BlockBonds>& bonds_;
  const Communicator& communicator_;
};

// True if the points are on the plane in the middle of a whole body: they stay there, and nothing is missing.
bool holds_the_middle(const Place& place) { return place.before > 0 && place.behind > 0 && place.off == 0; }

// The reason why the body does not continue behind the plane as its mirror image; empty if it does. `whole_cells`: its
// formulation needs whole cells, of which nodes on the plane have a half.
std::string objection(const Place& place, PointsAt at, bool whole_cells) {
  std::ostringstream text;
  text.precision(3);
  const bool at_nodes = at == PointsAt::nodes;
  if (place.in_set == place.points) {
    text << "all points of a body are in the set (plane strain)";
  } else if (place.before > 0 && place.behind > 0) {
    text << "the body of its points lies on both sides of the plane";
  } else if (at_nodes ? place.off > 0 : place.most > farthest || place.least > farthest_of_nearest) {
    text << "points of the set are up to " << place.most_m << " m away from the plane; expected "
         << (at_nodes ? "nodes on it" : "elements with a face, edge or corner on it");
  } else if (!at_nodes && place.least < nearest) {
    text << "the plane runs through elements of the set; expected faces of elements on it";
  } else if (place.gap > 0) {
    text << "the plane is about " << place.gap << " m off the faces of " << place.apart
         << " elements of the set, which have no node on it; expected a plane through nodes, to " << on_plane
         << " of an element's edge";
  } else if (place.apart > 0) {
    text << place.apart
         << " partly filled elements of the set have no node on the plane, and their bonds run by common nodes only; "
            "expected a plane through nodes of the mesh";
  } else if (place.free > 0) {
    text << place.free << " points at the plane are not in the set";
  } else if (at_nodes && whole_cells) {
    text << "quadratic correspondence has no mirror images of points at nodes; expected Points \"Elements\"";
  }
  return text.str();
}

std::string path_of(const deck::Deck& deck, const Mirror& plane) {
  return "Boundary Conditions > " + deck.conditions[plane.number].name;
}

// Planes of one body that are not parallel must meet at 180°/n, or the images of the body would overlap.
void check_angles(const deck::Deck& deck, const std::vector<Mirror>& planes) {
  for (std::size_t a = 0; a < planes.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (planes[a].body != planes[b].body) continue;
      const double sine = planes[a].normal.cross(planes[b].normal).norm();
      const double angle = std::atan2(sine, std::abs(planes[a].normal.dot(planes[b].normal)));
      const double parts = std::numbers::pi / angle;
      if (sine < 1e-9 || std::abs(parts - std::round(parts)) < 1e-6) continue;
      throw Error(text_of(path_of(deck, planes[b]), " and ", path_of(deck, planes[a]),
                          ": symmetry planes of one body at ", angle * 180 / std::numbers::pi,
                          "°; expected 180°/n (90, 60, 45 …), or the mirror images overlap"));
    }
  }
}

// True if a block of the body is by quadratic correspondence.
bool is_quadratic_body(const deck::Deck& deck, const PointCloud& cloud, const std::vector<BlockBonds>& bonds,
                       int body) {
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const int material = section_of(deck, cloud.block_names[b])->material;
    if (bonds[b].body == body && is_quadratic(deck.materials[material])) return true;
  }
  return false;
}

}  // namespace

std::vector<Mirror> symmetry_planes(const deck::Deck& deck) {
  constexpr int first = 2 * lower_side;  // bit after those of periodic sides
  std::vector<Mirror> planes;
  for (int c = 0; c < static_cast<int>(deck.conditions.size()); ++c) {
    const auto* plane = std::get_if<SymmetryPlane>(&deck.conditions[c].kind);
    if (!plane || deck.conditions[c].node_set == "all") continue;
    planes.push_back(
        {.on = plane->point, .normal = plane->normal, .number = c, .bit = first + static_cast<int>(planes.size())});
  }
  if (planes.size() > static_cast<std::size_t>(most_planes - first)) {
    throw Error("Boundary Conditions: " + std::to_string(planes.size()) + " symmetry planes of node sets; expected " +
                std::to_string(most_planes - first) + " at most");
  }
  return planes;
}

Mirrors mirrors(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator) {
  Mirrors found;
  const std::vector<BlockBonds> bonds = block_bonds(deck, cloud);
  std::vector<int> bodies;
  for (const BlockBonds& block : bonds) bodies.push_back(block.body);
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  for (Mirror plane : symmetry_planes(deck)) {
    for (const int body : bodies) {
      plane.body = body;
      const std::string& set = deck.conditions[plane.number].node_set;
      Place place = PlaneSearch(cloud, plane, set, bonds, communicator).place();
      if (deck.discretization.grid.boxes) place.apart = place.gap = 0;  // boxes are no nodes, and are refused below
      if (place.in_set == 0 || holds_the_middle(place)) continue;
      const bool is_quadratic = is_quadratic_body(deck, cloud, bonds, body);
      const std::string text = objection(place, cloud.at, is_quadratic);
      if (text.empty()) {
        Mirror inward = plane;
        if (place.behind > 0) inward.normal *= -1;
        found.planes.push_back(inward);
      } else {
        found.warnings += "WARNING: " + path_of(deck, plane) + ": " + text +
                          "; so these points only keep their distance to it, with an error of the first order in the "
                          "spacing, and the body does not go on as its mirror image\n";
      }
    }
  }
  if (deck.discretization.grid.boxes && !found.planes.empty()) {
    throw Error(path_of(deck, found.planes.front()) +
                ": families that are boxes of cells end with the grid, and do not go on behind the plane; expected "
                "Discretization > NeighborhoodType \"Spherical\"");
  }
  check_angles(deck, found.planes);
  return found;
}

void add_faces_without_images(const deck::Deck& deck, const FacesOnPlanes& faces, const Communicator& communicator,
                              PointCloud& cloud) {
  if (communicator.sum(std::ssize(faces)) == 0) return;
  const std::vector<BlockBonds> bonds = block_bonds(deck, cloud);
  const std::vector<Mirror> planes = mirrors(deck, cloud, communicator).planes;
  for (FaceOnPlanes face : faces) {
    const auto has_image = [&](const Mirror& plane) {
      return plane.body == bonds[cloud.blocks[face.point]].body && (face.planes >> plane.bit & 1) != 0;
    };
    if (std::ranges::any_of(planes, has_image)) continue;
    face.planes = 0;
    add_face(face, cloud);
  }
}

namespace {

// A cell's face on a plane or periodic side; its areas are in m².
struct CellFace {
  std::array<std::int64_t, 4> nodes;  // their numbers, ascending
  int point;
  double filled;     // by material, estimated from the cell's volume and centroid
  double uncounted;  // the part of `filled` that the mesh does not count as surface of the body
};

constexpr std::int64_t number_of_node = (std::int64_t{1} << first_plane_bit) - 1;

// The distance between the face of a cell on the plane and the opposite face of this cell, m.
double thickness(const Mirror& plane, const PointCloud& cloud, int i) {
  return 2 * std::abs(plane.distance(cloud.positions[i]));
}

// Sets the areas of a face. The x axis points out of the body, h is the thickness of the cell along x, and X is the
// middle of the cell. The material in the cell has the volume V and is bounded by the surface that the mesh counts,
// with the area a = ∫ n_x dA and the moment M = ∫ n_x (x − X) dA; by the uncounted area A of the face on the plane; and
// by the area B of the opposite face. The integrals over this whole boundary are a + A − B = 0 and M + (A + B) h/2 = V.
void estimate(const Mirror& plane, const PointCloud& cloud, CellFace& face) {
  const double h = thickness(plane, cloud, face.point), volume = cloud.volumes[face.point];
  const CellShape& shape = cloud.shapes[face.point];
  const double ahead = -plane.normal.dot(shape.offset);
  const double filled = ahead > 0 ? volume / (h - 2 * ahead) : volume / h * (1 + 6 * ahead / h);
  const double moment = plane.normal.dot(shape.surface_moments * plane.normal);
  const double facing = -plane.normal.dot(shape.surface);
  face.filled = std::clamp(filled, 0.0, std::pow(cloud.spacings[face.point], 3) / h),
  face.uncounted = (volume - moment - 0.5 * h * facing) / h;
}

// The faces of this rank's hexahedra that are bodies' ends at a plane or side, as far as their filling reaches it.
// Periodic sides are of all bodies.
std::vector<CellFace> faces_on(const Mirror& plane, const std::vector<BlockBonds>& bonds, const PointCloud& cloud) {
  const bool is_lower = plane.period > 0 && plane.normal.sum() > 0;
  const int bit = first_plane_bit + plane.bit + (is_lower ? lower_side : 0);
  std::vector<CellFace> faces;
  for (int i = 0; i < std::ssize(cloud.shapes); ++i) {
    if (plane.period == 0 && bonds[cloud.blocks[i]].body != plane.body) continue;
    if (distance_in_extents(cloud, plane, i) > farthest_of_nearest) continue;
    CellFace face{.nodes = {}, .point = i, .filled = 0, .uncounted = 0};
    std::size_t count = 0;
    for (const std::int64_t node : cloud.shared_nodes[i]) {
      if ((node >> bit & 1) != 0 && count++ < 4) face.nodes[count - 1] = node & number_of_node;
    }
    if (count != 4) continue;
    std::ranges::sort(face.nodes);
    estimate(plane, cloud, face);
    faces.push_back(face);
  }
  return faces;
}

// Collective. Those of all ranks; not many, as they are of one plane or side.
template <class One>
std::vector<One> of_all_ranks(const std::vector<One>& mine, const Communicator& communicator) {
  std::vector<One> leaving;
  for (int rank = 0; rank < communicator.size(); ++rank) std::ranges::copy(mine, std::back_inserter(leaving));
  const std::vector<std::int64_t> to(communicator.size(), std::ssize(mine)), from = counts_from_ranks(communicator, to);
  return exchange<One>(communicator, leaving, to, from);
}

// Collective. True if the faces of cells on a plane are counted as surface: the mesh was cut there. Of lattices and
// foams -0.1 to 0.5 of the filled area is not counted then, 0.9 to 1.5 in meshes that were made to repeat.
bool cuts(const std::vector<CellFace>& faces, const Communicator& communicator) {
  double sums[] = {0, 0};
  for (const CellFace& face : faces) sums[0] += face.filled, sums[1] += face.uncounted;
  communicator.sum(sums);
  return sums[1] < 0.7 * sums[0];
}

void take_off(const Mirror& plane, double area, double thickness, CellShape& shape) {
  const Vector outward = -plane.normal;
  const Vector along = shape.offset - outward.dot(shape.offset) * outward;
  shape.surface -= area * outward;
  shape.surface_moments -= area * outward * (along + 0.5 * thickness * outward).transpose();
}

// `behind`: the filled areas of the faces on the other side of a period; null at a mirror, behind which all goes on.
void take_off(const Mirror& plane, const std::vector<CellFace>& faces,
              const std::map<std::array<std::int64_t, 4>, double>* behind, PointCloud& cloud) {
  for (const CellFace& face : faces) {
    double area = face.filled - std::clamp(face.uncounted, 0.0, face.filled);
    if (behind) area = behind->contains(face.nodes) ? std::min(area, behind->at(face.nodes)) : 0;
    if (area > 0) take_off(plane, area, thickness(plane, cloud, face.point), cloud.shapes[face.point]);
  }
}

// Collective. Marks the shared nodes on a plane to which the filling of no element reaches: there the void goes on
// behind the plane, and an element has no bond to its image.
void mark_void(const Mirror& plane, const std::vector<BlockBonds>& bonds, const Communicator& communicator,
               PointCloud& cloud) {
  const auto is_on = [&](std::int64_t node) { return (node >> (first_plane_bit + plane.bit) & 1) != 0; };
  const auto over_nodes = [&](const auto& visit) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (bonds[cloud.blocks[i]].body != plane.body) continue;
      for (std::int64_t& node : cloud.shared_nodes[i]) {
        if (is_on(node)) visit(i, node);
      }
    }
  };
  std::vector<std::int64_t> reached;
  over_nodes([&](std::size_t i, std::int64_t node) {
    if (is_whole(cloud, i) || distance_in_extents(cloud, plane, i) <= farthest_of_nearest) reached.push_back(node);
  });
  std::ranges::sort(reached);
  reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
  const std::vector<std::int64_t> all = of_all_ranks(reached, communicator);
  const std::set<std::int64_t> filled(all.begin(), all.end());
  over_nodes([&](std::size_t, std::int64_t& node) {
    if (!filled.contains(node)) node |= std::int64_t{1} << (first_void_bit + plane.bit);
  });
  for (std::vector<std::int64_t>& nodes : cloud.shared_nodes) std::ranges::sort(nodes);
}

}  // namespace

void take_off_cuts(const deck::Deck& deck, const Communicator& communicator, PointCloud& cloud) {
  const bool has_cells = cloud.at == PointsAt::elements && !cloud.shapes.empty() && !cloud.shared_nodes.empty();
  if (!communicator.any(has_cells)) return;
  const std::vector<BlockBonds> bonds = block_bonds(deck, cloud);
  for (const Mirror& plane : mirrors(deck, cloud, communicator).planes) {
    const std::vector<CellFace> faces = faces_on(plane, bonds, cloud);
    if (cuts(faces, communicator)) take_off(plane, faces, nullptr, cloud);
    mark_void(plane, bonds, communicator, cloud);
  }
  const std::vector<Mirror> sides = sides_of_periods(deck);  // a lower and an upper one in turn
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const std::vector<CellFace> faces = faces_on(sides[s], bonds, cloud);
    if (!cuts(faces, communicator)) continue;
    std::map<std::array<std::int64_t, 4>, double> behind;
    for (const CellFace& face : of_all_ranks(faces_on(sides[s ^ 1], bonds, cloud), communicator))
      behind[face.nodes] += face.filled;  // parts of cells may have all nodes in common
    take_off(sides[s], faces, &behind, cloud);
  }
}

}  // namespace strut
