// Friction acts off the points: midway between two points, or at the surfaces of bodies. Its couple about a point acts
// on the neighborhood of the point (its family and itself); without this couple bodies would rotate.
#pragma once

#include <span>
#include <vector>

#include "contact/search/pairs.hpp"

namespace strut::contact {

// A patch: a piece of a body that takes friction as a whole. Friction acts on both bodies at one position; at two it
// would rotate them. Off its points a patch moves like a rigid body with the mean motion of its points, and a force
// there acts as a force at its center and a couple. Motion and force are transposes of each other, so friction does no
// work on bodies that stick to each other.
struct Patch {
  double weight = 0;                   // of all its points
  Vector middle = Vector::Zero();      // m
  Tensor per_couple = Tensor::Zero();  // rotation θ per couple: points get the forces weight θ × (position − middle)
  double smallest = 0;                 // smallest moment of its points about any axis, weight m²
  bool turns = false;                  // can take couples about all axes: its points are not in one line
  Vector row = Vector::Zero();         // unit vector along the line; zero if the patch turns, or is like one point
};

// Sums over the points of a patch; positions are relative to one near them, m.
class PatchSums {
 public:
  void add(double weight, const Vector& place);
  Vector middle() const { return first_ / weight_; }  // some weight must have been added

  // `arm`: distance from the center at which friction acts, m. The patch does not turn about an axis whose moment of
  // inertia is so small that a force at this distance would meet almost no inertia.
  Patch patch(double arm) const;

 private:
  double weight_ = 0;
  Vector first_ = Vector::Zero();
  Tensor second_ = Tensor::Zero();
};

// The part of a force at `place` whose couple a patch can take.
Vector bearable(const Patch& patch, const Vector& place, const Vector& force);

class Couples {
 public:
  // Collective, after a search. `points`: those that may get couples, ascending.
  void take(const Domain& domain, const std::vector<int>& points);
  bool any() const { return any_; }

  // The neighborhood of a point: its patch, relative to the point; its angular velocity, 1/s.
  struct Neighborhood {
    Patch patch;
    Vector spin = Vector::Zero();
  };
  // Collective: exchanges the present motion of ghosts. `of` is valid for owned points afterwards.
  void bring_to_present(const Kinematics& kinematics);
  Neighborhood of(const Kinematics& kinematics, int i, double arm) const;  // `arm`: see PatchSums::patch, m

  // Collective. Adds the forces of the couples couples[k] (N m) on the neighborhoods of points[k]. Each point sums its
  // own, in the order of its family, so the result is the same on any number of ranks.
  void add_forces(const Domain& domain, const std::vector<Neighborhood>& neighborhoods,
                  const std::vector<Vector>& couples, std::vector<Vector>& force_density);

  // Adds this rank's part of what the images exert on bodies by the last forces, N, to that of each of domain.mirrors.
  void add_mirror_reactions(const Domain& domain, std::vector<Vector>& of_mirrors) const;

  // The last forces through periodic sides across each axis, N: this rank's part.
  Vector through_sides(const Domain& domain) const;

  // Calls visit(i, force in N) for the last forces on this rank's points.
  template <class Visit>
  void for_each_force(const Visit& visit) const {
    for (std::size_t n = 0; n < forces_.size(); ++n) visit(affected_[n], forces_[n]);
  }

 private:
  struct Motion {
    Vector place, velocity;
    static void reflect(const Reflection& by, Motion& motion) {
      reflect_position(by, motion.place), reflect_direction(by, motion.velocity);
    }
  };
  struct Twist {
    Vector turn, middle;  // θ, and the position where the forces vanish
    static void reflect(const Reflection& by, Twist& twist) {
      reflect_position(by, twist.middle), reflect_direction(by, twist.turn);
      twist.turn *= by.turn.determinant();  // a mirror image rotates the other way
    }
  };
  // The force of the couple of point j on point i, per volume of i, N/m³.
  Vector density(const Domain& domain, int i, int j) const {
    return twists_[j].turn.cross(Vector(domain.current(i) - twists_[j].middle));
  }
  Vector place(const Domain& domain, int i) const { return i < domain.owned ? domain.current(i) : motions_[i].place; }

  bool any_ = false;             // on any rank
  std::vector<int> points_;      // points that may get couples
  std::vector<int> affected_;    // owned points in the neighborhoods of such points of any rank
  std::vector<Vector> forces_;   // forces on them, N; empty without friction
  std::vector<Motion> motions_;  // of owned points that are ghosts elsewhere, and of ghosts
  std::vector<Twist> twists_;    // of owned points and ghosts
};

}  // namespace strut::contact
