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

}  // namespace

// A bond over a side is in two families, at either side, once by an image above and once by one below.
std::vector<Vector> period_forces(const Body& body, int level, const std::vector<int>* moved) {
  const Domain& domain = body.domain;
  // Images are ghosts: points of the interior have none in their families.
  const std::vector<int> points = moving_points(body, moved, [&](int i) { return i >= domain.interior; });
  std::vector<Vector> forces;
  for (const Period& period : domain.periods) {
    const std::vector<int> above = periods_above(domain, period);
    double force = 0;
    for (const int n : std::set<int>(above.begin(), above.end())) {
      const auto picks = [&](int j) { return above[j] == n; };
      if (n != 0) force += 0.5 * n * image_force(body, points, level, picks)[period.axis];
    }
    forces.emplace_back(force * Vector::Unit(period.axis));
  }
  return forces;
}

}  // namespace strut
