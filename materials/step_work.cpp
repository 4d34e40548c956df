#include "materials/step_work.hpp"

namespace strut::materials {

double old_determinant(const PointStep& step) {
  const Tensor half = 0.5 * step.dt * to_tensor(step.rate), one = Tensor::Identity();
  return step.J * (one - half).determinant() / (one + half).determinant();
}

double step_work(const PointStep& step, double old_J, const Symmetric& before, const Symmetric& after) {
  const Tensor half = 0.5 * step.dt * to_tensor(step.rate), one = Tensor::Identity();
  const Symmetric from_old = symmetric_part(half * (one - half).inverse());
  const Symmetric from_new = symmetric_part(half * (one + half).inverse());
  return old_J * double_dot(before, from_old) + step.J * double_dot(after, from_new);
}

}  // namespace strut::materials
