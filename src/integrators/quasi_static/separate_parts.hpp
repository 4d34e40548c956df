// The parts of a scene that neither bonds nor contact connect. Each is in equilibrium by its own forces: those of a
// part that bears much are no measure for another one.
#pragma once

#include <span>
#include <vector>

#include "contact/contact.hpp"
#include "topology/domain.hpp"

namespace strut {

class SeparateParts {
 public:
  SeparateParts(const Domain& domain, const contact::Contact& contact);

  int count() const { return count_; }           // the same on all ranks
  int of(int i) const { return of_points_[i]; }  // of an owned point

  // Collective. For each part, the root of the sum of squares of a field of the owned points.
  std::vector<double> norms(std::span<const Vector> field, const Communicator& ranks) const;

 private:
  std::vector<int> of_points_;
  int count_ = 0;
};

}  // namespace strut
