// The points that a message describes, over all ranks: their number, and the position of one of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

struct FoundPoints {
  std::int64_t count = 0;
  Vector one = Vector::Zero();           // the reference position of the one with the least id, m
  Vector displacement = Vector::Zero();  // of that one, m
};

// Collective. One result for each list of owned points; every rank has the same number of lists.
std::vector<FoundPoints> found_points(const Body& body, const std::vector<std::vector<int>>& lists);

std::string place_text(const Vector& place);  // "(x, y, z) m"

}  // namespace strut
