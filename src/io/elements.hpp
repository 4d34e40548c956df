// The material point that an element stands for: its volume and its centroid.
#pragma once

#include <array>
#include <span>

#include "base/tensors.hpp"

namespace strut::io {

struct ElementPoint {
  Vector centroid;    // volumetric: the integral of x over the element, divided by its volume
  double volume = 0;  // negative for an element that is inside out
};

// Nodes in Exodus order: 0 1 2 3 around the lower face, 4 5 6 7 above them.
ElementPoint hexahedron(std::span<const Vector, 8> nodes);
ElementPoint tetrahedron(std::span<const Vector, 4> nodes);

// ∫ N_a dV of the shape function of each node: the parts of the volume that belong to the nodes. Their sum is the
// volume, and Σ part × node = volume × centroid.
std::array<double, 8> hexahedron_parts(std::span<const Vector, 8> nodes);
std::array<double, 4> tetrahedron_parts(std::span<const Vector, 4> nodes);

double sphere_volume(double radius);
double sphere_radius(double volume);  // of the sphere of equal volume

}  // namespace strut::io
