#include "output/mean_forces.hpp"

#include <utility>

namespace strut {

void MeanForces::add(std::span<const double> before, std::span<const double> after) {
  for (std::size_t k = 0; k < passed_.size(); ++k) {
    passed_[k] += ahead_[k] + before[k];
    ahead_[k] = after[k];
  }
}

std::vector<double> MeanForces::take(double time, const Communicator& communicator) {
  std::vector<double> means = std::exchange(passed_, std::vector<double>(passed_.size()));
  communicator.sum(means);
  for (double& mean : means) mean = time > since_ ? mean / (time - since_) : 0;
  since_ = time;
  return means;
}

void MeanForces::serialize(Archive& archive) {
  archive.number("mean_forces_since", since_);
  for (std::size_t k = 0; k < passed_.size(); ++k) {
    archive.share("mean_force_passed_" + std::to_string(k), passed_[k]);
    archive.share("mean_force_ahead_" + std::to_string(k), ahead_[k]);
  }
}

}  // namespace strut
