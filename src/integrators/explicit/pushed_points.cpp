#include "integrators/explicit/pushed_points.hpp"

#include <algorithm>

namespace strut {

// Levels are chosen one step ahead: a point counts as pushed if a free tool would reach it, at these velocities, within
// the next `steps` steps.
std::vector<std::uint8_t> pushed_points(const Body& body, const Conditions& conditions, const contact::Contact& contact,
                                        std::span<const Vector> velocities, double t, double dt) {
  // Margin for changes meanwhile, in steps and spacings; a gap of a round number must not depend on round-off.
  constexpr double steps = 2, near = 0.05 + 1e-6;
  std::vector<std::uint8_t> marks(body.owned(), 0);
  contact.mark_touching(marks);
  bool any = contact.any();
  for (const RigidTool& tool : tools_of(conditions)) {
    if (!tool.free) continue;
    any = true;
    const Vector offset = tool.offset(t);
    for (const int i : tool.points) {
      const Vector place = tool.nearest_image(body.domain, body.current(i) - offset);
      const Surface at = tool.met_by(i, tool.shape, place);
      const double closing = std::max(0.0, at.normal.dot(tool.free->velocity - velocities[i]));
      if (at.gap < steps * dt * closing + near * body.domain.cloud.spacings[i]) marks[i] = 1;
    }
  }
  return any ? marks : std::vector<std::uint8_t>();
}

std::vector<std::uint8_t> damped_points(const Body& body, const Conditions& conditions) {
  std::vector<std::uint8_t> marks;
  conditions.visit([&](const NonReflectingEnd& end) {
    marks.resize(body.owned(), 0);
    for (const auto& drag : end.drags) marks[drag.point] = 1;
  });
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
