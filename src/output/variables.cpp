#include "output/variables.hpp"

#include <algorithm>
#include <set>

#include "base/errors.hpp"
#include "deck/problems.hpp"
#include "io/exodus/exodus.hpp"
#include "io/text/history.hpp"

namespace strut {

namespace {

const std::string where = "History > Variables";
const std::vector<std::string> reaction_names = {"Reaction_X", "Reaction_Y", "Reaction_Z"};
const std::vector<std::string> contact_names = {"Contact_Force_X", "Contact_Force_Y", "Contact_Force_Z"};
const std::vector<std::string> crack_names = {"Crack_Tip", "Crack_Speed"};

const std::string instant = "Instant_";

std::string before_bracket(const std::string& name) { return name.substr(0, name.find('(')); }

bool is_instant(const std::string& name) { return name.starts_with(instant); }
std::string without_instant(const std::string& name) { return is_instant(name) ? name.substr(instant.size()) : name; }

// True if the name begins with the word or resembles one of `names`.
bool means(const std::string& name, const std::string& first_word, const std::vector<std::string>& names) {
  const std::string kind = before_bracket(name);
  return kind.starts_with(first_word) || !did_you_mean(kind, names).empty();
}

bool is_of_crack(const std::string& name) {
  const bool is_of_points = before_bracket(name) == "Crack_Work";  // of a probe
  return !is_of_points && means(name, "Crack", crack_names);
}

bool reacts(const ConditionPrototype& kind) {
  return std::visit([]<class Type>(const Type&) { return Reacts<Type>; }, kind);
}

// The index in the deck of the condition with this name; throws if it has no reaction.
int reacting_condition(const std::vector<deck::Condition>& conditions, const std::string& wanted,
                       const std::string& path) {
  std::vector<std::string> valid;
  for (std::size_t place = 0; place < conditions.size(); ++place) {
    if (!reacts(conditions[place].kind)) continue;
    if (conditions[place].name == wanted) return static_cast<int>(place);
    valid.push_back(conditions[place].name);
  }
  const std::string expected = "' is no section of Boundary Conditions that has a reaction force";
  throw Error(path + ": '" + wanted + expected + did_you_mean(wanted, valid) + "; there " +
              (valid.empty() ? "is none" : "are " + joined(valid)));
}

// Parses "Kind(wanted)" after `prefix`: the index of Kind in `kinds`, and the text in parentheses. `of`: the deck
// section that names may refer to.
std::pair<std::size_t, std::string> in_brackets(const std::string& name, const std::vector<std::string>& kinds,
                                                const std::string& of, const std::string& example,
                                                const std::string& prefix = "") {
  const std::string rest = name.substr(prefix.size()), kind = before_bracket(rest);
  const auto found = std::find(kinds.begin(), kinds.end(), kind);
  if (found == kinds.end() || kind == rest || name.back() != ')') {
    throw Error(where + " > " + name + ": expected one of " + joined(kinds) + did_you_mean(kind, kinds) +
                " and in brackets the name of a section of " + of + ", e.g. " + example);
  }
  return {found - kinds.begin(), rest.substr(kind.size() + 1, rest.size() - kind.size() - 2)};
}

ReactionComponent reaction(const std::vector<deck::Condition>& conditions, const std::string& name) {
  const auto [component, wanted] =
      in_brackets(name, reaction_names, "Boundary Conditions", "Reaction_Z(wall)", is_instant(name) ? instant : "");
  return {name, reacting_condition(conditions, wanted, where + " > " + name), static_cast<int>(component),
          is_instant(name)};
}

// Parses "Crack_Tip(notch)": the section of the deck, and the index in crack_names.
std::pair<const deck::WatchedCrack*, std::size_t> watched_crack(const std::vector<deck::WatchedCrack>& watched,
                                                                const std::string& name) {
  const auto [kind, wanted] = in_brackets(name, crack_names, "History > Cracks", "Crack_Tip(notch)");
  const auto is_wanted = [&wanted = wanted](const deck::WatchedCrack& crack) { return crack.name == wanted; };
  const auto found = std::find_if(watched.begin(), watched.end(), is_wanted);
  if (found != watched.end()) return {&*found, kind};
  std::vector<std::string> valid;
  for (const deck::WatchedCrack& crack : watched) valid.push_back(crack.name);
  throw Error(where + " > " + name + ": '" + wanted + "' is no section of History > Cracks" +
              did_you_mean(wanted, valid) + "; there " + (valid.empty() ? "is none" : "are " + joined(valid)));
}

// Collective. Adds the crack if this is its first column.
CrackColumn crack_column(const std::vector<deck::WatchedCrack>& watched, const Body& body, const std::string& name,
                         std::vector<CrackTip>& cracks) {
  const auto [crack, kind] = watched_crack(watched, name);
  const auto is_it = [crack = crack](const CrackTip& one) { return one.name() == crack->name; };
  const auto known = std::find_if(cracks.begin(), cracks.end(), is_it);
  const std::size_t place = known - cracks.begin();
  if (known == cracks.end()) cracks.emplace_back(*crack, body);
  return {name, place, kind == 1};
}

// The index of a block by its name; throws if there is none.
int block_of(const std::vector<std::string>& names, const std::string& wanted, const std::string& path) {
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  throw Error(path + ": there is no block '" + wanted + "'" + did_you_mean(wanted, names) + "; there are " +
              joined(names));
}

// The colon between the names of two blocks, which may have colons themselves.
std::size_t colon_between(const std::vector<std::string>& blocks, const std::string& name, const std::string& path) {
  const auto is_block = [&](const std::string& part) { return std::ranges::find(blocks, part) != blocks.end(); };
  const std::size_t begin = std::min(name.find('('), name.size() - 1) + 1;
  std::vector<std::size_t> colons;
  for (std::size_t at = name.find(':', begin); at != std::string::npos; at = name.find(':', at + 1)) {
    if (is_block(name.substr(begin, at - begin)) && is_block(name.substr(at + 1, name.size() - at - 2)))
      colons.push_back(at);
  }
  if (colons.size() > 1)
    throw Error(path + ": it names two pairs of blocks, since their names have colons; expected other names");
  return colons.empty() ? name.find(':') : colons.front();
}

// Does not check that they can touch.
ContactComponent contact_component(const std::vector<std::string>& blocks, const std::string& name) {
  const std::string path = where + " > " + name;
  const std::string kind = before_bracket(without_instant(name));
  const auto found = std::find(contact_names.begin(), contact_names.end(), kind);
  const std::size_t bracket = name.find('('), colon = colon_between(blocks, name, path);
  if (found == contact_names.end() || bracket == std::string::npos || name.back() != ')' ||
      colon == std::string::npos) {
    throw Error(path + ": expected one of " + joined(contact_names) + did_you_mean(kind, contact_names) +
                " and in brackets two blocks, e.g. Contact_Force_Z(foam:plate), the force on foam from plate");
  }
  const int first = block_of(blocks, name.substr(bracket + 1, colon - bracket - 1), path);
  const int second = block_of(blocks, name.substr(colon + 1, name.size() - colon - 2), path);
  if (first == second) throw Error(path + ": the forces of a block on itself add up to nothing; expected two blocks");
  return {name, first, second, static_cast<int>(found - contact_names.begin()), is_instant(name)};
}

ContactComponent contact_force(const contact::Contact& contact, const std::vector<std::string>& blocks,
                               const std::string& name) {
  const ContactComponent force = contact_component(blocks, name);
  if (contact.between(force.first, force.second)) return force;
  throw Error(where + " > " + name +
              ": these blocks cannot touch; expected an interaction of both in Contact > Interactions");
}

// "Displacement_Z(tip)" of a probe: the mean over its one point, "Mean_Displacement_Z(tip)". Other names stay.
std::string with_mean(const std::vector<deck::NodeSet>& sets, const std::string& name) {
  if (Reduction::is_mean(name) || Reduction::is_extreme(name)) return name;
  const bool is_of_probe = std::ranges::any_of(
      sets, [&](const deck::NodeSet& probe) { return probe.nearest && name.ends_with("(" + probe.name + ")"); });
  return is_of_probe ? "Mean_" + name : name;
}

// Collective. For variables whose zeros in blocks of other laws would be taken for values.
void check_exists(bool exists, const std::string& name) {
  if (exists) return;
  throw Error(where + " > " + name +
              ": there are points only whose material has no such variable; expected a block or set where one has it");
}

template <class LookUp>
void attempt(deck::Problems& problems, const LookUp& look_up) {
  try {
    look_up();
  } catch (const Error& error) {
    problems.add(error.what());
  }
}

// Collective. The checks of output_variables_of that need only names.
void look_up(const deck::Deck& deck, const std::vector<Observable>& all, const PointCloud& cloud,
             const Communicator& communicator, const std::string& name) {
  if (means(without_instant(name), "Reaction", reaction_names)) {
    reaction(deck.conditions, name);
  } else if (is_of_crack(name)) {
    const deck::WatchedCrack& crack = *watched_crack(deck.history.cracks, name).first;
    if (!cloud.block_names.empty())
      PointGroup(cloud, crack.node_set, "History > Cracks > " + crack.name + " > Node Set");  // throws if there is none
  } else if (cloud.block_names.empty()) {
    return;  // the other names need the mesh
  } else if (means(without_instant(name), "Contact", contact_names)) {
    contact_component(cloud.block_names, name);
  } else {
    check_reduction(all, deck.history.profiles, cloud, communicator, with_mean(deck.node_sets, name), where);
  }
}

// The observables of the bodies that the deck describes; all if its laws are unknown because of errors.
std::vector<Observable> observables_of(const deck::Deck& deck, const deck::Problems& problems) {
  if (problems.about("Materials") || problems.about("Damage Models")) return observables_of_all_laws();
  std::vector<materials::AnyLaw> laws;
  for (const deck::Material& material : deck.materials) {
    laws.push_back(material.law);
    for (const deck::NamedDamageModel& damage : deck.damage_models) {
      if (damage.model.is_gradual || damage.model.fracture_energy > 0) {  // the block's horizon decides
        if (const auto cracks = materials::cracking(material.law, 1)) laws.push_back(*cracks);
      }
      if (!damage.model.ductility) continue;
      if (const auto fails = materials::failing(material.law, *damage.model.ductility)) laws.push_back(*fails);
    }
  }
  return observables(laws);
}

// The layers of a profile may be called like a probe, a node set or a block.
void check_columns(const std::vector<Reduction>& means, deck::Problems& problems) {
  std::set<std::string> columns;
  for (const Reduction& mean : means) {
    for (const std::string& column : mean.columns()) {
      if (columns.insert(column).second) continue;
      problems.add(where, "two columns are called '" + column + "'; expected another name of the section of Profiles");
    }
  }
}

}  // namespace

void check_output_variables(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator,
                            deck::Problems& problems) {
  const std::vector<Observable> all = observables_of(deck, problems);
  for (const std::string& name : deck.output.variables) {
    attempt(problems, [&] { chosen(all, name, "Output > Output Variables"); });
  }
  for (const std::string& name : deck.history.variables) {
    const std::string in_brackets = name.substr(std::min(name.size(), before_bracket(name).size() + 1));
    const std::string section = in_brackets.substr(0, in_brackets.find(')'));
    if (problems.about("Boundary Conditions > " + section + " > Type")) continue;  // its reaction is unknown
    attempt(problems, [&] { look_up(deck, all, cloud, communicator, name); });
    const std::string problem = io::history_name_problem(name);
    if (!problem.empty()) problems.add(where, problem);
  }
  if (!deck.output.enabled) return;
  const std::string problem = io::result_problem(cloud, communicator);
  if (!problem.empty()) problems.add("Output", problem);
}

OutputVariables output_variables_of(const deck::Deck& deck, const Body& body, const contact::Contact& contact) {
  const std::vector<Observable> all = observables(body);
  OutputVariables variables;
  deck::Problems problems;
  for (const std::string& name : deck.output.variables) {
    attempt(problems, [&] { variables.frame.push_back(chosen(all, name, "Output > Output Variables")); });
  }
  for (const std::string& name : deck.history.variables) {
    attempt(problems, [&] {
      if (means(without_instant(name), "Reaction", reaction_names)) {
        variables.reactions.push_back(reaction(deck.conditions, name));
      } else if (is_of_crack(name)) {
        variables.crack_columns.push_back(crack_column(deck.history.cracks, body, name, variables.cracks));
      } else if (means(without_instant(name), "Contact", contact_names)) {
        variables.contacts.push_back(contact_force(contact, body.domain.cloud.block_names, name));
      } else {
        const std::string whole = with_mean(deck.node_sets, name);
        auto& those = Reduction::is_extreme(whole) ? variables.extremes : variables.means;
        those.push_back(reduction_of(all, deck.history.profiles, body, whole, where).named(name));
        check_exists(those.back().exists(body), name);
      }
    });
  }
  check_columns(variables.means, problems);
  problems.raise(deck.file.string());
  return variables;
}

}  // namespace strut
