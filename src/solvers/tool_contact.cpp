#include "solvers/tool_contact.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/keep.hpp"

namespace strut {

namespace {

// ε in units of M s, the stiffness of a cube of the material as large as a spacing: a round leaves about 1/(1 + 20) of
// the penetration, and GMRES does not notice, for the preconditioner knows ε.
constexpr double penalty_factor = 20;

// Of ε, along the surface: a stiffer one would let Newton's iterations jump between sticking and sliding.
constexpr double tangential_share = 0.2;

constexpr double most_penetration = 1e-4;  // spacings
constexpr double most_lag = 5e-3;          // of the largest pressure, of multipliers behind pressures, for friction
constexpr double most_softness = 2e-2;     // of the largest friction, of multipliers behind it where a point sticks

constexpr double just_touching = 1e-9;  // spacings

}  // namespace

ToolContact::ToolContact(std::vector<Tool> tools, const Body& body) : tools_(std::move(tools)) {
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    for (const int i : tools_[t].points) {
      grips_.push_back({.tool = static_cast<int>(t), .point = i, .spacing = body.domain.cloud.spacings[i]});
    }
  }
  offsets_.resize(tools_.size(), Vector::Zero());
  travels_ = offsets_;
}

void ToolContact::begin(const Body& body, double t, double dt) {
  for (std::size_t n = 0; n < tools_.size(); ++n) {
    offsets_[n] = tools_[n].offset(t + dt);
    travels_[n] = offsets_[n] - tools_[n].offset(t);
  }
  std::vector<double> moduli(body.owned(), 0);
  for (const MaterialBlock& block : body.blocks) {
    for (std::size_t k = 0; k < block.points.size(); ++k) moduli[block.points[k]] = block.moduli(k).longitudinal();
  }
  for (Grip& grip : grips_) {
    grip.start = body.current(grip.point);
    grip.penalty = penalty_factor * moduli[grip.point] * grip.spacing;
    grip.multiplier = grip.at_start.pressure;
    grip.tangential = grip.at_start.drag;
    grip.touched = grip.at_start.pressure > 0;
  }
}

void ToolContact::add_forces(const Body& body, Field& forces) {
  for (Grip& grip : grips_) {
    const Vector place = body.current(grip.point);
    const Surface at = surface(tools_[grip.tool].shape, place - offsets_[grip.tool]);
    const Vector way = place - grip.start - travels_[grip.tool];
    press(at, way - way.dot(at.normal) * at.normal, grip);
    forces[grip.point] += grip.now.force;
  }
}

void ToolContact::press(const Surface& at, const Vector& sliding, Grip& grip) const {
  const double e = grip.penalty;
  const Vector& n = at.normal;
  grip.gap = at.gap;
  const double pressure = std::max(0.0, grip.multiplier - e * at.gap);
  grip.now = {pressure, Vector::Zero(), pressure * n};
  grip.sticks = false, grip.stiffness.setZero();
  // A body that just lies on a tool is held by it.
  if (pressure == 0 && at.gap > just_touching * grip.spacing) return;
  grip.stiffness = e * n * n.transpose() - pressure * at.curvature;
  const double friction = tools_[grip.tool].friction;
  if (friction == 0 || pressure == 0) return;
  const double e_t = tangential_share * e;
  const Tensor along = Tensor::Identity() - n * n.transpose();
  const Vector trial = along * grip.tangential - e_t * sliding;
  const double length = trial.norm(), most = friction * grip.multiplier;
  if (length <= most) {
    grip.now.drag = trial, grip.sticks = true;
    grip.stiffness += e_t * along;
  } else {
    const Vector direction = trial / length;
    grip.now.drag = most * direction;
    grip.stiffness += most * e_t / length * (along - direction * direction.transpose());
  }
  grip.now.force += grip.now.drag;
}

void ToolContact::add_stiffness(const Field& field, Field& result) const {
  for (const Grip& grip : grips_) result[grip.point] += grip.stiffness * field[grip.point];
}

void ToolContact::add_springs(std::vector<Tensor>& springs) const {
  for (const Grip& grip : grips_) springs[grip.point] += grip.stiffness;
}

double ToolContact::largest_pressure() const {
  double largest = 0;
  for (const Grip& grip : grips_) largest = std::max(largest, grip.now.pressure);
  return largest;
}

double ToolContact::violation(double largest_pressure) const {
  double largest = 0;
  for (const Grip& grip : grips_) {
    if (grip.now.pressure == 0) continue;
    const double friction = tools_[grip.tool].friction;
    const double lag = friction > 0 ? std::abs(grip.now.pressure - grip.multiplier) / largest_pressure : 0;
    const double soft = grip.sticks ? (grip.now.drag - grip.tangential).norm() / (friction * largest_pressure) : 0;
    largest = std::max(
        {largest, std::abs(grip.gap) / (most_penetration * grip.spacing), soft / most_softness, lag / most_lag});
  }
  return largest;
}

bool ToolContact::has_changed() {
  bool changed = false;
  for (Grip& grip : grips_) {
    const bool touches = grip.stiffness.trace() > 0;
    changed = changed || touches != grip.touched;
    grip.touched = touches;
  }
  return changed;
}

void ToolContact::augment() {
  for (Grip& grip : grips_) grip.multiplier = grip.now.pressure, grip.tangential = grip.now.drag;
}

void ToolContact::commit() {
  for (Grip& grip : grips_) grip.at_start = grip.now;
}

void ToolContact::go_back() {
  for (Grip& grip : grips_) grip.now = grip.at_start;
}

void ToolContact::add_reactions(std::vector<Vector>& by_condition) const {
  for (const Grip& grip : grips_) {
    const int condition = tools_[grip.tool].condition;
    if (static_cast<std::size_t>(condition) < by_condition.size()) by_condition[condition] += grip.now.force;
  }
}

void ToolContact::keep(Archive& archive, const Body& body) {
  std::size_t first = 0;  // of the tool's grips
  for (std::size_t t = 0; t < tools_.size(); first += tools_[t].points.size(), ++t) {
    const auto traction = [this, first](std::size_t k) -> Traction& { return grips_[first + k].at_start; };
    archive.points("tool " + std::to_string(t), ids_of(body, tools_[t].points));
    archive.field("pressure", 1, [&](std::size_t k, int) -> double& { return traction(k).pressure; });
    archive.field("drag", 3, [&](std::size_t k, int c) -> double& { return traction(k).drag[c]; });
    archive.field("force", 3, [&](std::size_t k, int c) -> double& { return traction(k).force[c]; });
  }
  if (archive.restores()) go_back();
}

double ToolContact::work(const Body& body) const {
  double sum = 0;
  for (const Grip& grip : grips_) {
    sum += 0.5 * (grip.at_start.force + grip.now.force).dot(body.current(grip.point) - grip.start);
  }
  return sum;
}

}  // namespace strut
