#include "mechanics/mirror_forces.hpp"

#include <set>

#include "mechanics/force_sum.hpp"
#include "mechanics/formulation/quadratic_fits.hpp"
#include "topology/mirror_planes.hpp"

namespace strut {

namespace {

using bonds::to_vector;

// The images in the family of a point that a predicate selects.
template <class Picks>
struct OfImages : bonds::NearPoint {
  const Families& families;
  const Picks& picks;

  template <class Visit>
  void for_each(Visit&& visit) const {
    families.for_each(i, [&](int j) {
      if (picks(j)) visit(j, 1.0);
    });
  }
};

// The force density (N/m³) of some bonds of a point by all formulations. `active`: the bonds of `family` whose far ends
// act at this time. `own`: true if the point's own state acts at this time, on all bonds of `family`.
template <class Family, class Active, class Weight>
Vector force_of(const Body& body, const Family& family, const Active& active, bool own, Weight weight) {
  const Site* sites = body.domain.sites.data();
  const ForceStates& states = body.force_states;
  const int i = family.i;
  Vector force = Vector::Zero();
  if (!states.tensors.empty()) {
    force += to_vector(bonds::far_force<true>(active, sites, states.tensors.data(), weight));
    Vector moment = Vector::Zero(), pull = Vector::Zero();
    bonds::over(family, sites, weight, [&](int j, double w, const auto& xi, double) {
      moment += w * to_vector(xi);
      pull += w * (body.current(j) - body.current(i));
    });
    if (own) force += bonds::tensor_of(states.tensors[i]) * moment + states.tensors[i].stiffness() * pull;
  }
  if (own && !states.gradients.empty()) {
    for_each_bond_stabilization([&]<class S>(const S&, std::size_t kind) {
      if (body.block_of(i).material.stabilization.index() != kind) return;
      force += to_vector(bonds::residual<S>(kind, active, sites, states.gradients.data(), weight).force);
    });
  }
  if (!states.scalars.empty()) {
    force +=
        to_vector(bonds::ordinary_force(active, sites, states.scalars.data(), weight, bonds::OfPlaces<Active>(active)));
  }
  if (!states.quadratics.empty()) {
    const Eigen::Array4d* multipliers = body.fits->multipliers();
    force += to_vector(bonds::quadratic_far_force(active, sites, multipliers, states.quadratics.data(), weight));
    if (own && body.block_of(i).is_quadratic()) {
      QuadraticFit fit;
      bonds::set_sums(family, sites, multipliers, weight, fit);
      force += bonds::quadratic_own_force(states.quadratics[i], fit);
    }
  }
  return force;
}

// The owned points that `counts` selects and that are not in rigid motion: all, or those that moved in a substep.
std::vector<int> moving_points(const Body& body, const std::vector<int>* moved, const auto& counts) {
  std::vector<int> points;
  const auto look_at = [&](int i) {
    if (counts(i) && !body.block_of(i).in_rigid_motion) points.push_back(i);
  };
  if (moved) {
    std::ranges::for_each(*moved, look_at);
  } else {
    for (int i = 0; i < body.owned(); ++i) look_at(i);
  }
  return points;
}

// Calls visit(point, force on it in N through its bonds to the images that `picks` selects) for some points. Only ends
// with a time-step level of at least `level` act; the point's own state also acts through bonds to other images.
template <class Picks>
void for_each_image_force(const Body& body, const std::vector<int>& points, int level, const Picks& picks,
                          const auto& visit) {
  const auto acts = [&](int j) { return picks(j) && body.is_active(j, level); };
  bonds::with_influence(body.influence, [&](auto weight) {
    for (const int i : points) {
      const OfImages<Picks> family{{i}, body.domain.families, picks};
      const OfImages<decltype(acts)> active{{i}, body.domain.families, acts};
      visit(i, Vector(body.domain.volume(i) * force_of(body, family, active, body.is_active(i, level), weight)));
    }
  });
}

// For each site, how many periods it is above its original; 0 for sites that are no images.
std::vector<int> periods_above(const Domain& domain, const Period& period) {
  std::vector<int> above(domain.sites.size(), 0);
  for (const ImagePoint& image : domain.halo.images()) above[image.ghost] = strut::periods_above(image.by, period);
  return above;
}

}  // namespace

// A bond over a side is in two families, at either side, once by an image above and once by one below.
void for_each_period_force(const Body& body, int level, const std::vector<int>* moved,
                           const std::function<void(int, std::size_t, double)>& visit) {
  const Domain& domain = body.domain;
  // Images are ghosts: points of the interior have none in their families.
  const std::vector<int> points = moving_points(body, moved, [&](int i) { return i >= domain.interior; });
  for (std::size_t m = 0; m < domain.periods.size(); ++m) {
    const int axis = domain.periods[m].axis;
    const std::vector<int> above = periods_above(domain, domain.periods[m]);
    for (const int n : std::set<int>(above.begin(), above.end())) {
      const auto picks = [&](int j) { return above[j] == n; };
      const auto half = [&](int i, const Vector& force) { visit(i, m, 0.5 * n * force[axis]); };
      if (n != 0) for_each_image_force(body, points, level, picks, half);
    }
  }
}

std::vector<Vector> mirror_forces(const Body& body, int level, const std::vector<int>* moved) {
  const Domain& domain = body.domain;
  if (!domain.periods.empty()) {
    std::vector<Vector> forces(domain.periods.size(), Vector::Zero());
    for_each_period_force(body, level, moved,
                          [&](int, std::size_t m, double force) { forces[m][domain.periods[m].axis] += force; });
    return forces;
  }
  const auto points_of = [&](int number) {
    return moving_points(body, moved, [&](int i) { return domain.body_of(i) == number; });
  };
  const auto on_body = [&](int number) {
    Vector sum = Vector::Zero();
    for (const int i : points_of(number)) sum += domain.volume(i) * body.force_density[i];
    return sum;
  };
  const auto of_images = [&](int number, const std::vector<char>& behind) {
    Vector sum = Vector::Zero();
    for_each_image_force(
        body, points_of(number), level, [&](int j) { return behind[j]; },
        [&](int, const Vector& force) { sum += force; });
    return sum;
  };
  return mirror_reactions(domain, {on_body, of_images});
}

void serialize_mirror_forces(Archive& archive, std::vector<Vector>& forces) {
  for (std::size_t m = 0; m < forces.size(); ++m) {
    for (int c = 0; c < 3; ++c) archive.rank_sum("mirror_force_" + std::to_string(m) + "xyz"[c], forces[m][c]);
  }
}

}  // namespace strut
