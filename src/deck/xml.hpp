// The XML of a deck as a tree of named lists. Teuchos parses it; the tree is made here and not by Teuchos' reader of
// parameter lists, because that one lets "1.5e9x" pass for a number and "1.5" for the integer 1, keeps the last of two
// parameters of one name, and stops at the first problem.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deck/problems.hpp"

namespace strut::deck {

struct Parameter {
  std::string name;
  std::string type;  // "double", "int", "bool", "string", "Array(double)" …, not checked yet
  std::string value;
};

struct List {
  std::string name;
  std::vector<Parameter> parameters;
  std::vector<List> lists;
};

// Nothing where the text is not well-formed XML; the problem is then among the problems, with its line.
std::optional<List> parse_xml(const std::string& text, Problems& problems);

}  // namespace strut::deck
