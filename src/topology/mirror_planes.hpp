// Symmetry planes and the bodies that they cut: the points on a plane, and the force of a plane, which is the sum of
// the forces of images behind it on points before it. Forces within a body and its images cancel. A force through
// periodic sides counts once for each period between its ends.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "topology/domain.hpp"

namespace strut {

// The planes of the body of an owned point that run through it.
std::vector<Mirror> planes_through(const Domain& domain, int i);

// Number of images at the position of an owned point, itself included: 2 on a symmetry plane, each with half of a cell.
int coincident_images(const Domain& domain, int i);

// Sums over forces of one kind on this rank's points, N.
struct MirroredForces {
  std::function<Vector(int body)> on_body;  // all forces on a body
  // The forces that the images marked in `behind`, by site, exert on a body. Called only for planes that have a
  // parallel one.
  std::function<Vector(int body, const std::vector<char>& behind)> of_images;
};

// The force of each of domain.mirrors along its normal, N: this rank's part.
std::vector<Vector> mirror_reactions(const Domain& domain, const MirroredForces& sums);

// How many periods above its original an image is.
inline int periods_above(const Reflection& by, const Period& period) {
  return static_cast<int>(std::lround(by.period[period.axis] / period.length));
}

}  // namespace strut
