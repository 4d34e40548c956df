// A lock that allows only one run per file.
#pragma once

#include <filesystem>

namespace strut::io {

// Locks a file against other runs until the object goes out of scope or the process ends in any way. Throws Error if
// another run holds the lock, or if the file cannot be created (`made`) or opened (`there`). On file systems without
// locks it has no effect.
class FileLock {
 public:
  enum class File { made, there };  // created if it does not exist
  explicit FileLock(const std::filesystem::path& path, File file = File::made);
  ~FileLock();
  FileLock(const FileLock&) = delete;

 private:
  int handle_;
};

// Throws Error if another run holds a lock on the file. Locks and creates nothing.
void check_not_held(const std::filesystem::path& path);

}  // namespace strut::io
