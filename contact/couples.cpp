#include "contact/couples.hpp"

namespace strut::contact {

void Couples::take(const Domain& domain, const std::vector<int>& points) {
  forces_.clear(), affected_.clear();
  points_ = points;
  any_ = domain.communicator.max(points.empty() ? 0.0 : 1.0) > 0;
  if (!any_) return;
  const std::size_t count = domain.owned + domain.ghosts;
  std::vector<char> marks(count, 0), affected(count, 0);
  for (const int i : points) {
    marks[i] = affected[i] = 1;
    domain.families.for_each(i, [&](int j) { affected[j] = 1; });
  }
  domain.halo.exchange(marks);
  for (int i = domain.interior; i < domain.owned; ++i) {  // bonds are symmetric
    domain.families.for_each(i, [&](int j) { affected[i] |= marks[j]; });
  }
  for (int i = 0; i < domain.owned; ++i) {
    if (affected[i]) affected_.push_back(i);
  }
  motions_.resize(count);
  twists_.assign(count, {Vector::Zero(), Vector::Zero()});
}

void Couples::bring_to_present(const Kinematics& kinematics) {
  const Domain& domain = kinematics.domain;
  forces_.clear();
  if (!any_) return;
  for (int i = domain.interior; i < domain.owned; ++i) motions_[i] = {domain.current(i), kinematics.velocities[i]};
  domain.halo.exchange<Motion::reflect>(motions_);
}

Couples::Neighborhood Couples::of(const Kinematics& kinematics, int i, double arm) const {
  const Domain& domain = kinematics.domain;
  const Vector here = domain.current(i);
  PatchSums sums;
  sums.add(domain.volume(i), Vector::Zero());
  domain.families.for_each(i, [&](int j) { sums.add(domain.volume(j), place(domain, j) - here); });
  Neighborhood around{sums.patch(arm)};
  const Vector middle = around.patch.middle;
  Vector turning = -domain.volume(i) * middle.cross(kinematics.velocities[i]);
  domain.families.for_each(i, [&](int j) {
    const Vector velocity = j < domain.owned ? kinematics.velocities[j] : motions_[j].velocity;
    turning += domain.volume(j) * (place(domain, j) - here - middle).cross(velocity);
  });
  around.spin = around.patch.per_couple * turning;
  return around;
}

void Couples::add_forces(const Domain& domain, const std::vector<Neighborhood>& neighborhoods,
                         const std::vector<Vector>& couples, std::vector<Vector>& force_density) {
  if (!any_) return;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Patch& patch = neighborhoods[k].patch;
    twists_[points_[k]] = {patch.per_couple * couples[k], domain.current(points_[k]) + patch.middle};
  }
  domain.halo.exchange<Twist::reflect>(twists_);
  forces_.assign(affected_.size(), Vector::Zero());
  for (std::size_t n = 0; n < affected_.size(); ++n) {
    const int i = affected_[n];
    const Vector here = domain.current(i);
    Vector density = Vector::Zero();
    const auto take = [&](int j) {
      if (!twists_[j].turn.isZero(0)) density += twists_[j].turn.cross(Vector(here - twists_[j].middle));
    };
    take(i);
    domain.families.for_each(i, take);
    force_density[i] += density;
    forces_[n] = density * domain.volume(i);
  }
}

}  // namespace strut::contact
