// How points stand in files, and how on ranks: by number in slices, one after the other, and as the partition has it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel/communicator.hpp"
#include "base/parallel/portions.hpp"

namespace strut::io {

// Of `total` numbers 0, 1, … the slice of each rank: as many for each, to one.
std::vector<std::int64_t> slice_counts(std::int64_t total, int ranks);
// The first number of the slice of `rank`.
std::int64_t slice_begin(std::int64_t total, int ranks, int rank);
// The rank whose slice has the number.
int slice_owner(std::int64_t total, int ranks, std::int64_t number);

// Numbered things (points, nodes) that ranks have in any order, and the same in slices: each rank also keeps those
// whose numbers are in its slice, in ascending order. Values travel either way between both without any rank having
// more than its points and its slice.
class Slices {
 public:
  // Collective. `ids`: numbers of this rank's, 0 or more; several ranks may have the same. `total`: one more than the
  // largest may be; found where it is not given.
  Slices(const Communicator& communicator, std::span<const std::int64_t> ids, std::int64_t total = 0);

  const std::vector<std::int64_t>& ids() const { return ids_; }        // of this rank's slice
  const std::vector<std::int64_t>& counts() const { return counts_; }  // in the slice of each rank
  std::int64_t first() const;                                          // how many are in the slices before
  std::int64_t size() const;                                           // on all ranks

  // Collective. `width` values for each of this rank's things, in the order of the ids given; those of the slice. Where
  // several ranks have the same thing they must give the same.
  template <class T>
  std::vector<T> to_slices(std::span<const T> values, int width = 1) const {
    const std::vector<T> arrived =
        exchange<T>(communicator_, picked(values, leaving_, width), times(width, to_ranks_), times(width, from_ranks_));
    return placed(std::span<const T>(arrived), places_, ids_.size(), width);
  }
  // Collective. The way back.
  template <class T>
  std::vector<T> from_slices(std::span<const T> values, int width = 1) const {
    const std::vector<T> arrived =
        exchange<T>(communicator_, picked(values, places_, width), times(width, from_ranks_), times(width, to_ranks_));
    return placed(std::span<const T>(arrived), leaving_, leaving_.size(), width);
  }

 private:
  template <class T>
  static std::vector<T> picked(std::span<const T> values, const std::vector<int>& places, int width) {
    std::vector<T> result;
    const auto w = static_cast<std::size_t>(width);
    result.reserve(places.size() * w);
    for (const int place : places) {
      const auto row = values.subspan(static_cast<std::size_t>(place) * w, w);
      result.insert(result.end(), row.begin(), row.end());
    }
    return result;
  }
  template <class T>
  static std::vector<T> placed(std::span<const T> values, const std::vector<int>& places, std::size_t count,
                               int width) {
    const auto w = static_cast<std::size_t>(width);
    std::vector<T> result(count * w);
    for (std::size_t k = 0; k < places.size(); ++k) {
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(k * w), w,
                  result.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(places[k]) * w));
    }
    return result;
  }
  static std::vector<std::int64_t> times(int width, std::vector<std::int64_t> counts);

  Communicator communicator_;
  std::vector<int> leaving_;                         // this rank's things, as they leave
  std::vector<int> places_;                          // in the slice, of those that arrive
  std::vector<std::int64_t> to_ranks_, from_ranks_;  // how many
  std::vector<std::int64_t> ids_, counts_;
};

}  // namespace strut::io
