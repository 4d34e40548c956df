// All that acts on the points of a body from outside, and what it does together: in whole steps, substeps, equilibria.
// Nothing here knows one type of condition from the other; each says of itself what it does (condition_type.hpp).
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "conditions/condition.hpp"
#include "conditions/velocity_update.hpp"
#include "mechanics/body.hpp"

namespace strut {

class Conditions {
 public:
  // It will act after all of earlier stages, and those of its own stage that are there.
  void add(Condition condition);

  // Visits the conditions in the order in which they act.
  template <class Visit>
  void visit(const Visit& visit) const {
    for (const Condition& one : in_order_) std::visit(visit, one);
  }
  template <class Visit>
  void visit(const Visit& visit) {
    for (Condition& one : in_order_) std::visit(visit, one);
  }

  // Of the values on this rank so far, the first that was no number: where it stands in the deck, time and place. ""
  // where all are.
  std::string first_not_finite() const;

 private:
  std::vector<Condition> in_order_;
  std::vector<Function> expressions_;
};

// Whether any condition of a stage has a value that changes in time.
bool depend_on_time(const Conditions& conditions, Stage stage);

// Adds the forces of conditions at time t (s) to the force density.
void add_forces(const Conditions& conditions, double t, Body& body);

// Adds the work of these forces over the time of an impulse (s), once velocities are final.
void add_work_of_forces(const Conditions& conditions, double t, double impulse_time, const Body& body,
                        ImpulseWork& work);

// Changes the velocities after the impulse of forces at time t, which carry each point on for its step, to what the
// conditions allow. Adds the work of these changes, and the impulses of conditions that have a reaction.
void change_velocities(Conditions& conditions, double t, const PointTimeSteps& steps, Body& body, ImpulseWork& work,
                       ReactionImpulses& impulses);

// What acts at times between whole steps.
Conditions in_substeps(const Conditions& conditions, const MovingPoints& moving);

// The initial velocities of owned points, and in their place those that conditions impose at time t, in the mean over a
// moment (s).
std::vector<Vector> predicted_velocities(const Conditions& conditions, double t, double moment, const Body& body);

// Throws Error where a condition has no meaning without inertia.
void check_equilibria_possible(const Conditions& conditions);

// In the load step from t over dt (s), of points that are where it begins.
std::vector<HeldDirection> held_directions(const Conditions& conditions, const Body& body, double t, double dt);

// Of tools with a mass: their kinetic energy (J), the same on all ranks; what a checkpoint keeps of them, at the group
// of all owned points.
double kinetic_energy_of_tools(const Conditions& conditions);
void serialize_tools(Archive& archive, Conditions& conditions, int owned);

// All that is unilateral contact in equilibria.
std::vector<RigidTool> tools_of(const Conditions& conditions);

}  // namespace strut
