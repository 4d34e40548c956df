// What rigid tools do to the points of a body in equilibrium: unilateral contact with Coulomb friction by an augmented
// Lagrangian (Simo & Laursen 1992). With the gap g, the sliding s over the tool in the step, and the multipliers λ:
//   t_n = max(0, λ_n − ε g),  t_t = λ_t − ε s, cut to |t_t| ≤ μ t_n
// Where a point slides the tangent is not symmetric. An equilibrium at given multipliers leaves penetrations of the
// order t/ε; then λ ← t, and so on until they are below a tolerance. So ε is no constant of the material: it only
// decides how many rounds there are.
#pragma once

#include <vector>

#include "base/archive.hpp"
#include "conditions/rigid_tool.hpp"
#include "integrators/quasi_static/krylov.hpp"

namespace strut {

class ToolContact {
 public:
  ToolContact(std::vector<RigidTool> tools, const Body& body);

  bool any() const { return !tools_.empty(); }

  // A step from t over dt (s); points are where it begins.
  void begin(const Body& body, double t, double dt);

  // Adds the forces at the present places, N.
  void add_forces(const Body& body, Field& forces);
  // Adds minus their derivative at the places of the last forces, times a field.
  void add_stiffness(const Field& field, Field& result) const;
  void add_springs(std::vector<Tensor>& springs) const;

  // How far the last forces are from contact, above 1 where another round is due; of this rank's points, by the largest
  // pressure on any rank (N).
  double largest_pressure() const;
  double violation(double largest_pressure) const;
  // Whether other points touch here than when this was asked last.
  bool has_changed();
  void augment();  // λ ← t
  void commit();   // the last forces are where the next step begins

  void go_back();  // the last forces are those where the step begins

  // The forces of the last trial by condition.
  void add_reactions(std::vector<Vector>& by_condition) const;
  // What the forces at the start of the next step are.
  void serialize(Archive& archive, const Body& body);

  // J on this rank, by the mean of the forces at both ends of the step.
  double work(const Body& body) const;

 private:
  struct Traction {
    double pressure = 0;                                   // t_n, N
    Vector drag = Vector::Zero(), force = Vector::Zero();  // t_t, t_n n + t_t; N
  };
  struct ContactPoint {  // of a tool on a point
    int tool, point;
    double penalty = 0;                  // ε, N/m
    double spacing = 0;                  // m
    double multiplier = 0;               // λ_n, N
    Vector tangential = Vector::Zero();  // λ_t, N
    Vector start = Vector::Zero();       // where the step begins, m
    Traction at_start, now;              // at the last places
    double gap = 0;                      // m
    bool sticks = false;
    bool touched = false;               // when has_changed() was asked last
    Tensor stiffness = Tensor::Zero();  // N/m
  };
  void press(const Surface& at, const Vector& sliding, ContactPoint& contact) const;

  std::vector<RigidTool> tools_;
  std::vector<Vector> offsets_, travels_;  // of tools: at the end of the step, over it; m
  std::vector<ContactPoint> contact_points_;
};

}  // namespace strut
