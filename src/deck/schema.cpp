#include "deck/schema.hpp"

#include <cmath>

#include "base/errors.hpp"
#include "deck/contact_laws.hpp"
#include "deck/laws.hpp"
#include "deck/numbers.hpp"

namespace strut::deck {

namespace {

std::string describe(Kind kind) {
  switch (kind) {
    case Kind::real:
      return "a real number";
    case Kind::integer:
      return "an integer";
    case Kind::boolean:
      return "true or false (type bool)";
    case Kind::reals:
      return "a list of real numbers";
    case Kind::vector:
      return "three real numbers";
    case Kind::text:
      return "a text (type string)";
    case Kind::choice:
      return "one of ";
    case Kind::names:
      return "names separated by blanks (type string)";
    case Kind::expression:
      return "a number or an expression in x, y, z, t";
  }
  return "";
}

const char* const bonds_hold = "reserved: not in this version (bonds do not break)";

// A key that Peridigm's decks have and that changes nothing here.
Key without_effect(Key key, const std::string& why) {
  key.meaning = "Accepted for Peridigm's decks; no effect: " + why + ".";
  key.no_effect = why;
  return key;
}

const Key verbose = without_effect({.name = "Verbose", .kind = Kind::boolean, .fallback = "false"},
                                   "the program says what it does at all times");

// Peridigm's built-in grid.
Section grid() {
  std::vector<Key> keys = {
      {.name = "Type", .kind = Kind::choice, .choices = {"PdQuickGrid"}, .meaning = "The only one."}};
  for (const std::string axis : {"X", "Y", "Z"}) {
    keys.push_back({.name = axis + " Origin", .unit = "m", .required = true, .meaning = "Where the block begins."});
    keys.push_back(
        {.name = axis + " Length", .unit = "m", .range = positive, .required = true, .meaning = "Its edge."});
    keys.push_back({.name = "Number Points " + axis,
                    .kind = Kind::integer,
                    .range = {.low = 1},
                    .required = true,
                    .meaning = "Cells along it."});
  }
  return {.name = "TensorProduct3DMeshGenerator",
          .meaning = "A block of equal cells, one point at the centre of each, x fastest: the block block_1.",
          .keys = std::move(keys)};
}

Section discretization() {
  return {
      .name = "Discretization",
      .required = true,
      .meaning = "The points: where they are, and how much each sees of the others.",
      .keys = {{.name = "Type",
                .kind = Kind::choice,
                .choices = {"Exodus", "Text File", "PdQuickGrid"},
                .required = true,
                .meaning =
                    "The mesh file's format: elements or nodes become points, or a list of points. Or Peridigm's "
                    "built-in grid, without a file."},
               {.name = "Input Mesh File",
                .kind = Kind::text,
                .meaning = "Its path, relative to the deck's folder. Required but for PdQuickGrid."},
               {.name = "NeighborhoodType",
                .kind = Kind::choice,
                .choices = {"Spherical"},
                .meaning = "Required for PdQuickGrid: without it, Peridigm takes boxes for neighborhoods."},
               without_effect({.name = "Verbose", .kind = Kind::boolean, .fallback = "false"}, verbose.no_effect),
               without_effect({.name = "Store Exodus Mesh", .kind = Kind::boolean, .fallback = "false"},
                              "the mesh is not kept"),
               {.name = "Points",
                .kind = Kind::choice,
                .choices = {"Elements", "Nodes"},
                .fallback = "Elements",
                .meaning =
                    "Where the points of an Exodus mesh are: at the centroids of its elements, or, for hexahedra "
                    "and tetrahedra, at its nodes, each with its part of the elements around it. With nodes, "
                    "faces and rims of the body are where the mesh has them."},
               {.name = "Influence Function",
                .kind = Kind::choice,
                .choices = {"One", "Linear Decay", "Cubic Decay"},
                .fallback = "One",
                .meaning = "ω(r) with r = |ξ|/δ, ξ the bond and δ the horizon: 1, 1 − r, or 1 − 3r² + 2r³."},
               {.name = "Degenerate Points",
                .kind = Kind::choice,
                .choices = {"Error", "Drop"},
                .fallback = "Error",
                .meaning = "What to do with points that have too few neighbors, or coplanar ones, for a deformation "
                           "gradient."}},
      .sections = {grid()},
      .hints = {{"Bond Filters",
                 "unknown section: bonds of a body cannot be cut by planes or disks; make cracks as "
                 "gaps of the mesh, or bodies apart (Separate Body)"},
                {"Horizon", "unknown key; it belongs to the sections of Blocks"}}};
}

Section node_sets() {
  return {
      .name = "Node Sets",
      .meaning = "Sets of points besides those of the mesh; each key is the name of one.",
      .any_key = Key{.name = any_name,
                     .kind = Kind::expression,
                     .meaning = "The points at whose reference position (m) this is not zero, e.g. `z &lt; 1e-3`."}};
}

Section materials_section() {
  const std::string power_laws = "its power laws are those of 'Elastic Plastic Correspondence', Hardening and Rate";
  Key model = {.name = "Material Model",
               .kind = Kind::choice,
               .required = true,
               .meaning = "The law; it decides on further keys.",
               .hints = {{"Elastic Plastic", "did you mean 'Elastic Plastic Correspondence'?"},
                         {"Viscoplastic Needleman Correspondence",
                          "did you mean 'Elastic Plastic Correspondence'? " + power_laws}}};
  std::vector<Section> cases;
  for (const LawEntry& law : laws()) cases.push_back(law.schema);
  return {.name = "Materials",
          .required = true,
          .meaning = "The materials that blocks refer to.",
          .sections = {with_cases(material_section(), std::move(model), std::move(cases))}};
}

Section blocks() {
  return {
      .name = "Blocks",
      .required = true,
      .meaning = "What the blocks of the mesh are made of.",
      .sections = {
          {.name = any_name,
           .required = true,
           .meaning = "One or more blocks of the mesh. A block of the mesh belongs to one section at most.",
           .keys = {{.name = "Block Names",
                     .kind = Kind::names,
                     .required = true,
                     .meaning = "Blocks of the mesh, or `all`, or `default`: those that no other section names."},
                    {.name = "Material",
                     .kind = Kind::text,
                     .required = true,
                     .meaning = "The name of a section in Materials."},
                    {.name = "Horizon",
                     .unit = "m",
                     .range = positive,
                     .meaning = "δ: points closer than this are neighbors. Either this or Horizon Factor."},
                    {.name = "Horizon Factor",
                     .range = {.low = 1, .high = 20},
                     .meaning =
                         "δ of each point in local spacings: the edge of a cube with the volume of its "
                         "element, or with the mean volume of the elements around its node (six times "
                         "that of tetrahedra). Points i and j are neighbors when they are closer than (δ_i + δ_j)/2."},
                    {.name = "Separate Body",
                     .kind = Kind::boolean,
                     .fallback = "false",
                     .meaning = "Points of this section are not bonded to those of others, however near: a "
                                "body of its own, that others meet in contact."},
                    {.name = "Bonds Across Voids",
                     .kind = Kind::boolean,
                     .meaning = "false: bonds run through material. Two points within the horizon are bonded only if "
                                "elements that share nodes lead from one to the other within it. Needs hexahedra or "
                                "tetrahedra. Without this key: true, but false for Quadratic Correspondence."}},
           .hints = {{"Damage Model", bonds_hold}, {"Damage Models", bonds_hold}}}}};
}

Section contact() {
  const std::string found = "the program finds out when to search";
  Key law = {.name = "Contact Model",
             .kind = Kind::choice,
             .required = true,
             .meaning = "The law; it decides on further keys.",
             .hints = {{"Time-Dependent Short Range Force", "there are no coefficients that depend on time"}}};
  std::vector<Section> cases;
  for (const ContactLawEntry& entry : contact_laws()) cases.push_back(entry.schema);
  Section model = {
      .name = any_name,
      .required = true,
      .meaning = "One model of contact.",
      .keys = {
          {.name = "Contact Radius",
           .unit = "m",
           .range = positive,
           .required = true,
           .meaning = "r_c: points that are nearer repel each other. For points that start closer than r_c/0.9, 0.9 of "
                      "their first distance. One spacing is a good choice."},
          {.name = "Friction Coefficient", .range = not_negative, .fallback = "0", .meaning = "Coulomb's."}}};
  Section interaction = {
      .name = any_name,
      .required = true,
      .meaning = "Who may touch whom. Bonded points never do.",
      .keys = {{.name = "First Block",
                .kind = Kind::text,
                .meaning =
                    "A block of the mesh. Without both blocks: all blocks, but for those that other interactions "
                    "name; in the section `General Contact` each with all others, in `Self Contact` each with itself, "
                    "in one of another name both."},
               {.name = "Second Block", .kind = Kind::text, .meaning = "The other block, or the same: self-contact."},
               {.name = "Contact Model", .kind = Kind::text, .required = true, .meaning = "A section of Models."}}};
  return {
      .name = "Contact",
      .meaning = "Contact between bodies, and of a body with itself. Without this section there is none.",
      .keys = {verbose, without_effect({.name = "Search Radius", .unit = "m", .range = positive}, found),
               without_effect({.name = "Search Frequency", .kind = Kind::integer, .unit = "steps", .range = {.low = 1}},
                              found)},
      .sections = {{.name = "Models",
                    .required = true,
                    .meaning = "Models by name.",
                    .sections = {with_cases(std::move(model), std::move(law), std::move(cases))}},
                   {.name = "Interactions", .required = true, .meaning = "By any name.", .sections = {interaction}}}};
}

Section along_axis(const std::string& type, const std::string& unit, const std::string& meaning) {
  return {.name = type,
          .meaning = meaning,
          .keys = {{.name = "Coordinate",
                    .kind = Kind::choice,
                    .choices = {"x", "y", "z"},
                    .required = true,
                    .meaning = "The axis it acts along."},
                   {.name = "Value",
                    .kind = Kind::expression,
                    .unit = unit,
                    .required = true,
                    .meaning = "At the reference position x, y, z (m) and the time t (s)."}}};
}

Section plane(const std::string& type, const std::string& meaning) {
  return {.name = type,
          .meaning = meaning,
          .keys = {{.name = "Point", .kind = Kind::vector, .unit = "m", .required = true, .meaning = "On the plane."},
                   {.name = "Normal", .kind = Kind::vector, .required = true, .meaning = "Of any length but zero."}}};
}

// A section of a tool: its shape's keys, and those that all have.
Section tool(Section section) {
  section.keys.push_back(
      {.name = "Friction Coefficient", .range = not_negative, .fallback = "0", .meaning = "Coulomb's."});
  for (const std::string axis : {"X", "Y", "Z"}) {
    section.keys.push_back({.name = "Travel " + axis,
                            .kind = Kind::expression,
                            .unit = "m",
                            .meaning = "How far it has gone along " + axis +
                                       " at the time t (s), from where the other "
                                       "keys put it. Without: nowhere."});
  }
  return section;
}

Section rigid_plane() {
  return tool(plane("Rigid Plane", "A wall: the points stay on the side the normal points to."));
}

Section rigid_cylinder() {
  return tool(
      {.name = "Rigid Cylinder",
       .meaning = "A roll without ends: the points stay outside.",
       .keys = {{.name = "Point", .kind = Kind::vector, .unit = "m", .required = true, .meaning = "On the axis."},
                {.name = "Axis",
                 .kind = Kind::vector,
                 .required = true,
                 .meaning = "Its direction, of any length but zero."},
                {.name = "Radius", .unit = "m", .range = positive, .required = true, .meaning = "Of the roll."}}});
}

Section rigid_box() {
  return tool({.name = "Rigid Box",
               .meaning = "A solid block with faces across the axes and sharp edges: the points stay outside.",
               .keys = {{.name = "Lower Corner",
                         .kind = Kind::vector,
                         .unit = "m",
                         .required = true,
                         .meaning = "The smallest x, y, z."},
                        {.name = "Upper Corner",
                         .kind = Kind::vector,
                         .unit = "m",
                         .required = true,
                         .meaning = "The largest x, y, z, each larger than that of the lower corner."}}});
}

Section open_end() {
  return {.name = "Non-Reflecting End",
          .meaning =
              "Waves leave through the set, one layer of points, as if the body went on behind it: viscous traction "
              "ρ c v with the speeds of longitudinal and shear waves in the undeformed material.",
          .keys = {{.name = "Normal",
                    .kind = Kind::vector,
                    .required = true,
                    .meaning = "Of the end's surface, of any length but zero."}}};
}

Section conditions() {
  Section one = {.name = any_name,
                 .meaning = "One condition.",
                 .keys = {{.name = "Node Set",
                           .kind = Kind::text,
                           .fallback = "all",
                           .meaning = "A node set of the mesh or of Node Sets, a block's name, or `all`."}}};
  const std::string no_temperature = "there is no temperature here";
  Key type = {.name = "Type",
              .kind = Kind::choice,
              .required = true,
              .meaning = "It decides on further keys.",
              .hints = {{"Initial Displacement", "bodies start undeformed"},
                        {"Prescribed Temperature", no_temperature},
                        {"Initial Temperature", no_temperature},
                        {"Thermal Flux", no_temperature}}};
  return {
      .name = "Boundary Conditions",
      .meaning = "What is imposed on points, initial conditions included.",
      .any_key = Key{.name = any_name,
                     .kind = Kind::text,
                     .meaning = "A set of points as Peridigm writes it: the name holds `Node Set`, the value is the "
                                "numbers of elements (of points of a text file or grid) from 1, `1 4 7`, or the "
                                "name of a file of them, relative to the deck's folder."},
      .sections = {with_cases(std::move(one), std::move(type),
                              {along_axis("Initial Velocity", "m/s", "The velocity at the initial time."),
                               along_axis("Prescribed Displacement", "m", "The displacement at every time."),
                               along_axis("Prescribed Velocity", "m/s", "The velocity at every time."),
                               along_axis("Body Force", "N/m³", "A force per reference volume."),
                               plane("Symmetry Plane", "The points keep their distance to the plane."), rigid_plane(),
                               rigid_cylinder(), rigid_box(), open_end()})}};
}

const char* const own_solver = "equilibria are found in another way";

Section quasi_static() {
  return {.name = "QuasiStatic",
          .meaning =
              "Slow loading in the place of Verlet: a series of equilibria, without inertia. Times are those of "
              "the conditions; rates follow from them.",
          .keys = {{.name = "Method",
                    .kind = Kind::choice,
                    .choices = {"Newton", "Dynamic Relaxation"},
                    .fallback = "Newton",
                    .meaning = "How an equilibrium is found: with the tangent, or by damped motion without it. Newton "
                               "falls back on the other where it fails."},
                   {.name = "Number of Load Steps",
                    .kind = Kind::integer,
                    .range = {.low = 1},
                    .fallback = "10",
                    .meaning = "Of equal length. One that finds no equilibrium is cut in halves."},
                   {.name = "Tolerance",
                    .range = {.low = 0, .high = 1, .with_low = false, .with_high = false},
                    .fallback = "1e-6",
                    .meaning = "The forces that may be left, as a part of reactions, loads and contact."},
                   {.name = "Maximum Solver Iterations",
                    .kind = Kind::integer,
                    .range = {.low = 1},
                    .fallback = "20",
                    .meaning = "Newton's, of one load step, before it is cut."},
                   without_effect({.name = "Absolute Tolerance", .range = positive},
                                  "what may be left is a part of the forces that act: Tolerance"),
                   without_effect({.name = "Belos Linear Solver", .kind = Kind::text}, own_solver),
                   without_effect({.name = "Disable Heuristics", .kind = Kind::boolean}, own_solver),
                   without_effect({.name = "Damped Newton Diagonal Scale Factor"}, own_solver),
                   without_effect({.name = "Damped Newton Diagonal Shift Factor"}, own_solver)},
          .hints = {{"Adaptive Load-Stepping",
                     "unknown section; a load step that finds no equilibrium is cut in halves by itself"}}};
}

Section solver() {
  return {
      .name = "Solver",
      .required = true,
      .meaning = "The time that is simulated, and its steps.",
      .keys =
          {{.name = "Verbose",
            .kind = Kind::boolean,
            .fallback = "false",
            .meaning = "With QuasiStatic, each iteration is told."},
           without_effect({.name = "Peridigm Preconditioner", .kind = Kind::text}, own_solver),
           without_effect({.name = "Finite Difference Probe Length", .range = positive}, own_solver),
           {.name = "Initial Time", .unit = "s", .fallback = "0", .meaning = "When the run begins."},
           {.name = "Final Time", .unit = "s", .required = true, .meaning = "When it ends: after the initial time."}},
      .sections = {{.name = "Verlet",
                    .meaning = "Explicit steps by central differences: a fixed step or a safety factor, not both.",
                    .keys = {{.name = "Fixed dt", .unit = "s", .range = positive, .meaning = "The same step always."},
                             {.name = "Safety Factor",
                              .range = {.low = 0, .high = 1, .with_low = false},
                              .fallback = "0.8",
                              .meaning = "The step as a part of the stable one, which follows the deformation."},
                             {.name = "Subcycling",
                              .kind = Kind::boolean,
                              .fallback = "true",
                              .meaning = "Few points that would limit the step of all are stepped alone, more often. "
                                         "None are with a fixed step."}}},
                   quasi_static()},
      .hints = {{"Implicit", "unknown section; there are 'Verlet', and 'QuasiStatic' for loads without inertia"}}};
}

Section output() {
  return {.name = "Output",
          .meaning = "The fields of the points in time. Without this section there are none.",
          .keys = {{.name = "Output File Type",
                    .kind = Kind::choice,
                    .choices = {"ExodusII"},
                    .fallback = "ExodusII",
                    .meaning = "The format."},
                   {.name = "Output Filename",
                    .kind = Kind::text,
                    .required = true,
                    .meaning = "Relative to the working folder; `.e` is appended if it has no suffix."},
                   {.name = "Output Frequency",
                    .kind = Kind::integer,
                    .unit = "steps",
                    .range = {.low = 1},
                    .meaning = "Every so many steps. Not together with Output Interval."},
                   {.name = "Output Interval",
                    .unit = "s",
                    .range = positive,
                    .meaning = "Every so much time. Where neither is given: 1/20 of the run."},
                   without_effect({.name = "Output Format", .kind = Kind::text, .fallback = "BINARY"},
                                  "an Exodus file is binary"),
                   without_effect({.name = "Parallel Write", .kind = Kind::boolean, .fallback = "true"},
                                  "all ranks write one file")},
          .sections = {
              {.name = "Output Variables",
               .meaning = "The fields to write.",
               .any_key = Key{.name = any_name, .kind = Kind::boolean, .meaning = "A field, e.g. `Displacement`."}}}};
}

Section history() {
  return {
      .name = "History",
      .meaning = "Numbers of the whole body in time, as a table (CSV). Without this section there is none.",
      .keys = {{.name = "Filename", .kind = Kind::text, .required = true, .meaning = "Relative to the working folder."},
               {.name = "Frequency",
                .kind = Kind::integer,
                .unit = "steps",
                .range = {.low = 1},
                .meaning = "Every so many steps. Not together with Interval."},
               {.name = "Interval",
                .unit = "s",
                .range = positive,
                .meaning = "Every so much time. Where neither is given: 1/1000 of the run."}},
      .sections = {
          {.name = "Variables",
           .meaning = "The columns.",
           .any_key = Key{.name = any_name,
                          .kind = Kind::boolean,
                          .meaning = "E.g. `Max_Displacement`, or `Max_Displacement(foam)` for a node set or block; "
                                     "`Reaction_Z(wall)` for the force (N) of the condition `wall` on the body: "
                                     "prescribed motion, a symmetry plane or a rigid tool."}}}};
}

Section restart() {
  return {.name = "Restart",
          .meaning =
              "What a run leaves so that `strut --continue deck.xml` can go on, on any number of ranks. It is "
              "written at these times and when a signal ends the run. With this section it is written at the "
              "end, too, so that the final time can be put off; without, every 30 minutes, and removed at the "
              "end.",
          .keys = {{.name = "Enabled", .kind = Kind::boolean, .fallback = "true", .meaning = "False: none is written."},
                   {.name = "Filename",
                    .kind = Kind::text,
                    .meaning = "Relative to the working folder. Where it is not given: the deck's name with the "
                               "suffix `.restart`."},
                   {.name = "Frequency",
                    .kind = Kind::integer,
                    .unit = "steps",
                    .range = {.low = 1},
                    .meaning = "Every so many steps. Not together with Interval."},
                   {.name = "Interval", .unit = "s", .range = positive, .meaning = "Every so much time."},
                   {.name = "Minutes",
                    .unit = "min",
                    .range = positive,
                    .fallback = "30",
                    .meaning = "And every so many minutes of computing."},
                   without_effect({.name = "Restart", .kind = Kind::boolean, .fallback = "true"},
                                  "what it takes to go on is kept in any case, and `strut --continue deck.xml` does")}};
}

Section watch() {
  const std::vector<std::string> actions = {"Stop", "Continue"};
  return {.name = "Watch",
          .meaning =
              "What ends a run that has gone wrong, with the point, the likely cause and a last frame. A number "
              "that is not finite always does.",
          .keys = {{.name = "Beyond Limits",
                    .kind = Kind::choice,
                    .choices = actions,
                    .fallback = "Stop",
                    .meaning = "What happens where a limit of this section is passed. Continue: it is told once."},
                   {.name = "Inverted Points",
                    .kind = Kind::choice,
                    .choices = actions,
                    .fallback = "Stop",
                    .meaning = "What happens where a point is turned inside out (det F ≤ 0). Continue: it goes on as a "
                               "mass without stress while it is; in explicit steps."},
                   {.name = "Balance Error",
                    .range = positive,
                    .fallback = "0.5",
                    .meaning = "The largest error of the balance of energy, as a part of the largest energy, looked at "
                               "with each line of the history after the first ten."},
                   {.name = "Smallest Step",
                    .range = {.low = 0, .high = 1},
                    .fallback = "1e-3",
                    .meaning = "As a part of the first one; in explicit steps."},
                   {.name = "Penetration",
                    .range = {.low = 0, .high = 1},
                    .fallback = "0.95",
                    .meaning = "How far two points may come nearer than the distance at which they touch, as a part of "
                               "it; in explicit steps."}}};
}

}  // namespace

bool Range::contains(double value) const {
  return (with_low ? value >= low : value > low) && (with_high ? value <= high : value < high);
}

std::string Range::text() const {
  const bool bounded_below = std::isfinite(low), bounded_above = std::isfinite(high);
  if (bounded_below && bounded_above) {
    return "in " + std::string(with_low ? "[" : "(") + to_text(low) + ", " + to_text(high) + (with_high ? "]" : ")");
  }
  if (bounded_below) return (with_low ? "≥ " : "> ") + to_text(low);
  if (bounded_above) return (with_high ? "≤ " : "< ") + to_text(high);
  return "";
}

Section with_cases(Section section, Key selector, std::vector<Section> cases) {
  for (const Section& one : cases) selector.choices.push_back(one.name);
  section.selector = selector.name;
  section.keys.insert(section.keys.begin(), std::move(selector));
  section.cases = std::move(cases);
  return section;
}

std::string expected(const Key& key) {
  std::string text = "expected " + describe(key.kind) + joined(key.choices);
  if (const std::string range = key.range.text(); !range.empty()) text += " " + range;
  if (!key.unit.empty()) text += ", in " + key.unit;
  return text;
}

const Section& schema() {
  static const std::string one_solver =
      "unknown section; a deck has one 'Solver': runs in several parts are several decks";
  static const Section whole = {
      .meaning = "",
      .keys = {verbose},
      .sections = {discretization(), node_sets(), materials_section(), blocks(), contact(), conditions(), solver(),
                   output(), history(), restart(), watch()},
      .hints = {{"Damage Models", bonds_hold},
                {"Interfaces", "unknown section; there are no interfaces between elements"},
                {"Problem",
                 "unknown section; this is the oldest layout of Peridigm's decks: its sections belong to the "
                 "deck itself"},
                {"Solver1", one_solver},
                {"Solver2", one_solver}}};
  return whole;
}

}  // namespace strut::deck
