#include "deck/sections/discretization.hpp"

#include <cmath>
#include <fstream>

#include "deck/problems.hpp"
#include "deck/sections/several_sections.hpp"
#include "deck/sections/tools.hpp"
#include "deck/values.hpp"

namespace strut::deck {

namespace {

namespace fs = std::filesystem;

const char* const name = "Discretization";

// The name of Peridigm's built-in grid.
const char* const generator = "TensorProduct3DMeshGenerator";

struct AxisKeys {
  RealKey origin, length;
  IntegerKey points;

  explicit AxisKeys(const std::string& axis)
      : origin({.name = axis + " Origin", .unit = "m", .meaning = "Lower end of the grid."}),
        length({.name = axis + " Length", .unit = "m", .range = positive, .meaning = "Length of the grid."}),
        points({.name = "Number Points " + axis, .range = {.low = 1}, .meaning = "Number of cells."}) {}
};
const std::array<AxisKeys, 3> axes = {AxisKeys("X"), AxisKeys("Y"), AxisKeys("Z")};

Section grid_section() {
  std::vector<Key> keys = {
      {.name = "Type", .kind = Kind::choice, .choices = {"PdQuickGrid"}, .meaning = "The only choice."}};
  for (const AxisKeys& axis : axes) keys.insert(keys.end(), {axis.origin, axis.length, axis.points});
  return {.name = generator,
          .meaning = "Grid of equal cells with a point in the center of each, x fastest; the block block_1.",
          .keys = std::move(keys)};
}

bool are_boxes(const Values& values) {
  const auto* kind = std::get_if<std::string>(values.value("NeighborhoodType"));
  return kind && *kind == "Box";
}

Grid read_grid(const Values& values, bool boxes) {
  Grid grid{.boxes = boxes};
  for (int c = 0; c < 3; ++c) {
    grid.origin[c] = values[axes[c].origin];
    grid.length[c] = values[axes[c].length];
    grid.points[c] = values[axes[c].points];
  }
  return grid;
}

const ChoiceKey<MeshType> type(
    {.name = "Type",
     .meaning = "Format of the mesh file (`Text File`: a list of points), Peridigm's built-in grid, without a file, or "
                "`Memory`: the mesh that a script in Python hands over."},
    {{"Exodus", MeshType::exodus},
     {"Text File", MeshType::text},
     {"PdQuickGrid", MeshType::grid},
     {"Memory", MeshType::memory}});

const OptionalKey<std::string> mesh_file(
    {.name = "Input Mesh File", .meaning = "Path relative to the deck's folder. Required for Exodus and Text File."});

const Key neighborhood = {
    .name = "NeighborhoodType",
    .kind = Kind::choice,
    .choices = {"Spherical", "Box"},
    .meaning =
        "Required for PdQuickGrid. Spherical: neighbors are the points within the horizon; Box: "
        "those in a box of cells, as long along each axis as the horizon, rounded (Peridigm's default)."};

const ChoiceKey<Points> points(
    {.name = "Points",
     .fallback = "Elements",
     .meaning = "Position of the points: centroids of the elements, or nodes (hexahedra and tetrahedra), each with its "
                "part of the elements around it. Nodes represent faces and edges of the body exactly."},
    {{"Elements", Points::elements}, {"Nodes", Points::nodes}});

const ChoiceKey<Influence> influence(
    {.name = "Influence Function",
     .fallback = "One",
     .meaning = "ω(r) with r = |ξ|/δ, ξ the bond and δ the horizon: 1, 1 − r, or 1 − 3r² + 2r³."},
    {{"One", Influence::one}, {"Linear Decay", Influence::linear_decay}, {"Cubic Decay", Influence::cubic_decay}});

const ChoiceKey<DegeneratePoints> degenerate(
    {.name = "Degenerate Points",
     .fallback = "Error",
     .meaning = "Points whose neighbors are too few, or coplanar, for a deformation gradient. `Drop` removes them, and "
                "pieces that they alone connect, up to 1 % of all points, `Drop Any` any number. `Keep` leaves points "
                "of 'Elastic' without neighbors as masses that loads and contact move (as do Peridigm's decks without "
                "this key); others are an error."},
    {{"Error", DegeneratePoints::error},
     {"Drop", DegeneratePoints::drop},
     {"Drop Any", DegeneratePoints::drop_any},
     {"Keep", DegeneratePoints::keep}});

// ---- Bond Filters: initial cracks -----------------------------------------------------------------------------------

const char* const filters = "Bond Filters";

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

Section bond_filters_section() {
  return {.name = filters,
          .meaning = "Initial cracks, which no bond crosses.",
          .sections = {with_cases({.name = any_name, .required = true, .meaning = "One crack."},
                                  {.name = "Type", .meaning = "Shape."}, schemas_of(entries()))}};
}

std::vector<Crack> read_bond_filters(const Values& discretization, Problems& problems) {
  std::vector<Crack> cracks;
  for (const Values& section : discretization.section(filters).sections()) {
    const auto* entry = chosen_of(entries(), section);
    if (entry && entry->make) cracks.push_back(entry->make(section, problems));
  }
  return cracks;
}

// The meshes of shells, as paths from the deck's folder.
std::vector<fs::path> read_shell_filters(const Values& discretization, const fs::path& folder) {
  std::vector<fs::path> files;
  for (const Values& section : discretization.section(filters).sections()) {
    if (section.chosen() == of_shells) files.push_back(folder / section[shells]);
  }
  return files;
}

// ---------------------------------------------------------------------------------------------------------------------

// Checks the keys that each type of discretization needs, and those that it cannot have.
void check_source(const Values& values, Problems& problems) {
  if (!values.has(type)) return;
  const auto report = [&](const std::string& name, const std::string& what) {
    problems.add(path_to(values.path(), name), what);
  };
  const bool grid = values[type] == MeshType::grid, memory = values[type] == MeshType::memory;
  if (!grid && !memory && !values.given(mesh_file)) report(mesh_file.name, "missing; expected a text (type string)");
  if (grid && values.given(mesh_file))
    report(mesh_file.name, "unknown key for Type 'PdQuickGrid', which reads no file");
  if (memory && values.given(mesh_file)) report(mesh_file.name, "unknown key for Type 'Memory', which reads no file");
  if (grid && !values.has_section(generator)) report(generator, "missing section (the only grid that is known here)");
  if (!grid && values.has_section(generator)) report(generator, "unknown section; it belongs to Type 'PdQuickGrid'");
  if (!grid && are_boxes(values))
    report(neighborhood.name, "'Box'; expected 'Spherical': only Type 'PdQuickGrid' has boxes of cells");
  if (grid && !values.given(neighborhood)) {
    report(neighborhood.name, "missing; expected 'Spherical', or 'Box' for what Peridigm takes without this key");
  }
}

}  // namespace

Section discretization_section() {
  return {.name = name,
          .required = true,
          .meaning = "The material points and their neighborhoods.",
          .keys = {type, mesh_file, neighborhood, verbose_without_effect(),
                   without_effect({.name = "Store Exodus Mesh", .kind = Kind::boolean, .fallback = "false"},
                                  "the mesh is not kept"),
                   points, influence, degenerate},
          .sections = {grid_section(), bond_filters_section()},
          .hints = {{"Horizon", "unknown key; it belongs to the sections of Blocks"},
                    {"Trial Reads", "unknown key; leave it out: no file is read by a forked process any more"}}};
}

Discretization read_discretization(const Values& deck, const fs::path& deck_file, Problems& problems) {
  const Values& values = deck.section(name);
  const bool is_text = values[type] == MeshType::text;
  if ((is_text || values[type] == MeshType::grid) && values[points] == Points::nodes) {
    problems.add(values.path_to(points),
                 std::string("'Nodes'; a ") +
                     (is_text ? "text file has points" : "PdQuickGrid has the centers of cells") +
                     " only: expected 'Elements' (nodes have Exodus meshes of hexahedra or "
                     "tetrahedra)");
  }
  check_source(values, problems);
  const auto mesh = values[mesh_file];
  return {.type = values[type],
          .mesh = mesh ? deck_file.parent_path() / *mesh : fs::path(),
          .grid = read_grid(values.section(generator), are_boxes(values)),
          .points = values[points],
          .influence = values[influence],
          .degenerate = values[degenerate],
          .cracks = read_bond_filters(values, problems),
          .shells = read_shell_filters(values, deck_file.parent_path())};
}

void check_mesh(const fs::path& mesh, Problems& problems) {
  const std::string ending = mesh.extension().string();
  const bool of_others = ending == ".msh" || ending == ".vtk" || ending == ".vtu";
  const bool there = fs::exists(mesh);
  if (mesh.empty() || (!of_others && fs::is_regular_file(mesh) && std::ifstream(mesh))) return;
  const fs::path recipe = fs::path(mesh).replace_extension(".recipe");
  std::string what =
      "'" + mesh.string() +
      (!there      ? "' does not exist"
       : of_others ? "' is a mesh of another program, of which tools/tetrahedra makes one that can be read"
                   : "' is not a file that can be read");
  if (!there && fs::exists(recipe)) what += " (tools/run makes it from " + recipe.string() + ")";
  problems.add(path_to(name, mesh_file.name), what + "; expected a mesh, its path relative to the deck's folder");
}

}  // namespace strut::deck
