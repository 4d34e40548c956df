// Parses the YAML of a deck (Peridigm's newer decks) into a tree of named lists. Teuchos parses it.
#pragma once

#include <optional>
#include <string>

#include "deck/xml.hpp"

namespace strut::deck {

// nullopt if the text is not well-formed YAML; the problem is then reported.
std::optional<List> parse_yaml(const std::string& text, Problems& problems);

// The same for a text in XML or YAML.
std::optional<List> parse_xml_or_yaml(const std::string& text, Problems& problems);

}  // namespace strut::deck
