// Friction between points acts midway between them, friction of surfaces where these are: beside the points, whose
// bodies it would turn. What it turns of a body is the neighborhood of the point, its family and itself (patch.hpp).
#pragma once

#include <span>
#include <vector>

#include "contact/patch.hpp"
#include "contact/search/pairs.hpp"

namespace strut::contact {

class Couples {
 public:
  // Collective, after a search: the points that may get couples, ascending.
  void take(const Domain& domain, const std::vector<int>& points);
  bool any() const { return any_; }

  // The neighborhood of a point: its middle as seen from the point; how fast it turns, 1/s.
  struct Neighborhood {
    Patch patch;
    Vector spin = Vector::Zero();
  };
  // Collective: what ghosts are doing now. After that `of` answers for owned points.
  void bring_to_present(const Kinematics& kinematics);
  Neighborhood of(const Kinematics& kinematics, int i, double arm) const;  // `arm`: as PatchSums has it

  // Collective. Adds forces that are couples[k] (N m) on the neighborhood of points[k]. Each point sums its own, in the
  // order of its family: the same on any number of ranks.
  void add_forces(const Domain& domain, const std::vector<Neighborhood>& neighborhoods,
                  const std::vector<Vector>& couples, std::vector<Vector>& force_density);

  // Calls visit(i, force in N) for the last forces on this rank's points.
  template <class Visit>
  void for_each_force(const Visit& visit) const {
    for (std::size_t n = 0; n < forces_.size(); ++n) visit(affected_[n], forces_[n]);
  }

 private:
  struct Motion {
    Vector place, velocity;
  };
  struct Twist {
    Vector turn, middle;  // θ and where forces are none
  };
  Vector place(const Domain& domain, int i) const { return i < domain.owned ? domain.current(i) : motions_[i].place; }

  bool any_ = false;             // on any rank
  std::vector<int> points_;      // that may get couples
  std::vector<int> affected_;    // owned points in the neighborhoods of such, of any rank
  std::vector<Vector> forces_;   // on them, N; none where nothing rubs
  std::vector<Motion> motions_;  // of owned points that are ghosts elsewhere, and of ghosts
  std::vector<Twist> twists_;    // of owned points and ghosts
};

}  // namespace strut::contact
