// Damage to a valid input.
#pragma once

#include <string>
#include <vector>

#include "random.hpp"

namespace strut::fuzz {

// Bits flipped, bytes changed, parts cut out, doubled, taken from `other`; the end cut off; counts overwritten.
std::string damaged(std::string bytes, const std::string& other, Random& random);

// Words and lines dropped, doubled, swapped, or replaced by values that programs stumble over.
std::string reworded(std::string text, Random& random);

// Elements, names, types and values of a deck; entities, deep nesting, expressions.
std::string changed_deck(std::string deck, Random& random);

// "nan", "1e400", "-1", a very long word, …
std::string awkward_value(Random& random);

// An expression that is mostly valid, with an error now and then.
std::string expression(Random& random, int depth = 0);

}  // namespace strut::fuzz
