// Bonds that run through material: which members of a family are joined to the point by points that touch.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/tensors.hpp"

namespace strut {

// What is known of the points of a search, owned or of other ranks; they are named by their places in these columns.
struct Joined {
  std::span<const Vector> positions;
  std::span<const double> horizons;
  std::span<const int> bodies;
};

class ThroughMaterial {
 public:
  // `joints`: the number of a joint and a point that has it, in any order. Points of different bodies do not touch.
  ThroughMaterial(const Joined& points, std::vector<std::pair<std::int64_t, int>> joints);

  // Those of `family`, which is all that is bonded to i, to which no path of points leads that touch and are bonded to
  // both ends. Symmetric: i is apart from j where j is apart from i. In the order of the family.
  std::vector<int> apart(int i, std::span<const int> family);

 private:
  std::span<const int> touching(int i) const {
    return {touching_.data() + start_[i], touching_.data() + start_[i + 1]};
  }
  bool touch(int i, int j) const;
  bool near(int i, int j) const;
  bool in_family(int i) const { return family_[i] == now_; }
  bool is_joined(int i) const { return joined_[i] == now_; }
  void join_over_one(int i);
  bool walks_straight(int i, int j) const;
  bool floods(int i, int j);

  Joined points_;
  std::vector<std::size_t> start_{0};
  std::vector<int> touching_;  // of each point, ascending, without itself
  // Marks, one a point: set where they hold the number of the present search.
  std::vector<std::int64_t> family_, joined_, seen_;
  std::int64_t now_ = 0, flood_ = 0;
  std::vector<int> front_;
};

}  // namespace strut
