// How a snapshot stands in its file: what the writer and the reader agree on.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

namespace strut::io::checkpoint_layout {

// Of the layout below: raise it with every change of what the file holds.
constexpr int version = 4;
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
  void add(const std::vector<T>& values) {
    static_assert(sizeof(T) == 8);
    for (const T& value : values) {
      std::uint64_t word;
      std::memcpy(&word, &value, 8);
      sum_ = (sum_ ^ word) * 0x100000001b3u;
    }
  }
  double value() const { return static_cast<double>(sum_ >> 12); }

 private:
  std::uint64_t sum_ = 0xcbf29ce484222325u;
};

inline std::vector<std::size_t> order_by_id(const std::vector<std::int64_t>& ids) {
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&ids](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  return order;
}

// What is written, until it is whole and takes the place of the file.
inline std::filesystem::path part_of(const std::filesystem::path& path) { return path.string() + ".part"; }

}  // namespace strut::io::checkpoint_layout
