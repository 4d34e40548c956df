#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numbers>
#include <set>
#include <sstream>

#include "advice/checks.hpp"
#include "advice/mesh_nodes.hpp"
#include "contact/interpenetration.hpp"
#include "setup/found_points.hpp"
#include "topology/coincident.hpp"
#include "topology/nearby_ranks.hpp"
#include "topology/neighbors/cell_grid.hpp"
#include "topology/pieces.hpp"

namespace strut {

namespace {

// Limit of a family's volume over that of the sphere: lattices have at most 1.2 from a horizon of 1.5 spacings on,
// meshes of other elements 1 ± 0.25; a body that is defined twice has 2. Larger neighbors than the point reach out of
// that sphere by half of what their edges have more.
constexpr double crowded = 1.65;
constexpr double least_horizon = 1.5;  // in edges of a cube with the point's volume
// Elements of two parts of a mesh, which have no node in common: nearer than this, in edges of such a cube, points of a
// body that is defined twice are, and those of tetrahedra at one face are not (0.64).
constexpr double inside_below = 0.6;
constexpr double touching = 1.01, overlapping = 0.99;  // of the reaches of both cells, for round-off

// A point as it travels to other ranks.
struct Grain {
  double place[3], volume;
  std::int64_t body;
  Vector at() const { return Vector(place); }
};

// Points within a point's horizon, itself included.
struct Within {
  double volume = 0, edges = 0, count = 0;  // sums: m³; of cubes with the points' volumes, m
  void add(double of_point) { volume += of_point, edges += std::cbrt(of_point), count += 1; }
};

// Collective. For each owned point those of its body, bonded or not.
std::vector<Within> within_horizons(const Domain& domain) {
  std::vector<Grain> grains;
  Eigen::AlignedBox3d mine;
  double reach = 0;
  for (int i = 0; i < domain.owned; ++i) {
    const Vector X = domain.reference(i);
    grains.push_back({{X[0], X[1], X[2]}, domain.volume(i), domain.body_of(i)});
    mine.extend(X);
    reach = std::max(reach, domain.horizon(i));
  }
  reach = domain.communicator.max(reach);
  add_nearby(grains, mine, reach, domain.communicator);
  const std::vector<Vector> places = places_of(grains);
  const CellGrid grid(places, reach);
  std::vector<Within> all(domain.owned);
  for (int i = 0; i < domain.owned; ++i) {
    const double horizon = domain.horizon(i);
    grid.visit_near(places[i], [&](int j, const Vector& y) {
      const bool is_within = (y - places[i]).squaredNorm() < horizon * horizon;
      if (is_within && grains[j].body == grains[i].body) all[i].add(grains[j].volume);
    });
  }
  return all;
}

// Owned point i and those points of its family that lie within its own horizon: the family of a small point also holds
// larger points farther away.
Within neighbors_within(const Domain& domain, int i) {
  const double horizon = domain.horizon(i);
  Within all;
  all.add(domain.volume(i));
  domain.families.for_each(i, [&](int j) {
    const bool is_within = (domain.reference(j) - domain.reference(i)).squaredNorm() < horizon * horizon;
    if (is_within) all.add(domain.volume(j));
  });
  return all;
}

bool is_crowded(const Domain& domain, int i, const Within& within) {
  const double horizon = domain.horizon(i), edge = std::cbrt(domain.volume(i));
  if (horizon < least_horizon * edge) return false;
  const double reach = horizon + std::max(0.0, within.edges / within.count - edge) / 2;
  return within.volume > crowded * 4 * std::numbers::pi / 3 * reach * reach * reach;
}

// In a body of several pieces, visibility may leave out bonds between coincident points; otherwise families show them.
bool has_pieces(const Domain& domain, std::int64_t pieces) {
  std::set<int> bodies;
  for (const BlockHorizons& block : domain.blocks) bodies.insert(block.body);
  return pieces > std::ssize(bodies);
}

std::string crowds(const Body& body, std::int64_t pieces) {
  const Domain& domain = body.domain;
  std::vector<Within> within;
  if (has_pieces(domain, pieces)) within = within_horizons(domain);
  std::vector<int> points;
  for (int i = 0; i < body.owned(); ++i) {
    if (is_crowded(domain, i, within.empty() ? neighbors_within(domain, i) : within[i])) points.push_back(i);
  }
  const FoundPoints found = found_points(body, {points})[0];
  if (found.count == 0) return "";
  std::ostringstream text;
  text << "WARNING: around " << found.count << " points, one of them at " << place_text(found.one) << ", there is "
       << crowded << " times as much material as fits within the horizon, or more: elements that overlap, or are given "
       << "twice? Mass and stiffness count twice there\n";
  return text.str();
}

}  // namespace

namespace {

// An element with nodes, as it travels to other ranks. `part`: what the mesh joins, `piece`: what bonds join.
struct Element {
  double place[3], edge, moments[6];
  std::int64_t id, block, body, part, piece, is_whole, nodes[8];  // nodes: ascending; the last one is repeated

  Vector at() const { return Vector(place); }

  // The distance from its point to its face in a direction of unit length, as reach_of_cell().
  double reach(const Vector& direction) const {
    const Symmetric all = Eigen::Map<const Symmetric>(moments);  // zero where nothing needs them
    return std::sqrt(3 * direction.dot(to_tensor(all) * direction));
  }

  bool is_hexahedron() const { return nodes[6] != nodes[7]; }

  // A part may be another one because a crack cuts the bonds of elements with a common node.
  bool shares_a_node(const Element& other) const {
    return std::ranges::any_of(nodes, [&](std::int64_t node) { return std::ranges::binary_search(other.nodes, node); });
  }
};

// Parts of a body's mesh without a common node: owned points inside of elements of another part, and those beside one
// that nothing bonds to them.
struct AtOtherParts {
  std::vector<int> inside, beside;
};

// True if two elements touch along the line between their points.
bool touch(const Element& one, const Element& other, const Vector& between) {
  const Vector direction = between.stableNormalized();
  return between.norm() < touching * (one.reach(direction) + other.reach(direction));
}

// True if two boxes along the axes touch at a face, or overlap.
bool touch_as_boxes(const Element& one, const Element& other, const Vector& between) {
  int overlaps = 0;
  for (int c = 0; c < 3; ++c) {
    const double reaches = one.reach(Vector::Unit(c)) + other.reach(Vector::Unit(c)), apart = std::abs(between[c]);
    if (!(apart < touching * reaches)) return false;
    overlaps += apart < overlapping * reaches ? 1 : 0;
  }
  return overlaps >= 2;
}

bool is_along_an_axis(const Vector& between) {
  return between.norm() - between.lpNorm<Eigen::Infinity>() < 1e-9 * between.norm();
}

// A partly filled cell has its point anywhere, and its neighbors may be parts of their own.
bool is_whole(const Domain& domain, int i) {
  const double whole = std::pow(domain.cloud.spacings[i], 3);
  return std::abs(domain.volume(i) - whole) < 1e-6 * whole;
}

// Collective. The elements of this rank, `points` their local indices.
std::vector<Element> elements_of(const Domain& domain, const std::vector<std::int64_t>& parts,
                                 std::vector<int>& points) {
  const std::vector<std::int64_t> pieces = piece_ids(domain);
  std::vector<Element> elements;
  for (int i = 0; i < domain.owned; ++i) {
    if (domain.cloud.shared_nodes[i].empty()) continue;
    const Vector X = domain.reference(i);
    const std::vector<std::int64_t>& nodes = domain.cloud.shared_nodes[i];
    points.push_back(i);
    elements.push_back({.place = {X[0], X[1], X[2]},
                        .edge = domain.cloud.spacings[i],
                        .id = domain.id(i),
                        .block = domain.cloud.blocks[i],
                        .body = domain.body_of(i),
                        .part = parts[i],
                        .piece = pieces[i],
                        .is_whole = is_whole(domain, i)});
    for (std::size_t k = 0; k < 8; ++k) elements.back().nodes[k] = nodes[std::min(k, nodes.size() - 1)];
    if (!domain.cloud.shapes.empty()) Eigen::Map<Symmetric>(elements.back().moments) = domain.cloud.shapes[i].moments;
  }
  return elements;
}

// True if a crack separates owned point i from the point of this id, or their bond has broken.
bool is_cut(const Domain& domain, int i, std::int64_t id) {
  if (std::ranges::binary_search(domain.separated, std::pair(i, id))) return true;
  const auto& broken = domain.families.broken;
  return !broken.empty() && std::ranges::any_of(broken[i], [&](int j) { return domain.id(j) == id; });
}

// True if an interaction names the blocks of two points, whose bodies are then meant to meet.
bool meet(const deck::Deck& deck, const std::string& one, const std::string& other) {
  return std::ranges::any_of(deck.interactions, [&](const deck::Interaction& each) {
    return each.first_block.empty() ? each.partners == deck::Partners::itself && one == other
                                    : std::minmax(each.first_block, each.second_block) == std::minmax(one, other);
  });
}

// Collective.
AtOtherParts at_other_parts(const Domain& domain, const deck::Deck& deck) {
  if (domain.cloud.at == PointsAt::nodes) return {};
  const MeshNodes nodes(domain);
  if (!nodes.any()) return {};
  const std::vector<std::int64_t> parts = nodes.parts(domain);
  std::int64_t count = 0;
  for (int i = 0; i < domain.owned; ++i) count += parts[i] == domain.id(i) ? 1 : 0;
  if (!has_pieces(domain, domain.communicator.sum(count))) return {};
  std::vector<int> points;
  std::vector<Element> elements = elements_of(domain, parts, points);
  Eigen::AlignedBox3d mine;
  double near = std::numeric_limits<double>::min();
  for (const Element& one : elements) {
    mine.extend(one.at());
    const double widest = std::sqrt(3 * (one.moments[0] + one.moments[1] + one.moments[2]));
    near = std::max({near, one.edge, 2 * touching * widest});
  }
  near = domain.communicator.max(near);
  add_nearby(elements, mine, near, domain.communicator);
  const std::vector<Vector> places = places_of(elements);
  const std::vector<std::string>& names = domain.cloud.block_names;
  const CellGrid grid(places, near);
  AtOtherParts found;
  for (std::size_t e = 0; e < points.size(); ++e) {
    const Element& one = elements[e];
    bool is_inside = false, is_beside = false;
    bool is_along_axes = false, is_beside_as_box = false;  // a cube's moments do not tell how it is turned
    grid.visit_near(places[e], [&](int j, const Vector& y) {
      const Element& other = elements[j];
      const Vector between = y - places[e];
      is_along_axes = is_along_axes || (other.part == one.part && other.id != one.id && is_along_an_axis(between));
      if (other.body != one.body || other.part == one.part || one.shares_a_node(other)) return;
      const bool are_whole = one.is_whole != 0 && other.is_whole != 0;
      if (!are_whole && other.block == one.block) return;
      is_inside = is_inside || (are_whole && between.norm() < inside_below * std::min(one.edge, other.edge));
      if (other.piece == one.piece || is_cut(domain, points[e], other.id) ||
          meet(deck, names[one.block], names[other.block]))
        return;
      is_beside = is_beside || touch(one, other, between);
      is_beside_as_box =
          is_beside_as_box || (one.is_hexahedron() && other.is_hexahedron() && touch_as_boxes(one, other, between));
    });
    if (is_inside) found.inside.push_back(points[e]);
    if (is_beside || (is_along_axes && is_beside_as_box)) found.beside.push_back(points[e]);
  }
  return found;
}

// Collective. Points at nodes where others of their body are, with which no bonds connect them.
std::vector<int> unmerged_nodes(const Domain& domain, const deck::Deck& deck, std::int64_t pieces) {
  if (domain.cloud.at != PointsAt::nodes || !has_pieces(domain, pieces)) return {};
  const std::vector<std::int64_t> piece = piece_ids(domain);
  std::vector<Element> nodes;
  Eigen::AlignedBox3d mine;
  double near = std::numeric_limits<double>::min();
  for (int i = 0; i < domain.owned; ++i) {
    const Vector X = domain.reference(i);
    mine.extend(X), near = std::max(near, at_one_place * domain.cloud.spacings[i]);
    nodes.push_back({.place = {X[0], X[1], X[2]},
                     .edge = domain.cloud.spacings[i],
                     .block = domain.cloud.blocks[i],
                     .body = domain.body_of(i),
                     .piece = piece[i]});
  }
  near = domain.communicator.max(near);
  add_nearby(nodes, mine, near, domain.communicator);
  const std::vector<Vector> places = places_of(nodes);
  const std::vector<std::string>& names = domain.cloud.block_names;
  const CellGrid grid(places, near);
  std::vector<int> points;
  for (int i = 0; i < domain.owned; ++i) {
    bool is_unmerged = false;
    grid.visit_near(places[i], [&](int j, const Vector& y) {
      const Element &one = nodes[i], &other = nodes[j];
      is_unmerged = is_unmerged || (other.body == one.body && other.piece != one.piece &&
                                    (y - places[i]).norm() < at_one_place * one.edge &&
                                    !meet(deck, names[one.block], names[other.block]));
    });
    if (is_unmerged) points.push_back(i);
  }
  return points;
}

std::string parts_warning(const Body& body, const deck::Deck& deck, std::int64_t pieces, bool crowds_reported) {
  const AtOtherParts found = at_other_parts(body.domain, deck);
  const std::vector<int> unmerged = unmerged_nodes(body.domain, deck, pieces);
  const std::vector<FoundPoints> points =
      found_points(body, {found.inside, body.domain.cloud.at == PointsAt::nodes ? unmerged : found.beside});
  const FoundPoints &inside = points[0], &beside = points[1];
  std::ostringstream text;
  if (inside.count > 0 && !crowds_reported) {
    text << "WARNING: " << inside.count << " points, one of them at " << place_text(inside.one) << ", are nearer than "
         << inside_below
         << " of an element's edge to others of their body with which they share no node: elements that "
         << "overlap, or are given twice? Mass and stiffness count twice there\n";
  } else if (beside.count > 0 && inside.count == 0) {
    text << "WARNING: " << beside.count << " points, one of them at " << place_text(beside.one)
         << ", lie beside others of their body with which they share "
         << (body.domain.cloud.at == PointsAt::nodes ? "no element" : "no node")
         << ", and nothing connects the two, since bonds "
            "run through material only: nodes at one place that are not merged? Expected one node at each place, Bonds "
            "Across Voids true, or, for bodies that meet, Separate Body true\n";
  }
  return text.str();
}

}  // namespace

std::string overlaps(const Situation& situation) {
  const Body& body = situation.scene.body;
  const Domain& domain = body.domain;
  std::ostringstream text;
  // Cells of a grid do not overlap, and boxes of them hold more than the horizon.
  if (situation.deck.discretization.type != deck::MeshType::grid) {
    const std::string crowded_points = crowds(body, situation.scene.pieces);
    text << crowded_points << parts_warning(body, situation.deck, situation.scene.pieces, !crowded_points.empty());
  }
  for (const auto& [first, second, points] : contact::overlapping_blocks(domain)) {
    const FoundPoints found = found_points(body, {points})[0];
    if (found.count == 0) continue;
    text << "WARNING: " << found.count << " points of the blocks '" << domain.cloud.block_names[first] << "' and '"
         << domain.cloud.block_names[second] << "', one of them at " << place_text(found.one)
         << ", are inside of the other one at the start: mass counts twice there, and no contact parts them\n";
  }
  for (const contact::Interaction& one : situation.interactions) {
    constexpr double worth_telling = 0.1;
    const double overlap = domain.communicator.max(situation.scene.contact.overlap_at_start(one.first, one.second));
    if (one.first == one.second || overlap < worth_telling) continue;
    text << "blocks '" << domain.cloud.block_names[one.first] << "' and '" << domain.cloud.block_names[one.second]
         << "' overlap by up to about " << std::setprecision(2) << overlap
         << " spacings at the start: contact takes this for touching, without a force, so that together they stay "
            "shorter by as much than one after the other\n";
  }
  return text.str();
}

}  // namespace strut
