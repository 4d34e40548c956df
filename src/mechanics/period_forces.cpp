#include "mechanics/period_forces.hpp"

#include <set>

#include "mechanics/image_forces.hpp"

namespace strut {

namespace {

// How many periods above its original each image is; 0 for other points.
std::vector<int> periods_above(const Domain& domain, const Period& period) {
  std::vector<int> above(domain.sites.size(), 0);
  for (const ImagePoint& image : domain.halo.images()) {
    above[image.ghost] = static_cast<int>(std::lround(image.by.period[period.axis] / period.length));
  }
  return above;
}

// The force density of the images on some points, summed with volumes, N.
template <class Picks>
Vector sum_over(const Body& body, const std::vector<int>& points, const Picks& picks, const auto& is_due) {
  Vector sum = Vector::Zero();
  bonds::with_influence(body.influence, [&](auto weight) {
    for (const int i : points) {
      const OfImages<Picks> family{body.domain.families, i, picks};
      sum += body.domain.volume(i) * force_of(body, family, is_due(i), weight);
    }
  });
  return sum;
}

}  // namespace

// A bond over a side is in two families, at either side, once by an image above and once by one below.
std::vector<Vector> period_forces(const Body& body, int level, const std::vector<int>* moved) {
  const Domain& domain = body.domain;
  std::vector<int> points;  // images are ghosts: other points have none
  const auto look_at = [&](int i) {
    if (i >= domain.interior && !body.block_of(i).in_rigid_motion) points.push_back(i);
  };
  for (int i = domain.interior; moved == nullptr && i < domain.owned; ++i) look_at(i);
  if (moved) std::ranges::for_each(*moved, look_at);
  const auto is_due = [&](int i) { return body.time_levels.empty() || body.time_levels[i] >= level; };
  std::vector<Vector> forces;
  for (const Period& period : domain.periods) {
    const std::vector<int> above = periods_above(domain, period);
    double force = 0;
    for (const int n : std::set<int>(above.begin(), above.end())) {
      const auto picks = [&](int j) { return above[j] == n && is_due(j); };
      if (n != 0) force += 0.5 * n * sum_over(body, points, picks, is_due)[period.axis];
    }
    forces.emplace_back(force * Vector::Unit(period.axis));
  }
  return forces;
}

}  // namespace strut
