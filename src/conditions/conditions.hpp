// All conditions on the points of a body, and their common action in whole steps, substeps and equilibria. This code
// does not distinguish types of conditions; each type defines its own behavior (condition_type.hpp).
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "conditions/condition.hpp"
#include "conditions/velocity_update.hpp"
#include "mechanics/body.hpp"

namespace strut {

// True if a visitor takes one of these types.
template <class Visit, class... Types>
constexpr bool takes_any(std::variant<Types...>*) {
  return (std::invocable<const Visit&, Types&> || ...);
}
template <class Visit, class... Types>
constexpr bool takes_any(const std::variant<Types...>*) {
  return (std::invocable<const Visit&, const Types&> || ...);
}

class Conditions {
 public:
  // Adds a condition; it acts after all of earlier stages, and after those of its own stage added so far.
  void add(Condition condition);
  // Checks a value that others evaluate, too (first_not_finite).
  void watch(const Function& value);
  // True if a rigid tool has friction and points have a prescribed motion.
  bool has_friction_beside_motions() const { return has_friction_ && has_motions_; }

  // Visits the conditions of the types that `visit` takes, in the order in which they act.
  template <class Visit>
  void visit(const Visit& visit) const {
    pass_each(in_order_, visit);
  }
  template <class Visit>
  void visit(const Visit& visit) {
    pass_each(in_order_, visit);
  }

  std::size_t count() const { return in_order_.size(); }

  // The first value on this rank so far that was not finite: its path in the deck, time and position; "" if there is
  // none.
  std::string first_not_finite() const;

 private:
  template <class All, class Visit>
  static void pass_each(All& all, const Visit& visit) {
    static_assert(takes_any<Visit>(decltype(all.data())()), "it takes no condition");
    const auto pass = [&visit]<class Type>(Type& one) {
      if constexpr (std::invocable<const Visit&, Type&>) visit(one);
    };
    for (auto& one : all) std::visit(pass, one);
  }

  std::vector<Condition> in_order_;
  bool has_friction_ = false, has_motions_ = false;
  std::vector<Function> expressions_;
};

// True if any condition of a stage has a value that changes with time.
bool depend_on_time(const Conditions& conditions, Stage stage);

// Collective. Whether a load acts on all points of each body that it acts on, and the blocks of these bodies.
std::pair<bool, std::vector<std::size_t>> extent_of(const Conditions& load, const Body& body);
// The parts of loads for some points.
Conditions loads_on(const Conditions& loads, const MovingPoints& some);
// Collective. The loads and prescribed motions of parts of bodies that change with time.
Conditions changing_on_parts(const Conditions& conditions, const Body& body);
// Marks the owned points that these move otherwise than at their present velocities, at any of so many times within the
// step from t over dt (s); empty if there are no such conditions.
std::vector<std::uint8_t> moved_within(const Conditions& changing, const Body& body, double t, double dt, int times);

// Adds `part` of the forces of conditions at time t (s) to the force density.
void add_forces(const Conditions& conditions, double t, double part, Body& body);

// Adds the work of these forces over `impulse_time` (s), once velocities are final.
void add_work_of_forces(const Conditions& conditions, double t, double impulse_time, const Body& body,
                        ImpulseWork& work);

// Changes the velocities after the impulse of forces at time t (s), which then move each point for its step, to those
// that the conditions allow. Adds the work of these changes, and the impulses of conditions with a reaction.
void change_velocities(Conditions& conditions, double t, const PointTimeSteps& steps, Body& body, ImpulseWork& work,
                       ReactionImpulses& impulses);

// The conditions that act at times between whole steps.
Conditions in_substeps(const Conditions& conditions, const MovingPoints& moving);

// Velocities of owned points at time t: those that conditions impose (of positions the slope over the `moment`, s,
// after t), else the initial velocities.
std::vector<Vector> predicted_velocities(const Conditions& conditions, double t, double moment, const Body& body);

// Throws Error if a condition has no meaning without inertia.
void check_equilibria_possible(const Conditions& conditions);

// Held directions in the load step from t over dt (s), for points that are at its start.
std::vector<HeldDirection> held_directions(const Conditions& conditions, const Body& body, double t, double dt);

// The kinetic energy of tools with a mass, J, the same on all ranks.
double kinetic_energy_of_tools(const Conditions& conditions);
// Saves or restores the state of all tools, at the group of all owned points.
void serialize_tools(Archive& archive, Conditions& conditions, int owned);
// The same for their reaches alone, "tool_N_reach", N the tool's index in the deck.
void serialize_reaches(Archive& archive, Conditions& conditions);
// Tools that held the body before, on the same points, keep the reaches that they had.
void keep_reaches(const Conditions& before, Conditions& now);

// All conditions that are unilateral contact in equilibria.
std::vector<RigidTool> tools_of(const Conditions& conditions);

}  // namespace strut
