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

namespace {

std::vector<int> owners_of(std::span<const std::int64_t> ids, std::int64_t total, const Communicator& communicator) {
  if (total == 0) {
    const std::int64_t largest = ids.empty() ? -1 : *std::max_element(ids.begin(), ids.end());
    total = 1 + static_cast<std::int64_t>(communicator.max(static_cast<double>(largest)));
  }
  std::vector<int> owners;
  owners.reserve(ids.size());
  for (const std::int64_t id : ids) owners.push_back(slice_owner(total, communicator.size(), id));
  return owners;
}

}  // namespace

Slices::Slices(const Communicator& communicator, std::span<const std::int64_t> ids, std::int64_t total)
    : communicator_(communicator), routes_(communicator, owners_of(ids, total, communicator)) {
  const std::vector<std::int64_t> arrived = routes_.there([&ids](int k) { return ids[k]; });
  ids_ = arrived;
  std::sort(ids_.begin(), ids_.end());
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  places_.reserve(arrived.size());
  for (const std::int64_t id : arrived) {
    places_.push_back(static_cast<int>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin()));
  }
  counts_ = counts_from_ranks(communicator, std::vector<std::int64_t>(communicator.size(), std::ssize(ids_)));
}

std::int64_t Slices::first() const {
  return std::accumulate(counts_.begin(), counts_.begin() + communicator_.rank(), std::int64_t{0});
}

std::int64_t Slices::size() const { return std::accumulate(counts_.begin(), counts_.end(), std::int64_t{0}); }

}  // namespace strut::io
