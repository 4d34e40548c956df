// Each point sums the forces of its own pairs, in the order of ids: no atomics, the same on any number of ranks, and
// equal and opposite to the last bit at the two ends of a pair.
#include "contact/forces.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace strut::contact {

namespace {

constexpr int site_stride = sizeof(Site) / sizeof(double);

void bring_to_present(const Kinematics& kinematics, Pairs& pairs) {
  for (std::size_t k = 0; k < pairs.owned.size(); ++k)
    pairs.sites[k].current = kinematics.domain.sites[pairs.owned[k]].current;
  if (!pairs.halo) return;
  double* places = pairs.sites.empty() ? nullptr : pairs.sites.data()->current.data();
  pairs.halo->exchange(places, site_stride, 3);
}

// Pairs that are just at the distance at which they touch, as bodies with a common face are at the start, count as
// touching: their stiffness belongs into the first step.
constexpr double just = 1 + 1e-9;

// A pair that touches.
struct Touch {
  int partner;
  Vector direction;  // from the point to its partner, unit length
  double distance, touching, stiffness;
  double force() const { return normal_force(stiffness, touching, distance); }
};

double reference_distance(const Site& a, const Site& b) {
  return (b.reference - a.reference).head<3>().matrix().norm();
}

// Calls visit(Touch) for the partners of owned[k] that touch it.
template <class Visit>
void for_each_touch(const Pairs& pairs, const Model& model, std::size_t k, Visit&& visit) {
  const Site& here = pairs.sites[k];
  const double radius2 = just * model.radius * model.radius;
  for (std::size_t p = pairs.start[k]; p < pairs.start[k + 1]; ++p) {
    const Site& there = pairs.sites[pairs.partners[p]];
    const Vector eta = (there.current - here.current).head<3>().matrix();
    const double distance2 = eta.squaredNorm();
    if (!(distance2 < radius2)) continue;
    const double touching = touching_distance(model.radius, reference_distance(here, there), pairs.one_body);
    if (!(distance2 < just * touching * touching)) continue;
    const double distance = std::sqrt(distance2);
    // Two points at the same place have no direction: nothing parts them in this step.
    const Vector direction = distance > 0 ? Vector(eta / distance) : Vector::Zero();
    const double horizon = 0.5 * (here.current[3] + there.current[3]);
    const double stiffness = penalty_stiffness(model.penalty, horizon) * (here.reference[3] * there.reference[3]);
    visit(Touch{pairs.partners[p], direction, distance, touching, stiffness});
  }
}

// What the partners of a point must know of it for friction.
struct Slider {
  Vector velocity = Vector::Zero();
  Vector push = Vector::Zero();  // the sum of its normal forces, N
  double contacts = 0;           // how many
};
constexpr int slider_width = sizeof(Slider) / sizeof(double);

std::vector<Slider> sliders(const Kinematics& kinematics, const Model& model, Pairs& pairs) {
  std::vector<Slider> all(pairs.sites.size());
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    all[k].velocity = kinematics.velocities[pairs.owned[k]];
    for_each_touch(pairs, model, k, [&](const Touch& touch) {
      all[k].push -= touch.force() * touch.direction;
      all[k].contacts += 1;
    });
  }
  if (pairs.halo) pairs.halo->exchange(reinterpret_cast<double*>(all.data()), slider_width, slider_width);
  return all;
}

// The normal of two surfaces of points, from the pushes on both. That of a single pair sways as points pass each other:
// with it, the friction of a flat face would be larger than μ times its load.
Vector surface_normal(const Slider& here, const Slider& there, const Vector& direction) {
  const Vector difference = here.push.stableNormalized() - there.push.stableNormalized();
  const double length = difference.norm();
  return length > 1e-6 ? Vector(difference / length) : direction;
}

// Of a positive semidefinite tensor, where it is above `floor`: it is at most the trace.
double largest_eigenvalue(const Tensor& springs, double floor) {
  if (!(springs.trace() > floor)) return 0;
  return Eigen::SelfAdjointEigenSolver<Tensor>(springs, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

}  // namespace

ForceResult add_normal_forces(const Kinematics& kinematics, const Model& model, Pairs& pairs,
                              std::vector<Vector>& force_density) {
  bring_to_present(kinematics, pairs);
  ForceResult result;
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    Vector force = Vector::Zero();
    Tensor springs = Tensor::Zero();
    for_each_touch(pairs, model, k, [&](const Touch& touch) {
      force -= touch.force() * touch.direction;
      result.deepest.take({1 - touch.distance / touch.touching, pairs.owned[k]});
      result.energy += 0.5 * stored_energy(touch.stiffness, touch.touching, touch.distance);
      const double mass = pairs.masses[k];
      const double weight = touch.stiffness * (1 / mass + 1 / std::sqrt(mass * pairs.masses[touch.partner]));
      springs += weight * touch.direction * touch.direction.transpose();
    });
    force_density[pairs.owned[k]] += force / pairs.sites[k].reference[3];
    result.stiffness = std::max(result.stiffness, largest_eigenvalue(springs, result.stiffness));
  }
  return result;
}

void add_friction(const Kinematics& kinematics, const Model& model, double dt, Pairs& pairs,
                  std::vector<Vector>& force_density, std::vector<Vector>& friction) {
  friction.assign(pairs.owned.size(), Vector::Zero());
  const std::vector<Slider> all = sliders(kinematics, model, pairs);
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    const Slider& here = all[k];
    for_each_touch(pairs, model, k, [&](const Touch& touch) {
      const Slider& there = all[touch.partner];
      const Vector normal = surface_normal(here, there, touch.direction);
      const double load = touch.force() * std::abs(normal.dot(touch.direction));
      const double mobility = here.contacts / pairs.masses[k] + there.contacts / pairs.masses[touch.partner];
      friction[k] += friction_force(model.friction, load, there.velocity - here.velocity, normal, mobility, dt);
    });
    force_density[pairs.owned[k]] += friction[k] / pairs.sites[k].reference[3];
  }
}

void add_springs(const Model& model, const Pairs& pairs, std::span<Tensor> springs) {
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    for_each_touch(pairs, model, k, [&](const Touch& touch) {
      springs[pairs.owned[k]] += touch.stiffness * touch.direction * touch.direction.transpose();
    });
  }
}

void add_stiffness(const Model& model, Pairs& pairs, std::span<const Vector> field, std::span<Vector> result) {
  std::vector<Vector> values(pairs.sites.size());
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) values[k] = field[pairs.owned[k]];
  if (pairs.halo) pairs.halo->exchange(reinterpret_cast<double*>(values.data()), 3, 3);
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    for_each_touch(pairs, model, k, [&](const Touch& touch) {
      const double approach = touch.direction.dot(values[k] - values[touch.partner]);
      result[pairs.owned[k]] += touch.stiffness * approach * touch.direction;
    });
  }
}

}  // namespace strut::contact
