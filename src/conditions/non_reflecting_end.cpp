#include "conditions/non_reflecting_end.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conditions/velocity_update.hpp"
#include "topology/cell_edges.hpp"

namespace strut {

namespace {

// The velocity after forces that would change `before` by `change`, and a drag on the mean of `before` and the result:
// stable for any rate.
double dragged(double before, double change, double rate, double dt) {
  return (before * (1 - 0.5 * rate * dt) + change) / (1 + 0.5 * rate * dt);
}

// Least volume spanned by the normals: with less they are in one plane, or two of them are equal.
constexpr double least_span = 0.1;

double span(const std::vector<Vector>& normals) {
  if (normals.size() == 2) return normals[0].cross(normals[1]).norm();
  return normals.size() == 3 ? std::abs(normals[0].cross(normals[1]).dot(normals[2])) : normals.size() < 2;
}

}  // namespace

NonReflectingEnd NonReflectingEnd::on(std::vector<int> points, int at, const Body& body) const {
  NonReflectingEnd end{.normal = normal, .index = at};
  for (const int i : points) {
    const BlockMaterial& material = body.blocks[body.domain.cloud.blocks[i]].material;
    const auto moduli = materials::moduli_of(material.law);
    const double h = edge_of_cell(body.domain, i, normal);
    end.drags.push_back({.point = i,
                         .along = 2 / h * std::sqrt(moduli.longitudinal() / material.density),
                         .across = 2 / h * std::sqrt(moduli.shear / material.density)});
  }
  return end;
}

// Where ends meet, they act one after the other, which is the drag of both together except for the product of their
// rates over a step, and as stable.
void NonReflectingEnd::change_velocities(VelocityUpdate& update) const {
  const auto& scales = update.body.mass_scale;  // the traction is that of the material, whatever mass was added
  for (const auto& [i, along, across] : drags) {
    const double slower = scales.empty() ? 1 : 1 / scales[i];
    const Vector before = update.body.previous_velocity[i], change = update.body.velocity[i] - before;
    const double speed = normal.dot(before), push = normal.dot(change), dt = update.steps.of_impulse(i);
    const Vector sliding = before - speed * normal, shear = change - push * normal;
    Vector& v = update.body.velocity[i];
    const Vector before_end = v;
    v = dragged(speed, push, slower * along, dt) * normal;
    for (int c = 0; c < 3; ++c) v[c] += dragged(sliding[c], shear[c], slower * across, dt);
    update.record(i, v - before_end);
  }
}

std::optional<NonReflectingEnd> NonReflectingEnd::in_substeps(const MovingPoints& moving) const {
  NonReflectingEnd part = *this;
  std::erase_if(part.drags, [&](const Drag& drag) { return !moving.include(drag.point); });
  return part;
}

// The fraction of the full angle: of a wedge by the angle between its faces, of a trihedral corner by Girard's theorem.
double part_within(const std::vector<Vector>& normals) {
  const auto between = [&](std::size_t a, std::size_t b) {
    return std::acos(std::clamp(normals[a].dot(normals[b]), -1.0, 1.0));
  };
  const double pi = std::numbers::pi;
  if (span(normals) < least_span) return 0;
  switch (normals.size()) {
    case 0:
      return 1;
    case 1:
      return 0.5;
    case 2:
      return (pi - between(0, 1)) / (2 * pi);
    default:
      return (2 * pi - between(0, 1) - between(1, 2) - between(2, 0)) / (4 * pi);
  }
}

}  // namespace strut
