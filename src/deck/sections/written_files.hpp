// Checks that the files of a run may be replaced and can be written (base/files.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "deck/forward.hpp"

namespace strut::deck {

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
