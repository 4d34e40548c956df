#include "conditions/non_reflecting_end.hpp"

#include <algorithm>
#include <cmath>

#include "conditions/velocity_update.hpp"

namespace strut {

namespace {

// The velocity after forces that would change `before` by `change`, with a drag on the mean of both: stable at any
// rate.
double dragged(double before, double change, double rate, double dt) {
  return (before * (1 - 0.5 * rate * dt) + change) / (1 + 0.5 * rate * dt);
}

}  // namespace

NonReflectingEnd NonReflectingEnd::on(std::vector<int> points, int, const Body& body) const {
  NonReflectingEnd end{normal};
  for (const int i : points) {
    const BlockMaterial& material = body.blocks[body.domain.cloud.blocks[i]].material;
    const auto moduli = std::visit([](const auto& law) { return law.moduli(); }, material.law);
    const double s = body.domain.cloud.spacings[i];
    end.drags.push_back({.point = i,
                         .along = 2 / s * std::sqrt(moduli.longitudinal() / material.density),
                         .across = 2 / s * std::sqrt(moduli.shear / material.density),
                         .gain = std::max(1.0, 2 * body.domain.volume(i) / (s * s * s))});
  }
  return end;
}

void NonReflectingEnd::change_velocities(VelocityUpdate& update) const {
  for (const auto& [i, along, across, gain] : drags) {
    const Vector before = update.body.previous_velocity[i], change = gain * (update.body.velocity[i] - before);
    const double speed = normal.dot(before), push = normal.dot(change), dt = update.steps.of_impulse(i);
    const Vector sliding = before - speed * normal, shear = change - push * normal;
    Vector& v = update.body.velocity[i];
    const Vector before_end = v;
    v = dragged(speed, push, along, dt) * normal;
    for (int c = 0; c < 3; ++c) v[c] += dragged(sliding[c], shear[c], across, dt);
    update.record(i, v - before_end);
  }
}

std::optional<NonReflectingEnd> NonReflectingEnd::in_substeps(const MovingPoints& moving) const {
  NonReflectingEnd part = *this;
  std::erase_if(part.drags, [&](const Drag& drag) { return !moving.include(drag.point); });
  return part;
}

}  // namespace strut
