#include "setup/contact.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>

#include "base/errors.hpp"
#include "setup/blocks.hpp"

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

void set_surface_laws(const Body& body, std::vector<contact::Interaction>& interactions) {
  const auto modulus = [&body](int block) {
    return std::visit([](const auto& law) { return law.moduli().longitudinal(); }, body.blocks[block].material.law);
  };
  for (contact::Interaction& one : interactions) {
    auto* law = std::get_if<contact::SurfaceLaw>(&one.model.law);
    if (!law) continue;
    const double a = body.domain.blocks[one.first].spacing, b = body.domain.blocks[one.second].spacing;
    law->modulus = 2 / (1 / modulus(one.first) + 1 / modulus(one.second));
    law->radius = contact::reach_in_spacings * std::max(a, b);
    law->spacing = 0.5 * (a + b);
  }
}

namespace {

// The bonds between two blocks, both ends counted once, and the shortest of them, m.
struct BondsBetween {
  double count = 0, shortest = std::numeric_limits<double>::infinity();
};

BondsBetween bonds_between(const Domain& domain, const std::vector<int>& blocks, int first, int second) {
  BondsBetween bonds;
  for (int i = 0; i < domain.owned; ++i) {
    if (domain.cloud.blocks[i] != first) continue;
    domain.families.for_each(i, [&](int j) {
      if (blocks[j] != second) return;
      ++bonds.count;
      bonds.shortest = std::min(bonds.shortest, (domain.reference(j) - domain.reference(i)).norm());
    });
  }
  return {domain.communicator.sum(bonds.count), domain.communicator.min(bonds.shortest)};
}

// Of owned points and ghosts.
std::vector<int> blocks_of(const Domain& domain) {
  std::vector<int> blocks(domain.cloud.blocks.begin(), domain.cloud.blocks.end());
  blocks.resize(domain.owned + domain.ghosts, -1);
  domain.halo.exchange(blocks);
  return blocks;
}

std::string remedy(const deck::Deck& deck, const std::string& first, const std::string& second) {
  const std::string one = section_of(deck, first)->name, other = section_of(deck, second)->name;
  if (one == other) return "a section of Blocks for each of them (both are in '" + one + "'), with Separate Body true";
  return "Blocks > " + one + " > Separate Body true, or Blocks > " + other + " > Separate Body true";
}

}  // namespace

std::string bonded_contacts(const deck::Deck& deck, const Domain& domain) {
  constexpr double gap =
      1.25;  // spacings: no two layers of one lattice, or of two that fit, are so far from each other
  if (deck.interactions.empty()) return "";
  const std::vector<std::string>& names = domain.cloud.block_names;
  const std::vector<int> blocks = blocks_of(domain);
  std::ostringstream text;
  for (int a = 0; a < static_cast<int>(names.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(names.size()); ++b) {
      if (domain.blocks[a].body != domain.blocks[b].body) continue;
      const auto is_meant = [&](const deck::Interaction& one) {
        return one.first_block.empty()
                   ? one.partners != deck::Partners::itself
                   : std::minmax(one.first_block, one.second_block) == std::minmax(names[a], names[b]);
      };
      const auto one = std::find_if(deck.interactions.begin(), deck.interactions.end(), is_meant);
      if (one == deck.interactions.end()) continue;
      const auto [bonds, shortest] = bonds_between(domain, blocks, a, b);
      const bool across_gap = shortest > gap * std::max(domain.blocks[a].spacing, domain.blocks[b].spacing);
      if (bonds == 0 || (one->first_block.empty() && !across_gap)) continue;
      text << "WARNING: Contact > Interactions > " << one->name << ": blocks " << names[a] << " and " << names[b]
           << " are bonded to each other by " << static_cast<std::int64_t>(bonds)
           << " bonds, between whose ends contact never acts; expected, for bodies that meet, "
           << remedy(deck, names[a], names[b]) << "\n";
    }
  }
  return text.str();
}

}  // namespace strut
