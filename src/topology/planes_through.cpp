#include "topology/planes_through.hpp"

#include <algorithm>
#include <iterator>

namespace strut {

std::vector<Mirror> planes_through(const Domain& domain, int i) {
  std::vector<Mirror> planes;
  std::ranges::copy_if(domain.mirrors, std::back_inserter(planes), [&](const Mirror& mirror) {
    return mirror.body == domain.body_of(i) && mirror.holds(domain.reference(i), domain.cloud.spacings[i]);
  });
  return planes;
}

int coincident_images(const Domain& domain, int i) {
  const std::vector<Mirror> planes = planes_through(domain, i);
  std::vector<Tensor> turns{Tensor::Identity()};
  for (std::size_t n = 0; n < turns.size(); ++n) {
    for (const Mirror& plane : planes) {
      const Tensor turn = Reflection::by(plane).turn * turns[n];
      const auto is_it = [&turn](const Tensor& other) { return (other - turn).norm() < 1e-6; };  // round-off is 1e-16
      if (std::none_of(turns.begin(), turns.end(), is_it)) turns.push_back(turn);
    }
  }
  return static_cast<int>(turns.size());
}

}  // namespace strut
