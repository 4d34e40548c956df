// Points near the points of other ranks: the candidates for ghosts.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "base/math/tensors.hpp"
#include "base/parallel/communicator.hpp"

namespace strut {

class Communicator;

// Collective. `width` doubles per record; the k-th one goes to ranks[k], which ascend. Returns the records received by
// this rank, also from itself, in the order of the ranks that sent them.
std::vector<double> sent_to_ranks(std::span<const int> ranks, std::span<const double> records, int width,
                                  const Communicator& communicator);

// places[k] goes to ranks[k], in the order of ranks, and within each rank in the order of positions.
struct NearbyRanks {
  std::vector<int> ranks, places;
  std::int64_t tests = 0;  // number of tests of a position against a box
};

// Finds the positions within `reach` (m) of the box of each other rank; an empty box is near none. If a box is out of
// reach of all positions, or of a run of them, they are not tested one by one.
NearbyRanks nearby_ranks(std::span<const Eigen::AlignedBox3d> boxes, int this_rank, std::span<const Vector> places,
                         double reach);

// `width` doubles per position. Used by the template below.
std::vector<double> doubles_from_nearby_ranks(const Eigen::AlignedBox3d& box, std::span<const Vector> places,
                                              std::span<const double> records, int width, double reach,
                                              const Communicator& communicator);

// Collective. records[k] belongs to the point at places[k]. Sends every other rank the records of positions within
// `reach` (m) of that rank's `box`; returns the records received, in the order of ranks. All ranks get all boxes, which
// is fine up to some thousand ranks.
template <class Record>
std::vector<Record> from_nearby_ranks(const Eigen::AlignedBox3d& box, std::span<const Vector> places,
                                      std::span<const Record> records, double reach, const Communicator& communicator) {
  static_assert(std::is_trivially_copyable_v<Record> && sizeof(Record) % sizeof(double) == 0);
  constexpr int width = sizeof(Record) / sizeof(double);
  const std::span<const double> outgoing(reinterpret_cast<const double*>(records.data()), records.size() * width);
  const std::vector<double> incoming = doubles_from_nearby_ranks(box, places, outgoing, width, reach, communicator);
  const Record* first = reinterpret_cast<const Record*>(incoming.data());
  return {first, first + incoming.size() / width};
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
