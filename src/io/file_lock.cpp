#include "io/file_lock.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/errors.hpp"

namespace strut::io {

namespace {

struct flock whole_file() {
  struct flock whole = {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return whole;
}

[[noreturn]] void fail_as_held(const std::filesystem::path& path) {
  throw Error(path.string() + ": another run is writing to it: expected to wait for that, to end it, or to run in " +
              "another folder");
}

}  // namespace

void check_not_held(const std::filesystem::path& path) {
  const int handle = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (handle < 0) return;
  struct flock lock = whole_file();
  const bool is_held = ::fcntl(handle, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  ::close(handle);
  if (is_held) fail_as_held(path);
}

// Locks the open file, not the process, so that libraries that open and close the same file do not release the lock.
FileLock::FileLock(const std::filesystem::path& path, File file)
    : handle_(::open(path.c_str(), O_RDWR | O_CLOEXEC | (file == File::made ? O_CREAT : 0), 0666)) {
  if (handle_ < 0) {
    throw Error(path.string() + (file == File::made ? ": cannot create it: " : ": cannot go on with it: ") +
                std::strerror(errno));
  }
  struct flock whole = whole_file();
  if (::fcntl(handle_, F_OFD_SETLK, &whole) == 0 || (errno != EAGAIN && errno != EACCES)) return;
  ::close(handle_);
  fail_as_held(path);
}

FileLock::~FileLock() { ::close(handle_); }

}  // namespace strut::io
