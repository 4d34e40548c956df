// Points that the deck lets go because they have too few neighbors, and what falls off with them.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "topology/domain.hpp"

namespace strut {

// Over all ranks.
struct Dropped {
  std::int64_t points = 0;
  // Of a piece that was one before: all parts of what is left but the largest, and their points.
  std::int64_t parts = 0, points_cut_off = 0;
};

// Of the points of this rank, by their ids: the piece that each is in.
using PiecesOfPoints = std::vector<std::pair<std::int64_t, std::int64_t>>;
PiecesOfPoints pieces_of_points(const Domain& domain);  // collective

// Collective. What is cut off in the domain that is left; `before`: where points were before any was dropped.
void take_pieces(const Domain& left, const PiecesOfPoints& before, Dropped& dropped);

// Collective. Throws Error on all ranks where 1 % of all points is lost, dropped or cut off.
void check_dropped(const Domain& left, const Dropped& dropped);

// A line, or nothing.
std::string told(const Dropped& dropped);

}  // namespace strut
