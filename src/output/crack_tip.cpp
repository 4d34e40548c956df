#include "output/crack_tip.hpp"

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"

namespace strut {

CrackTip::CrackTip(const deck::WatchedCrack& crack, const Body& body) : crack_(crack) {
  const std::string path = "History > Cracks > " + crack.name;
  if (!body.may_break()) throw Error(path + ": no bonds can break here; expected a block with a Damage Model");
  const PointCloud& cloud = body.domain.cloud;
  group_ = PointGroup(cloud, crack.node_set, path + " > Node Set");
  if (body.domain.communicator.sum(std::ssize(group_.points(cloud))) > 0) return;
  throw Error(path + " > Node Set: the node set or block holds no point");
}

double CrackTip::local(const Body& body) const {
  double farthest = 0;
  for (int i = 0; i < body.owned(); ++i) {
    if (!group_.counts(body.domain.cloud, i) || !(body.damage[i] > crack_.damage)) continue;
    farthest = std::max(farthest, crack_.direction.dot(body.domain.reference(i) - crack_.start));
  }
  return farthest;
}

void CrackTip::take(double time, double tip) {
  rows_.emplace_back(time, tip);
  if (static_cast<int>(rows_.size()) > crack_.rows) rows_.pop_front();
}

double CrackTip::speed() const {
  double time = 0, product = 0, square = 0;
  for (const auto& row : rows_) time += row.first / static_cast<double>(rows_.size());
  for (const auto& [t, x] : rows_)
    product += (t - time) * (x - rows_.front().second), square += (t - time) * (t - time);
  return square > 0 ? product / square : 0;
}

void CrackTip::serialize(Archive& archive) {
  const std::string name = "crack_" + crack_.name + "_";
  int count = static_cast<int>(rows_.size());
  archive.number(name + "rows", count);
  rows_.resize(count);
  for (int k = 0; k < crack_.rows; ++k) {  // a fixed number of rows
    std::pair<double, double> row = k < count ? rows_[k] : std::pair(0.0, 0.0);
    archive.number(name + "time_" + std::to_string(k), row.first);
    archive.number(name + "tip_" + std::to_string(k), row.second);
    if (k < count) rows_[k] = row;
  }
}

}  // namespace strut
