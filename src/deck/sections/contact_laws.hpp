// The laws of contact as a deck names them: for each its keys and how it is made from them. A new law is one entry.
#pragma once

#include <vector>

#include "contact/laws/laws.hpp"
#include "deck/values.hpp"

namespace strut::deck {

// The key that chooses one, and what all of them share: radius and friction.
Key contact_law_key();
std::vector<Key> contact_law_keys();
std::vector<Section> contact_law_cases();

// Of a section of Contact > Models.
contact::Model read_contact_law(const Values& model);

}  // namespace strut::deck
