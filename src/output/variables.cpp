#include "output/variables.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "deck/problems.hpp"

namespace strut {

namespace {

const std::string where = "History > Variables";
const std::vector<std::string> reaction_names = {"Reaction_X", "Reaction_Y", "Reaction_Z"};

std::string before_bracket(const std::string& name) { return name.substr(0, name.find('(')); }

// Right or nearly so.
bool means_reaction(const std::string& name) {
  const std::string kind = before_bracket(name);
  return kind.starts_with("Reaction") || !did_you_mean(kind, reaction_names).empty();
}

bool reacts(const ConditionPrototype& kind) {
  return std::visit([]<class Type>(const Type&) { return Reacts<Type>; }, kind);
}

// The place in the deck of the condition of this name; throws where it is none that reacts.
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

ReactionComponent reaction(const std::vector<deck::Condition>& conditions, const std::string& name) {
  const std::string kind = before_bracket(name), path = where + " > " + name;
  const auto found = std::find(reaction_names.begin(), reaction_names.end(), kind);
  if (found == reaction_names.end() || kind == name || name.back() != ')') {
    throw Error(path + ": expected one of " + joined(reaction_names) + did_you_mean(kind, reaction_names) +
                " and in brackets the name of a section of Boundary Conditions, e.g. Reaction_Z(wall)");
  }
  const std::string wanted = name.substr(kind.size() + 1, name.size() - kind.size() - 2);
  return {name, reacting_condition(conditions, wanted, path), static_cast<int>(found - reaction_names.begin())};
}

// Collective: an unknown name throws on all ranks, before they count.
Extreme extreme(const std::vector<Observable>& all, const Domain& domain, const std::string& name) {
  Extreme extreme(all, domain.cloud, name, where);
  if (domain.communicator.sum(extreme.points(domain.cloud)) > 0) return extreme;
  throw Error(where + " > " + name + ": the node set or block holds no point");
}

}  // namespace

OutputVariables output_variables_of(const deck::Deck& deck, const Body& body) {
  const std::vector<Observable> all = observables(body);
  OutputVariables variables;
  deck::Problems problems;
  const auto attempt = [&problems](const auto& look_up) {
    try {
      look_up();
    } catch (const Error& error) {
      problems.add(error.what());
    }
  };
  attempt([&] { variables.frame = chosen(all, deck.output.variables, "Output > Output Variables"); });
  for (const std::string& name : deck.history.variables) {
    attempt([&] {
      if (means_reaction(name)) {
        variables.reactions.push_back(reaction(deck.conditions, name));
      } else {
        variables.extremes.push_back(extreme(all, body.domain, name));
      }
    });
  }
  problems.raise(deck.file.string());
  return variables;
}

}  // namespace strut
