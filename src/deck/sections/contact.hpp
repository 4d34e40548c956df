// The section Contact: its models, and the blocks that may touch.
#pragma once

#include <string>
#include <vector>

#include "contact/laws/laws.hpp"
#include "deck/forward.hpp"

namespace strut::deck {

// The pairs of blocks of an interaction that names none.
enum class Partners { any, others, itself };

// Short-range contact between two blocks of the mesh, or within one.
struct Interaction {
  std::string name;                       // of the section
  std::string first_block, second_block;  // both empty: all blocks, with these partners
  Partners partners = Partners::any;
  int model = 0;  // index into Deck::contact_models
};

struct ContactModel {
  std::string name;  // of the section
  contact::Model model;
};

Section contact_section();
std::vector<ContactModel> read_contact_models(const Values& deck);
std::vector<Interaction> read_interactions(const Values& deck, const std::vector<ContactModel>& models,
                                           Problems& problems);

}  // namespace strut::deck
