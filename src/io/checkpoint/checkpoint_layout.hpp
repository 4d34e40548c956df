// The layout of a snapshot in its file, for writer and reader.
#pragma once

#include <string>

#include "base/archive.hpp"
#include "io/check_sum.hpp"

namespace strut::io::checkpoint_layout {

// Version of the layout below: increase it with every change of the file's content.
constexpr int version = 5;

inline std::string name_of_ids(std::size_t group) { return "g" + std::to_string(group) + "_id"; }
inline std::string name_of(std::size_t group, const std::string& column) {
  return "g" + std::to_string(group) + "_" + column;
}
inline std::string name_of_share(const std::string& name) { return "share_" + name; }
inline std::string name_of_number(const std::string& name) { return "number_" + name; }
// The checksums: of the numbers and the deck, then one for each list, in the order of the snapshot. This list is
// defined first: its name begins with checkpoint_mark, which identifies a file that a killed run has only begun.
constexpr const char* name_of_sums = "strut_restart_sums";
// The deck has a checksum of its own: it is read before there is a snapshot to compare with.
constexpr const char* name_of_deck_sum = "deck_sum";

inline double sum_of_deck(const std::string& deck) {
  CheckSum sum;
  sum.add(deck);
  return sum.value();
}

inline std::size_t number_of_lists(const Snapshot& snapshot) {
  std::size_t lists = snapshot.shares.size();
  for (const Snapshot::Group& group : snapshot.groups) lists += 1 + group.columns.size();
  return lists;
}

}  // namespace strut::io::checkpoint_layout
