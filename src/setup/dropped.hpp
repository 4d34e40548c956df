// Points that are dropped because they have too few neighbors, and the parts that this cuts off.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "topology/domain.hpp"

namespace strut {

// Numbers over all ranks.
struct Dropped {
  std::int64_t points = 0;
  // Parts of former pieces, without the largest part of each, and their points.
  std::int64_t parts = 0, points_cut_off = 0;
};

// Id and piece of each point of this rank, by id.
using PiecesOfPoints = std::vector<std::pair<std::int64_t, std::int64_t>>;
PiecesOfPoints pieces_of_points(const Domain& domain);  // collective

// Collective. Finds parts that are cut off in the remaining domain; `before`: pieces before points were dropped.
void take_pieces(const Domain& left, const PiecesOfPoints& before, Dropped& dropped);

// Collective. Throws Error on all ranks if more than 1 % of all points are dropped or cut off.
void check_dropped(const Domain& left, const Dropped& dropped);

// A line of the report, or nothing.
std::string describe_dropped(const Dropped& dropped);

}  // namespace strut
