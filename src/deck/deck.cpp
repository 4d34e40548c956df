#include "deck/deck.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "deck/check.hpp"
#include "deck/contact_laws.hpp"
#include "deck/laws.hpp"
#include "deck/numbers.hpp"
#include "deck/peridigm/peridigm.hpp"

namespace strut::deck {

namespace {

namespace fs = std::filesystem;

// The place of the value of a choice in a table that has the order of the enum.
template <class Enum>
Enum to_enum(const std::string& choice, const std::vector<std::string>& in_order) {
  const auto found = std::find(in_order.begin(), in_order.end(), choice);
  return static_cast<Enum>(found == in_order.end() ? 0 : found - in_order.begin());
}

Grid grid(const Values& values) {
  Grid grid;
  for (int c = 0; c < 3; ++c) {
    const std::string axis(1, "XYZ"[c]);
    grid.origin[c] = values.real(axis + " Origin");
    grid.length[c] = values.real(axis + " Length");
    grid.points[c] = values.integer("Number Points " + axis);
  }
  return grid;
}

// What each type of discretization must have, and what it cannot.
void check_source(const Values& values, Problems& problems) {
  if (!values.has("Type")) return;
  const auto report = [&](const std::string& name, const std::string& what) {
    problems.add(path_to(values.path(), name), what);
  };
  const std::string generator = "TensorProduct3DMeshGenerator", file = "Input Mesh File", shape = "NeighborhoodType";
  const bool grid = values.text("Type") == "PdQuickGrid";
  if (!grid && !values.given(file)) report(file, "missing; expected a text (type string)");
  if (grid && values.given(file)) report(file, "unknown key for Type 'PdQuickGrid', which reads no file");
  if (grid && !values.has_section(generator)) report(generator, "missing section (the only grid that is known here)");
  if (!grid && values.has_section(generator)) report(generator, "unknown section; it belongs to Type 'PdQuickGrid'");
  if (grid && !values.given(shape)) {
    report(
        shape,
        "missing; expected 'Spherical': without it Peridigm takes boxes for neighborhoods, which are not known here");
  }
}

Discretization discretization(const Values& values, const fs::path& deck, Problems& problems) {
  if (values.text("Type") == "Text File" && values.text("Points") == "Nodes") {
    problems.add(path_to(values.path(), "Points"),
                 "'Nodes'; a text file has points only: expected 'Elements' (nodes have Exodus meshes of hexahedra or "
                 "tetrahedra)");
  }
  check_source(values, problems);
  return {.type = to_enum<MeshType>(values.text("Type"), {"Exodus", "Text File", "PdQuickGrid"}),
          .mesh = values.has("Input Mesh File") ? deck.parent_path() / values.text("Input Mesh File") : fs::path(),
          .grid = grid(values.section("TensorProduct3DMeshGenerator")),
          .points = to_enum<Points>(values.text("Points"), {"Elements", "Nodes"}),
          .influence = to_enum<Influence>(values.text("Influence Function"), {"One", "Linear Decay", "Cubic Decay"}),
          .degenerate = to_enum<DegeneratePoints>(values.text("Degenerate Points"), {"Error", "Drop"})};
}

void check_mesh(const fs::path& mesh, Problems& problems) {
  if (mesh.empty() || (fs::is_regular_file(mesh) && std::ifstream(mesh))) return;
  const fs::path recipe = fs::path(mesh).replace_extension(".recipe");
  const bool there = fs::exists(mesh);
  std::string what = "'" + mesh.string() + (there ? "' is not a file that can be read" : "' does not exist");
  if (!there && fs::exists(recipe)) what += " (tools/run makes it from " + recipe.string() + ")";
  problems.add("Discretization > Input Mesh File", what + "; expected a mesh, its path relative to the deck's folder");
}

// What a run writes may not be what it reads, nor one file be two, by whatever name or link.
void check_files(const Deck& deck, Problems& problems) {
  const auto same = [](const fs::path& one, const fs::path& other) {
    std::error_code failure;
    if (fs::equivalent(one, other, failure)) return true;
    failure.clear();
    const fs::path a = fs::weakly_canonical(one, failure), b = fs::weakly_canonical(other, failure);
    return !failure && !a.empty() && a == b;
  };
  const auto check = [&](const std::string& path, const fs::path& file) {
    const char* read = same(file, deck.discretization.mesh) ? "the input mesh"
                       : same(file, deck.file)              ? "this deck"
                                                            : "";
    std::error_code failure;
    const fs::file_status status = fs::status(file, failure);
    if (*read) {
      problems.add(path, "'" + file.string() + "' is " + read + "; expected a file that may be replaced");
    } else if (fs::exists(status) && !fs::is_regular_file(status)) {
      problems.add(path, "'" + file.string() + "' is a folder or a device; expected a file that may be replaced");
    }
  };
  if (deck.output.enabled) check("Output > Output Filename", deck.output.file);
  if (deck.history.enabled) check("History > Filename", deck.history.file);
  if (deck.restart.enabled) check("Restart > Filename", deck.restart.file);
  const auto differ = [&](const std::string& path, bool enabled, const fs::path& file, const std::string& other,
                          bool other_enabled, const fs::path& other_file) {
    if (!enabled || !other_enabled || !same(file, other_file)) return;
    problems.add(path, "'" + file.string() + "' is " + other + "'s file, too; expected another");
  };
  const Output& output = deck.output;
  const History& history = deck.history;
  const Restart& restart = deck.restart;
  differ("History > Filename", history.enabled, history.file, "Output", output.enabled, output.file);
  differ("Restart > Filename", restart.enabled, restart.file, "Output", output.enabled, output.file);
  differ("Restart > Filename", restart.enabled, restart.file, "History", history.enabled, history.file);
}

std::vector<NodeSet> node_sets(const Values& values, Problems& problems) {
  std::vector<NodeSet> sets;
  for (const std::string& name : values.keys()) {
    const std::string path = path_to(values.path(), name);
    if (name == "all") problems.add(path, "is the set of all points; expected another name");
    if (values.function(name).depends_on_time()) problems.add(path, "depends on t; expected an expression in x, y, z");
    sets.push_back({name, values.function(name)});
  }
  return sets;
}

std::optional<std::vector<int>> numbers_in(const std::string& text) {
  std::vector<int> numbers;
  for (const std::string& word : to_words(text)) {
    const std::optional<int> number = to_integer(word);
    if (!number || *number < 1) return std::nullopt;
    numbers.push_back(*number);
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

// Lines that begin with #, / or * are comments.
std::string without_comments(std::istream& file) {
  std::string text, line;
  while (std::getline(file, line)) {
    const std::string_view content = trimmed(line);
    if (!content.empty() && std::string_view("#/*").find(content[0]) == std::string_view::npos) text += line + " ";
  }
  return text;
}

// Peridigm's sets: parameters among the conditions. Those in files are left to read_numbers.
void add_numbered_sets(const Values& conditions, const fs::path& deck, std::vector<NodeSet>& sets, Problems& problems) {
  for (const std::string& name : conditions.keys()) {
    const std::string path = path_to(conditions.path(), name);
    if (name.find("Node Set") == std::string::npos) {
      problems.add(path, "unknown key; expected sections, or sets of points by number, whose names hold 'Node Set'");
    }
    const std::string& text = conditions.text(name);
    const auto numbers = numbers_in(text);
    NodeSet set;
    set.name = name;
    set.numbers = numbers.value_or(std::vector<int>());
    if (!numbers) set.file = deck.parent_path() / text;
    sets.push_back(set);
  }
}

void read_numbers(std::vector<NodeSet>& sets, Problems& problems) {
  for (NodeSet& set : sets) {
    if (set.file.empty()) continue;
    std::ifstream file(set.file);
    const auto numbers = fs::is_regular_file(set.file) ? numbers_in(without_comments(file)) : std::nullopt;
    set.numbers = numbers.value_or(std::vector<int>());
    if (!set.numbers->empty()) continue;
    problems.add("Boundary Conditions > " + set.name,
                 "'" + set.file.filename().string() +
                     "' is neither a list of numbers, the first 1, nor a file of them in the deck's folder");
  }
}

StabilizationType stabilization(const std::string& name) {
  if (name == "None") return StabilizationType::none;
  return name == "Silling" ? StabilizationType::silling : StabilizationType::mean_gradient;
}

void check_needs_no_stabilization(const Values& values, Material& material, Problems& problems) {
  material.stabilization = StabilizationType::none;
  for (const char* key : {"Stabilization", "Stabilization Coefficient"}) {
    if (!values.given(key) || values.text("Stabilization") == "None") continue;
    problems.add(
        values.path() + " > " + key,
        "given, but Formulation 'Quadratic Correspondence' has no zero-energy modes and takes none; expected no "
        "such key");
  }
}

Material material(const Values& values, Problems& problems) {
  Material material{.name = values.name(),
                    .density = values.real("Density"),
                    .stabilization = stabilization(values.text("Stabilization")),
                    .linear_viscosity = values.real("Linear Viscosity"),
                    .quadratic_viscosity = values.real("Quadratic Viscosity"),
                    .stabilization_coefficient = values.real("Stabilization Coefficient")};
  for (const LawEntry& law : laws()) {
    if (law.schema.name != values.text("Material Model")) continue;
    const bool by_cells =
        law.formulation == Formulation::correspondence && values.text("Formulation") == "Quadratic Correspondence";
    material.formulation = by_cells ? Formulation::quadratic : law.formulation;
    if (by_cells) check_needs_no_stabilization(values, material, problems);
    material.law = law.make(values, problems);
  }
  return material;
}

std::vector<Material> materials_of(const Values& values, Problems& problems) {
  std::vector<Material> all;
  for (const Values& section : values.sections()) all.push_back(material(section, problems));
  return all;
}

// The place in `all` of the one whose name `key` of the section gives. `where`: the section that holds all.
template <class Named>
int find_named(const Values& section, const std::string& key, const std::vector<Named>& all, const std::string& where,
               Problems& problems) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  const std::string& wanted = section.text(key);
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found != names.end() || !section.has(key)) return static_cast<int>(found - names.begin());
  problems.add(path_to(section.path(), key), "'" + wanted + "' is not defined" + did_you_mean(wanted, names) +
                                                 "; expected the name of a section of " + where +
                                                 (names.empty() ? "" : ": " + joined(names)));
  return 0;
}

void check_overlaps(const std::vector<Block>& blocks, Problems& problems) {
  std::map<std::string, std::string> owners;  // block of the mesh -> section that has it
  const auto clash = [&](const Block& block, const std::string& name, const std::string& owner) {
    problems.add("Blocks > " + block.name + " > Block Names",
                 "'" + name + "' is named twice: here and in Blocks > " + owner + "; expected once");
  };
  for (const Block& block : blocks) {
    for (const std::string& name : block.block_names) {
      if (name == "default") {
        if (!owners.emplace(name, block.name).second) clash(block, name, owners[name]);
        continue;
      }
      const auto taken = name == "all" ? owners.begin() : owners.find(owners.count("all") ? "all" : name);
      if (taken != owners.end()) clash(block, name == "all" ? taken->first : name, taken->second);
      owners.emplace(name, block.name);
    }
  }
}

// Reports where both keys are given.
void check_one_of(const Values& values, const std::string& one, const std::string& other, Problems& problems) {
  if (values.given(one) && values.given(other)) {
    problems.add(values.path(), "'" + one + "' and '" + other + "' are both given; expected one of them");
  }
}

std::optional<double> real_if_given(const Values& values, const std::string& key) {
  return values.has(key) ? std::optional(values.real(key)) : std::nullopt;
}

void check_horizon(const Values& values, Problems& problems) {
  check_one_of(values, "Horizon", "Horizon Factor", problems);
  if (values.given("Horizon") || values.given("Horizon Factor")) return;
  problems.add(path_to(values.path(), "Horizon"),
               "missing; expected a real number > 0, in m, or 'Horizon Factor' in its place");
}

std::vector<Block> blocks(const Values& values, const std::vector<Material>& materials, Problems& problems) {
  std::vector<Block> all;
  for (const Values& section : values.sections()) {
    check_horizon(section, problems);
    all.push_back({.name = section.name(),
                   .block_names = section.names("Block Names"),
                   .material = find_named(section, "Material", materials, "Materials", problems),
                   .horizon = real_if_given(section, "Horizon"),
                   .horizon_factor = real_if_given(section, "Horizon Factor"),
                   .separate_body = section.flag("Separate Body"),
                   .across_voids = section.has("Bonds Across Voids") ? std::optional(section.flag("Bonds Across Voids"))
                                                                     : std::nullopt});
  }
  check_overlaps(all, problems);
  return all;
}

std::vector<ContactModel> contact_models(const Values& values) {
  std::vector<ContactModel> all;
  for (const Values& section : values.sections()) {
    all.push_back(
        {.name = section.name(), .law = make_contact_law(section), .friction = section.real("Friction Coefficient")});
  }
  return all;
}

// The blocks of the mesh that an interaction joins, in either order.
std::pair<std::string, std::string> parties(const Interaction& interaction) {
  return std::minmax(interaction.first_block, interaction.second_block);
}

void check_interaction(const Interaction& one, const std::vector<Interaction>& earlier, const std::string& path,
                       Problems& problems) {
  if (one.first_block.empty() != one.second_block.empty()) {
    problems.add(path, "one block is named; expected First Block and Second Block, or neither of them for all blocks");
  }
  for (const Interaction& other : earlier) {
    const bool apart =
        one.partners != other.partners && one.partners != Partners::any && other.partners != Partners::any;
    if (parties(one) == parties(other) && !apart)
      problems.add(path, "joins the same blocks as " + other.name + "; expected once");
  }
}

// The names that Peridigm knows; they say nothing of an interaction that names its blocks.
Partners partners(const Values& interaction) {
  if (interaction.has("First Block")) return Partners::any;
  if (interaction.name() == "General Contact") return Partners::others;
  return interaction.name() == "Self Contact" ? Partners::itself : Partners::any;
}

std::vector<Interaction> interactions(const Values& values, const std::vector<ContactModel>& models,
                                      Problems& problems) {
  std::vector<Interaction> all;
  for (const Values& section : values.sections()) {
    const Interaction one{.name = section.name(),
                          .first_block = section.text("First Block"),
                          .second_block = section.text("Second Block"),
                          .partners = partners(section),
                          .model = find_named(section, "Contact Model", models, "Contact > Models", problems)};
    check_interaction(one, all, section.path(), problems);
    all.push_back(one);
  }
  return all;
}

Vector to_vector(const std::vector<double>& numbers, const Vector& otherwise) {
  return numbers.size() == 3 ? Vector(numbers[0], numbers[1], numbers[2]) : otherwise;
}

// A direction of any length but zero.
Vector direction(const Values& values, const std::string& key, const Vector& otherwise, Problems& problems) {
  const Vector found = to_vector(values.reals(key), otherwise);
  if (found.isZero(0)) problems.add(path_to(values.path(), key), "is zero; expected a direction");
  return found;
}

std::array<std::optional<Function>, 3> travel(const Values& values, Problems& problems) {
  std::array<std::optional<Function>, 3> all;
  const char* const keys[] = {"Travel X", "Travel Y", "Travel Z"};
  for (int c = 0; c < 3; ++c) {
    if (!values.has(keys[c])) continue;
    all[c] = values.function(keys[c]);
    if (!all[c]->depends_on_place()) continue;
    problems.add(path_to(values.path(), keys[c]),
                 "'" + all[c]->text() + "' depends on x, y or z; expected a number or an expression in t, in m");
  }
  return all;
}

void check_corners(const Values& values, const Vector& lower, const Vector& upper, Problems& problems) {
  const std::string higher = "Upper Corner", low = "Lower Corner";
  if (!values.has(higher) || !values.has(low) || (lower.array() < upper.array()).all()) return;
  const auto text = [](const Vector& v) { return to_text(v[0]) + " " + to_text(v[1]) + " " + to_text(v[2]); };
  problems.add(path_to(values.path(), higher),
               "'" + text(upper) + "'; expected > Lower Corner (" + text(lower) + ") in each component, in m");
}

Condition condition(const Values& values, Problems& problems) {
  Condition condition{
      .name = values.name(),
      .type = to_enum<ConditionType>(
          values.text("Type"), {"Initial Velocity", "Prescribed Displacement", "Prescribed Velocity", "Body Force",
                                "Symmetry Plane", "Rigid Plane", "Rigid Cylinder", "Rigid Box", "Non-Reflecting End"}),
      .node_set = values.text("Node Set"),
      .component = to_enum<int>(values.text("Coordinate"), {"x", "y", "z"}),
      .value = values.function("Value")};
  condition.point = to_vector(values.reals("Point"), condition.point);
  condition.normal = direction(values, "Normal", condition.normal, problems);
  condition.axis = direction(values, "Axis", condition.axis, problems);
  condition.radius = values.real("Radius");
  condition.lower = to_vector(values.reals("Lower Corner"), condition.lower);
  condition.upper = to_vector(values.reals("Upper Corner"), condition.upper);
  condition.friction = values.real("Friction Coefficient");
  condition.travel = travel(values, problems);
  check_corners(values, condition.lower, condition.upper, problems);
  return condition;
}

std::vector<Condition> conditions(const Values& values, Problems& problems) {
  std::vector<Condition> all;
  for (const Values& section : values.sections()) all.push_back(condition(section, problems));
  return all;
}

QuasiStatic quasi_static(const Values& values) {
  return {.with_tangent = values.text("Method") == "Newton",
          .load_steps = values.integer("Number of Load Steps"),
          .tolerance = values.real("Tolerance"),
          .most_iterations = values.integer("Maximum Solver Iterations")};
}

Solver solver(const Values& values, Problems& problems) {
  const Values& verlet = values.section("Verlet");
  Solver solver{.initial_time = values.real("Initial Time"),
                .final_time = values.real("Final Time"),
                .verbose = values.flag("Verbose"),
                .safety_factor = verlet.real("Safety Factor"),
                .subcycling = verlet.flag("Subcycling")};
  solver.fixed_dt = real_if_given(verlet, "Fixed dt");
  if (values.has_section("QuasiStatic")) {
    solver.quasi_static = quasi_static(values.section("QuasiStatic"));
    if (values.has_section("Verlet")) {
      problems.add(values.path(), "'Verlet' and 'QuasiStatic' are both given; expected one of them");
    }
  }
  check_one_of(verlet, "Fixed dt", "Safety Factor", problems);
  if (values.has("Initial Time") && values.has("Final Time") && solver.final_time <= solver.initial_time) {
    problems.add(
        path_to(values.path(), "Final Time"),
        "'" + to_text(solver.final_time) + "'; expected > Initial Time (" + to_text(solver.initial_time) + "), in s");
  }
  return solver;
}

std::vector<std::string> switched_on(const Values& variables) {
  std::vector<std::string> names = variables.keys();
  std::erase_if(names, [&](const std::string& name) { return !variables.flag(name); });
  return names;
}

// Sets the frequency or the interval; a `share` of the run where the deck has neither.
template <class Sink>
void set_when(Sink& sink, const Values& values, const std::string& prefix, double share, const Solver& solver,
              Problems& problems) {
  const std::string frequency = prefix + "Frequency", interval = prefix + "Interval";
  check_one_of(values, frequency, interval, problems);
  if (values.has(frequency)) {
    sink.frequency = values.integer(frequency);
  } else {
    sink.interval = values.has(interval) ? values.real(interval) : share * (solver.final_time - solver.initial_time);
  }
}

Output output(const Values* values, const Solver& solver, Problems& problems) {
  if (!values) return {};
  Output output{.enabled = true,
                .file = values->text("Output Filename"),
                .variables = switched_on(values->section("Output Variables"))};
  if (!output.file.has_extension()) output.file += ".e";
  set_when(output, *values, "Output ", 1.0 / 20, solver, problems);
  return output;
}

History history(const Values* values, const Solver& solver, Problems& problems) {
  if (!values) return {};
  History history{
      .enabled = true, .file = values->text("Filename"), .variables = switched_on(values->section("Variables"))};
  set_when(history, *values, "", 1.0 / 1000, solver, problems);
  return history;
}

Restart restart(const Values* values, bool asked_for, const fs::path& deck, Problems& problems) {
  Restart restart{.asked_for = asked_for, .file = fs::path(deck.filename()).replace_extension(".restart")};
  if (!values) return restart;
  restart.enabled = values->flag("Enabled");
  if (values->has("Filename")) restart.file = values->text("Filename");
  check_one_of(*values, "Frequency", "Interval", problems);
  if (values->has("Frequency")) restart.frequency = values->integer("Frequency");
  if (values->has("Interval")) restart.interval = values->real("Interval");
  restart.minutes = values->real("Minutes");
  return restart;
}

Watch watch(const Values* values) {
  if (!values) return {};
  return {.stops = values->text("Beyond Limits") == "Stop",
          .stops_inverted = values->text("Inverted Points") == "Stop",
          .balance_error = values->real("Balance Error"),
          .smallest_step = values->real("Smallest Step"),
          .penetration = values->real("Penetration")};
}

// What has no meaning where nothing has inertia.
void check_quasi_static(const Deck& deck, Problems& problems) {
  if (!deck.solver.quasi_static) return;
  for (const Condition& condition : deck.conditions) {
    const bool is_velocity = condition.type == ConditionType::initial_velocity;
    if (!is_velocity && condition.type != ConditionType::open_end) continue;
    problems.add("Boundary Conditions > " + condition.name + " > Type",
                 std::string(is_velocity ? "'Initial Velocity'" : "'Non-Reflecting End'") +
                     " has no meaning with Solver > QuasiStatic, which knows no inertia; expected a prescribed "
                     "motion, a load, a plane or a tool");
  }
  for (const ContactModel& model : deck.contact_models) {
    if (model.friction == 0) continue;
    problems.add("Contact > Models > " + model.name + " > Friction Coefficient",
                 "'" + to_text(model.friction) +
                     "'; expected 0 with Solver > QuasiStatic: there, friction is that of "
                     "rigid planes and tools");
  }
}

Deck build(const Values& values, const fs::path& file, Problems& problems) {
  Deck deck;
  deck.file = file;
  deck.discretization = discretization(values.section("Discretization"), file, problems);
  deck.node_sets = node_sets(values.section("Node Sets"), problems);
  deck.materials = materials_of(values.section("Materials"), problems);
  deck.blocks = blocks(values.section("Blocks"), deck.materials, problems);
  if (const Values* contact = values.find("Contact")) {
    deck.contact_models = contact_models(contact->section("Models"));
    deck.interactions = interactions(contact->section("Interactions"), deck.contact_models, problems);
  }
  deck.conditions = conditions(values.section("Boundary Conditions"), problems);
  add_numbered_sets(values.section("Boundary Conditions"), file, deck.node_sets, problems);
  deck.solver = solver(values.section("Solver"), problems);
  check_quasi_static(deck, problems);
  deck.output = output(values.find("Output"), deck.solver, problems);
  deck.history = history(values.find("History"), deck.solver, problems);
  deck.restart = restart(values.find("Restart"), values.has_section("Restart"), file, problems);
  deck.watch = watch(values.find("Watch"));
  return deck;
}

// Files are looked at on one rank only: the others may not see them, and need not.
enum class FileCheck { no, yes };

Deck parse(const std::string& text, const fs::path& file, FileCheck file_check) {
  Problems problems;
  Deck deck;
  if (is_text_of_peridigm(text)) {
    problems.add("XML",
                 "this is no XML; Peridigm's other forms of a deck (indented text with aprepro's {…}, YAML) are "
                 "not read: write it as <ParameterList>s");
  } else if (auto list = parse_xml(text, problems)) {
    translate_peridigm(*list, problems);
    const Values values = check(*list, schema(), "", problems);
    deck = build(values, file, problems);
    deck.text = text;
    if (file_check == FileCheck::yes) {
      check_mesh(deck.discretization.mesh, problems);
      read_numbers(deck.node_sets, problems);
      check_files(deck, problems);
    }
  }
  problems.raise(file.string());
  deck.notes = problems.notes();
  return deck;
}

constexpr std::uintmax_t largest_deck = 1'000'000;  // bytes; a long one has twenty thousand

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!fs::exists(file)) throw Error(file.string() + ": the deck does not exist");
  if (!fs::is_regular_file(file) || !stream) throw Error(file.string() + ": the deck is not a file that can be read");
  if (fs::file_size(file) > largest_deck) {
    throw Error(file.string() + ": the deck has " + std::to_string(fs::file_size(file)) + " bytes, expected at most " +
                std::to_string(largest_deck));
  }
  std::ostringstream text;
  text << stream.rdbuf();
  const std::string byte_order_mark = "\xef\xbb\xbf";
  return text.str().substr(text.str().starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
}

}  // namespace

Deck read(const fs::path& file, const Communicator& communicator) {
  std::string text;
  Deck deck;
  run_on_root(communicator, [&] {
    text = contents(file);
    deck = parse(text, file, FileCheck::yes);
  });
  communicator.broadcast(text);
  if (communicator.rank() != 0) deck = parse(text, file, FileCheck::no);
  for (NodeSet& set : deck.node_sets) {
    if (!set.file.empty()) communicator.broadcast(*set.numbers);
  }
  return deck;
}

}  // namespace strut::deck
