#include "deck/sections/tools.hpp"

#include "base/numbers.hpp"
#include "deck/problems.hpp"

namespace strut::deck {

namespace {

const RealKey friction(
    {.name = "Friction Coefficient", .range = not_negative, .fallback = "0", .meaning = "Coulomb friction."});

OptionalKey<Function> travel_along(const std::string& axis) {
  return OptionalKey<Function>({.name = "Travel " + axis,
                                .unit = "m",
                                .meaning = "Displacement along " + axis + " as a function of the time t (s)."});
}
const std::array<OptionalKey<Function>, 3> travel = {travel_along("X"), travel_along("Y"), travel_along("Z")};

const OptionalKey<double> mass(
    {.name = "Mass",
     .unit = "kg",
     .range = positive,
     .meaning =
         "The tool moves freely under contact forces, without turning. Without this key it moves as Travel says. "
         "With symmetry planes: of the computed part."});

RealKey speed_along(const std::string& axis) {
  return RealKey({.name = "Speed " + axis,
                  .unit = "m/s",
                  .fallback = "0",
                  .meaning = "Initial velocity along " + axis + " of a tool with a Mass."});
}
const std::array<RealKey, 3> speed = {speed_along("X"), speed_along("Y"), speed_along("Z")};

OptionalKey<Function> force_along(const std::string& axis) {
  return OptionalKey<Function>(
      {.name = "Force " + axis,
       .unit = "N",
       .meaning = "Force on a tool with a Mass along " + axis + " as a function of the time t (s)."});
}
const std::array<OptionalKey<Function>, 3> force = {force_along("X"), force_along("Y"), force_along("Z")};

// The section of a tool: the keys of its shape, and those of all tools.
Section tool(Section section) {
  section.keys.push_back(friction);
  section.keys.insert(section.keys.end(), travel.begin(), travel.end());
  section.keys.push_back(mass);
  section.keys.insert(section.keys.end(), speed.begin(), speed.end());
  section.keys.insert(section.keys.end(), force.begin(), force.end());
  return section;
}

// A function of the time alone, if it is given.
std::optional<Function> of_time(const OptionalKey<Function>& key, const Values& values, Problems& problems) {
  std::optional<Function> function = values[key];
  if (function && function->depends_on_position()) {
    problems.add(
        values.path_to(key),
        "'" + function->text() + "' depends on x, y or z; expected a number or an expression in t, in " + key.unit);
  }
  return function;
}

std::shared_ptr<FreeMotion> read_free_motion(const Values& values, Problems& problems) {
  FreeMotion free{.mass = values[mass].value_or(0)};
  const auto check = [&](const Key& key, bool has_a_mass) {
    if (!values.given(key) || has_a_mass == values[mass].has_value()) return;
    problems.add(values.path_to(key), has_a_mass ? "is of a tool with a Mass; expected the key Mass, too"
                                                 : "is of a tool without a Mass; expected Speed or Force");
  };
  for (int c = 0; c < 3; ++c) {
    free.velocity[c] = values[speed[c]];
    free.force[c] = of_time(force[c], values, problems);
    check(speed[c], true), check(force[c], true), check(travel[c], false);
  }
  return values[mass] ? std::make_shared<FreeMotion>(std::move(free)) : nullptr;
}

RigidTool read_tool(Shape shape, const Values& values, Problems& problems) {
  RigidTool tool{.shape = std::move(shape), .friction = values[friction]};
  for (int c = 0; c < 3; ++c) tool.travel[c] = of_time(travel[c], values, problems);
  tool.free = read_free_motion(values, problems);
  return tool;
}

const VectorKey point_on_plane({.name = "Point", .unit = "m", .meaning = "A point of the plane."});
const VectorKey normal({.name = "Normal", .meaning = "Normal, of any length."});

Section plane(const std::string& type, const std::string& meaning) {
  return {.name = type, .meaning = meaning, .keys = {point_on_plane, normal}};
}

const VectorKey point_on_axis({.name = "Point", .unit = "m", .meaning = "A point of the axis."});
const VectorKey axis({.name = "Axis", .meaning = "Direction of the axis, of any length."});
const RealKey radius({.name = "Radius", .unit = "m", .range = positive, .meaning = "Radius."});

const VectorKey lower({.name = "Lower Corner", .unit = "m", .meaning = "Smallest x, y, z."});
const VectorKey upper({.name = "Upper Corner", .unit = "m", .meaning = "Largest x, y, z."});

void check_corners(const Values& values, Problems& problems) {
  if (!values.has(upper) || !values.has(lower)) return;
  const Vector low = values[lower], high = values[upper];
  if ((low.array() < high.array()).all()) return;
  const auto text = [](const Vector& v) { return to_text(v[0]) + " " + to_text(v[1]) + " " + to_text(v[2]); };
  problems.add(values.path_to(upper),
               "'" + text(high) + "'; expected > Lower Corner (" + text(low) + ") in each component, in m");
}

}  // namespace

std::vector<Case<ConditionPrototype, Problems&>> planes_and_tools() {
  return {
      {plane(
           "Symmetry Plane",
           "A body that ends at the plane continues behind it as its mirror image. The node set has all points at the "
           "plane and no others: elements with a face on it, or nodes. Points of `all` or of a block keep their "
           "distance to the plane (plane strain); so do those of any other set, with a warning. Contact does not see "
           "mirror images."),
       [](const Values& values, Problems& problems) -> ConditionPrototype {
         return SymmetryPlane{.normal = read_direction(values, normal, problems), .point = values[point_on_plane]};
       }},
      {tool(plane("Rigid Plane", "Wall: bodies stay on the side that the normal points to.")),
       [](const Values& values, Problems& problems) -> ConditionPrototype {
         const HalfSpace half{values[point_on_plane], read_direction(values, normal, problems)};
         return read_tool(half, values, problems);
       }},
      {tool({.name = "Rigid Cylinder",
             .meaning = "Cylinder without ends: bodies stay outside.",
             .keys = {point_on_axis, axis, radius}}),
       [](const Values& values, Problems& problems) -> ConditionPrototype {
         const Cylinder roll{values[point_on_axis], read_direction(values, axis, problems), values[radius]};
         return read_tool(roll, values, problems);
       }},
      {tool({.name = "Rigid Box",
             .meaning = "Box with sharp edges along the axes: bodies stay outside. One as long as the period of "
                        "Periodic Sides has no ends.",
             .keys = {lower, upper}}),
       [](const Values& values, Problems& problems) -> ConditionPrototype {
         const RigidTool block = read_tool(Box{values[lower], values[upper]}, values, problems);
         check_corners(values, problems);
         return block;
       }}};
}

// Scaled by the largest component, because the squares of 1e-300 and 1e300 underflow and overflow.
Vector unit_vector(const Vector& direction) {
  const double largest = direction.cwiseAbs().maxCoeff();
  return largest > 0 ? Vector((direction / largest).normalized()) : direction;
}

Vector read_direction(const Values& values, const VectorKey& key, Problems& problems) {
  const Vector direction = values[key];
  if (values.has(key) && direction.isZero(0)) problems.add(values.path_to(key), "is zero; expected a direction");
  return unit_vector(direction);
}

}  // namespace strut::deck
