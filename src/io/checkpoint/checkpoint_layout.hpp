// The layout of a snapshot in its file, for writer and reader.
#pragma once

#include <string>
#include <vector>

#include "base/archive.hpp"
#include "io/check_sum.hpp"

namespace strut::io::checkpoint_layout {

// Version of the layout below: increase it with every change of the file's content.
constexpr int version = 15;

inline std::string name_of_ids(std::size_t group) { return "g" + std::to_string(group) + "_id"; }
inline std::string name_of(std::size_t group, const std::string& column) {
  return "g" + std::to_string(group) + "_" + column;
}
inline std::string name_of_rank_sum(const std::string& name) { return "share_" + name; }
inline std::string name_of_number(const std::string& name) { return "number_" + name; }
// The checksums: of the numbers and the deck, then one for each list, in the order of the snapshot. This list is
// defined first: its name begins with checkpoint_mark, which identifies a file that a killed run has only begun.
constexpr const char* name_of_sums = "strut_restart_sums";
// The deck has a checksum of its own: it is read before there is a snapshot to compare with.
constexpr const char* name_of_deck_sum = "deck_sum";
// Texts, a name a line, for a reader that wants some of them: the numbers, the groups of points, and the lists in the
// order of their checksums.
constexpr const char* name_of_numbers = "numbers";
constexpr const char* name_of_groups = "groups";
constexpr const char* name_of_lists = "lists";

inline double sum_of_deck(const std::string& deck) {
  CheckSum sum;
  sum.add(deck);
  return sum.value();
}

inline std::vector<std::string> lists_of(const Snapshot& snapshot) {
  std::vector<std::string> lists;
  for (const auto& [name, value] : snapshot.rank_sums) lists.push_back(name_of_rank_sum(name));
  for (std::size_t g = 0; g < snapshot.groups.size(); ++g) {
    lists.push_back(name_of_ids(g));
    for (const Snapshot::Column& column : snapshot.groups[g].columns) lists.push_back(name_of(g, column.name));
  }
  return lists;
}

}  // namespace strut::io::checkpoint_layout
