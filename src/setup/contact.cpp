#include "setup/contact.hpp"

#include <algorithm>
#include <map>

#include "base/errors.hpp"

namespace strut {

void check_interactions(const deck::Deck& deck, const PointCloud& cloud, deck::Problems& problems) {
  const std::vector<std::string>& valid = cloud.block_names;
  for (const deck::Interaction& one : deck.interactions) {
    for (const auto& [key, name] : {std::pair("First Block", one.first_block), {"Second Block", one.second_block}}) {
      if (name.empty() || std::find(valid.begin(), valid.end(), name) != valid.end()) continue;
      problems.add("Contact > Interactions > " + one.name + " > " + key,
                   "the mesh has no block '" + name + "'" + did_you_mean(name, valid) + "; it has " + joined(valid));
    }
  }
}

std::vector<contact::Interaction> interactions_of(const deck::Deck& deck, const PointCloud& cloud) {
  const auto model = [&](const deck::Interaction& one) { return deck.contact_models[one.model].model; };
  const auto block = [&](const std::string& name) {
    return static_cast<int>(std::find(cloud.block_names.begin(), cloud.block_names.end(), name) -
                            cloud.block_names.begin());
  };
  std::map<std::pair<int, int>, contact::Model> models;  // the first entry of a pair holds
  for (const deck::Interaction& one : deck.interactions) {
    if (!one.first_block.empty())
      models.emplace(std::minmax({block(one.first_block), block(one.second_block)}), model(one));
  }
  const int blocks = static_cast<int>(cloud.block_names.size());
  for (const deck::Interaction& one : deck.interactions) {
    for (int a = 0; one.first_block.empty() && a < blocks; ++a) {
      for (int b = a; b < blocks; ++b) {
        const bool meant = one.partners == deck::Partners::any || (a == b) == (one.partners == deck::Partners::itself);
        if (meant) models.emplace(std::pair(a, b), model(one));
      }
    }
  }
  std::vector<contact::Interaction> interactions;
  for (const auto& [pair, model] : models) interactions.push_back({pair.first, pair.second, model});
  return interactions;
}

}  // namespace strut
