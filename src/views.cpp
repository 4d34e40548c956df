#include "views.hpp"

#include "base/errors.hpp"
#include "deck/problems.hpp"

namespace strut {

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
    attempt([&] { views.extremes.emplace_back(all, body.domain.cloud.block_names, name, "History > Variables"); });
  }
  problems.raise(deck.file.string());
  return views;
}

}  // namespace strut
