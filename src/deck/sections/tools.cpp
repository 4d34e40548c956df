#include "deck/sections/tools.hpp"

#include "deck/numbers.hpp"
#include "deck/problems.hpp"
#include "deck/values.hpp"

namespace strut::deck {

namespace {

const RealKey friction(
    {.name = "Friction Coefficient", .range = not_negative, .fallback = "0", .meaning = "Coulomb's."});

OptionalKey<Function> travel_along(const std::string& axis) {
  return OptionalKey<Function>({.name = "Travel " + axis,
                                .unit = "m",
                                .meaning = "How far it has gone along " + axis +
                                           " at the time t (s), from where the other keys put it. Without: nowhere."});
}
const std::array<OptionalKey<Function>, 3> travel = {travel_along("X"), travel_along("Y"), travel_along("Z")};

const OptionalKey<double> mass({.name = "Mass",
                                .unit = "kg",
                                .range = positive,
                                .meaning = "It flies, and what it pushes pushes back; it does not turn. Without: it "
                                           "travels as given, whatever force that takes."});

RealKey speed_along(const std::string& axis) {
  return RealKey({.name = "Speed " + axis,
                  .unit = "m/s",
                  .fallback = "0",
                  .meaning = "At the initial time, along " + axis + ", of a tool with a Mass."});
}
const std::array<RealKey, 3> speed = {speed_along("X"), speed_along("Y"), speed_along("Z")};

OptionalKey<Function> force_along(const std::string& axis) {
  return OptionalKey<Function>({.name = "Force " + axis,
                                .unit = "N",
                                .meaning = "That drives a tool with a Mass along " + axis + ", at the time t (s)."});
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
  if (function && function->depends_on_place()) {
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

const VectorKey point_on_plane({.name = "Point", .unit = "m", .meaning = "On the plane."});
const VectorKey normal({.name = "Normal", .meaning = "Of any length but zero."});

Section plane(const std::string& type, const std::string& meaning) {
  return {.name = type, .meaning = meaning, .keys = {point_on_plane, normal}};
}

const VectorKey point_on_axis({.name = "Point", .unit = "m", .meaning = "On the axis."});
const VectorKey axis({.name = "Axis", .meaning = "Its direction, of any length but zero."});
const RealKey radius({.name = "Radius", .unit = "m", .range = positive, .meaning = "Of the roll."});

const VectorKey lower({.name = "Lower Corner", .unit = "m", .meaning = "The smallest x, y, z."});
const VectorKey upper({.name = "Upper Corner",
                       .unit = "m",
                       .meaning = "The largest x, y, z, each larger than that of the lower corner."});

void check_corners(const Values& values, Problems& problems) {
  if (!values.has(upper) || !values.has(lower)) return;
  const Vector low = values[lower], high = values[upper];
  if ((low.array() < high.array()).all()) return;
  const auto text = [](const Vector& v) { return to_text(v[0]) + " " + to_text(v[1]) + " " + to_text(v[2]); };
  problems.add(values.path_to(upper),
               "'" + text(high) + "'; expected > Lower Corner (" + text(low) + ") in each component, in m");
}

}  // namespace

Section symmetry_plane_section() {
  return plane("Symmetry Plane",
               "A body that ends at the plane goes on behind it as its mirror image: a half, or a quarter between two "
               "planes, is the whole. The node set has all points at the plane and no others: elements with a face on "
               "it, or nodes. Points of `all` or of a block keep their distance to the plane (plane strain), and so do "
               "those of a set that is none of these, of which a warning tells. Contact does not see mirror images.");
}

ConditionPrototype read_symmetry_plane(const Values& values, Problems& problems) {
  return SymmetryPlane{.normal = read_direction(values, normal, problems), .point = values[point_on_plane]};
}

Section rigid_plane_section() {
  return tool(plane("Rigid Plane", "A wall: bodies stay on the side the normal points to."));
}

ConditionPrototype read_rigid_plane(const Values& values, Problems& problems) {
  return read_tool(HalfSpace{values[point_on_plane], read_direction(values, normal, problems)}, values, problems);
}

Section rigid_cylinder_section() {
  return tool({.name = "Rigid Cylinder",
               .meaning = "A roll without ends: bodies stay outside.",
               .keys = {point_on_axis, axis, radius}});
}

ConditionPrototype read_rigid_cylinder(const Values& values, Problems& problems) {
  const Cylinder roll{values[point_on_axis], read_direction(values, axis, problems), values[radius]};
  return read_tool(roll, values, problems);
}

Section rigid_box_section() {
  return tool({.name = "Rigid Box",
               .meaning = "A solid block with faces across the axes and sharp edges: bodies stay outside.",
               .keys = {lower, upper}});
}

ConditionPrototype read_rigid_box(const Values& values, Problems& problems) {
  const RigidTool block = read_tool(Box{values[lower], values[upper]}, values, problems);
  check_corners(values, problems);
  return block;
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
