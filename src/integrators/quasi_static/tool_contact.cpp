#include "integrators/quasi_static/tool_contact.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/serialize.hpp"

namespace strut {

namespace {

// ε in units of M s, the stiffness of a cube of the material as large as a spacing. A larger one would leave less
// penetration per round, but struts that begin to touch would jump on it: with 20 Newton's method stalled in a foam.
constexpr double penalty_factor = 1;

// Tangential penalty, relative to ε.
constexpr double tangential_fraction = 0.5;

// Rounds of the multipliers end when the penetration is this small, in spacings, and in parts of the compression of a
// cell by the largest pressure: a body that is strained by 1e-4 is pressed by less than 1e-4 of a spacing. The pressure
// of points that hardly touch is exact to round-off alone.
constexpr double most_penetration = 1e-4, most_of_compression = 1e-2, least_penetration = 1e-8;
constexpr double most_softness = 2e-2;  // drag minus multiplier of sticking points, over the largest friction

constexpr double just_touching = 1e-9;  // spacings

}  // namespace

ToolContact::ToolContact(std::vector<RigidTool> tools, const Body& body) : tools_(std::move(tools)) {
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    for (const int i : tools_[t].points) {
      contact_points_.push_back({.tool = static_cast<int>(t), .point = i, .spacing = body.domain.cloud.spacings[i]});
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
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      // By the stiffest integration point: one that has failed has no stiffness.
      for (int q = 0; q < block.points_per_cell(); ++q) {
        double& modulus = moduli[block.points[k]];
        modulus = std::max(modulus, block.moduli(block.index(k, q)).longitudinal());
      }
    }
  }
  for (ContactPoint& contact : contact_points_) {
    contact.start = body.current(contact.point);
    contact.penalty = penalty_factor * moduli[contact.point] * contact.spacing;
    contact.multiplier = contact.at_start.pressure;
    contact.tangential = contact.at_start.drag;
    contact.touched = contact.at_start.pressure > 0;
  }
}

void ToolContact::add_forces(const Body& body, Field& forces) {
  for (ContactPoint& contact : contact_points_) {
    const Vector place = body.current(contact.point);
    const RigidTool& tool = tools_[contact.tool];
    const Vector image = tool.nearest_image(body.domain, place - offsets_[contact.tool]);
    const Surface at = tool.met_by(contact.point, tool.shape, image);
    const Vector displacement = place - contact.start - travels_[contact.tool];
    press(at, displacement - displacement.dot(at.normal) * at.normal, contact);
    forces[contact.point] += contact.now.force;
  }
}

void ToolContact::press(const Surface& at, const Vector& sliding, ContactPoint& contact) const {
  const double e = contact.penalty;
  const Vector& n = at.normal;
  contact.gap = at.gap;
  const double pressure = std::max(0.0, contact.multiplier - e * at.gap);
  contact.now = {pressure, Vector::Zero(), pressure * n};
  contact.sticks = false, contact.stiffness.setZero();
  // A body that just lies on a tool is held by it.
  if (pressure == 0 && at.gap > just_touching * contact.spacing) return;
  contact.stiffness = e * n * n.transpose() - pressure * at.curvature;
  const double friction = tools_[contact.tool].friction;
  if (friction == 0 || pressure == 0) return;
  const double e_t = tangential_fraction * e;
  const Tensor along = Tensor::Identity() - n * n.transpose();
  const Vector trial = along * contact.tangential - e_t * sliding;
  const double length = trial.norm(), most = friction * pressure;
  if (length <= most) {
    contact.now.drag = trial, contact.sticks = true;
    contact.stiffness += e_t * along;
  } else {
    const Vector direction = trial / length;
    contact.now.drag = most * direction;
    contact.stiffness += most * e_t / length * (along - direction * direction.transpose());
    contact.stiffness += friction * e * direction * n.transpose();
  }
  contact.now.force += contact.now.drag;
}

void ToolContact::add_stiffness(const Field& field, Field& result) const {
  for (const ContactPoint& contact : contact_points_) result[contact.point] += contact.stiffness * field[contact.point];
}

void ToolContact::add_springs(std::vector<Tensor>& springs) const {
  for (const ContactPoint& contact : contact_points_) springs[contact.point] += contact.stiffness;
}

std::vector<double> ToolContact::largest_pressures(const SeparateParts& parts) const {
  std::vector<double> largest(parts.pieces(), 0);
  for (const ContactPoint& contact : contact_points_) {
    double& of_part = largest[parts.of(contact.point)];
    of_part = std::max(of_part, contact.now.pressure);
  }
  return largest;
}

double ToolContact::violation(const std::vector<double>& largest_pressures, const SeparateParts& parts) const {
  double largest = 0;
  for (const ContactPoint& contact : contact_points_) {
    if (contact.now.pressure == 0) continue;
    const double friction = tools_[contact.tool].friction,
                 largest_pressure = largest_pressures[parts.of(contact.point)];
    const double soft =
        contact.sticks ? (contact.now.drag - contact.tangential).norm() / (friction * largest_pressure) : 0;
    const double allowed = std::clamp(most_of_compression * largest_pressure / contact.penalty,
                                      least_penetration * contact.spacing, most_penetration * contact.spacing);
    largest = std::max({largest, std::abs(contact.gap) / allowed, soft / most_softness});
  }
  return largest;
}

std::pair<int, double> ToolContact::deepest() const {
  std::pair<int, double> found{-1, 0};
  for (const ContactPoint& contact : contact_points_) {
    if (-contact.gap > found.second) found = {contact.point, -contact.gap};
  }
  return found;
}

bool ToolContact::has_changed() {
  bool changed = false;
  for (ContactPoint& contact : contact_points_) {
    const bool touches = contact.stiffness.trace() > 0;
    changed = changed || touches != contact.touched;
    contact.touched = touches;
  }
  return changed;
}

void ToolContact::augment() {
  for (ContactPoint& contact : contact_points_)
    contact.multiplier = contact.now.pressure, contact.tangential = contact.now.drag;
}

void ToolContact::commit() {
  for (ContactPoint& contact : contact_points_) {
    contact.at_start = contact.now;
    if (contact.now.pressure > 0) *tools_[contact.tool].touched = true;
  }
}

void ToolContact::go_back() {
  for (ContactPoint& contact : contact_points_) contact.now = contact.at_start;
}

void ToolContact::add_reactions(std::vector<Vector>& by_condition) const {
  for (const ContactPoint& contact : contact_points_) {
    const int index = tools_[contact.tool].reaction_index;
    if (static_cast<std::size_t>(index) < by_condition.size()) by_condition[index] += contact.now.force;
  }
}

void ToolContact::serialize(Archive& archive, const Body& body) {
  std::size_t first = 0;  // first contact point of the tool
  for (std::size_t t = 0; t < tools_.size(); first += tools_[t].points.size(), ++t) {
    const auto traction = [this, first](std::size_t k) -> Traction& { return contact_points_[first + k].at_start; };
    archive.points("tool " + std::to_string(t), ids_of(body, tools_[t].points));
    archive.field("pressure", 1, [&](std::size_t k, int) -> double& { return traction(k).pressure; });
    archive.field("drag", 3, [&](std::size_t k, int c) -> double& { return traction(k).drag[c]; });
    archive.field("force", 3, [&](std::size_t k, int c) -> double& { return traction(k).force[c]; });
  }
  if (archive.loading()) go_back();
}

double ToolContact::work(const Body& body) const {
  double sum = 0;
  for (const ContactPoint& contact : contact_points_) {
    sum += 0.5 * (contact.at_start.force + contact.now.force).dot(body.current(contact.point) - contact.start);
  }
  return sum;
}

}  // namespace strut
