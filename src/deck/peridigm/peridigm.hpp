// Decks in Peridigm's dialect (inputs/from-peridigm.md). What stands in another place or goes by another name there is
// put into ours before a deck is checked, here and nowhere else; what it does to the meaning is among the notes. Keys
// that Peridigm has and that change nothing here are in the schema.
#pragma once

#include <string>

#include "deck/problems.hpp"
#include "deck/xml.hpp"

namespace strut::deck {

void translate_peridigm(List& deck, Problems& problems);

// Its sections Output, Output1, "Output Data" … and Compute Class Parameters, as one Output of fields and one History.
void translate_outputs(List& deck, Problems& problems);

// Whether a deck has sections or keys that only decks of Peridigm need.
bool is_peridigms(List& deck);
// Adds a note for each key that means another thing in this program than in Peridigm.
void tell_differences(List& deck, Problems& problems);

// Of a list, by name; null where it has none.
Parameter* find_parameter(List& list, const std::string& name);
List* find_list(List& list, const std::string& name);
std::string value_of(const List& list, const std::string& name);  // "" where it has none
void erase_parameter(List& list, const std::string& name);
void erase_list(List& list, const std::string& name);

}  // namespace strut::deck
