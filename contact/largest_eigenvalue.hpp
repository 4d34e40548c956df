// What bounds ω² of a point that springs hold.
#pragma once

#include <Eigen/Eigenvalues>

#include "base/math/tensors.hpp"

namespace strut::contact {

// Of a positive semidefinite tensor, where it is above `floor`: it is at most the trace.
inline double largest_eigenvalue(const Tensor& springs, double floor) {
  if (!(springs.trace() > floor)) return 0;
  return Eigen::SelfAdjointEigenSolver<Tensor>(springs, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

}  // namespace strut::contact
