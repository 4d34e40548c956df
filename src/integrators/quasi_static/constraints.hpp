// The directions in which conditions hold points during one load step, together: those of one point need not be across
// each other, nor agree.
#pragma once

#include <vector>

#include "conditions/condition_type.hpp"
#include "integrators/quasi_static/krylov.hpp"
#include "mechanics/body.hpp"

namespace strut {

class Constraints {
 public:
  Constraints(const std::vector<HeldDirection>& held, const Body& body);

  void remove(Field& field) const;            // the held parts, from a field
  void keep_constrained(Field& field) const;  // them only
  // The projection of point i on its free directions.
  const Tensor& free_projection(int i) const { return free_projection_[i]; }

  // Adds what forces the holding conditions put against `forces` (N), by condition.
  void add_reactions(const Field& forces, std::vector<Vector>& by_condition) const;

  // What is left of the way of each held point over the step (m); 0 along free directions.
  Field way_left(const Body& body) const;

 private:
  void hold(const HeldDirection& held);

  struct Direction {
    int reaction_place, point;
    Vector along;  // of unit length, across the earlier ones of its point
  };
  std::vector<Direction> directions_;

  std::vector<Tensor> free_projection_;
  Field places_;  // where the held directions of a point lead to: m, 0 along free ones
};

}  // namespace strut
