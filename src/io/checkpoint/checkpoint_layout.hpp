// How a snapshot stands in its file: what the writer and the reader agree on.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>

namespace strut::io::checkpoint_layout {

// Of the layout below: raise it with every change of what the file holds.
constexpr int version = 5;
constexpr const char* mark = "strut_restart";

inline std::string name_of_ids(std::size_t group) { return "g" + std::to_string(group) + "_id"; }
inline std::string name_of(std::size_t group, const std::string& column) {
  return "g" + std::to_string(group) + "_" + column;
}
inline std::string name_of_share(const std::string& name) { return "share_" + name; }
inline std::string name_of_number(const std::string& name) { return "number_" + name; }

// FNV-1a of all that is written, word by word: a disk or a copy that has changed a bit is found out.
class Sum {
 public:
  template <class T>
  void add(std::span<const T> values) {
    static_assert(sizeof(T) == 8);
    for (const T& value : values) {
      std::uint64_t word;
      std::memcpy(&word, &value, 8);
      sum_ = (sum_ ^ word) * 0x100000001b3u;
    }
  }
  void add(double value) { add(std::span<const double>(&value, 1)); }
  double value() const { return static_cast<double>(sum_ >> 12); }

 private:
  std::uint64_t sum_ = 0xcbf29ce484222325u;
};

// What is written, until it is whole and takes the place of the file.
inline std::filesystem::path part_of(const std::filesystem::path& path) { return path.string() + ".part"; }

}  // namespace strut::io::checkpoint_layout
