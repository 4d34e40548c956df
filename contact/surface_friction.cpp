// Friction between surfaces: the forces on touching points, and their tangent.
#include <algorithm>
#include <cmath>

#include "contact/laws/contact_law.hpp"
#include "contact/surfaces.hpp"

namespace strut::contact {

namespace {

// Stiffness of friction springs over that of the surfaces. Below 1 these springs do not limit the time step.
constexpr double of_friction = 0.5;

// Friction exchange: the friction on a point, as its partners need it.
struct FrictionExchange {
  Vector drag = Vector::Zero();    // friction over the point's ρ, N
  Vector twist = Vector::Zero();   // rotation θ of the point's patch, N/m
  Vector middle = Vector::Zero();  // center of the patch, relative to the point, m

  // The reaction on a partner at η from the point, per V W.
  Vector reaction(const Vector& eta) const { return twist.cross(Vector(eta - middle)) - drag; }
};

// The exchange of a force (N) on the point's body at a position relative to the point: its reaction there acts as a
// force and a couple on the patch that the point feels.
FrictionExchange friction_exchange_of(const Patch& patch, const Vector& place, const Vector& force) {
  return {force / patch.weight, patch.per_couple * (patch.middle - place).cross(force), patch.middle};
}

}  // namespace

// `motion`: of pairs.sites, velocities or displacements. The motion of the patch that the point feels minus the point's
// own: at a position relative to the point if the patch `turns` with its points, else the mean over its points.
template <class MotionOf>
Vector Surfaces::slip_of(const Pairs& pairs, std::size_t k, const Patch& patch, const Vector& place, bool turns,
                         const MotionOf& motion) const {
  Vector mean = Vector::Zero(), turning = Vector::Zero();
  over_felt(pairs, k, [&](int partner, const Vector& eta, double distance2, double reach) {
    const Vector part = pairs.sites[partner].volume() * Smoothing(reach).value(distance2) * motion(partner);
    mean += part;
    if (turns) turning += (eta - patch.middle).cross(part);
  });
  const Vector arm = patch.middle - place;
  return mean / patch.weight + arm.cross(patch.per_couple * turning) - motion(static_cast<int>(k));
}

Patch Surfaces::felt_patch(const Pairs& pairs, std::size_t k, const Vector& place) const {
  PatchSums sums;
  over_felt(pairs, k, [&](int partner, const Vector& eta, double distance2, double reach) {
    sums.add(pairs.sites[partner].volume() * Smoothing(reach).value(distance2), eta);
  });
  return sums.patch((sums.middle() - place).norm());
}

// Position, relative to a touching point, midway between the surface of its body and that of the other one.
Vector Surfaces::between_surfaces(std::size_t k) const {
  return (points_[places_[k]].depth - 0.5 * overlaps_[places_[k]]) * gradient_[k].stableNormalized();
}

void Surfaces::add_friction(const Kinematics& kinematics, const Sliding& sliding, const SurfaceLaw& law,
                            double coefficient, Pairs& pairs, Couples& couples, std::vector<Vector>& force_density,
                            std::vector<Vector>& friction) {
  std::vector<Vector> displacements(pairs.sites.size(), Vector::Zero());
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) displacements[k] = sliding.times * sliding.of[pairs.owned[k]];
  exchange_records(pairs, displacements);
  std::vector<FrictionExchange> exchanges(pairs.sites.size());
  std::vector<Couples::Neighborhood> own(pairs.owned.size());
  std::vector<Vector> turned(pairs.owned.size(), Vector::Zero());
  if (!sliding.is_trial) couples.bring_to_present(kinematics);
  friction.assign(pairs.owned.size(), Vector::Zero());
  friction_tangents_.assign(sliding.is_trial ? pairs.owned.size() : 0, {});
  if (!sliding.is_trial) slips_before_ = slips_;
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    Vector& slip = slips_[places_[k]];
    slip.setZero();
    if (!facing_[k].touches()) continue;
    Vector place = Vector::Zero();
    if (!sliding.is_trial) place = between_surfaces(k);
    if (!place.isZero(0)) own[k] = couples.of(kinematics, pairs.owned[k], place.norm());
    if (!own[k].patch.turns) place.setZero();  // nothing could take the couple
    const Patch patch = felt_patch(pairs, k, place);
    const Vector normal = gradient_[k].stableNormalized();
    slip = slips_before_[places_[k]] - sliding.times * own[k].spin.cross(place) +
           slip_of(pairs, k, patch, place, !sliding.is_trial, [&](int site) { return displacements[site]; });
    slip -= slip.dot(normal) * normal;
    slip = bearable(patch, place, slip);
    const double stiffness = of_friction * law.stiffness() * points_[places_[k]].area;
    const double most = coefficient * facing_[k].push * gradient_[k].norm(), wanted = stiffness * slip.norm();
    friction[k] = yielding_spring(most, stiffness, slip);
    exchanges[k] = friction_exchange_of(patch, place, friction[k]);
    turned[k] = place.cross(friction[k]);
    if (!sliding.is_trial) continue;
    const bool slides = wanted > most;
    friction_tangents_[k] = {.along = friction[k].stableNormalized(),
                             .normal = normal,
                             .spring = slides ? stiffness * most / wanted : stiffness,
                             .by_fraction = slides ? coefficient * facing_[k].stiffness * gradient_[k].norm() : 0,
                             .patch = patch,
                             .slides = slides};
  }
  exchange_records(pairs, exchanges);
  if (!sliding.is_trial) couples.add_forces(kinematics.domain, own, turned, force_density);
  pairs.friction_through.setZero();
  if (!any_touches_) return;
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    over_feeling(pairs, k, [&](int partner, const Vector& eta, double distance2, double reach) {
      const double weight = pairs.sites[k].volume() * Smoothing(reach).value(distance2);
      const Vector force = weight * exchanges[partner].reaction(-eta);
      friction[k] += force;
      pairs.friction_through += pairs.through_sides(partner, force);
    });
    force_density[pairs.owned[k]] += friction[k] / points_[places_[k]].volume;
  }
}

void Surfaces::commit(const std::vector<Vector>& friction) {
  slips_before_ = slips_;
  friction_before_.assign(points_.size(), Vector::Zero());
  for (std::size_t k = 0; k < friction.size(); ++k) friction_before_[places_[k]] = friction[k];
}

std::vector<Vector> Surfaces::committed_friction() const {
  std::vector<Vector> friction;
  for (const int place : places_) friction.push_back(friction_before_[place]);
  return friction;
}

double Surfaces::friction_work(const Pairs& pairs, const std::vector<Vector>& friction,
                               std::span<const Vector> increments) const {
  double work = 0;
  for (std::size_t k = 0; k < friction.size(); ++k) {
    const Vector before = friction_before_.empty() ? Vector::Zero() : friction_before_[places_[k]];
    work += 0.5 * (before + friction[k]).dot(increments[pairs.owned[k]]);
  }
  return work;
}

void Surfaces::add_stiffness(Pairs& pairs, std::span<const Vector> field, std::span<Vector> result) const {
  struct Change {
    Vector of_place = Vector::Zero();
    FrictionExchange friction;  // change of the friction
    double tension = 0;         // κ times the change of ρ
  };
  std::vector<Change> changes(pairs.sites.size());
  std::vector<Vector> drags(pairs.owned.size(), Vector::Zero());
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) changes[k].of_place = field[pairs.owned[k]];
  exchange_records(pairs, changes);
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    if (!facing_[k].touches()) continue;
    double fraction_change = gradient_[k].dot(changes[k].of_place);
    over_felt(pairs, k, [&](int partner, const Vector& eta, double distance2, double reach) {
      fraction_change += pairs.sites[partner].volume() * Smoothing(reach).slope_over_distance(distance2) *
                         eta.dot(changes[partner].of_place);
    });
    changes[k].tension = facing_[k].stiffness * fraction_change;
    if (friction_tangents_.empty()) continue;
    const FrictionTangent& tangent = friction_tangents_[k];
    Vector slip =
        slip_of(pairs, k, tangent.patch, Vector::Zero(), false, [&](int site) { return changes[site].of_place; });
    slip -= slip.dot(tangent.normal) * tangent.normal;
    slip = bearable(tangent.patch, Vector::Zero(), slip);
    if (tangent.slides) slip -= slip.dot(tangent.along) * tangent.along;
    drags[k] = tangent.spring * slip + tangent.by_fraction * fraction_change * tangent.along;
    changes[k].friction = friction_exchange_of(tangent.patch, Vector::Zero(), drags[k]);
  }
  exchange_records(pairs, changes);
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    Vector sum = changes[k].tension * gradient_[k] - drags[k];
    over_feeling(pairs, k, [&](int partner, const Vector& eta, double distance2, double reach) {
      const Smoothing around(reach);
      const double volume = pairs.sites[k].volume();
      sum -= changes[partner].tension * volume * around.slope_over_distance(distance2) * eta;
      sum -= volume * around.value(distance2) * changes[partner].friction.reaction(-eta);
    });
    result[pairs.owned[k]] += sum;
  }
}

}  // namespace strut::contact
