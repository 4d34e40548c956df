#include "topology/nearby_ranks.hpp"

#include <algorithm>

#include "topology/bounding_box.hpp"

namespace strut {

namespace {

std::vector<Eigen::AlignedBox3d> boxes_of_all(const Eigen::AlignedBox3d& mine, const Communicator& communicator) {
  std::vector<double> corners(6 * communicator.size(), 0);
  // An empty box, with its corners swapped, must stay finite to be summed.
  const Vector low = mine.isEmpty() ? Vector::Constant(1) : mine.min();
  const Vector high = mine.isEmpty() ? Vector::Constant(-1) : mine.max();
  double* own = &corners[6 * communicator.rank()];
  std::copy_n(low.data(), 3, own);
  std::copy_n(high.data(), 3, own + 3);
  communicator.sum(corners);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (int r = 0; r < communicator.size(); ++r) {
    const double* c = &corners[6 * r];
    boxes.emplace_back(Vector(c[0], c[1], c[2]), Vector(c[3], c[4], c[5]));
  }
  return boxes;
}

// Successive positions lie along a curve, or in a lattice: a run of them is in a small box.
constexpr std::size_t run_length = 32;

struct Run {
  std::size_t begin, end;
  Eigen::AlignedBox3d box;
};

std::vector<Run> runs_of(std::span<const Vector> places) {
  std::vector<Run> runs;
  for (std::size_t begin = 0; begin < places.size(); begin += run_length) {
    const std::size_t count = std::min(run_length, places.size() - begin);
    runs.push_back({begin, begin + count, box_around(places.subspan(begin, count))});
  }
  return runs;
}

}  // namespace

// A box that contains positions is no farther from another box than any of them, to the last bit, because differences
// of coordinates and sums of squares are monotonic in floating point.
NearbyRanks nearby_ranks(std::span<const Eigen::AlignedBox3d> boxes, int this_rank, std::span<const Vector> places,
                         double reach) {
  NearbyRanks found;
  const Eigen::AlignedBox3d around = box_around(places);
  const std::vector<Run> runs = runs_of(places);
  for (int r = 0; r < static_cast<int>(boxes.size()); ++r) {
    const auto near = [&](const auto& what) { return boxes[r].squaredExteriorDistance(what) <= reach * reach; };
    if (r == this_rank || boxes[r].isEmpty() || !near(around)) continue;
    for (const Run& run : runs) {
      if (!near(run.box)) continue;
      found.tests += static_cast<std::int64_t>(run.end - run.begin);
      for (std::size_t k = run.begin; k < run.end; ++k) {
        if (!near(places[k])) continue;
        found.ranks.push_back(r);
        found.places.push_back(static_cast<int>(k));
      }
    }
  }
  return found;
}

NearbyRanks nearby_ranks(const Eigen::AlignedBox3d& box, std::span<const Vector> places, double reach,
                         const Communicator& communicator) {
  if (communicator.size() == 1) return {};
  return nearby_ranks(boxes_of_all(box, communicator), communicator.rank(), places, reach);
}

}  // namespace strut
