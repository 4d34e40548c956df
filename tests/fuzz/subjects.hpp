// The readers of inputs, and valid inputs for each.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/parallel/communicator.hpp"
#include "random.hpp"

namespace strut::fuzz {

struct Subject {
  std::string name;
  std::string file;  // name of the file for the reader
  std::vector<std::string> samples;
  std::function<std::string(const std::string& sample, const std::string& other, Random& random)> change;
  // Must return or throw Error; anything else is a fault.
  std::function<void(const std::filesystem::path&)> read;
};

// Meshes that decks name are written into the folder.
std::vector<Subject> all_subjects(const std::filesystem::path& folder, const Communicator& communicator);

Subject decks(const std::filesystem::path& folder, const Communicator& communicator);

}  // namespace strut::fuzz
