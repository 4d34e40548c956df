// The directions in which conditions hold points during one load step, combined: the directions of one point need not
// be orthogonal or consistent.
#pragma once

#include <vector>

#include "conditions/condition_type.hpp"
#include "integrators/quasi_static/krylov.hpp"
#include "mechanics/body.hpp"

namespace strut {

class Constraints {
 public:
  Constraints(const std::vector<HeldDirection>& held, const Body& body);

  void remove(Field& field) const;            // removes the held components of a field
  void keep_constrained(Field& field) const;  // keeps only these
  // The projection of point i onto its free directions.
  const Tensor& free_projection(int i) const { return free_projection_[i]; }

  // Adds the forces by which the holding conditions balance `forces` (N), by condition.
  void add_reactions(const Field& forces, std::vector<Vector>& by_condition) const;

  // Displacements (m) from the present positions of the points to their targets along held directions; 0 along free
  // ones.
  Field remaining_displacement(const Body& body) const;

 private:
  void hold(const HeldDirection& held);

  struct Direction {
    int reaction_index, point;
    Vector along;  // of unit length, orthogonal to the earlier ones of its point
  };
  std::vector<Direction> directions_;

  std::vector<Tensor> free_projection_;
  Field places_;  // target positions along the held directions of each point: m, 0 along free ones
};

// Collective. True if displacements (m) of the owned points are more than the round-off of times.
bool is_a_motion(const Field& displacements, const Body& body);

}  // namespace strut
