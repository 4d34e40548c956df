// The material point of an element: its volume, centroid and second moments; the parts of its nodes.
#pragma once

#include <array>
#include <span>

#include "topology/cloud.hpp"

namespace strut::io {

struct ElementPoint {
  Vector centroid;    // volumetric: the integral of x over the element, divided by its volume
  double volume = 0;  // negative for an inverted element
};

// Nodes in Exodus order: 0 1 2 3 around the lower face, 4 5 6 7 above them.
ElementPoint hexahedron(std::span<const Vector, 8> nodes);
ElementPoint tetrahedron(std::span<const Vector, 4> nodes);

// The corner (0 to 7) with left-handed edges, at which the element is folded although its volume may be positive: det
// ∂x/∂ξ < 0. Returns -1 if there is none; for a hexahedron collapsed to a wedge or pyramid the determinant is 0.
int folded_corner(std::span<const Vector, 8> nodes);

// ∫ N_a dV of the shape function of each node: the parts of the volume that belong to the nodes. Their sum is the
// volume, and Σ part × node = volume × centroid.
std::array<double, 8> hexahedron_parts(std::span<const Vector, 8> nodes);
std::array<double, 4> tetrahedron_parts(std::span<const Vector, 4> nodes);

// Integrals over a piece of a body, relative to a point O; those of several pieces are added.
struct Integrals {
  double volume = 0;                     // ∫ dV, m³
  Vector first = Vector::Zero();         // ∫ (x − O) dV, m⁴
  Symmetric second = Symmetric::Zero();  // ∫ (x − O)⊗(x − O) dV, m⁵

  Integrals& operator+=(const Integrals& other);
};
// The centroid, relative to O, and the central second moments per volume.
CellShape cell_shape(const Integrals& integrals);

// Exact moments relative to the element's centroid.
Symmetric hexahedron_moments(std::span<const Vector, 8> nodes);
Symmetric tetrahedron_moments(std::span<const Vector, 4> nodes);
Symmetric cube_moments(double volume);

// Integrals over the piece next to each node, relative to that node: an octant of the hexahedron's local coordinates;
// the quarter of the tetrahedron between the node, the middles of its edges and faces, and the centroid.
std::array<Integrals, 8> hexahedron_pieces(std::span<const Vector, 8> nodes);
std::array<Integrals, 4> tetrahedron_pieces(std::span<const Vector, 4> nodes);

double sphere_volume(double radius);
double sphere_radius(double volume);  // of the sphere of equal volume

}  // namespace strut::io
