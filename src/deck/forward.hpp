// Declarations for the headers of the sections, which use these types by name only.
#pragma once

namespace strut::deck {

struct Section;
class Values;  // of the whole deck, when a section is read
class Problems;

}  // namespace strut::deck
