// Bonds that run through material: which members of a family are joined to the point by points that touch.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/math/tensors.hpp"

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

  // Those of `asked` to which no path of points leads that touch and are bonded to both ends. `family`: all that is
  // within the horizon of i; `asked`: some of it. Symmetric: i is apart from j where j is apart from i.
  std::vector<int> apart(int i, std::span<const int> family, std::span<const int> asked);
  bool touch(int i, int j) const;

 private:
  std::span<const int> touching(int i) const {
    return {touching_.data() + start_[i], touching_.data() + start_[i + 1]};
  }
  bool near(int i, int j) const;
  bool in_family(int i) const { return mark_[i] >> 1 == now_; }
  bool is_missing(int i) const { return mark_[i] == 2 * now_; }
  void spread(int i, std::size_t family);
  bool is_near_path(int j, int end) const;
  bool walks_straight(int i, int j) const;
  bool floods(int i, int j);

  Joined points_;
  std::vector<std::size_t> start_{0};
  std::vector<int> touching_;  // of each point, ascending, without itself
  // One a point. Where it holds twice the number of the present search the point is in its family, where it is one more
  // it has been joined to i, too.
  std::vector<std::int64_t> mark_;
  std::vector<std::int64_t> seen_;  // the number of the last flood that was here
  std::int64_t now_ = 0, flood_ = 0;
  std::vector<int> before_;  // of a joined point: the one before it on a path from i; −1 where it touches i
  std::vector<int> front_;
};

}  // namespace strut
