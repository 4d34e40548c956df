// Redistributes points between slices, in the order of their numbers as in files, and the partition of the ranks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"

namespace strut::io {

// The size of each rank's slice of the numbers 0, 1, … `total` − 1: equal to within one.
std::vector<std::int64_t> slice_counts(std::int64_t total, int ranks);
// The first number of the slice of `rank`.
std::int64_t slice_begin(std::int64_t total, int ranks, int rank);
// The rank whose slice contains the number.
int slice_owner(std::int64_t total, int ranks, std::int64_t number);

// Numbered items (points, nodes) that ranks have in any order, and the same items in slices: each rank also holds the
// items with the numbers of its slice, in ascending order. Values are exchanged in both directions without any rank
// having more than its items and its slice.
class Slices {
 public:
  // Collective. `ids`: numbers of this rank's items, 0 or more; several ranks may have the same one. `total`: one more
  // than the largest possible number; found if it is not given.
  Slices(const Communicator& communicator, std::span<const std::int64_t> ids, std::int64_t total = 0);

  const std::vector<std::int64_t>& ids() const { return ids_; }        // in this rank's slice
  const std::vector<std::int64_t>& counts() const { return counts_; }  // number in the slice of each rank
  std::int64_t first() const;                                          // number in the slices before
  std::int64_t size() const;                                           // on all ranks

  // Collective. Takes `width` values per item of this rank, in the order of the ids, and returns value `component` for
  // the items of the slice. If several ranks have the same item, they must give the same value.
  template <class T>
  std::vector<T> to_slices(std::span<const T> values, int width = 1, int component = 0) const {
    const std::vector<T> arrived = routes_.there([&](int k) { return values[place_of(k, width, component)]; });
    std::vector<T> result(ids_.size());
    for (std::size_t n = 0; n < places_.size(); ++n) result[places_[n]] = arrived[n];
    return result;
  }
  // Collective. All components, one at a time, so that messages are small compared with the data.
  template <class T>
  std::vector<T> rows_to_slices(std::span<const T> values, int width) const {
    std::vector<T> result(ids_.size() * static_cast<std::size_t>(width));
    for (int c = 0; c < width; ++c) put(to_slices(values, width, c), width, c, std::span(result));
    return result;
  }
  // Collective. The opposite direction; `result` has `width` values for each item of this rank.
  template <class T>
  void rows_from_slices(std::span<const T> values, int width, std::span<T> result) const {
    for (int c = 0; c < width; ++c) {
      std::vector<T> answers;
      answers.reserve(places_.size());
      for (const int row : places_) answers.push_back(values[place_of(row, width, c)]);
      put(routes_.back(answers), width, c, result);
    }
  }

 private:
  static std::size_t place_of(int row, int width, int component) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(component);
  }
  template <class T>
  static void put(const std::vector<T>& column, int width, int component, std::span<T> rows) {
    for (int k = 0; k < std::ssize(column); ++k) rows[place_of(k, width, component)] = column[k];
  }

  Communicator communicator_;
  Routes routes_;            // of this rank's items to their slices
  std::vector<int> places_;  // indices in the slice of received items
  std::vector<std::int64_t> ids_, counts_;
};

}  // namespace strut::io
