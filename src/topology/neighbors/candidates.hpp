// Candidates for neighbors of this rank's points: its own points, those of other ranks nearby, and mirror
// images.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "topology/bounding_box.hpp"
#include "topology/cloud.hpp"
#include "topology/mirror.hpp"
#include "topology/nearby_ranks.hpp"
#include "topology/neighbors/block_bonds.hpp"
#include "topology/neighbors/cell_grid.hpp"

namespace strut {

// The mirrors or periods, and the images that they make.
struct Mirrored {
  std::vector<Mirror> mirrors;
  std::vector<Eigen::AlignedBox3d> boxes;  // for each mirror: the box of its body
  Images images;
  std::vector<Period> periods = {};
  Eigen::AlignedBox3d all = {};  // with periods: the box of all points
};

// Collective.
Mirrored mirrored(std::vector<Mirror> mirrors, const std::vector<Period>& periods, const PointCloud& cloud,
                  const std::vector<BlockBonds>& bonds, double reach, const Communicator& communicator);

// A position of a point that families of other points may need: its own (image 0), or that of an image.
struct Offered {
  int point, image;
  Vector place;
};

// The positions of the points of this rank. `reach`: the largest horizon, m.
std::vector<Offered> offered(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const Mirrored& mirrored,
                             double reach);

// The records of all positions offered to this rank: first from other ranks, then of images of its own points.
template <class Record>
std::vector<Record> received(const PointCloud& cloud, std::span<const Vector> places,
                             const std::vector<Record>& records, const std::vector<char>& is_image, double reach,
                             const Communicator& communicator) {
  const Eigen::AlignedBox3d box = box_around(cloud.positions);
  std::vector<Record> all = from_nearby_ranks<Record>(box, places, records, reach, communicator);
  if (box.isEmpty()) return all;
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (is_image[k] && box.squaredExteriorDistance(places[k]) <= reach * reach) all.push_back(records[k]);
  }
  return all;
}

// Owned points first, then candidates.
struct CandidatePool {
  std::vector<Vector> positions;
  std::vector<double> volumes;
  std::vector<std::int64_t> ids;
  std::vector<double> horizons;
  std::vector<int> bodies;
  std::vector<char> asks;      // 1: for visibility; 2: for touching points
  std::vector<double> deltas;  // δ, m; `horizons`: δ times search_factor()
  std::vector<int> owners;     // ranks of the candidates

  // A point on a symmetry plane, with the computed half of its cell, coincides with its image.
  bool is_own_image(int i, int j, const Vector& xi) const {
    constexpr double most = 12 * on_plane;  // of an edge of the cell's part before two planes or three
    return ids[i] != ids[j] && Images::original(ids[i]) == Images::original(ids[j]) &&
           xi.norm() < most * std::cbrt(volumes[i]);
  }
};

// The horizons of the search for each owned point, m.
std::vector<double> horizons_of(const PointCloud& cloud, const std::vector<BlockBonds>& bonds);

// Collective. This rank's points with these horizons, then points of other ranks and images within `reach` (m) of the
// box of this rank's points.
CandidatePool candidates_of(const PointCloud& cloud, const std::vector<double>& horizons,
                            const std::vector<BlockBonds>& bonds, const std::vector<Offered>& offers, double reach,
                            const Communicator& communicator);

// Calls visit(j) for all candidates within the horizon of pool member i.
template <class Visit>
void for_each_within(const CellGrid& grid, const CandidatePool& pool, int i, double reach, Visit&& visit) {
  const Vector here = pool.positions[i];
  grid.visit_near(here, [&](int j, const Vector& there) {
    const Vector xi = there - here;
    if (xi.squaredNorm() > reach * reach || j == i || pool.bodies[i] != pool.bodies[j]) return;
    if (pool.is_own_image(i, j, xi)) return;
    if (bonded(pool.horizons[i], pool.horizons[j], xi)) visit(j);
  });
}

}  // namespace strut
