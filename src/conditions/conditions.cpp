#include "conditions/conditions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <span>
#include <string>

#include "base/errors.hpp"

namespace strut {

namespace {

Stage stage_of(const Condition& condition) {
  return std::visit([]<class Type>(const Type&) { return Type::stage; }, condition);
}

}  // namespace

void Conditions::add(Condition condition) {
  for (const Function& value : std::visit([](const auto& one) { return one.values_at_points(); }, condition))
    watch(value);
  const auto* tool = std::get_if<RigidTool>(&condition);
  const auto* motion = std::get_if<PrescribedMotion>(&condition);
  has_friction_ = has_friction_ || (tool && tool->friction > 0);
  has_motions_ = has_motions_ || (motion && !motion->points.empty());
  const auto later = [](const Condition& one, const Condition& other) { return stage_of(one) < stage_of(other); };
  in_order_.insert(std::upper_bound(in_order_.begin(), in_order_.end(), condition, later), std::move(condition));
}

void Conditions::watch(const Function& value) {
  if (!value.is_constant()) expressions_.push_back(value);
}

std::string Conditions::first_not_finite() const {
  for (const Function& value : expressions_) {
    if (const std::string text = value.first_not_finite(); !text.empty()) return text;
  }
  return "";
}

bool depend_on_time(const Conditions& conditions, Stage stage) {
  bool any = false;
  conditions.visit([&](const auto& one) {
    for (const Function& value : one.values_at_points()) any = any || (one.stage == stage && value.depends_on_time());
  });
  return any;
}

namespace {

// Collective. For each body the number of ranks with points that are not among these, and with points that are.
std::vector<std::array<double, 2>> ranks_without_and_with(const std::vector<int>& points, const Body& body) {
  std::vector<std::uint8_t> marks(body.owned(), 0);
  for (const int i : points) marks[i] = 1;
  std::vector<std::array<double, 2>> has(body.domain.body_count(), {0, 0});
  for (int i = 0; i < body.owned(); ++i) has[body.domain.body_of(i)][marks[i]] = 1;
  if (!has.empty()) body.domain.communicator.sum(std::span(has[0].data(), 2 * has.size()));
  return has;
}

bool are_whole(const std::vector<std::array<double, 2>>& has) {
  return std::ranges::none_of(has, [](const auto& one) { return one[0] > 0 && one[1] > 0; });
}

}  // namespace

std::pair<bool, std::vector<std::size_t>> extent_of(const Conditions& load, const Body& body) {
  std::pair<bool, std::vector<std::size_t>> found{true, {}};
  load.visit([&](const AddsForces auto& one) {
    const auto has = ranks_without_and_with(one.points, body);
    found.first = are_whole(has);
    for (std::size_t b = 0; b < body.blocks.size(); ++b) {
      if (has[body.domain.blocks[b].body][1] > 0) found.second.push_back(b);
    }
  });
  return found;
}

Conditions loads_on(const Conditions& loads, const MovingPoints& some) {
  Conditions parts;
  loads.visit([&](const AddsForces auto& one) { parts.add(one.on_some(some)); });
  return parts;
}

Conditions changing_on_parts(const Conditions& conditions, const Body& body) {
  Conditions changing;
  conditions.visit([&]<class T>(const T& one) {
    if constexpr (AddsForces<T> || std::same_as<T, PrescribedMotion>) {
      const std::vector<Function> values = one.values_at_points();
      if (std::ranges::any_of(values, &Function::depends_on_time) &&
          !are_whole(ranks_without_and_with(one.points, body)))
        changing.add(one);
    }
  });
  return changing;
}

std::vector<std::uint8_t> moved_within(const Conditions& changing, const Body& body, double t, double dt, int times) {
  std::vector<std::uint8_t> marks;
  if (changing.count() == 0) return marks;
  marks.assign(body.owned(), 0);
  for (int n = 1; n <= times; ++n) {
    const double part = dt / times, now = t + n * part;
    changing.visit([&](const AddsForces auto& one) {
      for (const Function& value : one.values_at_points()) {
        for (const int i : one.points) marks[i] |= value.evaluate(body.domain.reference(i), now) != 0 ? 1 : 0;
      }
    });
    changing.visit([&](const PrescribedMotion& one) {
      constexpr double round_off = 1e-9;  // of a slope of positions
      for (const int i : one.points) {
        const auto at = [&](double time) { return one.value.evaluate(body.domain.reference(i), time); };
        const double v = one.is_velocity ? at(now - 0.5 * part) : (at(now) - at(now - part)) / part;
        for (const int c : one.components)
          marks[i] |= std::abs(v - body.velocity[i][c]) > round_off * std::abs(v) ? 1 : 0;
      }
    });
  }
  return marks;
}

void add_forces(const Conditions& conditions, double t, double part, Body& body) {
  conditions.visit([&](const AddsForces auto& one) { one.add_forces(t, part, body); });
}

void add_work_of_forces(const Conditions& conditions, double t, double impulse_time, const Body& body,
                        ImpulseWork& work) {
  conditions.visit([&](const AddsForces auto& one) { one.add_work(t, impulse_time, body, work); });
}

void change_velocities(Conditions& conditions, double t, const PointTimeSteps& steps, Body& body, ImpulseWork& work,
                       ReactionImpulses& impulses) {
  VelocityUpdate update{t, steps, body, impulses};
  if (conditions.has_friction_beside_motions()) update.held.assign(body.owned(), 0);
  conditions.visit([&](ChangesVelocities auto& one) {
    update.ledger_entry = one.ledger_entry;
    update.reaction_index = one.reaction_index;
    one.change_velocities(update);
  });
  add_work(update, work);
}

Conditions in_substeps(const Conditions& conditions, const MovingPoints& moving) {
  Conditions some;
  conditions.visit([&](const ChangesVelocities auto& one) {
    if (auto part = one.in_substeps(moving)) some.add(std::move(*part));
  });
  return some;
}

std::vector<Vector> predicted_velocities(const Conditions& conditions, double t, double moment, const Body& body) {
  std::vector<Vector> velocities = body.velocity;
  conditions.visit([&](const PredictsVelocities auto& one) { one.predict_velocities(t, moment, body, velocities); });
  return velocities;
}

void check_equilibria_possible(const Conditions& conditions) {
  conditions.visit([](const SaysWhyNotInEquilibria auto& one) { throw Error(one.why_not_in_equilibria); });
}

std::vector<HeldDirection> held_directions(const Conditions& conditions, const Body& body, double t, double dt) {
  std::vector<HeldDirection> all;
  conditions.visit([&](const HoldsDirections auto& one) {
    const std::vector<HeldDirection> more = one.held_directions(body, t, dt);
    all.insert(all.end(), more.begin(), more.end());
  });
  return all;
}

double kinetic_energy_of_tools(const Conditions& conditions) {
  double sum = 0;
  for (const RigidTool& tool : tools_of(conditions)) sum += tool.free ? tool.free->kinetic_energy() : 0;
  return sum;
}

namespace {

template <class Work>
void for_each_tool(Conditions& conditions, const Work& work) {  // work(tool, its name in checkpoints)
  conditions.visit([&](RigidTool& tool) { work(tool, "tool_" + std::to_string(tool.reaction_index)); });
}

}  // namespace

void serialize_tools(Archive& archive, Conditions& conditions, int owned) {
  for_each_tool(conditions, [&](RigidTool& tool, const std::string& name) { tool.serialize(archive, name, owned); });
}

void serialize_reaches(Archive& archive, Conditions& conditions) {
  for_each_tool(conditions, [&](RigidTool& tool, const std::string& name) { tool.serialize_reaches(archive, name); });
}

void keep_reaches(const Conditions& before, Conditions& now) {
  const std::vector<RigidTool> held = tools_of(before);
  for_each_tool(now, [&](RigidTool& tool, const std::string&) {
    const auto is_same = [&](const RigidTool& one) { return one.reaction_index == tool.reaction_index; };
    const auto found = std::ranges::find_if(held, is_same);
    if (found != held.end()) tool.reaches = found->reaches;
  });
}

std::vector<RigidTool> tools_of(const Conditions& conditions) {
  std::vector<RigidTool> tools;
  conditions.visit([&](const RigidTool& tool) { tools.push_back(tool); });
  return tools;
}

}  // namespace strut
