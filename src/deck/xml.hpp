// Parses the XML of a deck into a tree of named lists. Teuchos parses it, but the tree is made here, not by Teuchos'
// reader of parameter lists, which accepts "1.5e9x" as a number and "1.5" as the integer 1, keeps the last of two
// parameters with one name, and stops at the first problem.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deck/problems.hpp"

namespace strut::deck {

struct Parameter {
  std::string name;
  std::string type;  // "double", "int", "bool", "string", "Array(double)" …, not yet checked
  std::string value;
};

struct List {
  std::string name;
  std::vector<Parameter> parameters;
  std::vector<List> lists;
};

// nullopt if the text is not well-formed XML; the problem is then reported with its line. Names given twice stay twice.
std::optional<List> parse_xml(const std::string& text, Problems& problems);

}  // namespace strut::deck
