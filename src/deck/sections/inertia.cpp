#include "deck/sections/inertia.hpp"

#include "deck/numbers.hpp"
#include "deck/problems.hpp"

namespace strut::deck {

void check_quasi_static(const Solver& solver, const std::vector<Condition>& conditions,
                        const std::vector<ContactModel>& contact_models, Problems& problems) {
  if (!solver.quasi_static) return;
  for (const Condition& condition : conditions) {
    const bool is_velocity = condition.type == ConditionType::initial_velocity;
    if (!is_velocity && condition.type != ConditionType::open_end) continue;
    problems.add("Boundary Conditions > " + condition.name + " > Type",
                 std::string(is_velocity ? "'Initial Velocity'" : "'Non-Reflecting End'") +
                     " has no meaning with Solver > QuasiStatic, which knows no inertia; expected a prescribed "
                     "motion, a load, a plane or a tool");
  }
  for (const ContactModel& one : contact_models) {
    if (one.model.friction == 0) continue;
    problems.add("Contact > Models > " + one.name + " > Friction Coefficient",
                 "'" + to_text(one.model.friction) +
                     "'; expected 0 with Solver > QuasiStatic: there, friction is that of "
                     "rigid planes and tools");
  }
}

}  // namespace strut::deck
