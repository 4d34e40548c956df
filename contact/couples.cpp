#include "contact/couples.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "topology/mirror_planes.hpp"

namespace strut::contact {

void PatchSums::add(double weight, const Vector& place) {
  weight_ += weight;
  first_ += weight * place;
  second_ += weight * place * place.transpose();
}

Patch PatchSums::patch(double arm) const {
  constexpr double most = 10;  // largest arm²/(moment/weight): the effective mass at the arm is at least a point's
  Patch patch;
  if (!(weight_ > 0)) return patch;
  patch.weight = weight_;
  patch.middle = middle();
  const Tensor spread = second_ - weight_ * patch.middle * patch.middle.transpose();
  const Eigen::SelfAdjointEigenSolver<Tensor> axes(spread);
  const Vector along = axes.eigenvalues().cwiseMax(0), moments = Vector::Constant(along.sum()) - along;
  const double least = std::max(weight_ * arm * arm / most, 1e-9 * second_.trace());
  if (!(moments[1] > least)) return patch;
  patch.smallest = moments[2];
  patch.turns = patch.smallest > least;
  if (!patch.turns) patch.row = axes.eigenvectors().col(2);
  for (int c = 0; c < (patch.turns ? 3 : 2); ++c) {
    const Vector axis = axes.eigenvectors().col(c);
    patch.per_couple += axis * axis.transpose() / moments[c];
  }
  return patch;
}

Vector bearable(const Patch& patch, const Vector& place, const Vector& force) {
  if (patch.turns) return force;
  const Vector arm = place - patch.middle;
  if (patch.row.isZero(0)) return arm.isZero(0) ? force : Vector(force.dot(arm) / arm.squaredNorm() * arm);
  const Vector turned = patch.row.cross(arm).stableNormalized();
  return force - force.dot(turned) * turned;
}

void Couples::take(const Domain& domain, const std::vector<int>& points) {
  forces_.clear(), affected_.clear();
  points_ = points;
  any_ = domain.communicator.any(!points.empty());
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
  std::vector<char> turned(twists_.size(), 0);  // the few points in the neighborhood of an owned point with a couple
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Patch& patch = neighborhoods[k].patch;
    const int i = points_[k];
    twists_[i] = {patch.per_couple * couples[k], domain.current(i) + patch.middle};
    if (twists_[i].turn.isZero(0)) continue;
    turned[i] = 1;
    domain.families.for_each(i, [&](int j) { turned[j] = 1; });
  }
  domain.halo.exchange<Twist::reflect>(twists_);
  forces_.assign(affected_.size(), Vector::Zero());
  for (std::size_t n = 0; n < affected_.size(); ++n) {
    const int i = affected_[n];
    if (!turned[i] && i < domain.interior) continue;
    Vector sum = Vector::Zero();
    const auto take = [&](int j) {
      if (!twists_[j].turn.isZero(0)) sum += density(domain, i, j);
    };
    take(i);
    domain.families.for_each(i, take);
    force_density[i] += sum;
    forces_[n] = sum * domain.volume(i);
  }
}

// The couple of an image acts on points before the plane, and the couple of its original on images behind the plane,
// with the same force along the normal: the latter are summed twice.
void Couples::add_mirror_reactions(const Domain& domain, std::vector<Vector>& of_mirrors) const {
  if (forces_.empty() || domain.mirrors.empty()) return;
  const auto on_body = [&](int body) {
    Vector sum = Vector::Zero();
    for_each_force([&](int i, const Vector& force) {
      if (domain.body_of(i) == body) sum += force;
    });
    return sum;
  };
  const auto of_images = [&](int body, const std::vector<char>& behind) {
    Vector sum = Vector::Zero();
    for (const int i : affected_) {
      if (domain.body_of(i) != body) continue;
      domain.families.for_each(i, [&](int j) {
        if (behind[j]) sum += 2 * domain.volume(i) * density(domain, i, j);
      });
    }
    return sum;
  };
  const std::vector<Vector> reactions = mirror_reactions(domain, {on_body, of_images});
  for (std::size_t m = 0; m < reactions.size(); ++m) of_mirrors[m] += reactions[m];
}

// The forces of a couple cancel, so its forces on points behind a side act through that side.
Vector Couples::through_sides(const Domain& domain) const {
  Vector sum = Vector::Zero();
  if (forces_.empty() || domain.periods.empty()) return sum;
  std::vector<Vector> above(domain.owned + domain.ghosts, Vector::Zero());
  for (const ImagePoint& image : domain.halo.images()) {
    for (const Period& period : domain.periods) above[image.ghost][period.axis] = periods_above(image.by, period);
  }
  for (const int i : affected_) {
    domain.families.for_each(i, [&](int j) {
      if (!above[j].isZero(0) && !twists_[j].turn.isZero(0))
        sum += domain.volume(i) * above[j].cwiseProduct(density(domain, i, j));
    });
  }
  return sum;
}

}  // namespace strut::contact
