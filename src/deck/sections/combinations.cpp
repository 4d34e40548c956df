#include "deck/sections/combinations.hpp"

#include <algorithm>

#include "base/numbers.hpp"
#include "deck/problems.hpp"
#include "mechanics/hindered_breaks.hpp"

namespace strut::deck {

namespace {

// Equilibria in which bonds break are verified with prescribed motion and periodic sides that rest only.
void check_what_acts_on_cracks(const std::vector<Condition>& conditions,
                               const std::vector<ContactModel>& contact_models, Problems& problems) {
  const std::string unlike =
      " beside a Damage Model in Blocks with Solver > QuasiStatic; expected explicit steps (Verlet)";
  for (const Condition& condition : conditions) {
    const PeriodicSides* sides = std::get_if<PeriodicSides>(&condition.kind);
    const bool moving_sides = sides && !sides->stretch.is_constant();
    const bool is_tool = std::holds_alternative<RigidTool>(condition.kind);
    const bool is_other = std::holds_alternative<PrescribedTemperature>(condition.kind) ||
                          std::holds_alternative<SymmetryPlane>(condition.kind);
    if (!moving_sides && !is_tool && !is_other) continue;
    problems.add("Boundary Conditions > " + condition.name + (moving_sides ? " > Stretch" : " > Type"),
                 "given" + unlike + (is_tool ? ", or Prescribed Displacement" : ""));
  }
  if (!contact_models.empty()) problems.add("Contact", "given" + unlike);
}

// Where bonds break, all blocks go through the same rounds of breaks.
void check_others(const std::vector<Material>& materials, const std::vector<Block>& blocks, Problems& problems) {
  for (const Block& block : blocks) {
    if (block.damage_model || block.material >= static_cast<int>(materials.size())) continue;
    const Material& material = materials[block.material];
    if (material.name.empty() || stays_while_others_break(material.formulation, material.law)) continue;
    problems.add(
        "Blocks > " + block.name + " > Material",
        "'" + material.name +
            "' beside a block with a Damage Model: where bonds break with Solver > QuasiStatic, each round of "
            "breaks would age it by a load step; expected explicit steps (Verlet), or in all blocks a material "
            "'Elastic', 'Hyperelastic' without Relaxation, or 'Elastic Correspondence', without Formulation "
            "'Quadratic Correspondence'");
  }
}

void check_condition(const std::vector<Material>& materials, const std::string& path, Problems& problems) {
  for (const Material& material : materials) {
    const bool knows_its_own = std::visit([]<class L>(const L&) { return materials::tells_heat<L>; }, material.law);
    if (!knows_its_own) continue;
    problems.add(path, "'Prescribed Temperature' beside material '" + material.name +
                           "', whose temperature follows from its flow; expected materials without Softening, another "
                           "Flow Stress, Heating, an Equation of State or a Shear Modulus Slope");
  }
  if (std::ranges::none_of(materials, [](const Material& one) { return one.thermal_expansion != 0; }))
    problems.note(path, "has no effect: no material has a Thermal Expansion Coefficient");
}

void check_types(const std::vector<Condition>& conditions, bool steps_follow, Problems& problems) {
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
}

}  // namespace

void check_quasi_static(const Solver& solver, const std::vector<Condition>& conditions,
                        const std::vector<ContactModel>& contact_models, const std::vector<Material>& materials,
                        const std::vector<Block>& blocks, const std::vector<NamedDamageModel>& damage_models,
                        bool steps_follow, Problems& problems) {
  if (!solver.quasi_static) return;
  check_types(conditions, steps_follow, problems);
  for (const ContactModel& one : contact_models) {
    if (one.model.friction == 0 || std::holds_alternative<contact::SurfaceLaw>(one.model.law)) continue;
    problems.add("Contact > Models > " + one.name + " > Friction Coefficient",
                 "'" + to_text(one.model.friction) +
                     "'; expected 0, or Contact Model 'Surface', with Solver > QuasiStatic: there, "
                     "friction is that of surfaces, rigid planes and tools");
  }
  for (const Block& block : blocks) {
    const DamageModel* model = damage_model_of(block, damage_models);
    if (!model || block.material >= static_cast<int>(materials.size())) continue;
    const Material& material = materials[block.material];
    if (material.name.empty() || breaks_at_rest(material.formulation, material.law, *model)) continue;
    if (steps_follow) continue;
    constexpr const char* others =
        ", or Damage Model 'Critical Stretch' in a material 'Elastic', or 'Elastic Correspondence' without Formulation "
        "'Quadratic Correspondence', or 'Cohesive Crack' with it";
    problems.add("Blocks > " + block.name + " > Damage Model",
                 std::string("bonds ") + (model->ductility ? "of metal that fails " : "") +
                     "cannot break with Solver > QuasiStatic" + (model->ductility ? "" : " in this way") +
                     "; expected explicit steps (Verlet)" + (model->ductility ? "" : others));
  }
  const bool breaks = std::ranges::any_of(blocks, [](const Block& block) { return block.damage_model.has_value(); });
  if (!breaks || steps_follow) return;
  check_others(materials, blocks, problems);
  check_what_acts_on_cracks(conditions, contact_models, problems);
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

void check_temperatures(const std::vector<Material>& materials, const std::vector<Condition>& conditions,
                        bool has_expanded, Problems& problems) {
  bool heats = false, changes = has_expanded;
  for (const Condition& condition : conditions) {
    const auto* one = std::get_if<PrescribedTemperature>(&condition.kind);
    if (!one) continue;
    heats = true;
    changes = changes || one->value.depends_on_time();
    check_condition(materials, "Boundary Conditions > " + condition.name, problems);
    if (changes) continue;  // a constant one may keep points of an earlier one as they are: set-up knows
    problems.note("Boundary Conditions > " + condition.name + " > Value",
                  "has no effect: points expand by the change of T since the initial time; expected a function of t");
  }
  if (heats) return;
  for (const Material& material : materials) {
    if (material.thermal_expansion == 0) continue;
    problems.note("Materials > " + material.name + " > Thermal Expansion Coefficient",
                  "has no effect: no Boundary Condition of the type 'Prescribed Temperature' warms the points");
  }
}

}  // namespace strut::deck
