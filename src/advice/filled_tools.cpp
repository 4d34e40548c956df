#include <algorithm>
#include <sstream>

#include "advice/checks.hpp"

namespace strut {

namespace {

constexpr double least_depth = 0.01;  // of a spacing

}  // namespace

std::string filled_tools(const Situation& situation) {
  const Scene& scene = situation.scene;
  const Domain& domain = scene.body.domain;
  const std::vector<RigidTool> tools = tools_of(scene.conditions);
  std::ostringstream text;
  text.precision(3);
  for (std::size_t n = 0; n < tools.size(); ++n) {
    const Vector offset = tools[n].offset(situation.start);
    double inside = 0, deepest = 0;
    for (const int i : tools[n].points) {
      const double depth = -tools[n].met_by(i, tools[n].shape, scene.body.current(i) - offset).gap;
      if (depth <= least_depth * domain.cloud.spacings[i]) continue;
      ++inside;
      deepest = std::max(deepest, depth);
    }
    inside = domain.communicator.sum(inside), deepest = domain.communicator.max(deepest);
    if (inside == 0) continue;
    text << "WARNING: " << static_cast<std::int64_t>(inside) << " points are inside of the tool '"
         << scene.tools[n].name << "' at the start, up to " << deepest
         << " m deep: the first step pushes them out; where should it stand, in m?\n";
  }
  return text.str();
}

}  // namespace strut
