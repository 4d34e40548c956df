// The forces of the pairs of points that a search has found.
#pragma once

#include <functional>
#include <vector>

#include "contact/couples.hpp"
#include "contact/laws/laws.hpp"
#include "contact/search/pairs.hpp"

namespace strut::contact {

// The owned point that another has come nearest to, as a part of the distance at which the two touch: 0 where none
// touches, 1 at the same place. Of surfaces, the overlap in spacings.
struct DeepestPenetration {
  double penetration = 0;
  int point = -1;  // local index in the body
  bool of_surfaces = false;

  void take(const DeepestPenetration& other) {
    if (other.penetration > penetration) *this = other;
  }
};

// Of this rank's points.
struct ForceResult {
  DeepestPenetration deepest;
  double energy = 0;  // stored by the pairs that touch, J: half of each
  // A bound of ω² of the touching points, 1/s²: the largest eigenvalue of any Σ k (1/m_i + 1/√(m_i m_j)) n⊗n. For a
  // pair (n·(x_i − x_j))² ≤ (1 + √(m_i/m_j)) (n·x_i)² + (1 + √(m_j/m_i)) (n·x_j)². With k so that it holds in the next
  // step too: that of twice the present overlap, or of the one after another step like the last, where it is more.
  // Pairs that come to touch in such a step count.
  double stiffness = 0;
};

// The load on a point by the partners that touch it.
struct Load {
  Vector push = Vector::Zero();     // the sum of their normal forces, N
  Tensor springs = Tensor::Zero();  // of which ForceResult::stiffness is the largest eigenvalue, 1/s²
  double contacts = 0;              // how many there are
};

// Collective. Brings the pairs to the present places and adds their normal forces to force_density (N/m³); loads[k] is
// that of pairs.owned[k]. dt: the length of the last step (s); 0: there was none.
ForceResult add_normal_forces(const Kinematics& kinematics, double dt, const PairLaw& law, Pairs& pairs,
                              std::vector<Vector>& force_density, std::vector<Load>& loads);

// Collective, after add_normal_forces. Adds Coulomb friction to force_density; friction[k] is its force on
// pairs.owned[k] (N), so that its work can be counted, beside that of `couples`, which has taken pairs.owned. dt: the
// length of the step (s). `loads`: of pairs.owned, by whatever else rubs on them, too.
void add_friction(const Kinematics& kinematics, const PairLaw& law, double coefficient, double dt, Pairs& pairs,
                  const std::vector<Load>& loads, Couples& couples, std::vector<Vector>& force_density,
                  std::vector<Vector>& friction);

// After add_normal_forces. What each point pairs.owned[k] feels, by visit(k, force in N).
void for_each_normal_force(const PairLaw& law, const Pairs& pairs,
                           const std::function<void(std::size_t, Vector)>& visit);

// Collective, after add_normal_forces. Adds the tangent stiffness of the touching pairs, times a field of the body's
// owned points, to result (N/m times the field's unit). The turning of a pair's direction is left out.
void add_stiffness(const PairLaw& law, Pairs& pairs, std::span<const Vector> field, std::span<Vector> result);

// Of each owned point alone, N/m.
void add_springs(const PairLaw& law, const Pairs& pairs, std::span<Tensor> springs);

}  // namespace strut::contact
