// The YAML of a deck, as Peridigm's newer decks are written, as a tree of named lists. Teuchos parses it.
#pragma once

#include <optional>
#include <string>

#include "deck/xml.hpp"

namespace strut::deck {

// Nothing where the text is not well-formed YAML; the problem is then among the problems.
std::optional<List> parse_yaml(const std::string& text, Problems& problems);

// The same of a text that is XML or YAML.
std::optional<List> parse_xml_or_yaml(const std::string& text, Problems& problems);

}  // namespace strut::deck
