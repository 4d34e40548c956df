// An upper bound for the relative displacement of any two bonded points.
//
// Consecutive clusters form a region. Points of a region and of its families move apart no faster than the diagonal of
// the bounding box of their velocities. If there are ghosts among them, whose velocities are unknown, the box of the
// velocities of all points is used, and the displacement of the periodic sides is added.
#pragma once

#include <span>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

class Travel {
 public:
  explicit Travel(const Domain& domain);

  // Collective. Adds a step of dt (s) with these velocities of owned points (m/s). `next_checks`: travel at which each
  // cluster must be checked, m; infinite if it need not be. `stretch`: increment of the stretch of periodic sides in
  // the step, along x, y, z. Returns true if a cluster of any rank must be checked.
  bool advance(const Body& body, std::span<const Vector> velocities, double dt, std::span<const double> next_checks,
               const Vector& stretch);

  double of(int cluster) const { return regions_[cluster / clusters_a_region].travel; }  // since the start, m
  double last() const { return last_; }  // of any two points in the last step, m
  double bytes() const;

 private:
  static constexpr int clusters_a_region = 8;

  struct Region {
    std::vector<int> near;  // regions with points in the families of this one, itself included
    bool meets_ghosts = false;
    double travel = 0;        // m
    Eigen::AlignedBox3d box;  // of velocities, m/s
  };
  void set_boxes(const ClusterLists& lists, std::span<const Vector> velocities, std::span<const double> next_checks);
  double until_check(std::size_t region, std::span<const double> next_checks) const;

  std::vector<Region> regions_;
  Vector farthest_ = Vector::Zero();  // largest shift of an image behind periodic sides, along x, y, z, m
  double last_ = 0;
};

}  // namespace strut
