#include "conditions/symmetry_plane.hpp"

#include <algorithm>

#include "conditions/velocity_update.hpp"

namespace strut {

SymmetryPlane SymmetryPlane::on(std::vector<int> all, int index, const Body& body) const {
  const Domain& domain = body.domain;
  std::erase_if(all, [&](int i) {
    const int of_point = domain.body_of(i);
    return std::any_of(domain.mirrors.begin(), domain.mirrors.end(), [&](const Mirror& mirror) {
      return mirror.number == index && mirror.body == of_point &&
             !mirror.holds(domain.reference(i), domain.cloud.spacings[i]);
    });
  });
  SymmetryPlane plane = *this;
  plane.points = std::move(all), plane.reaction_index = index;
  return plane;
}

void SymmetryPlane::change_velocities(VelocityUpdate& update) const {
  for (const int i : points) {
    const Vector change = -normal.dot(update.body.velocity[i]) * push.value_or(normal);
    update.body.velocity[i] += change;
    update.record(i, change);
  }
}

std::optional<SymmetryPlane> SymmetryPlane::in_substeps(const MovingPoints& moving) const {
  SymmetryPlane part = *this;
  part.points = moving.among(points);
  return part;
}

void SymmetryPlane::predict_velocities(double, double, const Body&, std::vector<Vector>& velocities) const {
  for (const int i : points) velocities[i] -= normal.dot(velocities[i]) * push.value_or(normal);
}

std::vector<HeldDirection> SymmetryPlane::held_directions(const Body& body, double, double) const {
  std::vector<HeldDirection> all;
  for (const int i : points) all.push_back({reaction_index, i, normal, normal.dot(body.current(i))});
  return all;
}

}  // namespace strut
