// Decks in Peridigm's dialect (inputs/from-peridigm.md). Keys with another place or name are converted to ours before a
// deck is checked, only here; notes report changes of meaning. Keys that Peridigm has and that have no effect here are
// in the schema.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>

#include "deck/problems.hpp"
#include "deck/xml.hpp"

namespace strut::deck {

// `folder`: the deck's. Returns true if the deck was written for Peridigm.
bool translate_peridigm(List& deck, const std::filesystem::path& folder, Problems& problems);

// True if a deck has sections or keys that only decks of Peridigm have: its meanings hold.
bool is_peridigms(List& deck);
// True if it has sections or keys that are rare in decks of ours: differences then get notes.
bool may_be_peridigms(List& deck);

// Reads a deck of Peridigm as its own reader does: the last of several equal keys counts, \{ is a brace, files are
// relative to the working folder.
void read_as_peridigm(List& deck, const std::filesystem::path& folder, Problems& problems);

// Reports sections, laws and conditions that do not exist here, each once, and takes them and their keys out of the
// deck.
void refuse_what_is_missing(List& deck, Problems& problems);
// True for laws and sections that only decks of Peridigm name.
bool has_missing_ability(List& deck);

// Converts the solvers for equilibria, and Solver1, Solver2 … of Peridigm's decks.
void translate_solvers(List& deck, bool is_theirs, Problems& problems);

// Prescribed displacements that are not zero at the initial time: Peridigm adds up increments since then.
void translate_displacements(List& deck, Problems& problems);

// Converts its sections Output, Output1, "Output Data" … and Compute Class Parameters to one Output and one History.
void translate_outputs(List& deck, bool is_theirs, Problems& problems);

// Adds a note for each key that has another meaning in this program than in Peridigm.
void tell_differences(List& deck, Problems& problems);

// Parameters and sections of a list by name; null if there is none.
Parameter* find_parameter(List& list, const std::string& name);
List* find_list(List& list, const std::string& name);
// The sections at a path, {"Contact", "Models"}; none if it is not there.
std::span<List> sections_of(List& deck, std::initializer_list<const char*> path);
std::string value_of(const List& list, const std::string& name);  // "" if there is none
std::optional<double> real_of(const List& list, const std::string& name);
std::string tidied(std::string text);  // in lower case, with blanks for _: as Peridigm compares words
void erase_parameter(List& list, const std::string& name);
void erase_list(List& list, const std::string& name);

}  // namespace strut::deck
