// The bound of ω² of a point held by springs.
#pragma once

#include <Eigen/Eigenvalues>

#include "base/math/tensors.hpp"

namespace strut::contact {

// Largest eigenvalue of a positive semidefinite tensor; 0 if its trace, an upper bound, is at most `floor`.
inline double largest_eigenvalue(const Tensor& springs, double floor) {
  if (!(springs.trace() > floor)) return 0;
  return Eigen::SelfAdjointEigenSolver<Tensor>(springs, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

}  // namespace strut::contact
