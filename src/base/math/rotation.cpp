#include "base/math/rotation.hpp"

namespace strut {

Tensor polar_rotation(const Tensor& deformation_gradient) {
  constexpr int most_iterations = 60;        // a stretch of 1e-15 needs 50
  constexpr double nearly_converged = 1e-8;  // the error of the next iterate is its square
  Tensor R = deformation_gradient;
  for (int n = 0; n < most_iterations; ++n) {
    const Tensor next = 0.5 * (R + R.inverse().transpose());
    const double change = (next - R).norm();
    R = next;
    if (change < nearly_converged) break;
  }
  return R;
}

}  // namespace strut
