// The mean stress that the criterion of ductile failure reads in cells by quadratic correspondence.
//
// In plastic flow the volume of cells alternates from one to the next, as in elements with one pressure each. The sum
// of forces does not show that, but a criterion that falls steeply with the mean stress does. Here the criterion gets
// the stress of its integration point, shifted by the difference between a plane through the mean stresses of the
// family's cells (least squares, weighted by volume) and the mean stress of its own cell. Broken bonds take no part.
#pragma once

#include <string_view>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

// The column of a variable in the state of a block's law; -1 if the law has none of this name.
int state_column(const MaterialBlock& block, std::string_view name);

class FittedCriterion {
 public:
  FittedCriterion() = default;  // no block needs it
  explicit FittedCriterion(Body& body);

  // Call it before the stress update of a step.
  void start(const Body& body);
  // Collective. After the stress update: replaces the growth of the failure indicators in it.
  void finish(Body& body) const;

  double bytes() const;

 private:
  struct OfBlock {
    std::size_t block;
    int indicator, strain, rate, temperature;  // columns of the law's state; temperature: -1 without
    std::vector<double> indicators, strains;   // before the step, by integration point
  };

  std::vector<double> mean_stresses(const Body& body) const;
  double fitted(const Body& body, const std::vector<double>& means, int i) const;

  std::vector<OfBlock> blocks_;   // of cells with a criterion that reads the stress
  std::vector<char> takes_part_;  // of owned points and ghosts: 1 in these blocks
};

}  // namespace strut
