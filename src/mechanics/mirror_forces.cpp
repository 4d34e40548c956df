#include "mechanics/mirror_forces.hpp"

#include <set>

#include "mechanics/image_forces.hpp"
#include "topology/mirror_reactions.hpp"

namespace strut {

namespace {

// For each site; 0 for sites that are no images.
std::vector<int> periods_above(const Domain& domain, const Period& period) {
  std::vector<int> above(domain.sites.size(), 0);
  for (const ImagePoint& image : domain.halo.images()) above[image.ghost] = strut::periods_above(image.by, period);
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

std::vector<Vector> mirror_forces(const Body& body, int level, const std::vector<int>* moved) {
  const Domain& domain = body.domain;
  if (!domain.periods.empty()) return period_forces(body, level, moved);
  const auto points_of = [&](int number) {
    return moving_points(body, moved, [&](int i) { return domain.body_of(i) == number; });
  };
  const auto on_body = [&](int number) {
    Vector sum = Vector::Zero();
    for (const int i : points_of(number)) sum += domain.volume(i) * body.force_density[i];
    return sum;
  };
  const auto of_images = [&](int number, const std::vector<char>& behind) {
    return image_force(body, points_of(number), level, [&](int j) { return behind[j]; });
  };
  return mirror_reactions(domain, {on_body, of_images});
}

void serialize_mirror_forces(Archive& archive, std::vector<Vector>& forces) {
  for (std::size_t m = 0; m < forces.size(); ++m) {
    for (int c = 0; c < 3; ++c) archive.share("mirror_force_" + std::to_string(m) + "xyz"[c], forces[m][c]);
  }
}

}  // namespace strut
