// Each point sums the forces of its own pairs in the order of ids. So there are no atomics, results are the same on any
// number of ranks, and forces are equal and opposite to the last bit at the two ends of a pair.
#include "contact/forces.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "contact/breaks.hpp"
#include "contact/laws/contact_law.hpp"

namespace strut::contact {

namespace {

// Pairs exactly at the touching distance, as on a common face at the start, count as touching: their stiffness must
// limit the first step.
constexpr double just = 1 + 1e-9;

// The stiffness that bounds the next step is that of this many times the present overlap.
constexpr double growth = 2;

// A pair that touches now, or will in a step like the last one.
template <ContactLaw L>
struct Touch {
  const L& law;
  PointPair pair;
  int partner;
  Vector direction;  // from the point to its partner, unit length
  double distance, touching;
  double distance_to_come;

  bool is_now() const { return distance * distance < just * touching * touching; }
  double overlap() const { return std::max(0.0, touching - distance); }
  double penetration() const { return 1 - distance / touching; }
  double force() const { return law.normal_force(pair, overlap()); }
  double energy() const { return law.stored_energy(pair, overlap()); }
  double stiffness() const { return law.tangent_stiffness(pair, overlap()); }
  double stiffness_to_come() const {
    return law.tangent_stiffness(pair, std::max(growth * overlap(), touching - distance_to_come));
  }
};

// Displacements of the sites of pairs in the last step, m; empty if there was none.
struct StepDisplacements {
  std::vector<Vector> of = {};
  double most = 0;  // upper bound of the approach of two of them
};

// Computed from velocities, so that the displacements do not depend on when a search found the pairs.
StepDisplacements step_displacements(const Kinematics& kinematics, double dt, Pairs& pairs) {
  StepDisplacements displacements;
  if (dt == 0) return displacements;
  displacements.of.assign(pairs.sites.size(), Vector::Zero());
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) displacements.of[k] = dt * kinematics.velocities[pairs.owned[k]];
  if (pairs.halo) pairs.halo->exchange<unchanged>(displacements.of);
  Eigen::AlignedBox3d box;
  for (const Vector& displacement : displacements.of) box.extend(displacement);
  if (!displacements.of.empty()) displacements.most = box.diagonal().norm();
  return displacements;
}

PointPair pair_of(const Site& a, const Site& b, bool one_body) {
  return {{a.volume(), b.volume()},
          {a.horizon(), b.horizon()},
          (b.reference - a.reference).head<3>().matrix().norm(),
          one_body};
}

// Calls visit(Touch) for each partner of owned[k] that touches it or is about to.
template <ContactLaw L, class Visit>
void for_each_near(const Pairs& pairs, const StepDisplacements& displacements, const L& law, std::size_t k,
                   Visit&& visit) {
  const Site& here = pairs.sites[k];
  const double reach = law.radius + displacements.most, reach2 = just * reach * reach;
  for (std::size_t p = pairs.start[k]; p < pairs.start[k + 1]; ++p) {
    const int partner = pairs.partners[p];
    const Site& there = pairs.sites[partner];
    const Vector eta = (there.current - here.current).head<3>().matrix();
    const double distance2 = eta.squaredNorm();
    if (!(distance2 < reach2)) continue;
    const PointPair pair = pair_of(here, there, pairs.one_body);
    double touching = law.touching_distance(pair);
    if (!pairs.limits.empty()) touching = std::min(touching, pairs.limits[p]);
    const double seen = touching + displacements.most;
    if (!(distance2 < just * seen * seen)) continue;
    const double distance = std::sqrt(distance2);
    const double to_come =
        displacements.of.empty() ? distance : (eta + displacements.of[partner] - displacements.of[k]).norm();
    // Two points at the same position have no direction: no force separates them in this step.
    const Vector direction = distance > 0 ? Vector(eta / distance) : Vector::Zero();
    const Touch<L> touch{law, pair, partner, direction, distance, touching, to_come};
    if (touch.is_now() || to_come < touching) visit(touch);
  }
}

template <ContactLaw L, class Visit>
void for_each_touch(const Pairs& pairs, const L& law, std::size_t k, Visit&& visit) {
  for_each_near(pairs, StepDisplacements(), law, k, visit);
}

// Data of a point that its partners need for friction.
struct Slider {
  Vector velocity = Vector::Zero();
  Vector spin = Vector::Zero();  // of its neighborhood, 1/s
  Vector push = Vector::Zero();  // the sum of its normal forces, N
  double mobility = 0;           // velocity per unit of impulse from each of its contacts, 1/kg
  double turning = 0;            // the same off the point, by rotation of its neighborhood, over arm², 1/(kg m²)
  double turns = 0;              // 1: its neighborhood can take a couple

  // The velocity of the body, m/s, at the position `arm` relative to the point, m.
  Vector velocity_at(const Vector& arm) const { return velocity + spin.cross(arm); }
  double mobility_at(const Vector& arm) const { return mobility + turning * arm.squaredNorm(); }
};

std::vector<Slider> sliders(const Kinematics& kinematics, const ContactLaw auto& law, Pairs& pairs,
                            const std::vector<Load>& loads, const Couples& couples,
                            std::vector<Couples::Neighborhood>& neighborhoods) {
  std::vector<Slider> all(pairs.sites.size());
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    if (loads[k].contacts == 0) continue;
    Slider& slider = all[k];
    slider.velocity = kinematics.velocities[pairs.owned[k]];
    slider.push = loads[k].push;
    slider.mobility = loads[k].contacts / pairs.masses[k];
    neighborhoods[k] = couples.of(kinematics, pairs.owned[k], 0.5 * law.radius);
    const Patch& patch = neighborhoods[k].patch;
    if (!patch.turns) continue;
    slider.turning = slider.mobility * patch.weight / patch.smallest;  // includes all of its points
    slider.spin = neighborhoods[k].spin;
    slider.turns = 1;
  }
  if (pairs.halo) pairs.halo->exchange<unchanged>(all);
  return all;
}

// Position at which friction acts on a point and its partner, as a fraction of the vector between them: midway, or at
// the one that cannot take a couple.
double place_of_friction(const Slider& here, const Slider& there) { return 0.5 * (1 + here.turns - there.turns); }

// The normal of two surfaces of points, from the normal forces on both. The direction of a single pair oscillates as
// points pass each other, which would make the friction of a flat face exceed μ times its load.
Vector surface_normal(const Slider& here, const Slider& there, const Vector& direction) {
  const Vector difference = here.push.stableNormalized() - there.push.stableNormalized();
  const double length = difference.norm();
  return length > 1e-6 ? Vector(difference / length) : direction;
}

template <ContactLaw L>
ForceResult normal_forces(const L& law, const Pairs& pairs, const StepDisplacements& displacements,
                          std::vector<Vector>& force_density, std::vector<Load>& loads) {
  ForceResult result;
  loads.resize(pairs.owned.size());
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    Load load;
    for_each_near(pairs, displacements, law, k, [&](const Touch<L>& touch) {
      const double mass = pairs.masses[k];
      const double weight = touch.stiffness_to_come() * (1 / mass + 1 / std::sqrt(mass * pairs.masses[touch.partner]));
      load.springs += weight * touch.direction * touch.direction.transpose();
      if (!touch.is_now()) return;
      load.push -= touch.force() * touch.direction;
      load.contacts += 1;
      result.deepest.take({touch.penetration(), pairs.owned[k]});
      result.energy += 0.5 * touch.energy();
    });
    force_density[pairs.owned[k]] += load.push / pairs.sites[k].volume();
    result.stiffness = std::max(result.stiffness, largest_eigenvalue(load.springs, result.stiffness));
    loads[k] = load;
  }
  return result;
}

// Friction on pairs.owned[k]: its force, N, and its couple about the point, N m.
struct Friction {
  std::vector<Vector> forces, couples;
};

// No friction between two points that both have no neighbors or neighbors in one line: neither could take the couple.
template <ContactLaw L>
Friction friction_forces(const Kinematics& kinematics, const L& law, double coefficient, double dt, Pairs& pairs,
                         const std::vector<Load>& loads, const Couples& couples,
                         std::vector<Couples::Neighborhood>& neighborhoods) {
  const std::vector<Vector> none(pairs.owned.size(), Vector::Zero());
  Friction friction{none, none};
  const std::vector<Slider> all = sliders(kinematics, law, pairs, loads, couples, neighborhoods);
  pairs.friction_through.setZero();
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    const Slider& here = all[k];
    for_each_touch(pairs, law, k, [&](const Touch<L>& touch) {
      const Slider& there = all[touch.partner];
      if (here.turns + there.turns == 0) return;
      const Vector normal = surface_normal(here, there, touch.direction);
      const double load = touch.force() * std::abs(normal.dot(touch.direction));
      const Vector displacement = touch.distance * touch.direction, arm = place_of_friction(here, there) * displacement,
                   other_arm = -place_of_friction(there, here) * displacement;
      const Vector velocity = there.velocity_at(other_arm) - here.velocity_at(arm);
      const Vector force =
          friction_force(coefficient, load, velocity, normal, here.mobility_at(arm) + there.mobility_at(other_arm), dt);
      friction.forces[k] += force;
      pairs.friction_through += 0.5 * pairs.through_sides(touch.partner, force);
      friction.couples[k] += arm.cross(force);
    });
  }
  return friction;
}

// Calls visit(k, Touch) for the touching pairs of the points pairs.owned[k].
void over_touches(const PairLaw& law, const Pairs& pairs, const auto& visit) {
  const auto by_law = [&](const auto& one) {
    for (std::size_t k = 0; k < pairs.owned.size(); ++k)
      for_each_touch(pairs, one, k, [&](const auto& touch) { visit(k, touch); });
  };
  std::visit(by_law, law);
}

}  // namespace

ForceResult add_normal_forces(const Kinematics& kinematics, double dt, const PairLaw& law, Pairs& pairs,
                              std::vector<Vector>& force_density, std::vector<Load>& loads) {
  bring_to_present(kinematics, pairs);
  if (dt > 0) raise_limits(pairs);
  const StepDisplacements displacements = step_displacements(kinematics, dt, pairs);
  return std::visit([&](const auto& one) { return normal_forces(one, pairs, displacements, force_density, loads); },
                    law);
}

void add_friction(const Kinematics& kinematics, const PairLaw& law, double coefficient, double dt, Pairs& pairs,
                  const std::vector<Load>& loads, Couples& couples, std::vector<Vector>& force_density,
                  std::vector<Vector>& friction) {
  couples.bring_to_present(kinematics);
  std::vector<Couples::Neighborhood> neighborhoods(pairs.owned.size());
  Friction found = std::visit(
      [&](const auto& one) {
        return friction_forces(kinematics, one, coefficient, dt, pairs, loads, couples, neighborhoods);
      },
      law);
  for (std::size_t k = 0; k < pairs.owned.size(); ++k)
    force_density[pairs.owned[k]] += found.forces[k] / pairs.sites[k].volume();
  couples.add_forces(kinematics.domain, neighborhoods, found.couples, force_density);
  friction = std::move(found.forces);
}

void for_each_normal_force(const PairLaw& law, const Pairs& pairs,
                           const std::function<void(std::size_t, Vector)>& visit) {
  over_touches(law, pairs, [&](std::size_t k, const auto& touch) { visit(k, -touch.force() * touch.direction); });
}

// A pair over a side is seen from either end, once with an image above and once with one below.
Vector normal_force_through_sides(const PairLaw& law, const Pairs& pairs) {
  Vector sum = Vector::Zero();
  over_touches(law, pairs, [&](std::size_t, const auto& touch) {
    sum -= 0.5 * pairs.through_sides(touch.partner, touch.force() * touch.direction);
  });
  return sum;
}

void add_springs(const PairLaw& law, const Pairs& pairs, std::span<Tensor> springs) {
  over_touches(law, pairs, [&](std::size_t k, const auto& touch) {
    springs[pairs.owned[k]] += touch.stiffness() * touch.direction * touch.direction.transpose();
  });
}

void add_stiffness(const PairLaw& law, Pairs& pairs, std::span<const Vector> field, std::span<Vector> result) {
  std::vector<Vector> values(pairs.sites.size());
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) values[k] = field[pairs.owned[k]];
  if (pairs.halo) pairs.halo->exchange<unchanged>(values);
  over_touches(law, pairs, [&](std::size_t k, const auto& touch) {
    const double approach = touch.direction.dot(values[k] - values[touch.partner]);
    result[pairs.owned[k]] += touch.stiffness() * approach * touch.direction;
  });
}

double largest_eigenvalue(const Tensor& springs, double floor) {
  if (!(springs.trace() > floor)) return 0;
  return Eigen::SelfAdjointEigenSolver<Tensor>(springs, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

}  // namespace strut::contact
