// The directions in which conditions hold points during one load step: prescribed motion and symmetry planes.
#pragma once

#include <vector>

#include "conditions/conditions.hpp"
#include "solvers/quasi_static/krylov.hpp"

namespace strut {

class Constraints {
 public:
  // Of the step from t over dt (s); points are where it begins.
  Constraints(const Conditions& conditions, const Body& body, double t, double dt);

  void remove(Field& field) const;  // the held parts, from a field
  void keep(Field& field) const;    // them only
  // The projection of point i on its free directions.
  const Tensor& free_projection(int i) const { return free_projection_[i]; }

  // Adds what forces the holding conditions put against `forces` (N), by condition.
  void add_reactions(const Field& forces, std::vector<Vector>& by_condition) const;

  // What is left of the way of each held point over the step (m); 0 along free directions.
  Field way_left(const Body& body) const;

 private:
  void hold(int condition, int point, const Vector& direction, double place);

  struct Direction {
    int condition, point;
    Vector along;  // of unit length, across the earlier ones of its point
  };
  std::vector<Direction> directions_;

  std::vector<Tensor> free_projection_;
  Field places_;  // where the held directions of a point lead to: m, 0 along free ones
};

}  // namespace strut
