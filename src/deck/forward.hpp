// What the headers of the sections name without a need to know it.
#pragma once

namespace strut::deck {

struct Section;
class Values;  // of the whole deck, where a section is read
class Problems;

}  // namespace strut::deck
