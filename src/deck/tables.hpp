// Tables of expressions in files: "table(t, 'pull.csv')".
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deck/problems.hpp"
#include "deck/xml.hpp"

namespace strut::deck {

// Puts the numbers of the files that tables of `list`, which `text` was parsed to, name into the text: other ranks,
// checkpoints and comparisons of decks then need no file. Returns the files, found from `folder`.
std::vector<std::filesystem::path> fill_tables(std::string& text, const List& list, const std::filesystem::path& folder,
                                               Problems& problems);

}  // namespace strut::deck
