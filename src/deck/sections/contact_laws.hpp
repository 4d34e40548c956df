// The contact laws of a deck: the keys of each, and how it is made from them. A new law is one entry.
#pragma once

#include <vector>

#include "contact/laws/laws.hpp"
#include "deck/values.hpp"

namespace strut::deck {

// The key that selects a law, and the keys of all laws: radius and friction.
Key contact_law_key();
std::vector<Key> contact_law_keys();
std::vector<Section> contact_law_cases();

// The contact model of a section of Contact > Models.
contact::Model read_contact_law(const Values& model);

}  // namespace strut::deck
