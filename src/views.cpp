#include "views.hpp"

#include "base/errors.hpp"
#include "deck/problems.hpp"

namespace strut {

namespace {

// Collective: an unknown name throws on all ranks, before they count.
Extreme extreme(const std::vector<Observable>& all, const Domain& domain, const std::string& name) {
  const std::string where = "History > Variables";
  Extreme extreme(all, domain.cloud, name, where);
  if (domain.communicator.sum(extreme.points(domain.cloud)) > 0) return extreme;
  throw Error(where + " > " + name + ": the node set or block holds no point");
}

}  // namespace

Views views_of(const deck::Deck& deck, const Body& body) {
  const std::vector<Observable> all = observables(body);
  Views views;
  deck::Problems problems;
  const auto attempt = [&problems](const auto& look_up) {
    try {
      look_up();
    } catch (const Error& error) {
      problems.add(error.what());
    }
  };
  attempt([&] { views.frame = chosen(all, deck.output.variables, "Output > Output Variables"); });
  for (const std::string& name : deck.history.variables) {
    attempt([&] { views.extremes.push_back(extreme(all, body.domain, name)); });
  }
  problems.raise(deck.file.string());
  return views;
}

}  // namespace strut
