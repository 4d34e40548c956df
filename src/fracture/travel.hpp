// By how much two points that are bonded have moved apart at most.
//
// Clusters that follow upon each other are a region. No two points of it and of its families move apart faster than by
// the diagonal of the box of their velocities; where ghosts are among them, whose velocities are not known, by that of
// all points.
#pragma once

#include <span>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

class Travel {
 public:
  explicit Travel(const Domain& domain);

  // Collective. Over a step of dt (s) with these velocities of owned points (m/s). `due`: of each cluster, the travel
  // at which it is to be looked at, m; infinite of those who do not matter. Returns whether any is due, on any rank.
  bool advance(const Body& body, std::span<const Vector> velocities, double dt, std::span<const double> due);

  double of(int cluster) const { return regions_[cluster / clusters_a_region].travel; }  // so far, m
  double last() const { return last_; }  // of any two points in the last step, m
  double bytes() const;

 private:
  static constexpr int clusters_a_region = 8;

  struct Region {
    std::vector<int> near;  // regions with points that are in families of this one, itself included
    bool meets_ghosts = false;
    double travel = 0;        // m
    Eigen::AlignedBox3d box;  // of velocities, m/s
  };
  void set_boxes(const ClusterLists& lists, std::span<const Vector> velocities, std::span<const double> due);
  double until_due(std::size_t region, std::span<const double> due) const;

  std::vector<Region> regions_;
  double last_ = 0;
};

}  // namespace strut
