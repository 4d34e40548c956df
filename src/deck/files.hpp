// Files of a deck: tables of expressions in files, "table(t, 'pull.csv')"; checks that the files of a run may be
// replaced and can be written (base/files.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "deck/problems.hpp"
#include "deck/xml.hpp"

namespace strut::deck {

// Puts the numbers of the files that tables of `list`, which `text` was parsed to, name into the text: other ranks,
// checkpoints and comparisons of decks then need no file. Returns the files, found from `folder`.
std::vector<std::filesystem::path> fill_tables(std::string& text, const List& list, const std::filesystem::path& folder,
                                               Problems& problems);

// A file with its path in the deck and its owner.
struct WrittenFile {
  std::string path, owner;
  std::filesystem::path file;
  FileKind kind;
};

struct ReadFile {
  std::string what;
  std::filesystem::path file;
};

// A run must not write a file that it reads, or write one file twice, under any name or link.
void check_files(const std::vector<WrittenFile>& written, const std::vector<ReadFile>& read, Problems& problems);

}  // namespace strut::deck
