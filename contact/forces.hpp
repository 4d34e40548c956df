// Forces of the pairs of points that a search has found.
#pragma once

#include <functional>
#include <vector>

#include "contact/couples.hpp"
#include "contact/laws/laws.hpp"
#include "contact/search/pairs.hpp"

namespace strut::contact {

// The owned point with the deepest penetration, relative to the touching distance of the pair: 0 without touching
// points, 1 at the same position. For surfaces, the overlap in spacings.
struct DeepestPenetration {
  double penetration = 0;
  int point = -1;  // local index in the body
  bool of_surfaces = false;

  void take(const DeepestPenetration& other) {
    if (other.penetration > penetration) *this = other;
  }
};

// Result of an evaluation for this rank's points.
struct ForceResult {
  DeepestPenetration deepest;
  double energy = 0;  // stored by the touching pairs, J: half for each end
  // A bound of ω² of the touching points, 1/s²: the largest eigenvalue over all points of Σ k (1/m_i + 1/√(m_i m_j))
  // n⊗n, because (n·(x_i − x_j))² ≤ (1 + √(m_i/m_j)) (n·x_i)² + (1 + √(m_j/m_i)) (n·x_j)² for a pair. k also bounds the
  // next step: it is the stiffness at twice the present overlap, or after another step like the last one if that is
  // more. Pairs that come to touch in such a step are included.
  double stiffness = 0;
};

// The contact forces on a point by its touching partners.
struct Load {
  Vector push = Vector::Zero();     // the sum of their normal forces, N
  Tensor springs = Tensor::Zero();  // the tensor whose largest eigenvalue is ForceResult::stiffness, 1/s²
  double contacts = 0;              // number of touching partners
};

// Collective. Updates the pairs to the present positions and adds their normal forces to force_density (N/m³); loads[k]
// belongs to pairs.owned[k]. dt: length of the last step (s), 0 if there was none, as in a trial of an equilibrium.
ForceResult add_normal_forces(const Kinematics& kinematics, double dt, const PairLaw& law, Pairs& pairs,
                              std::vector<Vector>& force_density, std::vector<Load>& loads);

// Collective, after add_normal_forces. Adds Coulomb friction to force_density; friction[k] is the force on
// pairs.owned[k] (N), for its work, without the forces of `couples`, which must have taken pairs.owned. dt: length of
// the step (s). `loads`: of pairs.owned, including other contact pairs.
void add_friction(const Kinematics& kinematics, const PairLaw& law, double coefficient, double dt, Pairs& pairs,
                  const std::vector<Load>& loads, Couples& couples, std::vector<Vector>& force_density,
                  std::vector<Vector>& friction);

// After add_normal_forces. Calls visit(k, force in N) for each point pairs.owned[k].
void for_each_normal_force(const PairLaw& law, const Pairs& pairs,
                           const std::function<void(std::size_t, Vector)>& visit);

// After add_normal_forces. The sum of these forces through periodic sides across each axis, N: this rank's part.
Vector normal_force_through_sides(const PairLaw& law, const Pairs& pairs);

// Collective, after add_normal_forces. Adds the tangent stiffness of the touching pairs, times a field of the body's
// owned points, to result (N/m times the field's unit). The rotation of a pair's direction is neglected.
void add_stiffness(const PairLaw& law, Pairs& pairs, std::span<const Vector> field, std::span<Vector> result);

// Diagonal blocks of that stiffness, for each owned point, N/m.
void add_springs(const PairLaw& law, const Pairs& pairs, std::span<Tensor> springs);

// The bound of ω² of a point held by springs: largest eigenvalue of a positive semidefinite tensor; 0 if its trace, an
// upper bound, is at most `floor`.
double largest_eigenvalue(const Tensor& springs, double floor);

}  // namespace strut::contact
