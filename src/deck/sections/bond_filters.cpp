#include "deck/sections/bond_filters.hpp"

#include <array>
#include <cmath>

#include "deck/problems.hpp"
#include "deck/sections/tools.hpp"
#include "deck/values.hpp"

namespace strut::deck {

namespace {

const char* const name = "Bond Filters";

// A vector in the form of Peridigm's decks: a key for each component.
struct ComponentKeys {
  std::array<RealKey, 3> axes;

  ComponentKeys(const std::string& name, const std::string& unit, const std::string& meaning)
      : axes{key(name + "_X", unit, meaning), key(name + "_Y", unit, meaning), key(name + "_Z", unit, meaning)} {}

  Vector of(const Values& values) const { return {values[axes[0]], values[axes[1]], values[axes[2]]}; }

  // The vector scaled to unit length.
  Vector direction(const Values& values, Problems& problems) const {
    const Vector given = of(values);
    if (!given.isZero(0)) return unit_vector(given);
    if (values.has(axes[2])) problems.add(values.path_to(axes[0]), "the vector has no length; expected a direction");
    return Vector::UnitZ();
  }

 private:
  static RealKey key(const std::string& name, const std::string& unit, const std::string& meaning) {
    return RealKey({.name = name, .unit = unit, .meaning = meaning});
  }
};

const ComponentKeys normal("Normal", "", "Normal of the plane, of any length.");
const ComponentKeys corner("Lower_Left_Corner", "m", "Position of a corner.");
const ComponentKeys bottom("Bottom_Unit_Vector", "",
                           "Direction of the first edge from the corner; the other edge is along this × normal.");
const RealKey bottom_length(
    {.name = "Bottom_Length", .unit = "m", .range = positive, .meaning = "Length of the first edge."});
const RealKey side_length(
    {.name = "Side_Length", .unit = "m", .range = positive, .meaning = "Length of the other edge."});

const ComponentKeys center("Center", "m", "Center of the disk.");
const RealKey radius({.name = "Radius", .unit = "m", .range = positive, .meaning = "Radius of the disk."});

const TextKey shells({.name = "File Name",
                      .meaning = "Mesh of triangles and quadrilaterals (Exodus), relative to the deck's folder."});
const char* const of_shells = "Exodus Mesh";

std::vector<Key> keys_of(const std::vector<ComponentKeys>& vectors, const std::vector<Key>& others) {
  std::vector<Key> keys;
  for (const ComponentKeys& vector : vectors) keys.insert(keys.end(), vector.axes.begin(), vector.axes.end());
  keys.insert(keys.end(), others.begin(), others.end());
  return keys;
}

Crack read_rectangle(const Values& values, Problems& problems) {
  const Vector n = normal.direction(values, problems), along = bottom.direction(values, problems);
  if (std::abs(n.dot(along)) > 1e-6) {
    problems.add(values.path_to(bottom.axes[0]),
                 "is not at a right angle to the normal; expected an edge in the plane");
  }
  return RectangularCrack{corner.of(values), n, along, values[bottom_length], values[side_length]};
}

Crack read_disk(const Values& values, Problems& problems) {
  return DiskCrack{center.of(values), normal.direction(values, problems), values[radius]};
}

const std::vector<Case<Crack, Problems&>>& entries() {
  static const std::vector<Case<Crack, Problems&>> all = {
      {{.name = "Rectangular_Plane",
        .meaning = "A rectangle.",
        .keys = keys_of({normal, corner, bottom}, {bottom_length, side_length})},
       read_rectangle},
      {{.name = "Disk", .meaning = "A disk.", .keys = keys_of({normal, center}, {radius})}, read_disk},
      {{.name = of_shells,
        .meaning = "The surface of a mesh of shells; a quadrilateral is two triangles. Every bond looks at every "
                   "triangle.",
        .keys = {shells}},
       nullptr}};  // read_shell_filters
  return all;
}

}  // namespace

Section bond_filters_section() {
  return {.name = name,
          .meaning = "Initial cracks, which no bond crosses.",
          .sections = {with_cases({.name = any_name, .required = true, .meaning = "One crack."},
                                  {.name = "Type", .meaning = "Shape."}, schemas_of(entries()))}};
}

std::vector<Crack> read_bond_filters(const Values& discretization, Problems& problems) {
  std::vector<Crack> cracks;
  for (const Values& section : discretization.section(name).sections()) {
    const auto* entry = chosen_of(entries(), section);
    if (entry && entry->make) cracks.push_back(entry->make(section, problems));
  }
  return cracks;
}

std::vector<std::filesystem::path> read_shell_filters(const Values& discretization,
                                                      const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const Values& section : discretization.section(name).sections()) {
    if (section.chosen() == of_shells) files.push_back(folder / section[shells]);
  }
  return files;
}

}  // namespace strut::deck
