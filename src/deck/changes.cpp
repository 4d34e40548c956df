#include "deck/changes.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "deck/check.hpp"
#include "deck/peridigm/peridigm.hpp"
#include "deck/whole.hpp"
#include "deck/yaml.hpp"

namespace strut::deck {

namespace {

using Texts = std::map<std::string, std::string>;  // values by the paths of their keys

Texts texts_of(const std::string& deck) {
  Problems ignored;
  Texts texts;
  if (auto list = parse_xml_or_yaml(deck, ignored)) {
    translate_peridigm(*list, {}, ignored);
    check(*list, schema(), "", ignored).add_texts(texts);
  }
  return texts;
}

const std::string section_text = Values::section_text;

std::string text_at(const Texts& texts, const std::string& path) {
  const auto found = texts.find(path);
  return found == texts.end() ? "not there" : found->second;
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

bool is_accepted(const std::string& path, const Texts& before, const Texts& now) {
  if (path == "Solver > Verlet > Mass Scaling dt") return false;  // moved points had another mass
  if (std::any_of(free_to_change.begin(), free_to_change.end(), [&](const char* one) { return is_within(path, one); }))
    return true;
  if (path.starts_with("Solver > QuasiStatic > ")) return true;
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

}  // namespace

Changes changes(const std::string& before, const std::string& now) {
  const Texts old_texts = texts_of(before), new_texts = texts_of(now);
  std::set<std::string> paths;
  for (const auto& [path, text] : old_texts) paths.insert(path);
  for (const auto& [path, text] : new_texts) paths.insert(path);
  Changes changes;
  std::string whole;  // a section that only one of both has: of its keys only those that are refused are named
  for (const std::string& path : paths) {
    const std::string was = text_at(old_texts, path), is = text_at(new_texts, path);
    const bool accepted = is_accepted(path, old_texts, new_texts), within = !whole.empty() && is_within(path, whole);
    if (was == is || (within && (accepted || !is_accepted(whole, old_texts, new_texts)))) continue;
    if (!within) whole = was == section_text || is == section_text ? path : "";
    auto& kind = accepted                                               ? changes.accepted
                 : is_load(path, old_texts) && is_load(path, new_texts) ? changes.loads
                                                                        : changes.refused;
    kind.push_back(path + ": " + was + " before, " + is + " now");
  }
  return changes;
}

}  // namespace strut::deck
