#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>

#include "advice/checks.hpp"
#include "base/math/time_integral.hpp"
#include "base/text.hpp"
#include "conditions/crossing.hpp"
#include "conditions/prototype.hpp"
#include "setup/changes_in_time.hpp"
#include "topology/cell_edges.hpp"

namespace strut {

namespace {

constexpr int samples = 100;  // samples of a tool's path

// Times at which to look at a tool's path, s, in order.
std::vector<double> times_of_path(const RigidTool& tool, double start, double duration) {
  std::vector<double> times = uneven_times(start, start + duration, samples);
  for (const Function& travel : tool.values_at_points())
    std::ranges::copy(telling_times(travel, Vector::Zero(), start, start + duration, samples),
                      std::back_inserter(times));
  std::ranges::sort(times);
  return times;
}

// ---- Tools that are apart ------------------------------------------------------------------------------------------

double smallest_gap(const RigidTool& tool, const Body& body, const std::vector<Vector>& velocities, double start,
                    double after) {
  const Vector offset = tool.offset(start + after);
  double smallest = std::numeric_limits<double>::infinity();
  for (const int i : tool.points) {
    const Vector place = body.current(i) + after * velocities[i] - offset;
    smallest = std::min(smallest, tool.met_by(i, tool.shape, tool.nearest_image(body.domain, place)).gap);
  }
  return body.domain.communicator.min(smallest);
}

// Time at which a tool that is `gap` (m) from all points first touches one, s after the start; nullopt if not before
// the end of the run. A gap closes by no more than both have moved since it was computed.
std::optional<double> first_touch(const RigidTool& tool, const Body& body, const std::vector<Vector>& velocities,
                                  double start, double duration, double gap) {
  double fastest = 0;
  for (const int i : tool.points) fastest = std::max(fastest, velocities[i].norm());
  fastest = body.domain.communicator.max(fastest);
  double before = 0, computed = 0;
  Vector there = tool.offset(start);
  for (const double time : times_of_path(tool, start, duration)) {
    const double now = time - start;
    const Vector offset = tool.offset(time);
    if (gap <= fastest * (now - computed) + (offset - there).norm()) {
      gap = smallest_gap(tool, body, velocities, start, now);
      if (gap <= 0) return before;
      computed = now, there = offset;
    }
    before = now;
  }
  return std::nullopt;
}

// True if a value is that of the start throughout the run, or a displacement goes on at the speed of the start.
bool goes_on(const OfTime& of_time, bool is_velocity, double start, double duration) {
  constexpr double alike = 1e-6;
  const double first = of_time(start), moment = first_moment * duration;
  const double speed = is_velocity ? 0 : (of_time(start + moment) - first) / moment;
  for (const double time : telling_times(of_time.value, of_time.X, start, start + duration, samples)) {
    const double after = time - start, value = of_time(time);
    const double off = std::abs(value - first - speed * after);
    if (off > alike * std::max(std::abs(value), std::abs(first))) return false;
  }
  return true;
}

// Collective. True if a prescribed motion is not that of the start throughout the run.
bool change_later(const Scene& scene, double start, double duration) {
  bool any = false;
  scene.conditions.visit([&](const PrescribedMotion& one) {
    over_the_box(one.value, where(one.points, scene.body),
                 [&](const OfTime& of_time) { any = any || !goes_on(of_time, one.is_velocity, start, duration); });
  });
  return any;
}

// ---- Thin tools ----------------------------------------------------------------------------------------------------

using Extent = Eigen::AlignedBox3d;

constexpr double least_width = 1.5;  // spacings
constexpr double as_good_as_none = 1e-6;

// The range of a tool's displacements from its initial position.
Extent displacements_of(const RigidTool& tool, double start, double duration) {
  Extent displacements;
  for (const double time : times_of_path(tool, start, duration))
    displacements.extend(Vector(tool.offset(time) - tool.offset(start)));
  return displacements;
}

Extent moved(const Extent& box, const Extent& by) { return {box.min() + by.min(), box.max() + by.max()}; }

struct Meeting {
  Extent tool, block, displacements;  // initial boxes of both; displacements of the tool relative to the block
  Vector spacings;                    // m, of the block's layers along each axis
};

// The axes along which the tool approaches the block: those along which they are apart and in relative motion; else
// those with either.
std::vector<int> axes_of_approach(const Meeting& meeting) {
  const double none = as_good_as_none * meeting.spacings.maxCoeff();
  std::vector<int> apart, moving, both;
  for (int c = 0; c < 3; ++c) {
    const double gap =
        std::max(meeting.tool.min()[c] - meeting.block.max()[c], meeting.block.min()[c] - meeting.tool.max()[c]);
    const bool is_apart = gap >= -none, moves = meeting.displacements.sizes()[c] > none;
    if (is_apart) apart.push_back(c);
    if (moves) moving.push_back(c);
    if (is_apart && moves) both.push_back(c);
  }
  if (!both.empty()) return both;
  if (!apart.empty()) return apart;
  return moving.empty() ? std::vector{0, 1, 2} : moving;
}

// The axis along which a box is thinner than least_width where it meets the block, or −1.
int thin_axis(const Meeting& meeting) {
  for (const int approach : axes_of_approach(meeting)) {
    for (int c = 0; c < 3; ++c) {
      const bool reaches_across =
          meeting.tool.min()[c] <= meeting.block.min()[c] && meeting.tool.max()[c] >= meeting.block.max()[c];
      if (c != approach && !reaches_across && meeting.tool.sizes()[c] < least_width * meeting.spacings[c]) return c;
    }
  }
  return -1;
}

// The thin dimension of a tool where it meets a block, m; "" if it is thick.
struct Thin {
  double width = 0, spacing = 0;  // spacing: of the layers that it may pass between, m
  std::string what;
};

Thin thin(const HalfSpace&, const RigidTool&, const Trajectory&, const Vector&, double, double) { return {}; }

Thin thin(const Box& box, const RigidTool& tool, const Trajectory& block, const Vector& spacings, double start,
          double duration) {
  const Extent of_tool = displacements_of(tool, start, duration), &of_block = block.displacements;
  Extent at_start(box.lower, box.upper);
  at_start.translate(tool.offset(start));
  Extent swept = moved(block.places, of_block);
  swept = {swept.min() - spacings, swept.max() + spacings};
  if (!moved(at_start, of_tool).intersects(swept)) return {};
  const Extent relative{of_tool.min() - of_block.max(), of_tool.max() - of_block.min()};
  const int axis = thin_axis({at_start, block.places, relative, spacings});
  if (axis < 0) return {};
  return {at_start.sizes()[axis], spacings[axis], std::string("wide along ") + "xyz"[axis]};
}

// Distance of the tool's axis, at each sample, from the ball around the block.
Thin thin(const Cylinder& roll, const RigidTool& tool, const Trajectory& block, const Vector& spacings, double start,
          double duration) {
  const Vector across = (1 - roll.axis.array().square()).max(0).sqrt();  // parts of the axes across that of the roll
  const double spacing = across.cwiseProduct(spacings).maxCoeff();
  if (2 * roll.radius >= least_width * spacing) return {};
  const Extent swept = moved(block.places, block.displacements);
  const double around = 0.5 * swept.diagonal().norm() + spacing;
  for (const double time : times_of_path(tool, start, duration)) {
    const Vector from = swept.center() - tool.offset(time);
    if (surface(roll, from).gap < around) return {2 * roll.radius, spacing, "in diameter"};
  }
  return {};
}

bool meets_block(const RigidTool& tool, int block, const Domain& domain) {
  const bool any =
      std::any_of(tool.points.begin(), tool.points.end(), [&](int i) { return domain.cloud.blocks[i] == block; });
  return domain.communicator.any(any);
}

// Collective. The mean edges of each block's cells along x, y and z, m; the spacing where none is known.
std::vector<Vector> layer_spacings(const Situation& situation) {
  const Domain& domain = situation.scene.body.domain;
  std::vector<double> sums(4 * domain.blocks.size());
  for (int i = 0; i < domain.owned; ++i) {
    if (!has_known_edges(domain, i)) continue;
    double* of_block = &sums[4 * domain.cloud.blocks[i]];
    for (int c = 0; c < 3; ++c) of_block[c] += edge_of_cell(domain, i, Vector::Unit(c));
    ++of_block[3];
  }
  domain.communicator.sum(sums);
  std::vector<Vector> spacings;
  for (std::size_t b = 0; b < domain.blocks.size(); ++b) {
    const double count = sums[4 * b + 3];
    if (count > 0) {
      spacings.emplace_back(Vector::Map(&sums[4 * b]) / count);
    } else {
      spacings.emplace_back(Vector::Constant(situation.spacings[b]));
    }
  }
  return spacings;
}

}  // namespace

std::string apart_tools(const Situation& situation) {
  const Scene& scene = situation.scene;
  const double start = situation.start, duration = situation.duration;
  const Body& body = scene.body;
  const std::vector<RigidTool> tools = tools_of(scene.conditions);
  if (tools.empty()) return "";
  const std::vector<Vector> velocities = predicted_velocities(scene.conditions, start, first_moment * duration, body);
  double spacing = 0;
  for (const double h : body.domain.cloud.spacings) spacing = std::max(spacing, h);
  spacing = body.domain.communicator.max(spacing);
  const bool later = change_later(scene, start, duration);
  std::ostringstream text;
  text.precision(3);
  for (std::size_t n = 0; n < tools.size(); ++n) {
    const double gap = smallest_gap(tools[n], body, velocities, start, 0);
    if (gap <= spacing) continue;
    const auto touch = first_touch(tools[n], body, velocities, start, duration, gap);
    text << (touch || later ? "" : "WARNING: ") << "the tool '" << scene.tools[n].name << "' is " << gap
         << " m from all points at the start; by its path and the velocities of the start it touches nothing ";
    if (touch) {
      text << "before about t = " << start + *touch << " s\n";
    } else {
      text << "until the end: only loads" << (later ? ", impacts and motions that change later" : " and impacts")
           << " may bring them together; where should it stand, in m?\n";
    }
  }
  return text.str();
}

std::string meeting_tools(const Situation& situation) {
  const Scene& scene = situation.scene;
  const double start = situation.start, duration = situation.duration;
  const std::vector<RigidTool> tools = tools_of(scene.conditions);
  if (std::ranges::none_of(tools, [](const RigidTool& tool) { return tool.free != nullptr; })) return "";
  const std::vector<Vector> velocities =
      predicted_velocities(scene.conditions, start, first_moment * duration, scene.body);
  std::vector<double> stopped;  // s after the start
  std::vector<std::vector<double>> times;
  for (const RigidTool& tool : tools) {
    const double gap = smallest_gap(tool, scene.body, velocities, start, 0);
    stopped.push_back(gap > 0 ? first_touch(tool, scene.body, velocities, start, duration, gap).value_or(duration) : 0);
    times.push_back(times_of_path(tool, start, duration));
  }
  std::string text;
  for (std::size_t n = 0; n < tools.size(); ++n) {
    for (std::size_t m = 0; m < n; ++m) {
      if (!may_meet(tools[m], tools[n]) || gap_between(tools[m], tools[n], start) < 0) continue;
      std::vector<double> of_both;
      std::ranges::merge(times[m], times[n], std::back_inserter(of_both));
      const double until = start + std::min(stopped[m], stopped[n]) * (1 + as_good_as_none);
      const auto first = std::ranges::find_if(
          of_both, [&](double time) { return time > until || gap_between(tools[m], tools[n], time) < 0; });
      if (first == of_both.end() || *first > until) continue;
      text += text_of(std::setprecision(3), "WARNING: the tools '", scene.tools[m].name, "' and '", scene.tools[n].name,
                      "' meet by about t = ", *first,
                      " s, by their paths and the velocities of the start, and pass through each other: tools stop "
                      "points only; expected material between them, or an end before (Final Time)\n");
    }
  }
  return text;
}

std::string thin_tools(const Situation& situation) {
  const Scene& scene = situation.scene;
  const std::vector<Vector> spacings = layer_spacings(situation);
  const auto& trajectories = situation.trajectories;
  const double start = situation.start, duration = situation.duration;
  const Domain& domain = scene.body.domain;
  const std::vector<RigidTool> tools = tools_of(scene.conditions);
  std::ostringstream text;
  text.precision(3);
  for (std::size_t n = 0; n < tools.size(); ++n) {
    for (std::size_t b = 0; b < trajectories.size(); ++b) {
      if (trajectories[b].places.isEmpty() || !meets_block(tools[n], static_cast<int>(b), domain)) continue;
      const auto [width, spacing, what] = std::visit(
          [&](const auto& shape) { return thin(shape, tools[n], trajectories[b], spacings[b], start, duration); },
          tools[n].shape);
      if (what.empty()) continue;
      text << "WARNING: the tool '" << scene.tools[n].name << "' is " << width << " m " << what
           << ", less than 1.5 spacings of block '" << domain.cloud.block_names[b] << "' (" << spacing
           << " m each), which it can reach: tools stop points only, and this one passes between them; expected "
           << least_width * spacing << " m or more, or a finer mesh\n";
    }
  }
  return text.str();
}

namespace {

// The blocks of each body, and a box around them.
struct ThrownBody {
  std::string names;
  Eigen::AlignedBox3d cells;
  Vector velocity = Vector::Zero();  // m/s, of one of its blocks
  double spacing = 0;                // m, the largest
};

std::map<int, ThrownBody> bodies_that_meet(const RigidTool& tool, const Situation& situation) {
  const Domain& domain = situation.scene.body.domain;
  std::map<int, ThrownBody> bodies;
  for (std::size_t b = 0; b < situation.trajectories.size(); ++b) {
    const Trajectory& block = situation.trajectories[b];
    if (block.places.isEmpty() || !meets_block(tool, static_cast<int>(b), domain)) continue;
    ThrownBody& body = bodies[domain.blocks[b].body];
    body.names += (body.names.empty() ? "'" : ", '") + domain.cloud.block_names[b] + "'";
    body.cells.extend(block.cells);
    body.velocity = block.velocities.center();
    body.spacing = std::max(body.spacing, situation.spacings[b]);
  }
  return bodies;
}

}  // namespace

// A tool stops the layer of points that meets it within one step, and the energy of its motion along the normal is
// lost: measured of elastic bars of 4, 8, 16 and 32 layers, 0.250, 0.125, 0.063 and 0.031 of the kinetic energy; half
// of that with points at nodes. Of several bodies the nearest meets the tool.
std::string stopped_layers(const Situation& situation) {
  constexpr double worth_saying = 0.01;
  const Scene& scene = situation.scene;
  const std::vector<RigidTool> tools = tools_of(scene.conditions);
  if (scene.quasi_static) return "";
  std::string text;
  for (std::size_t n = 0; n < tools.size(); ++n) {
    const auto* half = std::get_if<HalfSpace>(&tools[n].shape);
    if (!half) continue;
    const Vector& normal = half->normal;
    const Vector on = half->point + tools[n].offset(situation.start);
    const double moment = first_moment * situation.duration;
    const Vector velocity = (tools[n].offset(situation.start + moment) - tools[n].offset(situation.start)) / moment;
    double nearest = std::numeric_limits<double>::infinity(), lost = 0;
    std::string names;
    for (const auto& [number, body] : bodies_that_meet(tools[n], situation)) {
      const Vector size = body.cells.sizes();
      const double reach = 0.5 * size.dot(normal.cwiseAbs());
      const double gap = normal.dot(body.cells.center() - on) - reach;
      const double closing = normal.dot(velocity - body.velocity);
      if (gap >= nearest) continue;
      nearest = gap, names = body.names, lost = 0;
      if (!(closing * situation.duration > gap) || body.velocity.norm() == 0) continue;
      const double part = closing * closing / body.velocity.squaredNorm() * body.spacing / (2 * reach);
      lost = situation.scene.body.domain.cloud.at == PointsAt::nodes ? 0.5 * part : part;
    }
    if (lost < worth_saying) continue;
    text += text_of(std::setprecision(2), "the tool '", scene.tools[n].name, "' stops the layer of points of ", names,
                    " that meets it at once: about ", 100 * lost,
                    " % of the kinetic energy is lost there (Tool_Work), and a rebound is slower; contact with another "
                    "body loses none\n");
  }
  return text;
}

}  // namespace strut
