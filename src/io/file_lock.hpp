// One run a file.
#pragma once

#include <filesystem>

namespace strut::io {

// Holds a file against other runs until it goes out of scope or the process ends,
// however it ends. Throws Error: another run holds it, it cannot be created, or is not there. File systems without
// locks hold nothing.
class FileLock {
 public:
  enum class File { made, there };  // made if it is not there
  explicit FileLock(const std::filesystem::path& path, File file = File::made);
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;

 private:
  int handle_ = -1;
};

// Throws Error: another run holds it. Nothing is held or made.
void check_not_held(const std::filesystem::path& path);

}  // namespace strut::io
