// Averages the criterion of ductile failure over a length that does not depend on the spacing.
//
// A criterion that only the point itself feels has no length: at a notch or in a neck finer points reach it sooner.
// Here its growth is averaged over a ball of radius R (Pijaudier-Cabot & Bažant 1987, for damage). The average is made
// of passes over the families. Each pass replaces a value by its mean over the family, or moves it toward this mean by
// a fraction. The variances of the passes add up to that of the ball, R²/5 along each axis. Broken bonds do not count,
// so nothing is averaged across a crack or from one strut to another.
#pragma once

#include <vector>

#include "mechanics/body.hpp"

namespace strut {

class AveragedCriterion {
 public:
  AveragedCriterion() = default;  // nothing is averaged
  // Collective. The families must be complete.
  explicit AveragedCriterion(Body& body);

  // Collective. Replaces the growth of the failure indicators since the last call that averaged by its average, once an
  // indicator has grown by 0.01 (points fail at 1).
  void average(Body& body);

  double bytes() const { return static_cast<double>(has_indicator_.size()); }

 private:
  struct OfBlock {
    std::size_t block;
    int number;   // of the indicator among the law's state variables
    double part;  // fraction by which a pass moves a value toward its mean
  };

  template <class Visit>
  void over_family(const Domain& domain, int i, const Visit& visit) const;
  template <class Visit>
  void over_points(Body& body, const Visit& visit) const;
  double largest_variance(const Domain& domain, const MaterialBlock& block) const;
  std::vector<double> growth_of(Body& body) const;
  void pass(Body& body, std::vector<double>& growth) const;

  std::vector<OfBlock> blocks_;      // with a criterion and a radius
  std::vector<char> has_indicator_;  // of owned points and ghosts: 1 in these blocks
  int passes_ = 0;
};

}  // namespace strut
