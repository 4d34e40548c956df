#include "deck/sections/discretization.hpp"

#include <fstream>

#include "deck/problems.hpp"
#include "deck/sections/bond_filters.hpp"
#include "deck/sections/several_sections.hpp"
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
