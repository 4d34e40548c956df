#include "integrators/explicit/pushed_points.hpp"

#include <algorithm>

namespace strut {

namespace {

// Levels are chosen one step ahead: marks points that a tool with this velocity would reach, at theirs, within the next
// `steps` steps.
void mark_met(const RigidTool& tool, const Vector& velocity, const Body& body, std::span<const Vector> velocities,
              double t, double dt, std::vector<std::uint8_t>& marks) {
  // Margin for changes meanwhile, in steps and spacings; a gap of a round number must not depend on round-off.
  constexpr double steps = 2, near = 0.05 + 1e-6;
  const Vector offset = tool.offset(t);
  for (const int i : tool.points) {
    const Vector place = tool.nearest_image(body.domain, body.current(i) - offset);
    const Surface at = tool.met_by(i, tool.shape, place);
    const double closing = std::max(0.0, at.normal.dot(velocity - velocities[i]));
    if (at.gap < steps * dt * closing + near * body.domain.cloud.spacings[i]) marks[i] = 1;
  }
}

}  // namespace

std::vector<std::uint8_t> pushed_points(const Body& body, const Conditions& conditions, const contact::Contact& contact,
                                        std::span<const Vector> velocities, double t, double dt) {
  std::vector<std::uint8_t> marks(body.owned(), 0);
  contact.mark_touching(marks);
  bool any = contact.any();
  for (const RigidTool& tool : tools_of(conditions)) {
    if (!tool.free) continue;
    any = true;
    mark_met(tool, tool.free->velocity, body, velocities, t, dt, marks);
  }
  return any ? marks : std::vector<std::uint8_t>();
}

std::vector<std::uint8_t> damped_points(const Body& body, const Conditions& conditions,
                                        std::span<const Vector> velocities, double t, double dt) {
  std::vector<std::uint8_t> marks;
  conditions.visit([&](const NonReflectingEnd& end) {
    marks.resize(body.owned(), 0);
    for (const auto& drag : end.drags) marks[drag.point] = 1;
  });
  for (const RigidTool& tool : tools_of(conditions)) {
    if (tool.friction == 0 || tool.free) continue;
    marks.resize(body.owned(), 0);
    const Vector velocity = dt > 0 ? Vector((tool.offset(t + dt) - tool.offset(t)) / dt) : Vector(Vector::Zero());
    mark_met(tool, velocity, body, velocities, t, dt, marks);
  }
  return marks;
}

bool any_in_both(const std::vector<std::uint8_t>& some, const std::vector<std::uint8_t>& others) {
  if (others.empty()) return false;
  for (std::size_t i = 0; i < some.size(); ++i) {
    if (some[i] && others[i]) return true;
  }
  return false;
}

}  // namespace strut
