#include "deck/sections/inertia.hpp"

#include "deck/numbers.hpp"
#include "deck/problems.hpp"

namespace strut::deck {

void check_quasi_static(const Solver& solver, const std::vector<Condition>& conditions,
                        const std::vector<ContactModel>& contact_models, const std::vector<Block>& blocks,
                        const std::vector<NamedDamageModel>& damage_models, bool steps_follow, Problems& problems) {
  if (!solver.quasi_static) return;
  for (const Condition& condition : conditions) {
    if (steps_follow && !std::holds_alternative<InitialDisplacement>(condition.kind)) continue;
    if (problems.about("Boundary Conditions > " + condition.name + " > Type")) continue;  // a type that there is not
    const auto check = [&]<class Type>(const Type&) {
      if constexpr (Type::in_equilibria == InEquilibria::impossible) {
        problems.add("Boundary Conditions > " + condition.name + " > Type", Type::why_not_in_equilibria);
      }
    };
    std::visit(check, condition.kind);
    const RigidTool* tool = std::get_if<RigidTool>(&condition.kind);
    if (tool && tool->free) {
      problems.add("Boundary Conditions > " + condition.name + " > Mass",
                   "has no meaning with Solver > QuasiStatic, which knows no inertia; expected Travel");
    }
  }
  for (const ContactModel& one : contact_models) {
    if (one.model.friction == 0 || std::holds_alternative<contact::SurfaceLaw>(one.model.law)) continue;
    problems.add("Contact > Models > " + one.name + " > Friction Coefficient",
                 "'" + to_text(one.model.friction) +
                     "'; expected 0, or Contact Model 'Surface', with Solver > QuasiStatic: there, "
                     "friction is that of surfaces, rigid planes and tools");
  }
  for (const Block& block : blocks) {
    const DamageModel* model = damage_model_of(block, damage_models);
    if (!block.damage_model || (steps_follow && !(model && model->is_gradual))) continue;
    problems.add("Blocks > " + block.name + " > Damage Model",
                 "bonds cannot break with Solver > QuasiStatic; expected explicit steps (Verlet)");
  }
}

void check_initial_strains(const std::vector<Condition>& conditions, const std::vector<Material>& materials,
                           Problems& problems) {
  for (const Material& material : materials) {
    if (material.formulation == Formulation::ordinary) continue;
    for (const Condition& condition : conditions) {
      if (!std::holds_alternative<InitialDisplacement>(condition.kind)) continue;
      problems.add(
          "Boundary Conditions > " + condition.name + " > Type",
          "'Initial Displacement' beside material '" + material.name +
              "', whose stress follows from rates and would begin with 0 though the body is strained; expected "
              "'Elastic' in all materials");
    }
  }
}

}  // namespace strut::deck
