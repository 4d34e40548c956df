#include "mesh/tessellation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <voro++/voro++.hh>

namespace strut::mesh {

namespace {

// Lengths in this file are in halves of the lattice constant: voro++ has absolute tolerances, and the sites of the BCC
// lattice are the points whose integer coordinates are all even or all odd.
using Site = Eigen::Array3i;

const double nearest = std::sqrt(3.0);  // distance of nearest neighbors
// Margin around the box: an empty sphere among the seeds has a radius of 1.12 on the lattice and at most 1.99 in the
// most irregular one, so no vertex near the box depends on a seed, or a wall of the container, beyond the margin.
constexpr double margin = 5;
constexpr int most_tries = 100;

// Uniform in [-1, 1), the same on every machine, unlike the library's distributions.
double uniform(std::mt19937_64& random) { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; }

Vector in_unit_ball(std::mt19937_64& random) {
  Vector x;
  do {
    for (int k = 0; k < 3; ++k) x[k] = uniform(random);
  } while (x.squaredNorm() > 1);
  return x;
}

class Seeds {
 public:
  // `half`: of the box's size.
  Seeds(const Vector& half, double irregularity, std::uint64_t seed)
      : reach_((half.array() + margin).ceil().cast<int>()),
        width_(2 * reach_ + 1),
        placed_(width_.cast<std::size_t>().prod(), Vector::Constant(INFINITY)),
        radius_(irregularity * nearest / 2),
        least_(nearest - radius_),
        random_(seed) {
    for (int k = -reach_[2]; k <= reach_[2]; ++k) {
      for (int j = -reach_[1]; j <= reach_[1]; ++j) {
        for (int i = -reach_[0]; i <= reach_[0]; ++i) {
          if (is_site({i, j, k})) place({i, j, k});
        }
      }
    }
  }

  const std::vector<Vector>& positions() const { return positions_; }
  // Half width of a box around the origin that contains all of them.
  Vector half_width() const { return reach_.cast<double>() + 1; }

 private:
  static bool is_site(const Site& site) {
    return ((site - site[0]).abs().unaryExpr([](int d) { return d % 2; }) == 0).all();
  }

  Vector& at(const Site& site) {
    const Site place = site + reach_;
    return placed_[(static_cast<std::size_t>(place[2]) * width_[1] + place[1]) * width_[0] + place[0]];
  }

  // A seed without room stays on its site, where there always is room: neighbors are at least `least_` apart.
  void place(const Site& site) {
    const Vector lattice = site.cast<double>();
    Vector x = lattice;
    if (radius_ > 0) {
      int tries = 0;
      do {
        x = lattice + radius_ * in_unit_ball(random_);
      } while (!has_room(site, x) && ++tries < most_tries);
      if (tries == most_tries) x = lattice;
    }
    at(site) = x;
    positions_.push_back(x);
  }

  // Sites 3 or more apart cannot get too close: they approach by 2 radius_ at most.
  bool has_room(const Site& site, const Vector& x) {
    const Site low = (site - 2).max(-reach_), high = (site + 2).min(reach_);
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) {
          if ((at({i, j, k}) - x).squaredNorm() < least_ * least_) return false;  // infinitely far: not placed yet
        }
      }
    }
    return true;
  }

  Site reach_, width_;
  std::vector<Vector> placed_;  // by site
  std::vector<Vector> positions_;
  double radius_, least_;
  std::mt19937_64 random_;
};

// A cell as returned by voro++.
struct Cell {
  std::vector<double> vertices;
  std::vector<int> faces;      // for each: number of vertices, then these in order
  std::vector<int> neighbors;  // of each face; negative: a wall of the container

  Vector vertex(int n) const { return {vertices[3 * n], vertices[3 * n + 1], vertices[3 * n + 2]}; }
};

// An edge is shared by three cells, and is taken from the one with the smallest number. Edges on a wall are left out.
void add_edges(const Cell& cell, int number, std::vector<Edge>& edges) {
  std::map<std::pair<int, int>, int> open;  // edges of one face so far, with the neighbor behind it
  std::size_t begin = 0;
  for (const int neighbor : cell.neighbors) {
    const int count = cell.faces[begin++];
    for (int n = 0; n < count; ++n) {
      const int a = cell.faces[begin + n], b = cell.faces[begin + (n + 1) % count];
      const auto [place, first] = open.insert({std::minmax(a, b), neighbor});
      if (first || number > std::min(neighbor, place->second)) continue;
      edges.push_back({cell.vertex(place->first.first), cell.vertex(place->first.second)});
    }
    begin += count;
  }
}

std::vector<Edge> tessellation_edges(const std::vector<Vector>& seeds, const Vector& half) {
  const Eigen::Array3i bins = (half.array() * 0.75).ceil().cast<int>();  // about 5 seeds each, as voro++ recommends
  voro::container container(-half[0], half[0], -half[1], half[1], -half[2], half[2], bins[0], bins[1], bins[2], false,
                            false, false, 8);
  for (std::size_t n = 0; n < seeds.size(); ++n) {
    container.put(static_cast<int>(n), seeds[n][0], seeds[n][1], seeds[n][2]);
  }
  std::vector<Edge> edges;
  voro::c_loop_all loop(container);
  voro::voronoicell_neighbor raw;
  Cell cell;
  if (loop.start()) do {
      if (!container.compute_cell(raw, loop)) continue;
      raw.vertices(loop.x(), loop.y(), loop.z(), cell.vertices);
      raw.face_vertices(cell.faces);
      raw.neighbors(cell.neighbors);
      add_edges(cell, loop.pid(), edges);
    } while (loop.inc());
  return edges;
}

}  // namespace

Skeleton foam_skeleton(const Vector& size, double cell, double irregularity, std::uint64_t seed) {
  // Two foam cells of volume π cell³ / 6 in each cube of the lattice.
  const double unit = cell * std::cbrt(std::numbers::pi / 3) / 2;
  const Vector half = size / (2 * unit);
  const Seeds seeds(half, irregularity, seed);
  Skeleton skeleton;
  for (const Vector& x : seeds.positions()) skeleton.cells += (x.array().abs() <= half.array()).all() ? 1 : 0;
  skeleton.edges = tessellation_edges(seeds.positions(), seeds.half_width());
  for (Edge& edge : skeleton.edges) {
    edge.a = unit * edge.a + size / 2;
    edge.b = unit * edge.b + size / 2;
  }
  return skeleton;
}

double length_within(const Edge& edge, const Vector& size) {
  double begin = 0, end = 1;  // fractions of the remaining part
  for (int k = 0; k < 3; ++k) {
    const double along = edge.b[k] - edge.a[k];
    if (along == 0 && (edge.a[k] < 0 || edge.a[k] > size[k])) return 0;
    if (along == 0) continue;
    const auto [first, last] = std::minmax({-edge.a[k] / along, (size[k] - edge.a[k]) / along});
    begin = std::max(begin, first);
    end = std::min(end, last);
  }
  return std::max(0.0, end - begin) * (edge.b - edge.a).norm();
}

}  // namespace strut::mesh
