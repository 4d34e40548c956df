// Free vibration of a body: its stiffness as a matrix, and the frequencies of K φ = ω² M φ, M = ρV of the points.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "mechanics/mechanics.hpp"

namespace strut::reference {

using SparseMatrix = Eigen::SparseMatrix<double>;

// The stiffness of a body at rest on one rank, N/m, three rows a point: the tangent applied to unit displacements.
// `reach`: the number of horizons within which points feel each other through their forces. Throws Error where the
// matrix is not symmetric: then the reach is too short, or forces have no energy.
SparseMatrix stiffness_matrix(Body& body, double reach = 3);

// kg, of the points.
Eigen::VectorXd masses_of(const Body& body);

// M^−½ K M^−½, 1/s², three rows a mass.
SparseMatrix by_mass(const SparseMatrix& stiffness, const Eigen::VectorXd& masses);

struct Vibration {
  int zeros = 0;  // modes without stiffness: six rigid motions, and patterns that a scheme does not see
  std::vector<double> frequencies;  // of the lowest others, rad/s
  double highest = 0;               // of all, rad/s
};

// The vibration of a matrix by mass. Throws Error where there are too many modes without stiffness to find `count`
// others.
Vibration vibration_of(const SparseMatrix& by_mass, int count);

}  // namespace strut::reference
