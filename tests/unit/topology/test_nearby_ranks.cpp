// Which points go to which ranks, of a thousand ranks that are made up.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "topology/nearby_ranks.hpp"

namespace strut {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr int side = 10;  // ranks along an edge; cubes of edge 1 that fill space
constexpr int in_the_middle = 555;

Vector corner_of(int rank) { return {double(rank % side), double(rank / side % side), double(rank / (side * side))}; }

std::vector<Box> boxes_of_ranks() {
  std::vector<Box> boxes;
  for (int r = 0; r < side * side * side; ++r) boxes.emplace_back(corner_of(r), corner_of(r) + Vector::Ones());
  return boxes;
}

// Positions of the rank in the middle, row by row as in a lattice, or in no order at all.
std::vector<Vector> places_of_rank(bool in_order) {
  constexpr int rows = 16;
  std::vector<Vector> places;
  for (int i = 0; i < rows * rows * rows; ++i) {
    const Vector cell(i % rows, i / rows % rows, double(i / (rows * rows)));
    places.push_back(corner_of(in_the_middle) + (cell + Vector::Constant(0.5)) / rows);
  }
  if (!in_order) std::shuffle(places.begin(), places.end(), std::mt19937(3));
  return places;
}

// Every place against every box.
NearbyRanks by_all_tests(const std::vector<Box>& boxes, const std::vector<Vector>& places, double reach) {
  NearbyRanks found;
  for (int r = 0; r < static_cast<int>(boxes.size()); ++r) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      ++found.tests;
      if (r == in_the_middle || boxes[r].isEmpty() || boxes[r].squaredExteriorDistance(places[k]) > reach * reach)
        continue;
      found.ranks.push_back(r);
      found.places.push_back(static_cast<int>(k));
    }
  }
  return found;
}

TEST(NearbyRanks, AreThoseOfAllTestsInTheirOrder) {
  std::vector<Box> boxes = boxes_of_ranks();
  boxes[in_the_middle + 1].setEmpty();  // a neighbor without points
  for (const bool in_order : {true, false}) {
    const std::vector<Vector> places = places_of_rank(in_order);
    for (const double reach : {0.5 / 16, 0.2, 1.3}) {  // the first: points half a spacing from a face, to the last bit
      const NearbyRanks found = nearby_ranks(boxes, in_the_middle, places, reach);
      const NearbyRanks expected = by_all_tests(boxes, places, reach);
      EXPECT_EQ(found.ranks, expected.ranks);
      EXPECT_EQ(found.places, expected.places);
      EXPECT_GT(found.ranks.size(), 1000u) << "the case is too empty to mean anything";
    }
  }
}

// The 26 neighbors are in reach; each takes n tests at the most, and far fewer where places have an order.
TEST(NearbyRanks, ThoseOutOfReachCostNoTestOfAPoint) {
  const std::vector<Box> boxes = boxes_of_ranks();
  const auto tests_a_place = [&](bool in_order) {
    const std::vector<Vector> places = places_of_rank(in_order);
    return double(nearby_ranks(boxes, in_the_middle, places, 0.2).tests) / double(places.size());
  };
  EXPECT_LE(tests_a_place(false), 26);
  EXPECT_LE(tests_a_place(true), 13);
}

TEST(NearbyRanks, AreNoneWithoutPlaces) {
  EXPECT_TRUE(nearby_ranks(boxes_of_ranks(), in_the_middle, {}, 1e9).ranks.empty());
}

}  // namespace
}  // namespace strut
