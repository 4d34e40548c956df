// Points near the points of other ranks: the candidates for ghosts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/math/tensors.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"

namespace strut {

// places[k] goes to ranks[k], in the order of ranks, and within each rank in the order of positions.
struct NearbyRanks {
  std::vector<int> ranks, places;
  std::int64_t tests = 0;  // number of tests of a position against a box
};

// Finds the positions within `reach` (m) of the box of each other rank; an empty box is near none. If a box is out of
// reach of all positions, or of a run of them, they are not tested one by one.
NearbyRanks nearby_ranks(std::span<const Eigen::AlignedBox3d> boxes, int this_rank, std::span<const Vector> places,
                         double reach);

// Collective. The same for the box of this rank. All ranks get all boxes, which is fine up to some thousand ranks.
NearbyRanks nearby_ranks(const Eigen::AlignedBox3d& box, std::span<const Vector> places, double reach,
                         const Communicator& communicator);

// Collective. records[k] belongs to the point at places[k]. Sends every other rank the records of positions within
// `reach` (m) of that rank's `box`; returns the records received, in the order of ranks.
template <class Record>
std::vector<Record> from_nearby_ranks(const Eigen::AlignedBox3d& box, std::span<const Vector> places,
                                      std::span<const Record> records, double reach, const Communicator& communicator) {
  if (communicator.size() == 1) return {};
  const NearbyRanks targets = nearby_ranks(box, places, reach, communicator);
  return Routes(communicator, targets.ranks).there([&](int k) { return records[targets.places[k]]; });
}

// The positions of records, which have one: at().
template <class Record>
std::vector<Vector> places_of(const std::vector<Record>& records) {
  std::vector<Vector> places;
  for (const Record& record : records) places.push_back(record.at());
  return places;
}

// Collective. Adds to this rank's records those of other ranks within `reach` (m) of `box`.
template <class Record>
void add_nearby(std::vector<Record>& records, const Eigen::AlignedBox3d& box, double reach,
                const Communicator& communicator) {
  const auto others = from_nearby_ranks(box, places_of(records), std::span<const Record>(records), reach, communicator);
  records.insert(records.end(), others.begin(), others.end());
}

}  // namespace strut
