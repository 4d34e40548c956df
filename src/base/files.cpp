#include "base/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/errors.hpp"

namespace strut {

namespace {

namespace fs = std::filesystem;

// Large enough for the header of a result with a thousand blocks.
constexpr std::size_t longest_head = 1'000'000;

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

// The path from the root, also through folders that do not exist yet; empty if the system cannot tell.
fs::path whole_name(const fs::path& name) {
  std::error_code failure;
  const fs::path absolute = fs::absolute(name, failure);
  return failure ? fs::path() : fs::weakly_canonical(absolute, failure);
}

std::string in_small_letters(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string head_of(const fs::path& file) {
  std::string head(longest_head, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return head;
}

// True for an empty file, or zeros only, as the netCDF library starts a file.
bool holds_nothing(const std::string& head) {
  return head.size() < longest_head && head.find_first_not_of('\0') == std::string::npos;
}

bool is_classic_netcdf(const std::string& head) {
  return head.starts_with(std::string("CDF\1", 4)) || head.starts_with(std::string("CDF\2", 4)) ||
         head.starts_with(std::string("CDF\5", 4));
}

// Finds the attribute "title" in the header: name, type (char), number of characters, text.
bool has_title(const std::string& head, const std::string& title) {
  const std::string name_and_type("title\0\0\0\0\0\0\2", 12);
  const std::size_t found = head.find(name_and_type);
  if (!is_classic_netcdf(head)) return false;
  // A run killed at its start leaves the attributes that Exodus writes before the title: replacing them loses nothing.
  if (found == std::string::npos) return head.find("api_version") != std::string::npos;
  const std::size_t count_bytes = head[3] == 5 ? 8 : 4, begin = found + name_and_type.size() + count_bytes;
  if (begin > head.size()) return false;
  const auto count = static_cast<std::size_t>(static_cast<unsigned char>(head[begin - 1]));  // at most 80
  const std::string text = head.substr(begin, count);
  return text.substr(0, text.find('\0')) == title;  // the library also writes the terminating zero
}

struct Known {
  const char* name;
  bool (*is_one)(const std::string& head);
};

Known known(FileKind kind) {
  switch (kind) {
    case FileKind::result:
      return {"result of strut", [](const std::string& head) { return has_title(head, result_title); }};
    case FileKind::history:
      return {"history of strut", [](const std::string& head) { return head.starts_with(history_mark); }};
    case FileKind::checkpoint:
      return {"checkpoint of strut", [](const std::string& head) {
                return is_classic_netcdf(head) && head.find(checkpoint_mark) != std::string::npos;
              }};
    case FileKind::lock:
      return {"lock of a run", [](const std::string&) { return false; }};
    case FileKind::log:
      return {"log of strut", [](const std::string& head) { return head.starts_with(log_mark); }};
    case FileKind::mesh:
      return {"mesh of strut-mesh", [](const std::string& head) { return has_title(head, mesh_title); }};
    case FileKind::unchecked:
      break;
  }
  return {"file", [](const std::string&) { return true; }};
}

// True if the shell has put standard output or the errors there: "> FILE", whatever its name.
bool takes_terminal_output(const fs::path& file) {
  struct stat named = {}, open = {};
  if (::stat(file.c_str(), &named) != 0) return false;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    if (::fstat(stream, &open) == 0 && open.st_dev == named.st_dev && open.st_ino == named.st_ino) return true;
  }
  return false;
}

// The reason why the system would refuse a name of this length in the folder, or nothing.
std::string refusal_of_length(const fs::path& file, const fs::path& folder) {
  const auto bytes = static_cast<long>(file.filename().native().size()),
             most = ::pathconf(folder.c_str(), _PC_NAME_MAX);
  if (most < 0 || bytes <= most) return "";  // below 0: it does not tell
  return "its name has " + std::to_string(bytes) + " bytes; expected up to " + std::to_string(most);
}

// The reason why the system would refuse to write it, or nothing.
std::string refusal_of_system(const fs::path& file) {
  const fs::path folder = folder_of(file);
  std::error_code failure;
  if (!fs::is_directory(folder, failure)) return "there is no folder '" + folder.string() + "'";
  if (const std::string why = refusal_of_length(file, folder); !why.empty()) return why;
  const fs::path asked = fs::exists(file, failure) ? file : folder;
  return access(asked.c_str(), W_OK) == 0 ? "" : "'" + asked.string() + "': " + std::strerror(errno);
}

}  // namespace

fs::path destination(fs::path name) {
  constexpr int most_links = 40;
  std::error_code failure;
  for (int n = 0; n < most_links && fs::is_symlink(fs::symlink_status(name, failure)); ++n) {
    name = folder_of(name) / fs::read_symlink(name, failure);
  }
  return name;
}

bool same_file(const fs::path& one, const fs::path& other) {
  if (one.empty() || other.empty()) return false;
  std::error_code failure;
  if (fs::equivalent(one, other, failure)) return true;
  if (const fs::path place = whole_name(one); !place.empty() && place == whole_name(other)) return true;
  if (fs::exists(one, failure) || fs::exists(other, failure)) return false;
  const fs::path a = destination(one), b = destination(other);
  return in_small_letters(a.filename()) == in_small_letters(b.filename()) &&
         fs::equivalent(folder_of(a), folder_of(b), failure);
}

std::string unreadable(const fs::path& file) {
  std::error_code failure;
  const fs::file_status status = fs::status(file, failure);
  const std::string name = file.string();
  if (!fs::exists(status)) return name + ": no such file, or it may not be read";
  if (fs::is_directory(status)) return name + ": it is a directory";
  if (!fs::is_regular_file(status)) return name + ": it is a pipe or a device; expected a file";
  if (!std::ifstream(file)) return name + ": no such file, or it may not be read";
  const std::string head = head_of(file).substr(0, 2);  // of UTF-16: its mark, or a letter in two bytes
  const bool is_wide = head == "\xff\xfe" || head == "\xfe\xff" || (head.size() == 2 && head[0] * head[1] == 0);
  return is_wide ? name + ": it is in UTF-16, or no text; expected a text in UTF-8" : "";
}

bool is_of_kind(const fs::path& file, FileKind kind) {
  const std::string head = head_of(file);
  return holds_nothing(head) || known(kind).is_one(head);
}

std::string obstacle(const fs::path& file, FileKind kind) {
  const std::string name = "'" + file.string() + "'";
  std::error_code failure;
  const fs::file_status status = fs::status(file, failure);
  const bool there = fs::exists(status), regular = fs::is_regular_file(status);
  const bool takes_lines =
      kind == FileKind::log && fs::is_character_file(status);  // a terminal; a pipe may block for ever
  if (there && !regular && !takes_lines)
    return name + " is a folder, a pipe or a device; expected a file that may be replaced";
  if (const std::string why = refusal_of_system(file); !why.empty()) return name + ": cannot create it: " + why;
  if (regular && takes_terminal_output(file))
    return name + " is the file that standard output or standard error goes to; expected another";
  if (!regular || is_of_kind(file, kind)) return "";
  const std::string head = head_of(file);
  const std::string what = head.starts_with("\x89HDF")  ? ", in the format netCDF-4 (was it converted?),"
                           : head.starts_with(log_mark) ? ", a log of strut (this run's --log?),"
                                                        : "";
  return name + " is there" + what + " and is no " + known(kind).name +
         ", which would replace it; expected another name, or that it is removed";
}

fs::path before_of(const fs::path& checkpoint) { return checkpoint.string() + ".old"; }
fs::path part_of(const fs::path& checkpoint) { return checkpoint.string() + ".part"; }
fs::path lock_of(const fs::path& checkpoint) { return checkpoint.string() + ".lock"; }

void force_to_disk(const std::filesystem::path& path) {
  const int handle = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool good = handle >= 0 && ::fsync(handle) == 0;
  const int why = errno;
  if (handle >= 0) ::close(handle);
  if (!good) throw Error(path.string() + ": cannot write it to disk: " + std::strerror(why));
}

}  // namespace strut
