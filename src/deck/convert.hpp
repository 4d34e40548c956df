// Converts one parameter of a deck to the value that its key declares.
#pragma once

#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "deck/xml.hpp"

namespace strut::deck {

// Throws Error with the value and what was expected. An integer is accepted as a real, and a string that contains a
// number as that number.
Value convert(const Parameter& parameter, const Key& key);

}  // namespace strut::deck
