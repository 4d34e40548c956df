#include "conditions/rigid_tool.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "base/parallel/reproducible_sum.hpp"
#include "conditions/impulse_work.hpp"
#include "conditions/velocity_update.hpp"
#include "mechanics/body.hpp"
#include "topology/cloud.hpp"
#include "topology/mirror.hpp"

namespace strut {

Vector sum_of_points(const Body& body, const std::vector<Vector>& values) {
  Vector sum;
  for (int c = 0; c < 3; ++c) {
    sum[c] = reproducible_sum(body.domain.communicator, static_cast<int>(values.size()),
                              [&](int i) { return values[i][c]; });
  }
  return sum;
}

void FreeMotion::advance(double t, double dt, const Body& body) {
  Vector load = Vector::Zero();
  for (int c = 0; c < 3; ++c) {
    if (force[c]) load[c] = (*force[c])(0, 0, 0, t);
  }
  if (begun) offset = offset_at(t);
  begun = true;  // half an impulse first: the initial velocity is that of the initial time
  before = velocity, time = t;
  mid_steps.before = step / (step + dt);
  force_impulse = 0.5 * (step + dt) * load;
  pending_sum = sum_of_points(body, pending);
  pending.assign(pending.size(), Vector::Zero());
  velocity += free_directions * (force_impulse - pending_sum) / mass;
  step = dt;
}

void FreeMotion::push_back(const Vector& impulse, const Body& body, ImpulseWork& work) {
  velocity = before + free_directions * (force_impulse - pending_sum - impulse) / mass;
  if (body.domain.communicator.rank() != 0) return;  // only once
  work.before.tools -= 0.5 * (impulse + pending_sum).dot(before);
  work.after.tools -= 0.5 * (impulse + pending_sum).dot(velocity);
  work.before.external += 0.5 * force_impulse.dot(before);
  work.after.external += 0.5 * force_impulse.dot(velocity);
}

void FreeMotion::keep_between(const std::vector<Mirror>& mirrors, const Shape& shape) {
  for (const Mirror& mirror : mirrors) {
    bool is_asked = std::abs(mirror.normal.dot(velocity)) > digits_of_decks * velocity.norm();
    for (int c = 0; c < 3; ++c) {
      const bool is_pushed = force[c] && !(force[c]->is_constant() && (*force[c])(0, 0, 0, 0) == 0);
      is_asked = is_asked || (is_pushed && std::abs(mirror.normal[c]) > digits_of_decks);
    }
    const Vector across = free_directions * mirror.normal;
    if (is_asked || across.norm() < digits_of_decks || !is_own_image(shape, mirror.on, mirror.normal)) continue;
    free_directions -= across * across.transpose() / across.squaredNorm();
  }
}

void FreeMotion::serialize(Archive& archive, const std::string& name, int owned) {
  for (int c = 0; c < 3; ++c) {
    const std::string axis = name + "_" + "xyz"[c];
    archive.number(axis + "_velocity", velocity[c]);
    archive.number(axis + "_before", before[c]);
    archive.number(axis + "_offset", offset[c]);
  }
  archive.number(name + "_time", time);
  archive.number(name + "_step", step);
  archive.number(name + "_begun", begun);
  pending.resize(owned, Vector::Zero());
  archive.field(name + "_pending", 3, [this](std::size_t i, int c) -> double& { return pending[i][c]; });
}

namespace {

// Position of a tool, and its velocity over the steps of its points, which differ by their time-step level.
class ToolMotion {
 public:
  struct Step {
    double dt;        // s
    Vector velocity;  // m/s
  };

  ToolMotion(const RigidTool& tool, double t, const PointTimeSteps& steps)
      : tool_(tool), t_(t), steps_(steps), offset_(tool.offset(t)) {}

  const Vector& offset() const { return offset_; }
  const Step& step(int level) {
    while (static_cast<int>(by_level_.size()) <= level) {
      const double dt = std::ldexp(steps_.whole, -static_cast<int>(by_level_.size()));
      by_level_.push_back({dt, (after(dt) - offset_) / dt});
    }
    return by_level_[level];
  }

 private:
  Vector after(double dt) const {
    if (tool_.free) return tool_.offset(t_ + dt);
    Vector sum = Vector::Zero();
    for (int c = 0; c < 3; ++c) {
      if (!tool_.travel[c]) continue;
      const auto travel = [&](double time) { return steps_.value(*tool_.travel[c], Vector::Zero(), time); };
      sum[c] = steps_.after(travel, t_, dt);
    }
    return sum;
  }

  const RigidTool& tool_;
  double t_;
  const PointTimeSteps& steps_;
  Vector offset_;
  std::vector<Step> by_level_;
};

// A position on an edge of a box is on several faces, to round-off. The face that it approaches fastest stops it: a
// punch whose edges coincide with the body's carries these edges along, whatever the round-off of positions.
template <class S>
void choose_face(const S&, const Vector&, const Vector&, Surface&) {}
void choose_face(const Box& box, const Vector& place, const Vector& velocity, Surface& at) {
  const Vector outside = (box.lower - place).cwiseMax(place - box.upper);  // distance from the faces across each axis
  const double round_off = 1e-9 * (box.upper - box.lower).minCoeff(), nearest = outside.maxCoeff();
  if (nearest > round_off) return;
  double slowest = std::numeric_limits<double>::infinity();
  for (int c = 0; c < 3; ++c) {
    const Vector n = (box.lower[c] - place[c] == outside[c] ? -1 : 1) * Vector::Unit(c);
    if (outside[c] < nearest - round_off || n.dot(velocity) >= slowest) continue;
    slowest = n.dot(velocity);
    at.normal = n;
  }
}

// The change of velocity that keeps a point with this velocity relative to the tool outside over dt (s). Friction
// leaves the `held` components to the conditions that prescribe them (VelocityUpdate).
Vector correction(const Surface& at, double friction, const Vector& velocity, double dt, std::uint8_t held) {
  const double speed = at.normal.dot(velocity);
  const double allowed = -at.gap / dt;  // the point lands on the surface; a point inside comes back
  const Vector push = (allowed - speed) * at.normal;
  if (friction == 0) return push;
  const Vector sliding = velocity - speed * at.normal;
  const double length = sliding.norm();
  const double friction_change = friction * std::abs(allowed - speed);
  Vector rub = friction_change < length ? Vector(-friction_change / length * sliding) : Vector(-sliding);
  for (int c = 0; c < 3; ++c) {
    if (held >> c & 1) rub[c] = 0;
  }
  return push + rub;
}

// Calls visit(i, change of velocity) for the points of this rank that would enter the tool.
template <class Visit>
void for_each_change(const RigidTool& tool, const VelocityUpdate& update, const Visit& visit) {
  ToolMotion motion(tool, update.t, update.steps);
  const Domain& domain = update.body.domain;
  const bool has_images = !domain.periods.empty();
  const auto keep_out = [&](const auto& shape) {
    for (const int i : tool.points) {
      const auto& [dt, velocity] = motion.step(update.steps.level(i));
      Vector place = domain.current(i) - motion.offset();
      if (has_images) place = tool.nearest_image(domain, place);
      const Vector relative = update.body.velocity[i] - velocity;
      Surface at = tool.met_by(i, shape, place);
      choose_face(shape, place, relative, at);
      if (at.gap + dt * at.normal.dot(relative) >= 0) continue;
      *tool.touched = true;
      visit(i, correction(at, tool.friction, relative, dt, update.held.empty() ? 0 : update.held[i]));
    }
  };
  std::visit(keep_out, tool.shape);
}

// Impulse that the tool would give to the points of all ranks, N s, and their mass, kg.
struct Push {
  Vector impulse = Vector::Zero();
  double mass = 0;
};

Push trial_push(const RigidTool& tool, const VelocityUpdate& update) {
  const Body& body = update.body;
  std::vector<Vector> impulses(body.owned(), Vector::Zero());
  double any = 0;
  for_each_change(tool, update, [&](int i, const Vector& change) { impulses[i] = body.mass(i) * change, any = 1; });
  if (body.domain.communicator.max(any) == 0) return {};
  const auto touched = [&](int i) { return impulses[i].isZero(0) ? 0.0 : body.mass(i); };
  return {sum_of_points(body, impulses), reproducible_sum(body.domain.communicator, body.owned(), touched)};
}

constexpr int most_trials = 20;
constexpr double accuracy = 1e-12;  // of the tool's velocity: the rest changes positions by less than round-off

}  // namespace

std::vector<Function> RigidTool::values_at_points() const {
  std::vector<Function> all;
  for (const std::optional<Function>& one : free ? free->force : travel) {
    if (one) all.push_back(*one);
  }
  return all;
}

Vector RigidTool::offset(double t) const {
  if (free) return free->offset_at(t);
  Vector sum = Vector::Zero();
  for (int c = 0; c < 3; ++c) {
    if (travel[c]) sum[c] = (*travel[c])(0, 0, 0, t);
  }
  return sum;
}

Vector RigidTool::nearest_image(const Domain& domain, Vector place) const {
  for (const Period& period : domain.periods) {
    const Vector step = domain.halo.stretch()[period.axis] * period.length * Vector::Unit(period.axis);
    place += steps_to(shape, place, step) * step;
  }
  return place;
}

void RigidTool::set_reaches(double t, const Body& body, BodyAt from) {
  const Domain& domain = body.domain;
  if (domain.cloud.at == PointsAt::nodes) return;
  auto all = std::make_shared<std::vector<double>>(body.owned(), 0);
  for (const int i : points) {
    const Vector place = from == BodyAt::mesh ? domain.reference(i) : body.current(i);
    const Surface at = surface(shape, nearest_image(domain, place - offset(t)));
    const double reach = reach_of_cell(domain.cloud, domain.volume(i), i, -at.normal);
    (*all)[i] = std::clamp(at.gap, 0.0, reach);
  }
  reaches = std::move(all);
}

void RigidTool::serialize_reaches(Archive& archive, const std::string& name) {
  if (reaches) archive.field(name + "_reach", 1, [this](std::size_t i, int) -> double& { return (*reaches)[i]; });
}

void RigidTool::serialize(Archive& archive, const std::string& name, int owned) {
  serialize_reaches(archive, name);
  if (free) free->serialize(archive, name, owned);
}

// The velocity V of the tool and the impulse J(V) that it gives to the points depend on each other: V = V* − J(V)/M.
// Newton's method, with the mass of the pushed points as the slope of J.
void RigidTool::fly(VelocityUpdate& update) {
  free->advance(update.t, update.steps.whole, update.body);
  const Vector without = free->velocity;
  for (int k = 0; k < most_trials; ++k) {
    const Push push = trial_push(*this, update);
    const Vector left = without - free->free_directions * push.impulse / free->mass - free->velocity;
    if (left.norm() <= accuracy * std::max(without.norm(), push.impulse.norm() / free->mass)) break;
    free->velocity += left / (1 + push.mass / free->mass);
  }
}

void RigidTool::change_velocities(VelocityUpdate& update) {
  if (free && in_whole_steps) fly(update);
  std::vector<Vector> given(free ? update.body.owned() : 0, Vector::Zero());
  for_each_change(*this, update, [&](int i, const Vector& change) {
    update.body.velocity[i] += change;
    update.record(i, change);
    if (free) given[i] = update.body.mass(i) * change;
  });
  if (!free) return;
  if (in_whole_steps) return free->push_back(sum_of_points(update.body, given), update.body, update.of_tools);
  free->pending.resize(given.size(), Vector::Zero());
  for (std::size_t i = 0; i < given.size(); ++i) free->pending[i] += given[i];
}

std::optional<RigidTool> RigidTool::in_substeps(const MovingPoints& moving) const {
  return RigidTool{moving.among(points), shape, travel, friction, reaction_index, free, false, reaches, touched};
}

}  // namespace strut
