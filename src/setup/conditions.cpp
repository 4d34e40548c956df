#include "setup/conditions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/errors.hpp"
#include "base/math/function.hpp"
#include "base/parallel/communicator.hpp"
#include "base/text.hpp"
#include "setup/contradictions.hpp"
#include "setup/found_points.hpp"
#include "setup/open_ends.hpp"
#include "setup/periods.hpp"
#include "setup/sudden_motion.hpp"
#include "topology/point_group.hpp"

namespace strut {

namespace {

// This rank's points of a node set, a block, or all; the name has been checked.
std::vector<int> points_of(const PointCloud& cloud, const std::string& set) {
  return PointGroup(cloud, set, "Node Set").points(cloud);
}

// The time of the body as it was read, and that at which the conditions begin, s.
struct Times {
  double mesh = 0, begin = 0;
};

// Collective. Adds a problem for each value of `conditions` (indices) that is no number somewhere at the time t, s.
void check_values(const deck::Deck& deck, const std::vector<int>& conditions, const PointsOfConditions& points,
                  double t, const Body& body, deck::Problems& problems) {
  std::vector<Function> values;
  PointsOfConditions wrong;
  for (const int c : conditions) {
    const auto values_of = [](const auto& prototype) { return prototype.values_at_points(); };
    for (const Function& value : std::visit(values_of, deck.conditions[c].kind)) {
      const auto is_number = [&](int i) { return std::isfinite(value.evaluate(body.domain.reference(i), t)); };
      values.push_back(value), wrong.push_back(points[c]);
      std::erase_if(wrong.back(), is_number);
    }
  }
  const std::vector<FoundPoints> found = found_points(body, wrong);
  for (std::size_t n = 0; n < values.size(); ++n) {
    const Vector& X = found[n].one;
    if (found[n].count > 0) problems.add(values[n].describe(X[0], X[1], X[2], t, values[n].evaluate(X, t)));
  }
}

// The mirrors of the bodies that a tool may meet.
std::vector<Mirror> mirrors_of(const RigidTool& tool, const Domain& domain) {
  std::vector<double> meets(domain.body_count(), 0);
  for (const int i : tool.points) meets[domain.body_of(i)] = 1;
  domain.communicator.max(meets);
  std::vector<Mirror> mirrors = domain.mirrors;
  std::erase_if(mirrors, [&](const Mirror& one) { return meets[one.body] == 0; });
  return mirrors;
}

// A tool that has held the body since the mesh was read, as in earlier equilibria, keeps its initial reaches.
void set_reaches(RigidTool& tool, const Times& times, const Body& body) {
  if (!tool.free || times.mesh == times.begin) return tool.set_reaches(times.mesh, body, BodyAt::mesh);
  tool.set_reaches(times.begin, body, BodyAt::present);
}

// For bodies that an Initial Displacement has moved out of a tool: at the positions of the mesh they may overlap it.
void set_reaches_from_here(double t, Scene& scene) {
  scene.conditions.visit([&](RigidTool& tool) { tool.set_reaches(t, scene.body, BodyAt::present); });
}

template <ConditionType Type>
void put(const Type& prototype, const std::string& name, std::vector<int> points, int index, const Times& times,
         Scene& scene) {
  Type condition = prototype.on(std::move(points), index, scene.body);
  if constexpr (std::is_same_v<Type, RigidTool>) {
    join_images(scene.body.domain.periods, condition.shape);
    if (condition.free) {
      condition.free->time = times.begin;  // it rests until then
      condition.free->keep_between(mirrors_of(condition, scene.body.domain), condition.shape);
    }
    set_reaches(condition, times, scene.body);
    scene.tools.push_back({name, condition.touched});
  }
  scene.conditions.add(std::move(condition));
}

void put(const ActsOnce auto& prototype, const std::string&, const std::vector<int>& points, int, const Times& times,
         Scene& scene) {
  prototype.set_initial_state(points, times.begin, scene.body);
}

void put(const PrescribedTemperature& prototype, const std::string&, const std::vector<int>& points, int,
         const Times& times, Scene& scene) {
  prototype.set_initial_state(points, times.begin, scene.body);
  scene.conditions.watch(prototype.value);
}

// If other conditions hold points of a plane in directions not orthogonal to its normal, the plane pushes these points
// in the directions that are left free: a separate condition for each such direction.
void put(const SymmetryPlane& prototype, std::vector<int> points, int index, const SharedPoints& shared, Scene& scene) {
  SymmetryPlane whole = prototype.on(std::move(points), index, scene.body);
  std::vector<SymmetryPlane> parts;
  const auto add_to_part = [&](int i, const Vector& push) {
    const auto same = [&](const SymmetryPlane& one) { return *one.push == push; };
    auto part = std::find_if(parts.begin(), parts.end(), same);
    if (part == parts.end()) {
      part = parts.insert(part, whole);
      part->points.clear(), part->push = push;
    }
    part->points.push_back(i);
  };
  std::erase_if(whole.points, [&](int i) {
    const auto found = shared.find(i);
    if (found == shared.end()) return false;
    const Vector push = push_of_plane(found->second, index);
    if (!push.isZero(0)) add_to_part(i, push);
    return true;
  });
  scene.conditions.add(std::move(whole));
  for (SymmetryPlane& part : parts) scene.conditions.add(std::move(part));
}

bool needs_inertia(const deck::Condition& condition) {
  const auto* tool = std::get_if<RigidTool>(&condition.kind);
  const auto impossible = []<class Type>(const Type&) { return Type::in_equilibria == InEquilibria::impossible; };
  return (tool && tool->free) || std::visit(impossible, condition.kind);
}

// Takes the initial displacement out of a plane, along its normal or in the directions that other conditions leave
// free.
void put_back(const SymmetryPlane& plane, const std::vector<int>& points, int index, const SharedPoints& shared,
              Body& body) {
  for (const int i : points) {
    const auto found = shared.find(i);
    const Vector push = found == shared.end() ? plane.normal : push_of_plane(found->second, index);
    const Vector back = plane.normal.dot(body.displacement(i)) * push;
    body.domain.sites[i].current.head<3>() -= back.array();
  }
}

// Moves held points to the displacement that their condition prescribes at the initial time, and points of symmetry
// planes back onto their plane.
void put_back_held(const deck::Deck& deck, const PointsOfConditions& points, const SharedPoints& shared, Body& body) {
  for (std::size_t c = 0; c < points.size(); ++c) {
    const auto* motion = std::get_if<PrescribedMotion>(&deck.conditions[c].kind);
    if (!motion || motion->is_velocity) continue;
    InitialDisplacement{motion->components, motion->value}.set_initial_state(points[c], deck.solver.initial_time, body);
  }
  for (std::size_t c = 0; c < points.size(); ++c) {
    const auto* plane = std::get_if<SymmetryPlane>(&deck.conditions[c].kind);
    if (plane) put_back(*plane, points[c], static_cast<int>(c), shared, body);
  }
}

bool is_initial_displacement(const deck::Condition& condition) {
  return std::holds_alternative<InitialDisplacement>(condition.kind);
}

// Checks the explicit steps after equilibria: their errors and warnings come before equilibria, which may take hours.
// Adds their non-reflecting ends to `ends`.
std::string check_next_steps(const deck::Deck& deck, const PointsOfConditions& points, const Body& body,
                             Conditions& ends, deck::Problems& problems) {
  deck::Deck next = deck;
  next.solver = *deck.next_solver;
  std::vector<int> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  check_values(deck, all, points, next.solver.initial_time, body, problems);
  for (const int c : all) {
    const auto* end = std::get_if<NonReflectingEnd>(&deck.conditions[c].kind);
    if (end) ends.add(end->on(points[c], c, body));
  }
  check_open_ends(next, ends, body, problems);
  check_poles(next, points, body, problems);
  return sudden_motions(next, points, body) + sampled_pulses(next, points, body);
}

// A body that rests or flies, and is heated from now on, expands. On all ranks alike, whoever has its heated points.
void end_rigid_motion_of_heated(Body& body) {
  if (body.heated.empty()) return;
  const std::vector<BlockHorizons>& blocks = body.domain.blocks;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (body.blocks[b].material.thermal_expansion == 0) continue;
    for (std::size_t other = 0; other < blocks.size(); ++other) {
      if (blocks[other].body == blocks[b].body) body.blocks[other].in_rigid_motion = false;
    }
  }
}

// Warns if explicit steps continue another run at other temperatures: the change of thermal strain acts at once.
std::string sudden_expansion(const deck::Deck& deck, Body& body) {
  constexpr double round_off = 1e-9;
  const double most = body.domain.communicator.max(sudden_expansion(body, deck.solver.initial_time));
  if (most <= round_off || deck.solver.quasi_static) return "";
  return text_of(
      "WARNING: temperatures at the initial time are not those of the checkpoint: in the first step points expand "
      "by up to ",
      most, ", which sends waves through the bodies (Boundary Conditions, 'Prescribed Temperature')\n");
}

// `index`: index of the condition in the deck.
void add_condition(const deck::Condition& condition, int index, std::vector<int> points, const SharedPoints& shared,
                   const Times& times, Scene& scene) {
  const auto add = [&]<class Type>(const Type& prototype) {
    if constexpr (std::is_same_v<Type, SymmetryPlane>) {
      put(prototype, std::move(points), index, shared, scene);
    } else {
      put(prototype, condition.name, std::move(points), index, times, scene);
    }
  };
  std::visit(add, condition.kind);
}

}  // namespace

void check_conditions(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator,
                      deck::Problems& problems) {
  const auto path = [](const deck::Condition& one) { return "Boundary Conditions > " + one.name + " > Node Set"; };
  std::vector<const deck::Condition*> known;
  std::vector<double> counts;
  for (const deck::Condition& condition : deck.conditions) {
    try {
      const PointGroup group(cloud, condition.node_set, path(condition));
      counts.push_back(static_cast<double>(group.points(cloud).size()));
      known.push_back(&condition);
    } catch (const Error& error) {
      problems.add(error.what());
    }
  }
  communicator.sum(counts);
  for (std::size_t c = 0; c < counts.size(); ++c) {
    const std::string& set = known[c]->node_set;  // an error in its expression may have been reported
    if (counts[c] > 0 || problems.about("Node Sets > " + set) || problems.about("Boundary Conditions > " + set))
      continue;
    problems.add(path(*known[c]), "'" + set + "' holds no point");
  }
}

void add_conditions(const deck::Deck& deck, double mesh_time, Scene& scene, const Communicator& communicator) {
  const Times times{mesh_time, deck.solver.initial_time};
  deck::Problems problems;
  if (scene.dropped.points > 0) check_conditions(deck, scene.body.domain.cloud, communicator, problems);  // again
  PointsOfConditions points;
  for (const deck::Condition& one : deck.conditions) points.push_back(points_of(scene.body.domain.cloud, one.node_set));
  scene.warnings += let_the_last_count(deck, scene.body, points);
  check_contradictions(deck, points, scene.body, problems);
  check_poles(deck, points, scene.body, problems);
  const bool displaces = std::ranges::any_of(deck.conditions, is_initial_displacement);
  if (!deck.start_from && !displaces) scene.warnings += check_initial_displacements(deck, points, scene.body, problems);
  if (mesh_time == deck.solver.initial_time) {  // else these warnings came before the equilibria
    scene.warnings += sudden_motions(deck, points, scene.body) + sampled_pulses(deck, points, scene.body) +
                      values_between_load_steps(deck, points, scene.body) +
                      temperatures_without_effect(deck, scene.body, points);
  }
  // Held points: for a body that continues behind a plane as its mirror image, only the points on the plane.
  for (std::size_t c = 0; c < points.size(); ++c) {
    const auto* plane = std::get_if<SymmetryPlane>(&deck.conditions[c].kind);
    if (plane) points[c] = plane->on(std::move(points[c]), static_cast<int>(c), scene.body).points;
  }
  std::vector<int> begun;
  for (int index = 0; index < static_cast<int>(deck.conditions.size()); ++index) {
    const bool begins_with_steps = deck.next_solver && needs_inertia(deck.conditions[index]);
    if (!begins_with_steps) begun.push_back(index);
  }
  check_values(deck, begun, points, times.begin, scene.body, problems);
  raise_together(communicator, problems.text(deck.file.string()));
  const SharedPoints shared = shared_points(deck, points);
  for (const int index : begun) add_condition(deck.conditions[index], index, points[index], shared, times, scene);
  set_reference_temperatures(scene.body, times.mesh);  // points have not expanded in the mesh
  if (displaces) {
    if (!deck.start_from)
      scene.warnings += check_initial_displacements(deck, points, scene.body, problems, MayRest::yes);
    put_back_held(deck, points, shared, scene.body);
    scene.body.domain.halo.exchange_positions(scene.body.domain.sites);
  }
  raise_together(communicator, problems.text(deck.file.string()));
  if (displaces && mesh_time == deck.solver.initial_time) set_reaches_from_here(mesh_time, scene);
  check_open_ends(deck, scene.conditions, scene.body, problems);
  Conditions ends;
  if (deck.next_solver) scene.warnings += check_next_steps(deck, points, scene.body, ends, problems);
  raise_together(communicator, problems.text(deck.file.string()));
  // Equilibria before the steps have the same loads. For steps after equilibria it is done.
  if (mesh_time == deck.solver.initial_time) {
    take_off_what_is_beyond_ends(deck.next_solver ? ends : scene.conditions, scene.body);
  }
}

void begin_from_here(const deck::Deck& deck, const Continued& continued, const std::function<bool(int)>& knows_reaches,
                     Scene& scene, const Communicator& communicator) {
  const double t = deck.solver.initial_time;
  deck::Problems problems;
  PointsOfConditions points;
  for (const deck::Condition& one : deck.conditions) {
    points.push_back(points_of(scene.body.domain.cloud, one.node_set));
    const auto* initial = std::get_if<InitialVelocity>(&one.kind);
    if (initial && !continued.velocities && !deck.next_solver) initial->set_initial_state(points.back(), t, scene.body);
  }
  set_reference_temperatures(scene.body, t);  // of those that were not heated before
  if (!continued.steps || !continued.conditions) end_rigid_motion_of_heated(scene.body);
  scene.warnings += sudden_expansion(deck, scene.body);
  // Where all goes on, a point that is not where its condition has it was pushed aside: a later condition wins.
  if (!continued.steps || !continued.conditions)
    scene.warnings += check_initial_displacements(deck, points, scene.body, problems);
  raise_together(communicator, problems.text(deck.file.string()));
  auto of_scene = scene.tools.begin();
  scene.conditions.visit([&](RigidTool& tool) {
    of_scene->is_resumed = knows_reaches(tool.reaction_index);
    if (!of_scene++->is_resumed) tool.set_reaches(t, scene.body, BodyAt::present);
  });
}

}  // namespace strut
