// A folder for the files of a test, shared by its ranks and removed at the end.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"

namespace strut {

class TemporaryFolder {
 public:
  explicit TemporaryFolder(const Communicator& communicator) : communicator_(communicator) {
    std::string name = (std::filesystem::temp_directory_path() / "strut-test-XXXXXX").string();
    run_on_root(communicator_, [&] {
      if (mkdtemp(name.data()) == nullptr) throw Error("cannot make a temporary folder");
    });
    communicator_.broadcast(name);
    path_ = name;
  }
  ~TemporaryFolder() {
    communicator_.barrier();
    std::error_code ignored;
    if (communicator_.rank() == 0) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  Communicator communicator_;
  std::filesystem::path path_;
};

}  // namespace strut
