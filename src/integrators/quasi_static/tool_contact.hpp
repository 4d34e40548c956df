// Forces of rigid tools on a body in equilibrium: unilateral contact with Coulomb friction by an augmented Lagrangian
// (Simo & Laursen 1992). With the gap g, the slip s over the tool in the step, and the multipliers λ:
//   t_n = max(0, λ_n − ε g),  t_t = λ_t − ½ ε s, cut to |t_t| ≤ μ t_n
// While a point slides, the tangent is unsymmetric. An equilibrium at given multipliers leaves penetrations of the
// order t/ε; then λ ← t, and the next equilibrium follows, until they are below a tolerance. So ε is no material
// constant: it only decides the number of these rounds.
#pragma once

#include <utility>
#include <vector>

#include "base/archive.hpp"
#include "conditions/rigid_tool.hpp"
#include "integrators/quasi_static/krylov.hpp"
#include "integrators/quasi_static/separate_parts.hpp"

namespace strut {

class ToolContact {
 public:
  ToolContact(std::vector<RigidTool> tools, const Body& body);

  bool any() const { return !tools_.empty(); }

  // Begins a step from t over dt (s); points are at their positions at its start.
  void begin(const Body& body, double t, double dt);

  // Adds the forces at the present positions, N.
  void add_forces(const Body& body, Field& forces);
  // Adds minus their derivative at the positions of the last forces, times a field.
  void add_stiffness(const Field& field, Field& result) const;
  void add_springs(std::vector<Tensor>& springs) const;

  // N, of the last forces on this rank's points of each part.
  std::vector<double> largest_pressures(const SeparateParts& parts) const;
  // Error of contact at the last forces on this rank's points, over the allowed one: above 1 another round of the
  // multipliers is needed. `largest_pressures`: over all ranks, N.
  double violation(const std::vector<double>& largest_pressures, const SeparateParts& parts) const;
  // The point of this rank that a tool overlaps most, and by how much, m; -1 and 0 if none.
  std::pair<int, double> deepest() const;
  // True if other points of this rank touch than at the last call.
  bool has_changed();
  void augment();  // λ ← t
  void commit();   // the next step begins with the last forces

  void go_back();  // resets the last forces to those at the start of the step

  // Adds the forces of the last trial by condition, N.
  void add_reactions(std::vector<Vector>& by_condition) const;
  // Saves or restores the forces at the start of the next step.
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
    Vector start = Vector::Zero();       // position at the start of the step, m
    Traction at_start, now;              // at the last positions
    double gap = 0;                      // m
    bool sticks = false;
    bool touched = false;               // at the last call of has_changed()
    Tensor stiffness = Tensor::Zero();  // N/m
  };
  void press(const Surface& at, const Vector& sliding, ContactPoint& contact) const;

  std::vector<RigidTool> tools_;
  std::vector<Vector> offsets_, travels_;  // of tools: at the end of the step; over the step; m
  std::vector<ContactPoint> contact_points_;
};

}  // namespace strut
