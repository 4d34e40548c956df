#include "deck/sections/conditions.hpp"

#include "base/numbers.hpp"
#include "deck/problems.hpp"
#include "deck/sections/node_sets.hpp"
#include "deck/sections/tools.hpp"
#include "deck/values.hpp"

namespace strut::deck {

namespace {

const TextKey node_set({.name = "Node Set",
                        .fallback = "all",
                        .meaning = "A node set of the mesh or of Node Sets, a block's name, or `all`."});

const AxesKey components({.name = "Coordinate", .meaning = "Axes, in any order, each with the same value."});
// Each case sets its unit.
const ExpressionKey value({.name = "Value",
                           .meaning = "Function of the reference position x, y, z (m) and the time t (s)."});

Section along_axes(const std::string& type, const std::string& unit, const std::string& meaning) {
  Key of_unit = value;
  of_unit.unit = unit;
  return {.name = type, .meaning = meaning, .keys = {components, of_unit}};
}

template <class Type>
ConditionPrototype read_along_axes(const Values& values, Problems&) {
  return Type{.components = values[components], .value = values[value]};
}

ConditionPrototype read_temperature(const Values& values, Problems&) {
  return PrescribedTemperature{.value = values[value]};
}

Section prescribed_temperature() {
  Key of_unit = value;
  of_unit.unit = "K";
  return {.name = "Prescribed Temperature",
          .meaning =
              "Temperature T at every time, for materials with a Thermal Expansion Coefficient. Where several overlap, "
              "the last one counts.",
          .keys = {of_unit}};
}

template <bool is_velocity>
ConditionPrototype read_prescribed_motion(const Values& values, Problems&) {
  return PrescribedMotion{.components = values[components], .value = values[value], .is_velocity = is_velocity};
}

const VectorKey end_normal({.name = "Normal", .meaning = "Normal of the surface, of any length."});

Section non_reflecting_end() {
  return {.name = "Non-Reflecting End",
          .meaning =
              "Waves leave through the node set, one layer of points, as if the body continued: traction ρ c v with "
              "the initial speeds of longitudinal and shear waves. Ends may meet at edges and corners.",
          .keys = {end_normal}};
}

ConditionPrototype read_non_reflecting_end(const Values& values, Problems& problems) {
  return NonReflectingEnd{.normal = read_direction(values, end_normal, problems)};
}

const RealKey lower_side({.name = "Lower", .unit = "m", .meaning = "Where the lower side is along the axis."});
const RealKey upper_side({.name = "Upper", .unit = "m", .meaning = "Where the upper side is, one period above."});
const ExpressionKey stretch(
    {.name = "Stretch",
     .unit = "1",
     .fallback = "1",
     .meaning = "The distance of the sides at the time t (s) over that of the mesh; its work is external."});

Section periodic_sides() {
  return {.name = "Periodic Sides",
          .meaning =
              "Behind each side all bodies, contact and rigid tools continue with their images one period away. "
              "Elements end at both sides. The reaction is the force through the section along the axis, tension "
              "positive.",
          .keys = {components, lower_side, upper_side, stretch}};
}

ConditionPrototype read_periodic_sides(const Values& values, Problems& problems) {
  PeriodicSides sides{.lower = values[lower_side], .upper = values[upper_side], .stretch = values[stretch]};
  const std::vector<int> axes = values[components];
  if (!axes.empty()) sides.axis = axes.front();
  if (axes.size() > 1) problems.add(values.path_to(components), "has several axes; expected one: x, y or z");
  if (!(sides.upper > sides.lower) && values.has(upper_side) && values.has(lower_side)) {
    problems.add(values.path_to(upper_side),
                 "'" + to_text(sides.upper) + "'; expected > Lower (" + to_text(sides.lower) + "), in m");
  }
  if (sides.stretch.depends_on_position()) {
    problems.add(values.path_to(stretch),
                 "'" + sides.stretch.text() + "' depends on x, y or z; expected a number or an expression in t");
  }
  const std::string set = values[node_set];
  if (set != "all")
    problems.add(values.path_to(node_set), "'" + set + "'; expected all: sides are those of all bodies");
  return sides;
}

std::vector<Case<ConditionPrototype, Problems&>> all_entries() {
  std::vector<Case<ConditionPrototype, Problems&>> all = {
      {along_axes("Initial Velocity", "m/s", "Velocity at the initial time."), read_along_axes<InitialVelocity>},
      {along_axes(
           "Initial Displacement", "m",
           "Displacement at the initial time where nothing holds the points, which begin strained. Only in bodies "
           "of 'Elastic', whose forces follow from positions alone."),
       read_along_axes<InitialDisplacement>},
      {along_axes("Prescribed Displacement", "m",
                  "Displacement at every time; with Verlet it must be 0 at the initial time."),
       read_prescribed_motion<false>},
      {along_axes("Prescribed Velocity", "m/s",
                  "Velocity at every time; with QuasiStatic, its integral over each load step."),
       read_prescribed_motion<true>},
      {along_axes("Body Force", "N/m³", "Force per reference volume. Several at a point add up."),
       read_along_axes<BodyForce>},
      {prescribed_temperature(), read_temperature},
  };
  for (auto& one : planes_and_tools()) all.push_back(std::move(one));
  all.push_back({non_reflecting_end(), read_non_reflecting_end});
  all.push_back({periodic_sides(), read_periodic_sides});
  return all;
}

const std::vector<Case<ConditionPrototype, Problems&>>& entries() {
  static const auto all = all_entries();
  return all;
}

Condition read_condition(const Values& values, Problems& problems) {
  Condition condition;
  condition.name = values.name();
  condition.node_set = values[node_set];
  if (const auto* entry = chosen_of(entries(), values)) condition.kind = entry->make(values, problems);
  return condition;
}

}  // namespace

Section conditions_section() {
  const std::string no_temperature = "no heat flows here";
  Key type = {
      .name = "Type",
      .meaning = "Kind.",
      .hints = {{"Initial Temperature", "write it as Blocks > Initial Temperature"}, {"Thermal Flux", no_temperature}}};
  Section one = {.name = any_name, .meaning = "One condition.", .keys = {node_set}};
  return {.name = boundary_conditions,
          .meaning =
              "Conditions on points, initial conditions included. Two that prescribe the motion of a point along axes "
              "that are not perpendicular must agree.",
          .any_key = numbered_set(),
          .sections = {with_cases(std::move(one), std::move(type), schemas_of(entries()))}};
}

std::vector<Condition> read_conditions(const Values& deck, Problems& problems) {
  std::vector<Condition> all;
  for (const Values& section : deck.section(boundary_conditions).sections()) {
    all.push_back(read_condition(section, problems));
  }
  return all;
}

}  // namespace strut::deck
