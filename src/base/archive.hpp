// The content of a checkpoint, by name. The `serialize` functions of the parts both save and restore it, so that both
// directions have the same content.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace strut {

// The data of one rank.
struct Snapshot {
  struct Column {
    std::string name;
    int width = 1;
    std::vector<double> values;  // point by point
  };
  // Some of this rank's points, with the same columns.
  struct Group {
    std::string name;
    std::vector<std::int64_t> ids;  // ids of these points, unique over all ranks
    std::vector<Column> columns;
  };
  std::vector<Group> groups;
  std::map<std::string, double> numbers;    // the same on all ranks
  std::map<std::string, double> rank_sums;  // per-rank sums: only their totals over all ranks have a meaning
};

class Archive {
 public:
  static Archive saving_to(Snapshot& into) { return {into, false}; }
  // Loads from a snapshot that has everything that was saved; throws std::logic_error if something is missing.
  static Archive loading_from(Snapshot& from) { return {from, true}; }

  bool loading() const { return restores_; }

  // The points of the next fields: starts a group, or continues it.
  void points(const std::string& group, const std::vector<std::int64_t>& ids);

  // at(k, c): a reference to component c of the k-th point.
  template <class At>
  void field(const std::string& name, int width, At&& at) {
    numbers(
        name, width, [&](std::size_t k, int c) { return static_cast<double>(at(k, c)); },
        [&](std::size_t k, int c, double number) {
          auto& own = at(k, c);
          own = static_cast<std::remove_reference_t<decltype(own)>>(number);
        });
  }

  // A field without references to its numbers: get(k, c) returns component c of the k-th point, set(k, c, number) sets
  // it.
  template <class Get, class Set>
  void numbers(const std::string& name, int width, Get&& get, Set&& set) {
    std::vector<double>& values = column(name, width).values;
    std::size_t n = 0;
    for (std::size_t k = 0; n < values.size(); ++k) {
      for (int c = 0; c < width; ++c, ++n) {
        if (restores_) {
          set(k, c, values[n]);
        } else {
          values[n] = get(k, c);
        }
      }
    }
  }

  // Any arithmetic type whose values a double holds exactly.
  template <class T>
  void number(const std::string& name, T& value) {
    pass(value, entry(snapshot_.numbers, name));
  }
  void rank_sum(const std::string& name, double& value) { pass(value, entry(snapshot_.rank_sums, name)); }

 private:
  Archive(Snapshot& snapshot, bool restores) : snapshot_(snapshot), restores_(restores) {}

  template <class T>
  void pass(T& own, double& kept) const {
    if (restores_) {
      own = static_cast<T>(kept);
    } else {
      kept = static_cast<double>(own);
    }
  }
  double& entry(std::map<std::string, double>& entries, const std::string& name) const;
  Snapshot::Column& column(const std::string& name, int width);

  Snapshot& snapshot_;
  bool restores_;
  std::size_t group_ = 0;
};

}  // namespace strut
