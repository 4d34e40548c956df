#include "output/observables.hpp"

namespace strut {

namespace {

const char* const introduction = R"(# Output variables

Generated from `src/output/observables.cpp` and the fields that are declared as output variables (`src/mechanics/body.hpp`, `materials/state_variables.hpp`); do not edit by hand. SI units throughout.

Each is a field of the points that the section `Output` of a deck can write (`Output Variables`). With `Max_` or `Min_`
in front it is a column that the section `History` can write: the extreme over all points, or with the name of a node
set or block, `Max_Displacement(foot)`, over its points. 3 components are x, y, z; 6 are xx, yy, zz, xy, yz, zx; 9 are a
tensor row by row. An extreme of several components is that of the root of the sum of their squares; one of them is named as
in `Max_Displacement_Z` and `Min_Cauchy_Stress_ZZ`. `Mean_` is the mean over the same points, weighted by their reference
volumes: `Mean_Displacement_Z(top)`. Where the brackets name a section of `History` > `Profiles`, there is a column for each of
its layers, `Mean_Velocity_Z(slices 1)`, ….

Besides, the history knows `Contact_Force_X(foam:plate)`, `_Y` and `_Z`, the force of contact on the block `foam` from the
block `plate`, with friction (N), and `Reaction_X(wall)`, `Reaction_Y(wall)` and `Reaction_Z(wall)`, the force of the condition `wall`
on the body (N). Both are means from the row before to this one, so that each times its interval is an impulse and all of them together
the change of momentum; the first row has 0. With `Instant_` in front, `Instant_Reaction_Z(wall)`, they are those of the one step at the
row's time. Of equilibria all are those of the row's time. Of a crack that the section `History` > `Cracks` names there are `Crack_Tip(notch)`, how far it has come along its
direction (m), and `Crack_Speed(notch)`, the slope of that over the last rows (m/s).

X and y are the reference and the current position of a point, F is its deformation gradient; other symbols are those of
the [glossary](../docs/glossary.md). A state variable is there where a material of the deck has a law with it: `Failed` of
metal foams alone, say; by quadratic correspondence it is the mean over the cell.

| variable | components | in the Exodus file | meaning, with its unit |
|---|---|---|---|
)";

// Escapes text for a cell of a table.
std::string escaped(const std::string& text) {
  std::string escaped;
  for (const char one : text) {
    if (one == '|') escaped += '\\';
    escaped += one;
  }
  return escaped;
}

}  // namespace

std::string observables_page() {
  std::string text = introduction;
  for (const Observable& o : observables_of_all_laws()) {
    text += "| `" + o.name + "` | " + std::to_string(o.components) + " | " + (o.nodal ? "nodal" : "element") + " | " +
            escaped(o.meaning + (o.unit.empty() || o.unit == "1" ? "" : ", " + o.unit)) + " |\n";
  }
  return text;
}

}  // namespace strut
