#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "advice/checks.hpp"

namespace strut {

namespace {

// Depths that are told, as fractions of a spacing: of centers, of cells.
constexpr double least_depth = 0.01, least_cut = 0.02;

// True if the cell of point i is a whole cube of a lattice: the reach of any other is an estimate.
bool is_cube(const Domain& domain, int i) {
  const double edge = domain.cloud.spacings[i];
  double nearest = std::numeric_limits<double>::infinity();
  domain.families.for_each(
      i, [&](int j) { nearest = std::min(nearest, (domain.reference(j) - domain.reference(i)).norm()); });
  return std::abs(nearest - edge) < 0.01 * edge && std::abs(std::cbrt(domain.volume(i)) - edge) < 1e-6 * edge;
}

// How far a cell reaches into a tool that its center, at this place, is outside of, m.
double cut(const RigidTool& tool, const Domain& domain, int i, const Vector& place) {
  const Surface at = surface(tool.shape, place);
  return reach_of_cell(domain.cloud, domain.volume(i), i, -at.normal) - std::max(at.gap, 0.0);
}

// Points that a tool meets at the start.
struct Met {
  std::int64_t points = 0;
  double deepest = 0;  // m

  void add(double depth) { ++points, deepest = std::max(deepest, depth); }
  void reduce(const Communicator& communicator) {
    points = communicator.sum(points), deepest = communicator.max(deepest);
  }
};

}  // namespace

std::string filled_tools(const Situation& situation) {
  const Scene& scene = situation.scene;
  const Domain& domain = scene.body.domain;
  const std::vector<RigidTool> tools = tools_of(scene.conditions);
  std::ostringstream text;
  text.precision(3);
  for (std::size_t n = 0; n < tools.size(); ++n) {
    const Vector offset = tools[n].offset(situation.start);
    // Cells that an earlier run has cut are not cut again.
    const bool cuts = tools[n].reaches && !scene.tools[n].is_resumed;
    Met inside, cells;
    for (const int i : tools[n].points) {
      const Vector place = tools[n].nearest_image(domain, scene.body.current(i) - offset);
      const double spacing = domain.cloud.spacings[i], depth = -tools[n].met_by(i, tools[n].shape, place).gap;
      if (depth > least_depth * spacing) inside.add(depth);
      const double part = cuts ? cut(tools[n], domain, i, place) : 0;
      if (part > least_cut * spacing && is_cube(domain, i)) cells.add(part);
    }
    inside.reduce(domain.communicator), cells.reduce(domain.communicator);
    if (inside.points > 0) {
      text << "WARNING: " << inside.points << " points are inside of the tool '" << scene.tools[n].name
           << "' at the start, up to " << inside.deepest
           << " m deep: the first step pushes them out; where should it stand, in m?\n";
    } else if (cells.points > 0) {
      text << "WARNING: the tool '" << scene.tools[n].name << "' stands in the cells of " << cells.points
           << " points at the start, up to " << cells.deepest
           << " m deep: bodies are taken as cut off there; where should it stand, in m?\n";
    }
  }
  return text.str();
}

}  // namespace strut
