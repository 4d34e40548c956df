// Decks in Peridigm's dialect (inputs/from-peridigm.md). Keys with another place or name are converted to ours before a
// deck is checked, only here; notes report changes of meaning. Keys that Peridigm has and that have no effect here are
// in the schema.
#pragma once

#include <string>

#include "deck/problems.hpp"
#include "deck/xml.hpp"

namespace strut::deck {

void translate_peridigm(List& deck, Problems& problems);

// Converts its sections Output, Output1, "Output Data" … and Compute Class Parameters to one Output and one History.
void translate_outputs(List& deck, Problems& problems);

// True if a deck has sections or keys that only decks of Peridigm need.
bool is_peridigms(List& deck);
// Adds a note for each key that has another meaning in this program than in Peridigm.
void tell_differences(List& deck, Problems& problems);

// Parameters and sections of a list by name; null if there is none.
Parameter* find_parameter(List& list, const std::string& name);
List* find_list(List& list, const std::string& name);
std::string value_of(const List& list, const std::string& name);  // "" if there is none
void erase_parameter(List& list, const std::string& name);
void erase_list(List& list, const std::string& name);

}  // namespace strut::deck
