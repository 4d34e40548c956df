#include "advice/lattice_axes.hpp"

#include <cmath>
#include <limits>

namespace strut {

namespace {

// The direction to the nearest neighbor more than 30 degrees off a line or plane, of which `off` is the sine; zero
// without any.
template <class Off>
Vector nearest_neighbor(const Domain& domain, int i, const Off& off) {
  Vector nearest = Vector::Zero();
  double least = std::numeric_limits<double>::infinity();
  domain.families.for_each(i, [&](int j) {
    const Vector xi = domain.reference(j) - domain.reference(i);
    const double length = xi.norm();
    if (length < least && off(Vector(xi / length)) > 0.5) least = length, nearest = xi / length;
  });
  return nearest;
}

}  // namespace

Tensor lattice_axes(const Domain& domain, int i) {
  Tensor axes = Tensor::Zero();
  axes.col(0) = nearest_neighbor(domain, i, [](const Vector&) { return 1; });
  axes.col(1) = nearest_neighbor(domain, i, [&](const Vector& u) { return u.cross(axes.col(0)).norm(); });
  if (axes.col(1).isZero()) return Tensor::Zero();
  const Vector normal = axes.col(0).cross(axes.col(1)).normalized();
  axes.col(2) = nearest_neighbor(domain, i, [&](const Vector& u) { return std::abs(u.dot(normal)); });
  if (axes.col(2).isZero()) axes.col(2) = normal;
  return axes;
}

}  // namespace strut
