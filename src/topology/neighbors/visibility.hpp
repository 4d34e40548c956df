// Visibility: the members of a family that a chain of touching points joins to the point.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/math/tensors.hpp"

namespace strut {

// The points of a search, owned or of other ranks; they are identified by their indices in these columns.
struct MeshedPoints {
  std::span<const Vector> positions;
  std::span<const double> horizons;
  std::span<const int> bodies;
};

class Visibility {
 public:
  // `shared_nodes`: pairs of a shared node and a point that has it, in any order. Points of different bodies do not
  // touch.
  Visibility(const MeshedPoints& points, std::vector<std::pair<std::int64_t, int>> shared_nodes);

  // Returns the points of `asked` that no chain of touching points, each bonded to both ends, connects with i.
  // `family`: all points within the horizon of i; `asked`: some of them. Symmetric: i is apart from j if j is apart
  // from i.
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

  MeshedPoints points_;
  std::vector<std::size_t> start_{0};
  std::vector<int> touching_;  // touching points of each point, ascending, without itself
  // One per point, with two meanings in one number: 2 now_ if the point is in the family of the present search, 2 now_
  // + 1 if a chain of touching points also connects it with i.
  std::vector<std::int64_t> mark_;
  std::vector<std::int64_t> seen_;  // number of the last flood that reached the point
  std::int64_t now_ = 0, flood_ = 0;
  std::vector<int> before_;  // of a joined point: the previous one on a path from i; −1 if it touches i
  std::vector<int> front_;
};

}  // namespace strut
