#include "deck/changes.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <string_view>

#include "base/errors.hpp"
#include "deck/check.hpp"
#include "deck/deck.hpp"
#include "deck/peridigm/peridigm.hpp"
#include "deck/yaml.hpp"

namespace strut::deck {

namespace {

using Texts = std::map<std::string, std::string>;  // values by the paths of their keys

struct Keys {
  Texts texts;
  std::vector<std::string> conditions;  // names in the deck's order, by which a run names what it keeps of them
};

Keys read_keys(const std::string& deck) {
  Problems ignored;
  Keys keys;
  if (auto list = parse_xml_or_yaml(deck, ignored)) {
    translate_peridigm(*list, {}, ignored);
    if (const List* conditions = find_list(*list, "Boundary Conditions")) {
      for (const List& one : conditions->lists) keys.conditions.push_back(one.name);
    }
    check(*list, schema(), "", ignored).add_texts(keys.texts);
  }
  return keys;
}

const std::string section_text = Values::section_text;

std::string text_at(const Texts& texts, const std::string& path) {
  const auto found = texts.find(path);
  return found == texts.end() ? "nothing" : found->second;
}

// "2000 before, 1000 now"; of long texts, as tables are, the part where they begin to differ.
std::string both(const std::string& was, const std::string& then, const std::string& is, const std::string& now) {
  constexpr std::size_t longest = 200, around = 60;
  const auto differ = std::mismatch(was.begin(), was.end(), is.begin(), is.end()).first - was.begin();
  const std::size_t from = std::max<std::size_t>(differ, around) - around;
  const auto shown = [&](const std::string& text) {
    if (std::max(was.size(), is.size()) <= longest || text.size() <= around) return text;
    const std::string end = from + 2 * around < text.size() ? "…" : "";
    return (from > 0 ? "…" : "") + text.substr(std::min(from, text.size()), 2 * around) + end;
  };
  return shown(was) + " " + then + ", " + shown(is) + " " + now;
}

bool is_within(const std::string& path, std::string_view parent) {
  return path == parent ||
         (path.starts_with(parent) && std::string_view(path).substr(parent.size()).starts_with(" > "));
}

// Keys that do not affect the past of a run.
constexpr std::array free_to_change = {"Solver > Final Time",
                                       "Solver > Wall Time",
                                       "Solver > Verbose",
                                       "Solver > Verlet",
                                       "Output > Output Frequency",
                                       "Output > Output Interval",
                                       "History > Frequency",
                                       "History > Interval",
                                       "Restart",
                                       "Watch"};

// True for columns of the history that follow the run from row to row: means of forces, and speeds of cracks.
bool has_a_past(const std::string& path, const Texts& texts) {
  constexpr std::string_view parent = "History > Variables > ";
  constexpr std::array with_past = {"Reaction_", "Instant_Reaction_", "Contact_Force_", "Instant_Contact_Force_",
                                    "Crack_Tip", "Crack_Speed"};
  if (!path.starts_with(parent) || text_at(texts, path) != "true") return false;
  const std::string column = path.substr(parent.size());
  return std::ranges::any_of(with_past, [&](const char* one) { return column.starts_with(one); });
}

// True for keys that decide on the mass that is added for a wanted step.
bool sets_masses(const std::string& path, const Texts& before, const Texts& now) {
  const std::string key = "Solver > Verlet > Mass Scaling dt";
  return path == key || (path == "Solver > Verlet > Safety Factor" && before.contains(key) && now.contains(key));
}

bool is_accepted(const std::string& path, const Texts& before, const Texts& now) {
  if (sets_masses(path, before, now)) return false;  // moved points had another mass
  if (std::any_of(free_to_change.begin(), free_to_change.end(), [&](const char* one) { return is_within(path, one); }))
    return true;
  if (path.starts_with("Solver > QuasiStatic > ")) return true;
  if (has_a_past(path, before) || has_a_past(path, now)) return false;
  for (const char* const sink : {"Output", "History"}) {  // a file that begins, or ends, with the new part of the run
    if (is_within(path, sink) && before.contains(sink) != now.contains(sink)) return true;
  }
  return false;
}

// True for the value of a load, which has no memory: a displacement would jump, an initial velocity has no effect.
bool is_load(const std::string& path, const Texts& now) {
  const std::string parent = "Boundary Conditions > ", key = " > Value";
  if (!path.starts_with(parent) || !path.ends_with(key)) return false;
  const std::string type = text_at(now, path.substr(0, path.size() - key.size()) + " > Type");
  return type == "Prescribed Velocity" || type == "Body Force";
}

std::set<std::string> paths_of(const Texts& some, const Texts& others) {
  std::set<std::string> paths;
  for (const auto& [path, text] : some) paths.insert(path);
  for (const auto& [path, text] : others) paths.insert(path);
  return paths;
}

// ---- Start From

// Where and how the points of a body begin, and what holds between them: another body would not be in equilibrium with
// the stress that it gets. The mesh itself is compared point by point.
constexpr std::array of_the_body = {"Discretization > Points",
                                    "Discretization > Influence Function",
                                    "Discretization > NeighborhoodType",
                                    "Discretization > Bond Filters",
                                    "Materials",
                                    "Blocks"};

// The type of a model by the name of its section.
std::string damage_type(const std::string& model, const Texts& texts) {
  return text_at(texts, "Damage Models > " + model + " > Damage Model");
}

bool is_ductile(const std::string& type) {
  return type == "Plastic Strain" || type == "Johnson-Cook" || type == "Cockcroft-Latham";
}

// True for keys of a criterion by which points fail or soften: how far a point is counts in parts of its constants.
bool is_of_failure(const std::string& path, const Texts& other) {
  const std::string parent = "Damage Models > ";
  if (!path.starts_with(parent)) return false;
  const std::size_t end = path.find(" > ", parent.size());
  const std::string type = damage_type(path.substr(parent.size(), end - parent.size()), other);
  return is_ductile(type) || type == "Cohesive Crack";
}

// Words on a model that a block did not have, if it counts what points have borne; else "".
std::string not_counted(const std::string& path, const Texts& other, const Texts& now) {
  if (!is_within(path, "Blocks") || !path.ends_with(" > Damage Model") || other.contains(path)) return "";
  const std::string type = damage_type(text_at(now, path), now);
  if (!is_ductile(type)) return "";
  return ": a model '" + type + "' counts from the beginning what points have borne, which that run has not";
}

bool is_of_the_body(const std::string& path, const Texts& other) {
  if (path.ends_with(" > Damage Model")) return other.contains(path);  // one may be added: no bond has broken yet
  if (is_of_failure(path, other)) return true;
  return std::any_of(of_the_body.begin(), of_the_body.end(), [&](const char* one) { return is_within(path, one); });
}

// The keys of the conditions of some types in one text each, without names.
std::multimap<std::string, std::string> keys_of(const Texts& texts, const std::set<std::string>& types) {
  std::multimap<std::string, std::string> names;  // by the keys
  for (const auto& [path, type] : texts) {
    const std::string parent = "Boundary Conditions > ", end = " > Type";
    if (!path.starts_with(parent) || !path.ends_with(end)) continue;
    if (!types.contains(type)) continue;
    const std::string name = path.substr(0, path.size() - end.size());
    std::string keys;
    for (const auto& [key, text] : texts) {
      if (key != name && is_within(key, name) && !key.ends_with(" > Stretch"))
        keys += key.substr(name.size()) + " " + text;
    }
    names.emplace(keys, name);
  }
  return names;
}

// True if the cracks of a section of Blocks open gradually (soften_cracks of setup/blocks.hpp; a horizon in m may be as
// long as that takes).
bool opens_gradually(const std::string& block, const Texts& texts) {
  const std::string model = text_at(texts, block + " > Damage Model"), type = damage_type(model, texts);
  if (type == "Cohesive Crack") return true;
  const bool is_given = texts.contains("Damage Models > " + model + " > Fracture Energy");
  if (type != "Critical Stretch" || !is_given || texts.contains("Solver > QuasiStatic")) return false;
  const std::string material = "Materials > " + text_at(texts, block + " > Material");
  if (text_at(texts, material + " > Material Model") != "Elastic Correspondence") return false;
  if (text_at(texts, material + " > Formulation") == "Quadratic Correspondence") return true;
  const std::string springs = text_at(texts, material + " > Stabilization");
  if (springs == "Silling" || springs == "None") return false;
  const auto factor = texts.find(block + " > Horizon Factor");
  return factor == texts.end() || std::strtod(factor->second.c_str(), nullptr) < 1.95;
}

// A point that has softened, and one whose bonds break at once, do not go on as the other.
void compare_cracks(const Texts& other, const Texts& now, std::vector<std::string>& refused) {
  const std::string end = " > Damage Model";
  for (const auto& [path, model] : now) {
    if (!is_within(path, "Blocks") || !path.ends_with(end) || !other.contains(path)) continue;
    const std::string block = path.substr(0, path.size() - end.size());
    const bool there = opens_gradually(block, other), here = opens_gradually(block, now);
    const std::string energy = "Damage Models > " + model + " > Fracture Energy";
    if (there && here && text_at(other, energy) != text_at(now, energy) && !is_of_failure(energy, other))
      refused.push_back(energy + ": " + both(text_at(other, energy), "there", text_at(now, energy), "here"));
    if (there == here) continue;
    refused.push_back(path + ": its cracks open gradually " + (there ? "there, and not here" : "here, and not there") +
                      " (a Fracture Energy of Critical Stretch acts so in explicit steps, but not with QuasiStatic; "
                      "alike are a Critical Stretch, Cohesive Crack, or the steps of a Solver 2)");
  }
}

// Symmetry planes and periodic sides make images of the points.
void compare_images(const Texts& other, const Texts& now, std::vector<std::string>& refused) {
  const std::set<std::string> types = {"Symmetry Plane", "Periodic Sides"};
  const auto before = keys_of(other, types), after = keys_of(now, types);
  for (const auto& [keys, name] : before) {
    if (!after.contains(keys)) refused.push_back(name + ": not there, or another one, now");
  }
  for (const auto& [keys, name] : after) {
    if (!before.contains(keys)) refused.push_back(name + ": not there, or another one, before");
  }
}

// The files that a run has written, as seen from the folder of its checkpoint, wherever it ran.
std::vector<std::filesystem::path> files_of(const Texts& texts) {
  const std::string checkpoint = "Restart > Filename";
  const std::filesystem::path named = texts.contains(checkpoint) ? texts.at(checkpoint) : "";
  const std::filesystem::path from_there = std::filesystem::path(".").lexically_relative(named.parent_path());
  std::vector<std::filesystem::path> files;
  for (const char* const key : {"Output > Output Filename", "History > Filename"}) {
    if (!texts.contains(key)) continue;
    std::filesystem::path file = texts.at(key);
    if (!file.has_extension() && std::string_view(key).starts_with("Output")) file += ".e";
    files.push_back(from_there / file);
  }
  return files;
}

}  // namespace

StartChanges start_changes(const std::string& other_deck, const std::string& deck) {
  const Keys other_keys = read_keys(other_deck), now_keys = read_keys(deck);
  const Texts &other = other_keys.texts, &now = now_keys.texts;
  StartChanges changes{.after_equilibria = other.contains("Solver > QuasiStatic"),
                       .same_solver = true,
                       .same_contact = true,
                       .same_conditions = true};
  std::string whole;  // a section that only one of both has: its keys are not named
  for (const std::string& path : paths_of(other, now)) {
    const std::string was = text_at(other, path), is = text_at(now, path);
    if (was == is) continue;
    const bool within = !whole.empty() && is_within(path, whole);
    if (!within) whole = was == section_text || is == section_text ? path : "";
    if (path == "Solver > QuasiStatic" || (is_within(path, "Solver > Verlet") && path != "Solver > Verlet > Rebalance"))
      changes.same_solver = false;
    // A Damage Model that is added changes the springs, whose forces and energies then begin anew.
    if (path.ends_with(" > Damage Model") && !other.contains(path)) changes.same_solver = false;
    if (is_within(path, "Contact")) changes.same_contact = false;
    if (is_within(path, "Boundary Conditions") || is_within(path, "Node Sets")) changes.same_conditions = false;
    if (sets_masses(path, other, now)) changes.masses = path + ": " + both(was, "there", is, "here");
    const std::string uncounted = not_counted(path, other, now);
    if ((is_of_the_body(path, other) || !uncounted.empty()) && !within)
      changes.refused.push_back(path + ": " + both(was, "there", is, "here") + uncounted);
  }
  compare_images(other, now, changes.refused);
  compare_cracks(other, now, changes.refused);
  changes.same_conditions = changes.same_conditions && other_keys.conditions == now_keys.conditions;
  changes.files = files_of(other);
  return changes;
}

Changes changes(const std::string& before, const std::string& now) {
  const Keys old_keys = read_keys(before), new_keys = read_keys(now);
  const Texts &old_texts = old_keys.texts, &new_texts = new_keys.texts;
  Changes changes;
  std::string whole;  // a section that only one of both has: of its keys only those that are refused are named
  for (const std::string& path : paths_of(old_texts, new_texts)) {
    const std::string was = text_at(old_texts, path), is = text_at(new_texts, path);
    const bool accepted = is_accepted(path, old_texts, new_texts), within = !whole.empty() && is_within(path, whole);
    if (was == is || (within && (accepted || !is_accepted(whole, old_texts, new_texts)))) continue;
    if (!within) whole = was == section_text || is == section_text ? path : "";
    auto& kind = accepted                                               ? changes.accepted
                 : is_load(path, old_texts) && is_load(path, new_texts) ? changes.loads
                                                                        : changes.refused;
    kind.push_back(path + ": " + both(was, "before", is, "now"));
  }
  const std::vector<std::string>&was = old_keys.conditions, &is = new_keys.conditions;
  if (was != is && std::ranges::is_permutation(was, is)) {
    changes.refused.push_back("Boundary Conditions, in their order: " + both(joined(was), "before", joined(is), "now"));
  }
  return changes;
}

}  // namespace strut::deck
