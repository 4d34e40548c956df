// The section Blocks: materials and horizons of the blocks of the mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deck/forward.hpp"
#include "deck/sections/damage_models.hpp"
#include "deck/sections/materials.hpp"

namespace strut::deck {

struct Block {
  std::string name;                      // of the section
  std::vector<std::string> block_names;  // of the mesh; "all" stands for every block
  int material = 0;                      // index into Deck::materials
  // Exactly one of these:
  std::optional<double> horizon;              // m
  std::optional<double> horizon_factor;       // in local spacings of each point
  bool separate_body{};                       // not bonded to anything outside of this section
  std::optional<bool> across_voids;           // whether bonds reach across voids
  std::optional<int> damage_model;            // index into Deck::damage_models
  std::optional<double> initial_temperature;  // K
};

// None where the block has none, or names one that the deck has not (an error of its own).
const DamageModel* damage_model_of(const Block& block, const std::vector<NamedDamageModel>& models);

Section blocks_section();
std::vector<Block> read_blocks(const Values& deck, const std::vector<Material>& materials,
                               const std::vector<NamedDamageModel>& damage_models, Problems& problems);

}  // namespace strut::deck
