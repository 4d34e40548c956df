#include "conditions/free_motion.hpp"

#include <string>

#include "base/parallel/reproducible_sum.hpp"
#include "conditions/impulse_work.hpp"
#include "mechanics/body.hpp"

namespace strut {

Vector sum_of_points(const Body& body, const std::vector<Vector>& values) {
  Vector sum;
  for (int c = 0; c < 3; ++c) {
    sum[c] = reproducible_sum(body.domain.communicator, static_cast<int>(values.size()),
                              [&](int i) { return values[i][c]; });
  }
  return sum;
}

void FreeMotion::advance(double t, double dt, const Body& body) {
  Vector load = Vector::Zero();
  for (int c = 0; c < 3; ++c) {
    if (force[c]) load[c] = (*force[c])(0, 0, 0, t);
  }
  if (begun) offset = offset_at(t);
  begun = true;  // half an impulse first: the initial velocity is that of the initial time
  before = velocity, time = t;
  mid_steps.before = step / (step + dt);
  force_impulse = 0.5 * (step + dt) * load;
  pending_sum = sum_of_points(body, pending);
  pending.assign(pending.size(), Vector::Zero());
  velocity += (force_impulse - pending_sum) / mass;
  step = dt;
}

void FreeMotion::push_back(const Vector& impulse, const Body& body, ImpulseWork& work) {
  velocity = before + (force_impulse - pending_sum - impulse) / mass;
  if (body.domain.communicator.rank() != 0) return;  // only once
  work.before.tools -= 0.5 * (impulse + pending_sum).dot(before);
  work.after.tools -= 0.5 * (impulse + pending_sum).dot(velocity);
  work.before.external += 0.5 * force_impulse.dot(before);
  work.after.external += 0.5 * force_impulse.dot(velocity);
}

void FreeMotion::serialize(Archive& archive, const std::string& name, int owned) {
  for (int c = 0; c < 3; ++c) {
    const std::string axis = name + "_" + "xyz"[c];
    archive.number(axis + "_velocity", velocity[c]);
    archive.number(axis + "_before", before[c]);
    archive.number(axis + "_offset", offset[c]);
  }
  archive.number(name + "_time", time);
  archive.number(name + "_step", step);
  archive.number(name + "_begun", begun);
  pending.resize(owned, Vector::Zero());
  archive.field(name + "_pending", 3, [this](std::size_t i, int c) -> double& { return pending[i][c]; });
}

}  // namespace strut
