#include "output/observables.hpp"

namespace strut {

namespace {

const char* const introduction = R"(# Output variables

Generated from `src/output/observables.cpp`, `src/mechanics/body.hpp` and `materials/state_variables.hpp`; do not edit by hand. SI units throughout.

The section `Output` of a deck writes these fields of the points. The section `History` writes, in columns:

- always `Time`, `Step_Size`; `Kinetic_Energy`, `Elastic_Energy`, `Stabilization_Energy`, `Tool_Kinetic_Energy`; so far, `Plastic_Work`, `Fracture_Energy`, `Heat`, and the work `Contact_Work`, `Tool_Work`, `External_Work` (of other conditions); `Balance_Error` ([definition](../docs/theory.md#central-differences-and-the-ledger)); `Momentum_X`, `_Y`, `_Z`.
- `Max_Displacement`, `Min_Pressure`: extreme over all points; of several components, of the root of the sum of their squares.
- `Max_Displacement(foam)`: extreme over the points of a node set or block. `Max_Displacement_Z`, `Min_Cauchy_Stress_ZZ`: extreme of a component.
- `Mean_Displacement_Z(top)`, `Sum_Force_Z(top)`: mean, weighted by reference volumes, and sum over the points.
- `Mean_Velocity_Z(slices)`: mean of each layer of the section `slices` in `History` > `Profiles`.
- `Contact_Force_X(foam:plate)`, `_Y`, `_Z`: contact force on the block `foam` from the block `plate`, with friction, N.
- `Reaction_X(wall)`, `_Y`, `_Z`: force of the condition `wall` on the body, N.
- `Crack_Tip(notch)`, `Crack_Speed(notch)`: length of the crack `notch` in `History` > `Cracks` along its direction, m, and its slope over the last rows, m/s.

Forces are means since the previous row: times the interval they are impulses; the first row has 0, and points of a prescribed motion start each explicit solver with its velocity, without an impulse. `Instant_Reaction_Z(wall)` is the force of the single step at the row's time. In equilibria all forces are those of the row's time.

X and y are reference and current position; other symbols: [glossary](../docs/glossary.md). In brackets: unit, number of components (one unless stated; 3 are x, y, z; 6 are xx, yy, zz, xy, yz, zx; 9 are a tensor row by row), and `nodal` (in the Exodus file; others are element variables). A variable of a law exists where a material has this law, else it is 0; extremes and means of `Temperature`, `Relative_Volume` and `Relative_Density` leave out points without it. By quadratic correspondence it is the mean over the cell.

)";

// " (Pa, 6): σ."
std::string described(const Observable& one) {
  return " (" + one.unit + (one.components > 1 ? ", " + std::to_string(one.components) : "") +
         (one.nodal ? ", nodal" : "") + "): " + one.meaning + ".\n";
}

}  // namespace

std::string observables_page() {
  std::string text = introduction, names;
  const auto all = observables_of_all_laws();
  for (std::size_t i = 0; i < all.size(); ++i) {  // neighbors with one description share a row
    names += (names.empty() ? "`" : ", `") + all[i].name + "`";
    if (i + 1 < all.size() && described(all[i + 1]) == described(all[i])) continue;
    text += "- " + names + described(all[i]);
    names.clear();
  }
  return text;
}

}  // namespace strut
