// Abilities of Peridigm that do not exist here are reported by name, once, with the reason. Keys and conditions that
// belong to them are taken out of the deck, so that no second message misleads.
#include <algorithm>
#include <map>

#include "base/errors.hpp"
#include "base/numbers.hpp"
#include "deck/peridigm/peridigm.hpp"

namespace strut::deck {

namespace {

const std::string associated =
    "gradients of a bond's own neighborhood (bond-associated) are not there; "
    "'Quadratic Correspondence' (Formulation) has no zero-energy modes either";
const std::string of_plasticity = "; plasticity is there by correspondence: 'Elastic Plastic Correspondence'";

const std::string no_heat_or_species = "no heat and no species flow here";

const std::map<std::string, std::string> missing_laws = {
    {"Elastic Plastic",
     "ordinary state-based plasticity is not there (with 'Disable Plasticity' it is 'Elastic')" + of_plasticity},
    {"Elastic Plastic Hardening", "ordinary state-based plasticity is not there" + of_plasticity},
    {"Pressure Dependent Elastic Plastic", "ordinary state-based plasticity is not there" + of_plasticity},
    {"Viscoelastic", "ordinary state-based viscoelasticity is not there, nor another viscoelastic law"},
    {"Multiphysics Elastic", "a solid with a fluid in its pores is not there"},
    {"Elastic Bond Based",
     "bond-based laws are not there, in two dimensions or three; 'Elastic' with a Poisson's "
     "ratio of 1/4 is the nearest, not the same near surfaces"},
    {"Pals",
     "position-aware influence functions are not there; 'Elastic Correspondence' is exact for affine motions, "
     "too"},
    {"Linear LPS Partial Volume", "partial volumes of neighbors are not there; 'Elastic' takes whole ones"},
    {"Elastic Partial Volume", "partial volumes of neighbors are not there; 'Elastic' takes whole ones"},
    {"Elastic Correspondence Partial Stress", "partial stresses are not there; 'Elastic Correspondence' is"},
    {"Diffusion", no_heat_or_species},
    {"Vector Poisson", "no fields but motion are computed here"},
    {"LCM", "laws of another library cannot be called"},
    {"Elastic Hypoelastic Correspondence", associated},
    {"Elastic Plastic Hypoelastic Correspondence", associated},
    {"Isotropic Hardening Hypoelastic Correspondence", associated},
    {"Elastic Bond Associated Correspondence", associated},
    {"Elastic Plastic Bond Associated Correspondence", associated},
    {"Isotropic Hardening Bond Associated Correspondence", associated},
};

const std::map<std::string, std::string> missing_damage = {
    {"Interface Aware", "bonds across an interface cannot have a model of their own; blocks can"},
    {"Initial Damage",
     "write its Bond Filters into Discretization > Bond Filters: bonds do not cross them from the "
     "start, and do not count as Damage"},
    {"Johnson Cook", "did you mean 'Johnson-Cook', which fails points by the strain of their metal?"},
    {"Von Mises Stress",
     "bonds do not break by stress; by stretch ('Critical Stretch'), energy ('Bond Energy') or the "
     "strain of a metal they do"},
};

const std::string no_heat =
    "no heat flows here: 'Prescribed Temperature' expands bodies, and a metal's own temperature begins with Blocks > "
    "Initial Temperature";
const std::string no_species = "no fluid and no species flow here";

// Conditions, by the words that their types hold.
std::string missing_condition(const std::string& type) {
  const std::string words = tidied(type);
  const auto holds = [&words](const char* word) { return words.find(word) != std::string::npos; };
  if (words == "prescribed temperature") return "";
  if (holds("temperature") || holds("thermal") || holds("heat")) return no_heat;
  if (holds("fluid") || holds("concentration") || holds("pressure")) return no_species;
  return "";
}

// Solvers, also as sections of Solver.
const std::map<std::string, std::string> missing_solvers = {
    {"Implicit",
     "implicit dynamics (Newmark's method) is not there; there are 'Verlet', and 'QuasiStatic' for loads without "
     "inertia"},
    {"ImplicitDiffusion", no_heat_or_species},
};

const std::map<std::string, std::string> missing_contact = {
    {"Time-Dependent Short Range Force", "a friction that changes with time is not there; 'Short Range Force' has one"},
    {"Time Dependent Short Range Force", "a friction that changes with time is not there; 'Short Range Force' has one"},
};

const std::map<std::string, std::string> missing_sections = {
    {"Interfaces", "there are no interfaces between elements"},
    {"Data Loader", "fields are not read from files; conditions take expressions of x, y, z and t"},
};

const std::map<std::string, std::string> missing_of_mesh = {
    {"Construct Interfaces", "there are no interfaces between elements"},
    {"Compute Element-Horizon Intersections", "partial volumes of neighbors are not there"},
    {"Input FEM Topology File", "finite elements are not coupled"},
};

// Replaces a missing law by a plain one, so that the rest of the deck can be checked.
void stand_in_for_law(List& deck, List& material, const std::string& why) {
  material = {material.name,
              {{"Material Model", "string", "Elastic"},
               {"Density", "double", "1"},
               {"Bulk Modulus", "double", "1"},
               {"Shear Modulus", "double", "1"}},
              {}};
  if (why != associated) return;
  std::erase_if(deck.parameters, [](const Parameter& one) { return one.name.starts_with("Enable Bond-Associated"); });
}

void stand_in_for_damage(List& deck, List& model, const std::string&) {
  model = {model.name, {{"Damage Model", "string", "Critical Stretch"}, {"Critical Stretch", "double", "1"}}, {}};
  for (List& block : sections_of(deck, {"Blocks"})) {
    if (value_of(block, "Damage Model") == model.name) erase_parameter(block, "Damage Model");
  }
}

void stand_in_for_contact(List&, List& model, const std::string&) {
  find_parameter(model, "Contact Model")->value = "Short Range Force";
  erase_parameter(model, "Friction Coefficient");
}

// `path`: of sections whose `key` may name something that is missing.
void refuse_models(List& deck, std::initializer_list<const char*> path, const std::string& key,
                   const std::map<std::string, std::string>& missing,
                   void (*stand_in)(List& deck, List& model, const std::string& why), Problems& problems) {
  const std::string section = joined({path.begin(), path.end()}, " > ");
  for (List& model : sections_of(deck, path)) {
    const auto found = missing.find(value_of(model, key));
    if (found == missing.end()) continue;
    problems.add(section + " > " + model.name + " > " + key, "'" + found->first + "': " + found->second);
    stand_in(deck, model, found->second);
  }
}

// Also removes the keys that choose the fields of several physics. Explicit steps stand in for a missing solver.
void refuse_solvers(List& deck, Problems& problems) {
  erase_parameter(deck, "Multiphysics");
  for (List& solver : deck.lists) {
    if (!solver.name.starts_with("Solver")) continue;
    std::erase_if(solver.parameters, [](const Parameter& one) { return one.name.starts_with("Solve For "); });
    for (const auto& [name, why] : missing_solvers) {
      List* missing = find_list(solver, name);
      if (!missing) continue;
      problems.add(path_to(solver.name, name), why);
      *missing = {"Verlet", {{"Safety Factor", "double", "0.8"}}, {}};
    }
  }
}

// A horizon that is an expression, and the default one of a block that has none.
void refuse_horizons(List& deck, Problems& problems) {
  for (List& block : sections_of(deck, {"Blocks"})) {
    const std::string horizon = value_of(block, "Horizon");
    const bool is_function = horizon.find_first_of("xyz") != std::string::npos;
    if (!is_function || to_real(horizon)) continue;
    problems.add("Blocks > " + block.name + " > Horizon",
                 "'" + horizon +
                     "': a horizon that varies within a block is a number of spacings here, Horizon Factor, and no "
                     "function of position");
    erase_parameter(block, "Horizon");
    block.parameters.push_back({"Horizon Factor", "double", "3"});
  }
}

void refuse_conditions(List& deck, Problems& problems) {
  List* conditions = find_list(deck, "Boundary Conditions");
  if (!conditions) return;
  std::erase_if(conditions->lists, [&problems](const List& condition) {
    const std::string type = value_of(condition, "Type"), why = missing_condition(type);
    if (why.empty()) return false;
    problems.add("Boundary Conditions > " + condition.name + " > Type", "'" + type + "': " + why);
    return true;
  });
}

void refuse_sections(List& deck, Problems& problems) {
  for (const auto& [name, why] : missing_sections) {
    if (!find_list(deck, name)) continue;
    problems.add(name, "unknown section; " + why);
    erase_list(deck, name);
  }
  List* mesh = find_list(deck, "Discretization");
  if (!mesh) return;
  for (const auto& [name, why] : missing_of_mesh) {
    const Parameter* given = find_parameter(*mesh, name);
    if (!given) continue;
    if (tidied(given->value) != "false") problems.add("Discretization > " + name, "'" + given->value + "': " + why);
    erase_parameter(*mesh, name);
  }
  std::erase_if(mesh->parameters,
                [](const Parameter& one) { return one.name.starts_with("Element-Horizon Intersection"); });
}

}  // namespace

bool has_missing_ability(List& deck) {
  const auto is_missing = [](const List& one) { return missing_laws.contains(value_of(one, "Material Model")); };
  return find_list(deck, "Data Loader") || std::ranges::any_of(sections_of(deck, {"Materials"}), is_missing);
}

void refuse_what_is_missing(List& deck, Problems& problems) {
  refuse_sections(deck, problems);
  refuse_models(deck, {"Materials"}, "Material Model", missing_laws, stand_in_for_law, problems);
  refuse_models(deck, {"Damage Models"}, "Damage Model", missing_damage, stand_in_for_damage, problems);
  refuse_conditions(deck, problems);
  refuse_models(deck, {"Contact", "Models"}, "Contact Model", missing_contact, stand_in_for_contact, problems);
  refuse_solvers(deck, problems);
  refuse_horizons(deck, problems);
}

}  // namespace strut::deck
