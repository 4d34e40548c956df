#include "io/slices.hpp"

#include <algorithm>
#include <numeric>

namespace strut::io {

std::int64_t slice_begin(std::int64_t total, int ranks, int rank) { return total * rank / ranks; }

std::vector<std::int64_t> slice_counts(std::int64_t total, int ranks) {
  std::vector<std::int64_t> counts;
  for (int rank = 0; rank < ranks; ++rank) {
    counts.push_back(slice_begin(total, ranks, rank + 1) - slice_begin(total, ranks, rank));
  }
  return counts;
}

// The last rank whose slice begins at this number or before.
int slice_owner(std::int64_t total, int ranks, std::int64_t number) {
  return static_cast<int>(((number + 1) * ranks - 1) / total);
}

Slices::Slices(const Communicator& communicator, std::span<const std::int64_t> ids, std::int64_t total)
    : communicator_(communicator), leaving_(ids.size()), to_ranks_(static_cast<std::size_t>(communicator.size()), 0) {
  if (total == 0) {
    const std::int64_t largest = ids.empty() ? -1 : *std::max_element(ids.begin(), ids.end());
    total = 1 + static_cast<std::int64_t>(communicator.max(static_cast<double>(largest)));
  }
  std::iota(leaving_.begin(), leaving_.end(), 0);
  std::sort(leaving_.begin(), leaving_.end(),
            [&ids](int a, int b) { return ids[static_cast<std::size_t>(a)] < ids[static_cast<std::size_t>(b)]; });
  for (const std::int64_t id : ids) {
    ++to_ranks_[static_cast<std::size_t>(slice_owner(total, communicator.size(), id))];
  }
  from_ranks_ = counts_from_ranks(communicator, to_ranks_);
  const std::vector<std::int64_t> arrived =
      exchange<std::int64_t>(communicator, picked(ids, leaving_, 1, 0), to_ranks_, from_ranks_);
  ids_ = arrived;
  std::sort(ids_.begin(), ids_.end());
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  places_.reserve(arrived.size());
  for (const std::int64_t id : arrived) {
    places_.push_back(static_cast<int>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin()));
  }
  const auto own = static_cast<std::int64_t>(ids_.size());
  counts_ = counts_from_ranks(communicator, std::vector<std::int64_t>(to_ranks_.size(), own));
}

std::int64_t Slices::first() const {
  return std::accumulate(counts_.begin(), counts_.begin() + communicator_.rank(), std::int64_t{0});
}

std::int64_t Slices::size() const { return std::accumulate(counts_.begin(), counts_.end(), std::int64_t{0}); }

}  // namespace strut::io
