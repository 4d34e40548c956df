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
  std::map<std::pair<int, int>, contact::Model> models;  // the first entry of a pair counts
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

std::vector<contact::Interaction> interactions_of(const deck::Deck& deck, const Body& body) {
  const auto spacing = [&body](int block) { return body.domain.blocks[block].spacing; };  // 0 without points
  const auto modulus = [&body](int block) {
    return materials::moduli_of(body.blocks[block].material.law).longitudinal();
  };
  std::vector<contact::Interaction> interactions = interactions_of(deck, body.domain.cloud);
  std::erase_if(interactions, [&](const auto& one) { return spacing(one.first) == 0 || spacing(one.second) == 0; });
  for (contact::Interaction& one : interactions) {
    auto* law = std::get_if<contact::SurfaceLaw>(&one.model.law);
    if (!law) continue;
    const double a = spacing(one.first), b = spacing(one.second);
    law->modulus = 2 / (1 / modulus(one.first) + 1 / modulus(one.second));
    law->radius = contact::reach_in_spacings * std::max(a, b);
    law->spacing = 0.5 * (a + b);
  }
  return interactions;
}

}  // namespace strut
