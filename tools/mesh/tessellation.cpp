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
using Triple = Eigen::Array3i;

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
  // `half`: of the box's size; `repeats`: cubes of the lattice along each axis of a periodic box, else 0.
  Seeds(const Vector& half, const Triple& repeats, double irregularity, std::mt19937_64& random)
      : repeats_(repeats),
        reach_((half.array() + margin).ceil().cast<int>()),
        width_(is_periodic() ? Triple(2 * repeats) : Triple(2 * reach_ + 1)),
        placed_(width_.cast<std::size_t>().prod(), Vector::Constant(INFINITY)),
        radius_(irregularity * nearest / 2),
        least_(nearest - radius_),
        random_(random) {
    const Site low = is_periodic() ? Site::Zero() : Site(-reach_), high = low + width_ - 1;
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) {
          if (is_site({i, j, k})) place({i, j, k});
        }
      }
    }
  }

  const std::vector<Vector>& positions() const { return positions_; }
  // The corners of a box that contains all of them; of a periodic one, that it repeats.
  Vector lower() const { return is_periodic() ? Vector(Vector::Zero()) : Vector(-reach_.cast<double>() - 1); }
  Vector upper() const { return is_periodic() ? Vector(width_.cast<double>()) : Vector(reach_.cast<double>() + 1); }
  bool is_periodic() const { return repeats_[0] > 0; }

 private:
  static bool is_site(const Site& site) {
    return ((site - site[0]).abs().unaryExpr([](int d) { return d % 2; }) == 0).all();
  }

  Vector& at(const Site& site) {
    const Site place = is_periodic() ? site : Site(site + reach_);
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
    const Site low = is_periodic() ? Site(site - 2) : Site((site - 2).max(-reach_));
    const Site high = is_periodic() ? Site(site + 2) : Site((site + 2).min(reach_));
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) {
          if ((seed_at({i, j, k}) - x).squaredNorm() < least_ * least_) return false;  // infinitely far: not placed yet
        }
      }
    }
    return true;
  }

  // The seed of a site; in a periodic box, which repeats, that of the site inside, moved.
  Vector seed_at(const Site& site) {
    if (!is_periodic()) return at(site);
    const Site inside = site - width_ * (site.cast<double>() / width_.cast<double>()).floor().cast<int>();
    return at(inside) + (site - inside).matrix().cast<double>();
  }

  Triple repeats_, reach_, width_;
  std::vector<Vector> placed_;  // by site
  std::vector<Vector> positions_;
  double radius_, least_;
  std::mt19937_64& random_;
};

// A cell as returned by voro++.
struct Cell {
  std::vector<double> vertices;
  std::vector<int> faces;      // for each: number of vertices, then these in order
  std::vector<int> neighbors;  // of each face; negative: a wall of the container

  Vector vertex(int n) const { return {vertices[3 * n], vertices[3 * n + 1], vertices[3 * n + 2]}; }
};

// Unit vector from the edge into a film: across the edge, towards the middle of the face.
Vector film_of(const Edge& edge, const Vector& middle) {
  const Vector along = (edge.b - edge.a).normalized(), to = middle - edge.a;
  return (to - to.dot(along) * along).normalized();
}

Vector middle_of(const Cell& cell, std::size_t begin, int count) {
  Vector sum = Vector::Zero();
  for (int n = 0; n < count; ++n) sum += cell.vertex(cell.faces[begin + n]);
  return sum / count;
}

// An edge is shared by three cells, and is taken from the one with the smallest number. Edges on a wall are left out.
// The third film is opposite to the other two.
void add_edges(const Cell& cell, int number, std::vector<Edge>& edges) {
  struct Half {
    int neighbor;  // behind the first of its two faces
    Vector middle;
  };
  std::map<std::pair<int, int>, Half> open;  // edges of one face so far
  std::size_t begin = 0;
  for (const int neighbor : cell.neighbors) {
    const int count = cell.faces[begin++];
    const Vector middle = middle_of(cell, begin, count);
    for (int n = 0; n < count; ++n) {
      const int a = cell.faces[begin + n], b = cell.faces[begin + (n + 1) % count];
      const auto [place, first] = open.insert({std::minmax(a, b), {neighbor, middle}});
      if (first || number > std::min(neighbor, place->second.neighbor)) continue;
      Edge edge{cell.vertex(place->first.first), cell.vertex(place->first.second)};
      edge.films[0] = film_of(edge, place->second.middle), edge.films[1] = film_of(edge, middle);
      edge.films[2] = -(edge.films[0] + edge.films[1]).normalized();
      edges.push_back(edge);
    }
    begin += count;
  }
}

// Seeds with the spheres whose radical planes are the faces of cells; of radii of 0 these are the bisecting planes.
struct Spheres {
  std::vector<Vector> places;
  std::vector<double> radii;
  Vector lower, upper;  // of the container
  bool periodic;

  // Calls visit(number, cell of voro++ around its place, place).
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    const Triple bins =
        ((upper - lower).array() * 0.375).ceil().cast<int>();  // about 5 seeds each, as voro++ recommends
    voro::container_poly container(lower[0], upper[0], lower[1], upper[1], lower[2], upper[2], bins[0], bins[1],
                                   bins[2], periodic, periodic, periodic, 8);
    for (std::size_t n = 0; n < places.size(); ++n) {
      container.put(static_cast<int>(n), places[n][0], places[n][1], places[n][2], radii[n]);
    }
    voro::c_loop_all loop(container);
    voro::voronoicell_neighbor cell;
    if (loop.start()) do {
        if (container.compute_cell(cell, loop)) visit(loop.pid(), cell, Vector(loop.x(), loop.y(), loop.z()));
      } while (loop.inc());
  }
};

// Moves seeds to the centroids of their cells; those near a wall, which cuts their cells, stay.
void relax(Spheres& spheres) {
  std::vector<Vector> moved = spheres.places;
  spheres.for_each_cell([&](int number, voro::voronoicell_neighbor& cell, const Vector& place) {
    const double wall = std::min((place - spheres.lower).minCoeff(), (spheres.upper - place).minCoeff());
    if (!spheres.periodic && wall < 2) return;
    Vector centroid;
    cell.centroid(centroid[0], centroid[1], centroid[2]);
    moved[number] = place + centroid;
  });
  spheres.places = std::move(moved);
}

// Edges, and the cells of the box between two corners.
Skeleton skeleton_of(const Spheres& spheres, const Vector& lower, const Vector& upper) {
  Skeleton skeleton;
  Cell cell;
  double sum = 0, squares = 0;
  spheres.for_each_cell([&](int number, voro::voronoicell_neighbor& raw, const Vector& place) {
    raw.vertices(place[0], place[1], place[2], cell.vertices);
    raw.face_vertices(cell.faces);
    raw.neighbors(cell.neighbors);
    add_edges(cell, number, skeleton.edges);
    if ((place - lower).minCoeff() < 0 || (upper - place).minCoeff() < 0) return;
    const double volume = raw.volume();
    ++skeleton.cells, sum += volume, squares += volume * volume;
  });
  const auto cells = static_cast<double>(skeleton.cells);
  skeleton.scatter = cells > 0 ? std::sqrt(std::max(0.0, cells * squares / (sum * sum) - 1)) : 0;
  return skeleton;
}

// The edges of a periodic box, and those around it.
std::vector<Edge> repeated(const std::vector<Edge>& edges, const Vector& size, double around) {
  std::vector<Edge> all;
  for (const Edge& edge : edges) {
    for (int n = 0; n < 27; ++n) {
      const Vector shift = size.cwiseProduct(Vector(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
      Edge image = edge;
      image.a += shift, image.b += shift;
      const Vector low = image.a.cwiseMin(image.b), high = image.a.cwiseMax(image.b);
      if ((high.array() >= -around).all() && (low.array() <= size.array() + around).all()) all.push_back(image);
    }
  }
  return all;
}

// Lognormal, with this mean and standard deviation over mean; Box and Muller's normal numbers, cut off at ±2.5.
std::vector<double> radii_of(std::size_t count, double mean, double deviation, std::mt19937_64& random) {
  const double sigma = std::sqrt(std::log1p(deviation * deviation));
  std::vector<double> radii;
  for (std::size_t n = 0; n < count; ++n) {
    const double u = 1 - 0.5 * (uniform(random) + 1), v = std::numbers::pi * uniform(random);
    const double normal = std::clamp(std::sqrt(-2 * std::log(u)) * std::cos(v), -2.5, 2.5);
    radii.push_back(mean * std::exp(sigma * normal - 0.5 * sigma * sigma));
  }
  return radii;
}

}  // namespace

Skeleton foam_skeleton(const Vector& size, const FoamSeeds& wanted) {
  // Two foam cells of volume π cell³ / 6 in each cube of the lattice.
  const double cube = wanted.cell * std::cbrt(std::numbers::pi / 3) / 2;
  Vector unit = cube * wanted.stretch / std::cbrt(wanted.stretch.prod());  // m
  Triple repeats = Triple::Zero();
  if (wanted.periodic) {
    repeats = (size.cwiseQuotient(2 * unit)).array().round().cast<int>().max(1);
    unit = size.cwiseQuotient(2 * repeats.matrix().cast<double>());
  }
  const Vector half = size.cwiseQuotient(2 * unit);
  std::mt19937_64 random(wanted.seed);
  const Seeds seeds(half, repeats, wanted.irregularity, random);
  std::vector<double> radii(seeds.positions().size(), 0);
  if (wanted.sizes > 0) radii = radii_of(radii.size(), nearest / 2, wanted.sizes, random);
  Spheres spheres{seeds.positions(), radii, seeds.lower(), seeds.upper(), wanted.periodic};
  for (int n = 0; n < wanted.relax; ++n) relax(spheres);
  const Vector origin = wanted.periodic ? Vector(Vector::Zero()) : Vector(-half);  // of the box
  Skeleton skeleton = skeleton_of(spheres, origin, origin + 2 * half);
  skeleton.stretch = unit / std::cbrt(unit.prod());
  const Vector middle = wanted.periodic ? Vector(Vector::Zero()) : Vector(size / 2);  // where the seeds' origin goes
  for (Edge& edge : skeleton.edges) {
    edge.a = unit.cwiseProduct(edge.a) + middle;
    edge.b = unit.cwiseProduct(edge.b) + middle;
    for (Vector& film : edge.films) film = unit.cwiseProduct(film).normalized();
  }
  if (wanted.periodic) skeleton.edges = repeated(skeleton.edges, size, 2 * unit.maxCoeff());
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
