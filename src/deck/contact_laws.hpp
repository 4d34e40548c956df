// The laws of contact as a deck names them: for each its keys and how it is made from them. A new law is one entry.
#pragma once

#include <vector>

#include "contact/laws/laws.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"

namespace strut::deck {

struct ContactLawEntry {
  Section schema;  // named as "Contact Model" has it
  contact::Law (*make)(const Values& model);
};

const std::vector<ContactLawEntry>& contact_laws();

// By the key "Contact Model" of a section of Contact > Models.
contact::Law make_contact_law(const Values& model);

}  // namespace strut::deck
