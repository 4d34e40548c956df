// Position and speed of a crack tip for the history: History > Cracks of a deck.
#pragma once

#include <deque>
#include <string>
#include <utility>

#include "base/archive.hpp"
#include "deck/sections/output.hpp"
#include "mechanics/body.hpp"
#include "topology/point_group.hpp"

namespace strut {

class CrackTip {
 public:
  // Collective. Throws Error if no bond can break, or if the group contains no point.
  CrackTip(const deck::WatchedCrack& crack, const Body& body);

  const std::string& name() const { return crack_.name; }
  // Largest position (m) of the cracked points of this rank along the crack's direction; 0 without any.
  double local(const Body& body) const;
  // Call it when a row is written; `tip`: the largest value over all ranks.
  void take(double time, double tip);
  double tip() const { return rows_.empty() ? 0 : rows_.back().second; }
  double speed() const;  // m/s: slope of the best-fit line through the last rows; 0 for one row

  void serialize(Archive& archive);

 private:
  deck::WatchedCrack crack_;
  PointGroup group_;
  std::deque<std::pair<double, double>> rows_;  // the last rows: time (s), tip (m)
};

}  // namespace strut
