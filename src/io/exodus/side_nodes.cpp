#include "io/exodus/side_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "base/parallel/gather_scatter.hpp"
#include "base/union_find.hpp"
#include "io/exodus/surface.hpp"
#include "topology/cloud.hpp"

namespace strut::io {

namespace {

// A node on sides: the number of its place, which its images have, too; the bits of the sides that it lies on; its
// index in the file.
struct SideNode {
  std::int64_t place, sides, node;
  auto operator<=>(const SideNode&) const = default;
};

using Flat = std::complex<double>;  // a vector in the plane of a side, m or of unit length

double cross(const Flat& a, const Flat& b) { return std::imag(std::conj(a) * b); }

// The material of a partly filled cell where it meets a side.
struct Section {
  Flat middle;
  double variances[3], gap;  // xx, xy, yy: of places in it, m²; m between the material and the side

  // Half its width if it is a rectangle along or across the direction, which is of unit length.
  double reach(const Flat& along) const {
    const double x = along.real(), y = along.imag();
    return std::sqrt(3 * std::max(0.0, variances[0] * x * x + 2 * variances[1] * x * y + variances[2] * y * y));
  }
};

// A corner of a face on a side, as it travels to the rank that compares the faces at its place.
struct SideCorner {
  SideNode node;
  int axis, is_upper, is_partly_filled;
  Flat next, last, inward;  // of unit length: along its edges, counterclockwise, and between them
  Section section;          // of a partly filled cell
};

bool holds(const SideCorner& one, const Flat& direction) {
  constexpr double least = 1e-3;
  return cross(one.next, direction) > least && cross(direction, one.last) > least;
}

// True if the faces lie over each other beside their common place, one on each side. Those of tetrahedra may halve a
// square in two ways.
bool meet(const SideCorner& a, const SideCorner& b) {
  return a.axis == b.axis && a.is_upper != b.is_upper && (holds(a, b.inward) || holds(b, a.inward));
}

// The distance between the materials behind two faces that meet, m: the largest along 12 directions. 0 or less if they
// touch.
double apart(const SideCorner& a, const SideCorner& b) {
  if (a.is_partly_filled == 0 || b.is_partly_filled == 0) return 0;
  const Flat between = b.section.middle - a.section.middle;
  double distance = -HUGE_VAL;
  for (int n = 0; n < 12; ++n) {
    const Flat along = std::polar(1.0, std::numbers::pi * n / 12);
    const double middles = std::abs(std::real(std::conj(between) * along));
    distance = std::max(distance, middles - (a.section.reach(along) + b.section.reach(along)));
  }
  return distance + (a.section.gap + b.section.gap);
}

// The section by a straight strut with the cell's moments, whose middle moves by `slope` per m along the axis.
Section section_of(const PartialCell& cell, const Mirror& side, int axis) {
  const Tensor moments = to_tensor(cell.moments);
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  const double along = moments(axis, axis), ahead = side.on[axis] - cell.centroid[axis];
  const Flat slope = Flat(moments(x, axis), moments(y, axis)) / along;
  return {Flat(cell.centroid[x], cell.centroid[y]) + ahead * slope,
          {moments(x, x) - along * slope.real() * slope.real(), moments(x, y) - along * slope.real() * slope.imag(),
           moments(y, y) - along * slope.imag() * slope.imag()},
          std::max(0.0, std::abs(ahead) - std::sqrt(3 * along))};
}

// The ways to the ranks that compare what is at a place.
template <class T, class Place>
Routes to_owners(const std::vector<T>& all, const Communicator& communicator, const Place& place) {
  std::vector<int> owners;
  for (const T& one : all) owners.push_back(static_cast<int>(place(one) % communicator.size()));
  return {communicator, owners};
}

// The nodes of a rank's elements that lie on sides, and the corners of faces there.
class Sides {
 public:
  Sides(const MeshSlice& slice, const std::vector<Mirror>& planes, const std::vector<double>& spacings)
      : slice_(slice), mesh_(slice.mesh), planes_(planes), spacings_(spacings) {}

  std::vector<SideNode> nodes() const {
    std::vector<SideNode> all;
    for_each_element([&](const Mesh::Block&, std::size_t, std::span<const int>, std::span<const SideNode> nodes) {
      std::ranges::copy_if(nodes, std::back_inserter(all), [](const SideNode& one) { return one.place != 0; });
    });
    std::ranges::sort(all);
    const auto rest = std::ranges::unique(all);
    all.erase(rest.begin(), rest.end());
    return all;
  }

  // `asked`: for each local node whether its corners are.
  std::vector<SideCorner> corners(const std::vector<char>& asked) const {
    std::vector<SideCorner> all;
    for_each_element([&](const Mesh::Block& block, std::size_t element, std::span<const int> corners,
                         std::span<const SideNode> nodes) {
      if (std::ranges::none_of(corners, [&](int node) { return asked[node] != 0; })) return;
      for (const auto& face : sides_of(block.type)) add_corners(block, element, face, corners, nodes, asked, all);
    });
    return all;
  }

 private:
  // Calls visit(block, element in it, its nodes here, the same as nodes on sides: place 0 if they are on none).
  template <class Visit>
  void for_each_element(const Visit& visit) const {
    std::size_t element = 0;
    std::vector<SideNode> nodes;
    for (const Mesh::Block& block : mesh_.blocks) {
      const std::size_t size = block.nodes.size() / std::max<std::size_t>(1, block.elements());
      for (std::size_t e = 0; e < block.elements(); ++e, ++element) {
        if (block.type == "SPHERE") continue;
        const std::span<const int> corners(&block.nodes[e * size], size);
        nodes.clear();
        for (const int node : corners) nodes.push_back(side_node(node, spacings_[element]));
        visit(block, e, corners, nodes);
      }
    }
  }

  SideNode side_node(int node, double spacing) const {
    const std::int64_t shared = shared_node_at(mesh_.nodes[node], 0, planes_, spacing);
    if ((shared & of_place) == 0) return {0, 0, slice_.nodes[node]};
    return {shared & ((std::int64_t{1} << first_plane_bit) - 1), shared >> first_plane_bit, slice_.nodes[node]};
  }

  void add_corners(const Mesh::Block& block, std::size_t element, const int (&face)[4], std::span<const int> corners,
                   std::span<const SideNode> nodes, const std::vector<char>& asked,
                   std::vector<SideCorner>& all) const {
    const int count = face[3] < 0 ? 3 : 4;
    for (const Mirror& side : planes_) {
      const bool is_upper = side.normal.sum() < 0;
      const int bit = side.bit + (is_upper ? 0 : lower_side);
      const auto is_on = [&](int corner) { return corner < 0 || (nodes[corner].sides >> bit & 1) != 0; };
      if (side.period == 0 || !std::ranges::all_of(face, is_on)) continue;
      int axis = 0;
      side.normal.cwiseAbs().maxCoeff(&axis);
      const auto at = [&](int c) {
        const Vector& X = mesh_.nodes[corners[face[(c + count) % count]]];
        return Flat(X[(axis + 1) % 3], X[(axis + 2) % 3]);
      };
      Flat middle = 0;
      for (int c = 0; c < count; ++c) middle += at(c) / static_cast<double>(count);
      for (int c = 0; c < count; ++c) {
        if (asked[corners[face[c]]] == 0) continue;
        int next = c + 1, last = c - 1;  // a hexahedron collapsed to a wedge has corners twice
        while (next < c + count && at(next) == at(c)) ++next;
        while (last > c - count && at(last) == at(c)) --last;
        if (!is_upper) std::swap(next, last);
        const auto toward = [&](const Flat& other) { return (other - at(c)) / std::abs(other - at(c)); };
        SideCorner& corner = all.emplace_back(SideCorner{nodes[face[c]],
                                                         axis,
                                                         is_upper,
                                                         !block.cells.empty(),
                                                         toward(at(next)),
                                                         toward(at(last)),
                                                         toward(middle),
                                                         {}});
        if (!block.cells.empty()) corner.section = section_of(block.cells[element], side, axis);
      }
    }
  }

  const MeshSlice& slice_;
  const Mesh& mesh_;
  const std::vector<Mirror>& planes_;
  const std::vector<double>& spacings_;
};

// Joins the nodes of faces that meet at a place. Parts of cells that share a hexahedron have their faces at one place:
// of these, material must touch, or be the nearest on both sides.
template <class Join>
void join_faces(std::span<const SideCorner> corners, const Join& join) {
  std::vector<double> least(corners.size(), HUGE_VAL);
  const auto for_each_pair = [&](const auto& visit) {
    for (std::size_t a = 0; a < corners.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        if (meet(corners[a], corners[b])) visit(a, b, apart(corners[a], corners[b]));
      }
    }
  };
  for_each_pair([&](std::size_t a, std::size_t b, double distance) {
    least[a] = std::min(least[a], distance), least[b] = std::min(least[b], distance);
  });
  for_each_pair([&](std::size_t a, std::size_t b, double distance) {
    if (distance <= 0 || (distance <= least[a] && distance <= least[b])) join(corners[a].node, corners[b].node);
  });
}

// The places, ascending, at which a side has several of these nodes, which ascend, too.
std::vector<std::int64_t> places_of_several(const std::vector<SideNode>& nodes) {
  std::vector<std::int64_t> places;
  for (std::size_t n = 1; n < nodes.size(); ++n) {
    const SideNode &one = nodes[n - 1], &other = nodes[n];
    if (one.place == other.place && one.sides == other.sides && (places.empty() || places.back() != one.place))
      places.push_back(one.place);
  }
  return places;
}

}  // namespace

std::vector<std::int64_t> seams_at_sides(const MeshSlice& slice, const std::vector<Mirror>& planes,
                                         const std::vector<double>& spacings, const Communicator& communicator) {
  std::vector<std::int64_t> seams(slice.nodes.size(), 0);
  if (std::ranges::none_of(planes, [](const Mirror& plane) { return plane.period > 0; })) return seams;
  const Sides sides(slice, planes, spacings);
  const std::vector<SideNode> mine = sides.nodes();
  const Routes routes = to_owners(mine, communicator, [](const SideNode& one) { return one.place; });
  const std::vector<SideNode> arrived = routes.there(mine);
  std::vector<SideNode> all = arrived;
  std::ranges::sort(all);
  const auto rest = std::ranges::unique(all);
  all.erase(rest.begin(), rest.end());
  const std::vector<std::int64_t> places = places_of_several(all);
  if (!communicator.any(!places.empty())) return seams;

  const auto here = [&](std::int64_t node) {
    return std::ranges::lower_bound(slice.nodes, node) - slice.nodes.begin();
  };
  const auto answered = [&](const auto& answer) {
    std::vector<std::int64_t> answers;
    for (const SideNode& one : arrived)
      answers.push_back(std::ranges::binary_search(places, one.place) ? answer(one) : 0);
    return routes.back(answers);
  };
  const std::vector<std::int64_t> of_several = answered([](const SideNode&) { return std::int64_t{1}; });
  std::vector<char> asked(slice.nodes.size(), 0);
  for (std::size_t n = 0; n < mine.size(); ++n) asked[here(mine[n].node)] |= of_several[n] != 0;
  const std::vector<SideCorner> leaving = sides.corners(asked);
  std::vector<SideCorner> corners =
      to_owners(leaving, communicator, [](const SideCorner& one) { return one.node.place; }).there(leaving);
  std::ranges::stable_sort(corners, {}, [](const SideCorner& one) { return one.node.place; });

  UnionFind joined(all.size());
  const auto number = [&](const SideNode& one) {
    return static_cast<int>(std::ranges::lower_bound(all, one) - all.begin());
  };
  for (auto begin = corners.begin(); begin != corners.end();) {
    const auto end =
        std::find_if(begin, corners.end(), [&](const SideCorner& one) { return one.node.place != begin->node.place; });
    join_faces({begin, end}, [&](const SideNode& a, const SideNode& b) { joined.join(number(a), number(b)); });
    begin = end;
  }
  const std::vector<std::int64_t> found =
      answered([&](const SideNode& one) { return 1 + all[joined.first(number(one))].node; });
  for (std::size_t n = 0; n < mine.size(); ++n) seams[here(mine[n].node)] = found[n];
  return seams;
}

}  // namespace strut::io
