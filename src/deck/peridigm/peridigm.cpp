#include "deck/peridigm/peridigm.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "base/errors.hpp"
#include "base/math/tensors.hpp"
#include "base/numbers.hpp"

namespace strut::deck {

namespace {

template <class Named>
Named* find(std::vector<Named>& all, const std::string& name) {
  const auto found = std::ranges::find(all, name, &Named::name);
  return found == all.end() ? nullptr : &*found;
}

const char* const needleman = "Viscoplastic Needleman Correspondence";

// Keys without effect here, which get a note unless they are false.
const std::pair<const char*, const char*> without_effect_here[] = {
    {"Apply Shear Correction Factor",
     "there is no correction of moduli at surfaces (Peridigm 1.6 has it for 'Elastic Plastic Hardening' alone)"},
    {"Apply Automatic Differentiation Jacobian", "equilibria are found in another way"},
    {"Finite Difference Probe Length", "equilibria are found in another way"},
};

void drop_what_is_off(List& material, const std::string& path, Problems& problems) {
  const Parameter* flaw = find_parameter(material, "Enable Flaw");
  if (flaw && tidied(flaw->value) != "false") {
    problems.add(path_to(path, flaw->name),
                 "'" + flaw->value + "'; expected false: there are no flaws in a material; make them in the mesh");
  }
  erase_parameter(material, "Enable Flaw");
  for (const auto& [key, why] : without_effect_here) {
    const Parameter* given = find_parameter(material, key);
    if (given && tidied(given->value) != "false")
      problems.note(path_to(path, key), std::string("has no effect here: ") + why);
    erase_parameter(material, key);
  }
}

// Drops the parameters of a flaw: without a flaw they have no effect; with one, the error about the flaw is enough.
void drop_flaw(List& material) {
  if (!find_parameter(material, "Enable Flaw")) return;
  std::erase_if(material.parameters, [](const Parameter& one) { return one.name.starts_with("Flaw "); });
}

// Drops the coefficient from other laws than those by correspondence.
void drop_hourglass(List& material, const std::string& path, Problems& problems) {
  const std::string model = value_of(material, "Material Model"), key = "Hourglass Coefficient";
  if (!find_parameter(material, key) || model.ends_with("Correspondence") || model.empty()) return;
  erase_parameter(material, key);
  problems.note(path_to(path, key), "has no effect, as in Peridigm: '" + model + "' has no zero-energy modes");
}

// Peridigm's spring acts along the bond, with 18 K C/(π δ⁴) over the bond's length; ours acts on the whole residual,
// which is mostly transverse where strain varies smoothly. For its deck PredictorFromPreviousSolver, 7³ points, ours
// with C/4 gives displacements within 2.1 % and the reaction within 0.3 %, with 2 C within 30 and 12 %.
void translate_hourglass(List& material, const std::string& path, Problems& problems) {
  const Parameter* given = find_parameter(material, "Hourglass Coefficient");
  const bool by_correspondence = value_of(material, "Material Model").ends_with("Correspondence");
  const bool own = find_parameter(material, "Stabilization") || find_parameter(material, "Stabilization Coefficient");
  const auto number = given ? to_real(given->value) : std::nullopt;
  if (!number || !(*number >= 0) || !by_correspondence || own) return;
  erase_parameter(material, "Hourglass Coefficient");
  if (*number == 0) {
    material.parameters.push_back({"Stabilization", "string", "None"});
    return;
  }
  const std::string coefficient = to_text(0.25 * *number);
  material.parameters.push_back({"Stabilization", "string", "Silling"});
  material.parameters.push_back({"Stabilization Coefficient", "double", coefficient});
  problems.note(
      path_to(path, "Hourglass Coefficient"),
      "is taken as Stabilization 'Silling' with the coefficient " + coefficient +
          ", which acts on the whole difference, not only along the bond as Peridigm's: displacements of its "
          "deck PredictorFromPreviousSolver and stresses differ by 2 %, plastic strains where flow begins by 40 %, "
          "others may by more");
}

// Peridigm's switch turns its plastic ordinary solid into the elastic one.
void translate_disabled_plasticity(List& material, const std::string& path, Problems& problems) {
  Parameter* model = find_parameter(material, "Material Model");
  const bool disabled = tidied(value_of(material, "Disable Plasticity")) == "true";
  erase_parameter(material, "Disable Plasticity");
  if (!model || !disabled || !tidied(model->value).starts_with("elastic plastic") ||
      model->value.ends_with("Correspondence"))
    return;
  model->value = "Elastic";
  for (const char* key : {"Yield Stress", "Hardening Modulus"}) erase_parameter(material, key);
  problems.note(path_to(path, "Disable Plasticity"), "makes it the law 'Elastic', as in Peridigm");
}

// Moves a key, if it is there, into a section of its own.
void move(List& material, const char* from, List& section, const char* to) {
  const Parameter* given = find_parameter(material, from);
  if (!given) return;
  section.parameters.push_back({to, given->type, given->value});
  erase_parameter(material, from);
}

void translate_isotropic_hardening(List& material) {
  Parameter* model = find_parameter(material, "Material Model");
  if (!model || model->value != "Isotropic Hardening Correspondence") return;
  model->value = "Elastic Plastic Correspondence";
  List hardening{"Hardening", {{"Type", "string", "Linear"}}, {}};
  move(material, "Hardening Modulus", hardening, "Hardening Modulus");
  material.lists.push_back(hardening);
}

// σ̄ = σ_y (1 + ε̄/ε̄₀)^N/(1 + (ε̄/ε̄₁)²) (ε̇/ε̇₀)^M
void translate_needleman(List& material, const std::string& path, Problems& problems) {
  Parameter* model = find_parameter(material, "Material Model");
  if (!model || model->value != needleman) return;
  model->value = "Elastic Plastic Correspondence";
  List hardening{"Hardening", {{"Type", "string", "Needleman"}}, {}},
      rate{"Rate", {{"Type", "string", "Needleman"}}, {}};
  move(material, "Strain Hardening Exponent", hardening, "Exponent");
  move(material, "Reference Strain 0", hardening, "Reference Strain");
  move(material, "Reference Strain 1", hardening, "Softening Strain");
  move(material, "Rate Hardening Exponent", rate, "Exponent");
  move(material, "Reference Strain Rate", rate, "Reference Rate");
  material.lists.push_back(hardening), material.lists.push_back(rate);
  problems.note(
      path_to(path, "Reference Strain Rate"),
      "is the slowest rate that counts: below it the flow stress is that of this rate, in Peridigm it falls on; "
      "above it the law is the same, but Peridigm looks for the flow at other strains than it then takes");
}

// Here the stretch that breaks a bond never includes thermal expansion; Peridigm has a key for that, 0 without it.
void drop_expansion_of_bonds(List& deck, bool is_theirs, Problems& problems) {
  if (!find_list(deck, "Materials")) return;
  const std::string key = "Thermal Expansion Coefficient";
  for (List& model : sections_of(deck, {"Damage Models"})) {
    const auto given = real_of(model, key);
    const bool is_same = std::ranges::all_of(sections_of(deck, {"Materials"}), [&](const List& one) {
      return real_of(one, key).value_or(0) == given.value_or(0);
    });
    if (!is_same && (given || is_theirs)) {
      problems.note(path_to("Damage Models > " + model.name, key),
                    std::string(given ? "has no effect here" : "is missing") +
                        ": the stretch of a bond counts beyond α ΔT of its material; in Peridigm " +
                        (given ? "beyond " + to_text(*given) + " ΔT" : "the whole counts"));
    }
    erase_parameter(model, key);
  }
}

void translate_materials(List& deck, bool is_theirs, Problems& problems) {
  for (List& material : sections_of(deck, {"Materials"})) {
    const std::string path = "Materials > " + material.name;
    translate_isotropic_hardening(material);
    translate_needleman(material, path, problems);
    translate_disabled_plasticity(material, path, problems);
    drop_hourglass(material, path, problems);
    translate_hourglass(material, path, problems);
    drop_flaw(material);
    drop_what_is_off(material, path, problems);
  }
  drop_expansion_of_bonds(deck, is_theirs, problems);
}

// Converts a horizon for all blocks, as in older decks.
void translate_horizon(List& discretization, List& blocks, Problems& problems) {
  const Parameter* given = find_parameter(discretization, "Horizon");
  const auto has_own = [](List& block) {
    return find_parameter(block, "Horizon") || find_parameter(block, "Horizon Factor");
  };
  if (!given || std::ranges::any_of(blocks.lists, has_own)) return;
  for (List& block : blocks.lists) block.parameters.push_back(*given);
  erase_parameter(discretization, "Horizon");
  problems.note("Discretization > Horizon", "is taken for every section of Blocks");
}

// Makes a section, and a body, of each block of the mesh.
void separate(List& blocks, Problems& problems) {
  std::vector<List> apart;
  for (const List& block : blocks.lists) {
    const std::vector<std::string> names = to_words(value_of(block, "Block Names"));
    for (const std::string& name : names) {
      List one = block;
      if (names.size() > 1) one.name += " (" + name + ")";
      find_parameter(one, "Block Names")->value = name;
      if (!find_parameter(one, "Separate Body")) one.parameters.push_back({"Separate Body", "bool", "true"});
      apart.push_back(one);
      if (name != "default" && name != "all") continue;
      problems.add("Discretization > Omit Bonds Between Blocks",
                   "'All' with the block name '" + name + "' in Blocks > " + block.name + "; expected names of blocks");
    }
    if (names.empty()) apart.push_back(block);
  }
  blocks.lists = apart;
}

void translate_omitted_bonds(List& discretization, List& blocks, Problems& problems) {
  const std::string key = "Omit Bonds Between Blocks";
  const Parameter* given = find_parameter(discretization, key);
  if (!given) return;
  const std::string value = tidied(given->value);
  if (value == "all") {
    separate(blocks, problems);
  } else if (value != "none") {
    problems.add("Discretization > " + key, "'" + given->value + "'; expected All or None");
  }
  erase_parameter(discretization, key);
}

void translate_blocks(List& deck, Problems& problems) {
  List *discretization = find_list(deck, "Discretization"), *blocks = find_list(deck, "Blocks");
  if (!discretization || !blocks) return;
  for (List& block : blocks->lists) {
    Parameter* names = find_parameter(block, "Block Names");
    if (names && tidied(names->value) == "default") names->value = "default";
  }
  translate_horizon(*discretization, *blocks, problems);
  translate_omitted_bonds(*discretization, *blocks, problems);
}

// Peridigm's defaults, where ours differ.
void add_defaults(List& mesh, Problems& problems) {
  const auto add = [&](const std::string& key, const std::string& value) {
    if (!find_parameter(mesh, key)) mesh.parameters.push_back({key, "string", value});
  };
  add("Degenerate Points", "Keep");
  if (value_of(mesh, "Type") != "PdQuickGrid" || find_parameter(mesh, "NeighborhoodType")) return;
  add("NeighborhoodType", "Box");
  problems.note("Discretization > NeighborhoodType",
                "is missing: families are boxes of cells, as in Peridigm, not the points within the horizon");
}

// A filter's vector from three keys, written back as such.
const char* const axis_endings[] = {"_X", "_Y", "_Z"};

std::optional<Vector> vector_of(List& filter, const std::string& name) {
  Vector vector;
  for (int c = 0; c < 3; ++c) {
    const auto part = real_of(filter, name + axis_endings[c]);
    if (!part) return std::nullopt;
    vector[c] = *part;
  }
  return vector;
}

// Peridigm takes the bottom vector as it is: of one that is not of unit length, or leaves the plane, its part in the
// plane counts, and both edges are measured in units of that.
void straighten(List& filter, const std::string& path, Problems& problems) {
  const auto normal = vector_of(filter, "Normal"), bottom = vector_of(filter, "Bottom_Unit_Vector");
  if (!normal || !bottom || normal->norm() == 0) return;
  const Vector n = normal->normalized(), along = *bottom - n * n.dot(*bottom);
  const double unit = along.norm();
  if (unit < 1e-6 || (std::abs(unit - 1) < 1e-6 && std::abs(n.dot(*bottom)) < 1e-6)) return;
  for (int c = 0; c < 3; ++c)
    find_parameter(filter, std::string("Bottom_Unit_Vector") + axis_endings[c])->value = to_text(along[c] / unit);
  for (const char* edge : {"Bottom_Length", "Side_Length"}) {
    Parameter* length = find_parameter(filter, edge);
    const auto number = length ? to_real(length->value) : std::nullopt;
    if (number) length->value = to_text(*number / unit);
  }
  problems.note(path + " > Bottom_Unit_Vector_X",
                "is no unit vector in the plane: its part there counts, of length " + to_text(unit) +
                    ", in units of whose inverse the edges are, as in Peridigm; bonds that touch an "
                    "edge are cut, in Peridigm by round-off");
}

// Peridigm watches nothing: its runs go on, and so do these, with a warning.
void go_on_beyond_limits(List& deck) {
  if (!find_list(deck, "Watch")) deck.lists.push_back({"Watch", {{"Beyond Limits", "string", "Continue"}}, {}});
}

void read_mesh_as_peridigm(List& deck, Problems& problems) {
  List* mesh = find_list(deck, "Discretization");
  if (!mesh) return;
  add_defaults(*mesh, problems);
  for (List& filter : sections_of(*mesh, {"Bond Filters"}))
    straighten(filter, "Discretization > Bond Filters > " + filter.name, problems);
}

void translate_conditions(List& deck) {
  for (List& condition : sections_of(deck, {"Boundary Conditions"})) {
    Parameter* set = find_parameter(condition, "Node Set");
    if (set && (tidied(set->value) == "full domain" || set->value == "All")) set->value = "all";
    Parameter* axis = find_parameter(condition, "Coordinate");
    if (axis && axis->value.size() == 1) axis->value = tidied(axis->value);
    Parameter* type = find_parameter(condition, "Type");
    for (const char* known : {"Initial Displacement", "Initial Velocity", "Prescribed Displacement",
                              "Prescribed Temperature", "Body Force"}) {
      if (type && tidied(type->value) == tidied(known)) type->value = known;
    }
  }
}

}  // namespace

std::string tidied(std::string text) {
  text = std::string(trimmed(text));
  for (char& c : text) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

Parameter* find_parameter(List& list, const std::string& name) { return find(list.parameters, name); }

List* find_list(List& list, const std::string& name) { return find(list.lists, name); }

std::span<List> sections_of(List& deck, std::initializer_list<const char*> path) {
  List* list = &deck;
  for (const char* name : path) {
    list = find_list(*list, name);
    if (!list) return {};
  }
  return list->lists;
}

std::string value_of(const List& list, const std::string& name) {
  const auto found = std::ranges::find(list.parameters, name, &Parameter::name);
  return found == list.parameters.end() ? "" : found->value;
}

std::optional<double> real_of(const List& list, const std::string& name) { return to_real(value_of(list, name)); }

void erase_parameter(List& list, const std::string& name) {
  std::erase_if(list.parameters, [&](const Parameter& one) { return one.name == name; });
}

void erase_list(List& list, const std::string& name) {
  std::erase_if(list.lists, [&](const List& one) { return one.name == name; });
}

bool translate_peridigm(List& deck, const std::filesystem::path& folder, Problems& problems) {
  const bool is_theirs = is_peridigms(deck), differs = may_be_peridigms(deck);
  if (is_theirs) read_as_peridigm(deck, folder, problems);
  if (is_theirs) read_mesh_as_peridigm(deck, problems);
  if (is_theirs) go_on_beyond_limits(deck);
  translate_blocks(deck, problems);
  translate_materials(deck, is_theirs, problems);
  translate_conditions(deck);
  refuse_what_is_missing(deck, problems);
  translate_solvers(deck, is_theirs, problems);
  if (is_theirs) translate_displacements(deck, problems);
  translate_outputs(deck, is_theirs, problems);
  if (differs) tell_differences(deck, problems);
  return is_theirs;
}

}  // namespace strut::deck
