// Points of all ranks of which something is told: how many there are, and where one of them is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

struct FoundPoints {
  std::int64_t count = 0;
  Vector one = Vector::Zero();  // the reference position of the one with the least id, m
};

// Collective. Of each of these lists of owned points; there are as many lists on every rank.
std::vector<FoundPoints> found_points(const Body& body, const std::vector<std::vector<int>>& lists);

std::string place_text(const Vector& place);  // "(x, y, z) m"

}  // namespace strut
