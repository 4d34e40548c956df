// How far a crack has come and how fast it is, as the history shows it: History > Cracks of a deck.
#pragma once

#include <deque>
#include <string>
#include <utility>

#include "base/archive.hpp"
#include "deck/sections/history.hpp"
#include "mechanics/body.hpp"
#include "topology/point_group.hpp"

namespace strut {

class CrackTip {
 public:
  // Collective. Throws Error where no bond can break, or no point is looked at.
  CrackTip(const deck::WatchedCrack& crack, const Body& body);

  const std::string& name() const { return crack_.name; }
  // How far (m) the cracked points of this rank are along the crack's direction; 0 where there is none.
  double local(const Body& body) const;
  // As a row is written: the largest one of all ranks.
  void take(double time, double tip);
  double tip() const { return rows_.empty() ? 0 : rows_.back().second; }
  double speed() const;  // m/s: of the line that fits the last rows best; 0 of one row

  void serialize(Archive& archive);

 private:
  deck::WatchedCrack crack_;
  PointGroup group_;
  std::deque<std::pair<double, double>> rows_;  // the last ones: time (s), tip (m)
};

}  // namespace strut
