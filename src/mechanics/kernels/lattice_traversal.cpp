#include "mechanics/kernels/lattice_traversal.hpp"

#include <numeric>

namespace strut {

namespace lattice {

void Planes::keep(int planes) {
  count_ = planes;
  if (storage_.size() < static_cast<std::size_t>(planes))
    storage_.resize(planes), begins_.resize(planes), ends_.resize(planes);
}

void Planes::open(int z, int begin, int end, int columns) {
  columns_ = columns;
  begins_[z % count_] = begin, ends_[z % count_] = end;
  std::vector<Pencil>& storage = storage_[z % count_];
  const std::size_t needed = static_cast<std::size_t>(end - begin) * columns;
  storage.reserve(needed);  // no more, so that the memory forecast does not depend on the order of strips
  storage.resize(std::max(storage.size(), needed));
}

std::size_t Planes::pencils() const {
  std::size_t pencils = 0;
  for (const auto& plane : storage_) pencils += plane.capacity();
  return pencils;
}

std::vector<Strip> strips(const std::vector<int>& slots_at, int far_y, int count) {
  const auto begin = slots_at.begin() + far_y, end = slots_at.end() - far_y;
  const auto all = std::accumulate(begin, end, std::int64_t{0});
  count = (count + threads() - 1) / threads() * threads();
  std::vector<Strip> strips;
  std::int64_t before = 0;
  int y0 = far_y;
  for (auto at = begin; at != end; ++at) {
    before += *at;
    const int y1 = static_cast<int>(at - slots_at.begin()) + 1;
    const bool is_full = before * count >= all * static_cast<std::int64_t>(strips.size() + 1);
    if (!is_full && at + 1 != end) continue;
    strips.push_back({y0, y1});
    y0 = y1;
  }
  return strips;
}

}  // namespace lattice

LatticeSums::Traversal::Traversal(const LatticeSums& all)
    : all_(all),
      lattice_(all.lattice_),
      nothing_(residual_inputs, Pencil{}),
      columns_near_(all.columns_.size()),
      near_(all.above_.size()),
      targets_(all.words_) {}

void LatticeSums::Traversal::take_plane(int z, int columns, const Take& take) {
  Chunk chunk;
  chunk.all = &all_, chunk.begin = sums_.begin(z), chunk.end = sums_.end(z), chunk.columns = columns;
  if (chunk.begin == chunk.end) return;
  chunk.sums = sums_.of(z, chunk.begin);
  take(chunk);
}

double LatticeSums::Traversal::bytes() const {
  return static_cast<double>(
      sizeof(Pencil) * (row_.size() + ring_.storage.size() + across_.size() + sums_.pencils() + sources_.pencils()));
}

// Chance decides which thread runs which strip, so each counts with the largest workspace of any.
double LatticeSums::bytes() const {
  const std::size_t rows = row_begins_.size() * sizeof(int) + 2 * filled_.size() * sizeof(std::uint64_t);
  double most = 0;
  for (const auto& traversal : traversals_) most = std::max(most, traversal->bytes());
  return static_cast<double>(rows) + constants_.bytes() + static_cast<double>(traversals_.size()) * most;
}

}  // namespace strut
