// The files that a run writes: may each be replaced, and can it be written (base/files.hpp)?
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "deck/forward.hpp"

namespace strut::deck {

// Where the deck names a file, whose it is, and the file.
struct WrittenFile {
  std::string path, owner;
  std::filesystem::path file;
  FileKind kind;
};

struct ReadFile {
  std::string what;
  std::filesystem::path file;
};

// What a run writes may not be what it reads, nor one file be two, by whatever name or link.
void check_files(const std::vector<WrittenFile>& written, const std::vector<ReadFile>& read, Problems& problems);

}  // namespace strut::deck
