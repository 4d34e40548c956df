#include "deck/peridigm/peridigm.hpp"

#include <algorithm>
#include <cctype>

#include "base/errors.hpp"
#include "deck/numbers.hpp"

namespace strut::deck {

namespace {

template <class Named>
Named* find(std::vector<Named>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

// Peridigm compares these words without regard to case, and treats _ as a blank.
std::string tidied(std::string text) {
  text = std::string(trimmed(text));
  for (char& c : text) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// A key whose only value with a meaning here is the one that switches it off.
struct OnlyOff {
  const char *key, *off, *what;
};
const OnlyOff only_off[] = {
    {"Apply Shear Correction Factor", "false", "there is no correction of moduli at surfaces"},
    {"Enable Flaw", "false", "there are no flaws in a material; make them in the mesh"},
    {"Thermal Expansion Coefficient", "0", "there is no thermal expansion"},
    {"Apply Automatic Differentiation Jacobian", "", "equilibria are found in another way"},
    {"Finite Difference Probe Length", "", "equilibria are found in another way"},
};

bool is_off(const Parameter& parameter, const OnlyOff& key) {
  if (!*key.off) return true;
  const auto number = to_real(parameter.value);
  return tidied(parameter.value) == key.off || (number && *number == 0 && std::string(key.off) == "0");
}

void drop_what_is_off(List& material, const std::string& path, Problems& problems) {
  for (const OnlyOff& key : only_off) {
    const Parameter* given = find_parameter(material, key.key);
    if (!given) continue;
    const std::string where = path_to(path, key.key);
    if (!is_off(*given, key)) {
      problems.add(where, "'" + given->value + "'; expected " + key.off + ": " + key.what);
    } else if (!*key.off) {
      problems.note(where, std::string("has no effect here: ") + key.what);
    }
    erase_parameter(material, key.key);
  }
}

// Without a flaw, the parameters of the flaw have no effect.
void drop_flaw(List& material) {
  if (tidied(value_of(material, "Enable Flaw")) != "false") return;
  std::erase_if(material.parameters, [](const Parameter& one) { return one.name.starts_with("Flaw "); });
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
  problems.note(path_to(path, "Hourglass Coefficient"),
                "is taken as Stabilization 'Silling' with the coefficient " + coefficient +
                    ", which acts on the whole difference, not only along the bond as Peridigm's: displacements of its "
                    "deck PredictorFromPreviousSolver differ by 2 %, others may by more");
}

void translate_isotropic_hardening(List& material) {
  Parameter* model = find_parameter(material, "Material Model");
  if (!model || model->value != "Isotropic Hardening Correspondence") return;
  model->value = "Elastic Plastic Correspondence";
  List hardening{"Hardening", {{"Type", "string", "Linear"}}, {}};
  if (const Parameter* modulus = find_parameter(material, "Hardening Modulus"))
    hardening.parameters.push_back(*modulus);
  erase_parameter(material, "Hardening Modulus");
  material.lists.push_back(hardening);
}

void translate_materials(List& deck, Problems& problems) {
  List* materials = find_list(deck, "Materials");
  if (!materials) return;
  for (List& material : materials->lists) {
    const std::string path = "Materials > " + material.name;
    translate_isotropic_hardening(material);
    translate_hourglass(material, path, problems);
    drop_flaw(material);
    drop_what_is_off(material, path, problems);
  }
}

// Converts a horizon for all blocks, as in older decks.
void translate_horizon(List& discretization, List& blocks, Problems& problems) {
  const Parameter* given = find_parameter(discretization, "Horizon");
  if (!given) return;
  for (List& block : blocks.lists) {
    if (find_parameter(block, "Horizon") || find_parameter(block, "Horizon Factor")) return;
  }
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

void translate_conditions(List& deck) {
  List* conditions = find_list(deck, "Boundary Conditions");
  if (!conditions) return;
  for (List& condition : conditions->lists) {
    Parameter* set = find_parameter(condition, "Node Set");
    if (set && (tidied(set->value) == "full domain" || set->value == "All")) set->value = "all";
    Parameter* axis = find_parameter(condition, "Coordinate");
    if (axis && axis->value.size() == 1) axis->value = tidied(axis->value);
    Parameter* type = find_parameter(condition, "Type");
    for (const char* known : {"Initial Velocity", "Prescribed Displacement", "Body Force"}) {
      if (type && tidied(type->value) == tidied(known)) type->value = known;
    }
  }
}

// Converts another solver for the same equilibria.
void translate_nox(List& solver, Problems& problems) {
  List* nox = find_list(solver, "NOXQuasiStatic");
  if (!nox || find_list(solver, "QuasiStatic")) return;
  nox->name = "QuasiStatic";
  nox->lists.clear();
  std::erase_if(nox->parameters, [](const Parameter& one) { return one.name != "Number of Load Steps"; });
  problems.note("Solver > NOXQuasiStatic",
                "is taken as QuasiStatic, of all its keys Number of Load Steps: equilibria are found in another way");
}

void translate_solver(List& deck, Problems& problems) {
  List* solver = find_list(deck, "Solver");
  if (!solver) return;
  if (find_list(*solver, "Rebalance")) {
    erase_list(*solver, "Rebalance");
    problems.note("Solver > Rebalance", "has no effect here: the points stay with their ranks");
  }
  translate_nox(*solver, problems);
  List* equilibria = find_list(*solver, "QuasiStatic");
  Parameter* tolerance = equilibria ? find_parameter(*equilibria, "Relative Tolerance") : nullptr;
  if (!tolerance || find_parameter(*equilibria, "Tolerance")) return;
  tolerance->name = "Tolerance";
  problems.note("Solver > QuasiStatic > Relative Tolerance", "is taken as Tolerance");
}

}  // namespace

Parameter* find_parameter(List& list, const std::string& name) { return find(list.parameters, name); }

List* find_list(List& list, const std::string& name) { return find(list.lists, name); }

std::string value_of(const List& list, const std::string& name) {
  for (const Parameter& one : list.parameters) {
    if (one.name == name) return one.value;
  }
  return "";
}

void erase_parameter(List& list, const std::string& name) {
  std::erase_if(list.parameters, [&](const Parameter& one) { return one.name == name; });
}

void erase_list(List& list, const std::string& name) {
  std::erase_if(list.lists, [&](const List& one) { return one.name == name; });
}

void translate_peridigm(List& deck, Problems& problems) {
  const bool is_theirs = is_peridigms(deck);
  translate_blocks(deck, problems);
  translate_materials(deck, problems);
  translate_conditions(deck);
  translate_solver(deck, problems);
  translate_outputs(deck, problems);
  if (is_theirs) tell_differences(deck, problems);
}

}  // namespace strut::deck
