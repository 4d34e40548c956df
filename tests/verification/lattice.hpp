// Bodies of points on a lattice, for tests.
#pragma once

#include <cmath>
#include <functional>
#include <random>

#include "add_point.hpp"
#include "larger.hpp"
#include "mechanics/make_body.hpp"
#include "mechanics/mechanics.hpp"
#include "topology/partition.hpp"

namespace strut {

struct LatticeSpec {
  Eigen::Array3i cells{8, 8, 8};
  double spacing = 1;
  double horizon = 3.015;   // in spacings
  double perturbation = 0;  // the largest shift of a point in each direction, in spacings
  Influence influence = Influence::one;
  BlockMaterial material;
  FamilyKind families = FamilyKind::fastest;
  std::function<bool(const Eigen::Array3i& cell)> is_filled = {};  // none: all cells are
  std::vector<Crack> cracks = {};
};

materials::AnyLaw elastic(double young, double poisson);

// All points on rank 0; the partition spreads them. Volumes are those of the lattice.
PointCloud lattice_cloud(const LatticeSpec& spec, const Communicator& world);

Body lattice_body(const LatticeSpec& spec, const Communicator& world);

// Puts every owned point at place(X).
void deform(Body& body, const std::function<Vector(const Vector&)>& place);

// True if the whole family of X, and the families of its neighbors, lie inside the lattice.
bool is_deep(const LatticeSpec& spec, const Vector& X, double margin);

// The largest value over the owned points of all ranks; NaN where one is, on its rank at least.
template <class Value>
double largest_over(const Body& body, Value&& value) {
  double largest = 0;
  for (int i = 0; i < body.owned(); ++i) largest = larger(largest, value(i));
  return larger(largest, body.domain.communicator.max(largest));
}

}  // namespace strut
