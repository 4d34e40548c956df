#include "mesh/lattices.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace strut::mesh {

namespace {

// In quarters of a cell, so that ends compare exactly.
using Node = std::array<int, 3>;
using Strut = std::array<Node, 2>;

Node sum(const Node& a, const Node& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

// All sign changes and orders of three numbers.
std::set<Node> like(Node n) {
  std::set<Node> all;
  std::sort(n.begin(), n.end());
  do {
    for (int s = 0; s < 8; ++s) all.insert({s & 1 ? -n[0] : n[0], s & 2 ? -n[1] : n[1], s & 4 ? -n[2] : n[2]});
  } while (std::next_permutation(n.begin(), n.end()));
  return all;
}

int squared(const Node& a, const Node& b) {
  int sum = 0;
  for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

// The same strut in the cell at the origin: both ends moved by whole cells.
Strut in_first_cell(Strut strut) {
  if (strut[1] < strut[0]) std::swap(strut[0], strut[1]);
  for (int c = 0; c < 3; ++c) {
    const int cells = static_cast<int>(std::floor(std::min(strut[0][c], strut[1][c]) / 4.0));
    for (Node& end : strut) end[c] -= 4 * cells;
  }
  return strut;
}

std::set<Strut> struts_of(const std::string& name) {
  std::set<Strut> struts;
  const Node origin{0, 0, 0}, body{2, 2, 2};
  const std::vector<Node> face_centered = {origin, {2, 2, 0}, {2, 0, 2}, {0, 2, 2}};
  const auto add = [&](const Node& from, const Node& to) { struts.insert(in_first_cell({from, to})); };
  if (name == "octet") {  // all neighbors of a face-centered lattice
    for (const Node& from : face_centered) {
      for (const Node& direction : like({0, 2, 2})) add(from, sum(from, direction));
    }
  } else if (name == "fcc") {
    for (const Node& direction : like({0, 2, 2})) add(origin, direction);
  } else if (name == "bcc") {
    for (const Node& direction : like({2, 2, 2})) add(origin, direction);
  } else {  // truncated octahedra around a body-centered lattice
    const std::set<Node> corners = like({0, 1, 2});
    for (const Node& a : corners) {
      for (const Node& b : corners) {
        if (squared(a, b) != 2) continue;
        add(a, b), add(sum(a, body), sum(b, body));
      }
    }
  }
  return struts;
}

Vector place_of(const Node& node) { return Vector(node[0], node[1], node[2]) / 4; }

// A field that vanishes on the surface, and its gradient, at a place in cells.
struct Surface {
  double value;
  Vector gradient;
};

Surface gyroid(const Vector& s, const Vector& c) {
  return {s[0] * c[1] + s[1] * c[2] + s[2] * c[0],
          {c[0] * c[1] - s[2] * s[0], c[1] * c[2] - s[0] * s[1], c[2] * c[0] - s[1] * s[2]}};
}

Surface diamond(const Vector& s, const Vector& c) {
  return {c[0] * c[1] * c[2] - s[0] * s[1] * s[2],
          {-s[0] * c[1] * c[2] - c[0] * s[1] * s[2], -c[0] * s[1] * c[2] - s[0] * c[1] * s[2],
           -c[0] * c[1] * s[2] - s[0] * s[1] * c[2]}};
}

}  // namespace

const std::vector<std::string>& lattice_names() {
  static const std::vector<std::string> names = {"octet",  "bcc",          "fcc",     "kelvin",
                                                 "gyroid", "gyroid-sheet", "diamond", "diamond-sheet"};
  return names;
}

bool has_struts(const std::string& name) { return !name.starts_with("gyroid") && !name.starts_with("diamond"); }

std::vector<Edge> lattice_cell(const std::string& name) {
  std::vector<Edge> edges;
  for (const Strut& strut : struts_of(name)) edges.push_back({place_of(strut[0]), place_of(strut[1])});
  return edges;
}

std::vector<Edge> lattice_edges(const std::string& name, const Vector& size, double cell) {
  const std::vector<Edge> one = lattice_cell(name);
  const Eigen::Array3i last = (size / cell).array().ceil().cast<int>();
  std::vector<Edge> edges;
  for (int k = -1; k <= last[2]; ++k) {
    for (int j = -1; j <= last[1]; ++j) {
      for (int i = -1; i <= last[0]; ++i) {
        const Vector at(i, j, k);
        for (const Edge& edge : one) edges.push_back({cell * (edge.a + at), cell * (edge.b + at)});
      }
    }
  }
  return edges;
}

std::function<double(const Vector&)> surface_field(const std::string& name, double cell) {
  const bool sheet = name.ends_with("-sheet"), is_gyroid = name.starts_with("gyroid");
  const double wave = 2 * std::numbers::pi / cell;
  return [=](const Vector& x) {
    const Vector s = (wave * x).array().sin(), c = (wave * x).array().cos();
    const Surface surface = is_gyroid ? gyroid(s, c) : diamond(s, c);
    const double steep = std::max(wave * surface.gradient.norm(), 1e-3 * wave);  // it vanishes at a few places far off
    return (sheet ? std::abs(surface.value) : surface.value) / steep;
  };
}

}  // namespace strut::mesh
