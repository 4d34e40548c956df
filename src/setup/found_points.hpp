// The points that a message describes, over all ranks: their number, and the position of one of them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mechanics/step_report.hpp"

namespace strut {

struct FoundPoints {
  std::int64_t count = 0;
  Vector one = Vector::Zero();           // the reference position of the one with the least id, m
  Vector displacement = Vector::Zero();  // of that one, m
};

// Collective. One result for each list of owned points; every rank has the same number of lists.
std::vector<FoundPoints> found_points(const Body& body, const std::vector<std::vector<int>>& lists);

using IndexPair = std::array<int, 2>;  // of two conditions or blocks

// Collective. The pairs that occur on any rank, in order.
std::vector<IndexPair> on_all_ranks(std::vector<IndexPair> pairs, const Communicator& communicator);

// Collective. The same for the points of each pair that occurs on any rank, without pairs that have no points.
std::map<IndexPair, FoundPoints> found_points_of_pairs(const Body& body,
                                                       const std::map<IndexPair, std::vector<int>>& lists);

}  // namespace strut
