#include "setup/conditions.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "setup/finite_value.hpp"

namespace strut {

namespace {

// The points of this rank in a node set, a block, or all; none where there is no such set.
std::vector<int> points_of(const PointCloud& cloud, const std::string& set) {
  const auto position = [&set](const std::vector<std::string>& names) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), set) - names.begin());
  };
  const std::size_t bit = position(cloud.set_names), block = position(cloud.block_names);
  std::vector<int> points;
  for (int i = 0; i < static_cast<int>(cloud.size()); ++i) {
    const bool in = set == "all" || (bit < cloud.set_names.size() ? (cloud.sets[i] >> bit & 1) != 0
                                                                  : cloud.blocks[i] == static_cast<int>(block));
    if (in) points.push_back(i);
  }
  return points;
}

void set_initial_velocity(const deck::Condition& condition, const std::vector<int>& points, double t, Body& body) {
  for (const int i : points) {
    body.velocity[i][condition.component] = finite_value(condition.value, body.domain.reference(i), t);
  }
}

Shape shape_of(const deck::Condition& condition) {
  switch (condition.type) {
    case deck::ConditionType::rigid_cylinder:
      return Cylinder{condition.point, condition.axis.normalized(), condition.radius};
    case deck::ConditionType::rigid_box:
      return Box{condition.lower, condition.upper};
    default:
      return HalfSpace{condition.point, condition.normal.normalized()};
  }
}

// `place`: of the condition in the deck.
void add_condition(const deck::Condition& condition, int place, double t, Scene& scene) {
  std::vector<int> points = points_of(scene.body.domain.cloud, condition.node_set);
  for (const int i : points) finite_value(condition.value, scene.body.domain.reference(i), t);
  Conditions& all = scene.conditions;
  const Vector normal = condition.normal.normalized();
  switch (condition.type) {
    case deck::ConditionType::initial_velocity:
      return set_initial_velocity(condition, points, t, scene.body);
    case deck::ConditionType::prescribed_displacement:
    case deck::ConditionType::prescribed_velocity: {
      const bool is_velocity = condition.type == deck::ConditionType::prescribed_velocity;
      return all.add(PrescribedMotion{std::move(points), condition.component, condition.value, is_velocity, place});
    }
    case deck::ConditionType::body_force:
      return all.add(BodyForce{std::move(points), condition.component, condition.value});
    case deck::ConditionType::symmetry_plane:
      return all.add(SymmetryPlane{std::move(points), normal, place});
    case deck::ConditionType::rigid_plane:
    case deck::ConditionType::rigid_cylinder:
    case deck::ConditionType::rigid_box:
      return all.add(RigidTool{std::move(points), shape_of(condition), condition.travel, condition.friction, place});
    case deck::ConditionType::open_end:
      return all.add(non_reflecting_end(points, normal, scene.body));
  }
}

}  // namespace

void check_conditions(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator,
                      deck::Problems& problems) {
  std::vector<std::string> valid{"all"};
  valid.insert(valid.end(), cloud.set_names.begin(), cloud.set_names.end());
  valid.insert(valid.end(), cloud.block_names.begin(), cloud.block_names.end());
  std::vector<double> counts;
  for (const deck::Condition& condition : deck.conditions) {
    counts.push_back(static_cast<double>(points_of(cloud, condition.node_set).size()));
  }
  communicator.sum(counts);
  for (std::size_t c = 0; c < counts.size(); ++c) {
    const std::string& set = deck.conditions[c].node_set;
    const std::string path = "Boundary Conditions > " + deck.conditions[c].name + " > Node Set";
    if (std::find(valid.begin(), valid.end(), set) == valid.end()) {
      problems.add(path, "there is no node set or block '" + set + "'" + did_you_mean(set, valid) + "; there are " +
                             joined(valid));
    } else if (counts[c] == 0) {
      problems.add(path, "'" + set + "' holds no point");
    }
  }
}

void add_conditions(const deck::Deck& deck, Scene& scene, const Communicator& communicator) {
  deck::Problems problems;
  if (scene.dropped > 0) check_conditions(deck, scene.body.domain.cloud, communicator, problems);  // once more
  for (int place = 0; place < static_cast<int>(deck.conditions.size()); ++place) {
    const deck::Condition& condition = deck.conditions[place];
    try {
      add_condition(condition, place, deck.solver.initial_time, scene);
    } catch (const Error& error) {
      problems.add("Boundary Conditions > " + condition.name + " > Value", error.what());
    }
  }
  raise_together(communicator, problems.text(deck.file.string()));
}

}  // namespace strut
