#include "deck/sections/blocks.hpp"

#include <algorithm>
#include <map>

#include "deck/sections/several_sections.hpp"

namespace strut::deck {

namespace {

const char* const name = "Blocks";

const NamesKey block_names({.name = "Block Names",
                            .meaning = "Blocks of the mesh, `all`, or `default` (those that no other section names)."});

const TextKey material({.name = "Material", .meaning = "The name of a section in Materials."});

const OptionalKey<double> horizon(
    {.name = "Horizon",
     .unit = "m",
     .range = positive,
     .meaning =
         "δ: points i and j are neighbors up to the distance 1.0001 (δ_i + δ_j)/2. Either this or Horizon Factor."});

const OptionalKey<double> horizon_factor(
    {.name = "Horizon Factor",
     .range = {.low = 1, .high = 20},
     .meaning = "δ in local spacings: the edge of a cube with the volume of the element, or with the mean volume of "
                "the elements around the node (six times that of tetrahedra)."});

const BooleanKey separate_body(
    {.name = "Separate Body",
     .fallback = "false",
     .meaning = "No bonds to points of other sections: a body of its own, which others meet in contact."});

const OptionalKey<bool> across_voids(
    {.name = "Bonds Across Voids",
     .meaning = "false: two points within the horizon are bonded only if elements that share nodes connect them within "
                "it (hexahedra or tetrahedra). Default true; false for Quadratic Correspondence."});

const OptionalKey<std::string> damage_model(
    {.name = "Damage Model",
     .meaning = "The name of a section in Damage Models. Without this key bonds break only to blocks that have one."});

const OptionalKey<double> initial_temperature({.name = "Initial Temperature",
                                               .unit = "K",
                                               .range = positive,
                                               .meaning = "For laws with a temperature; default 293."});

void check_overlaps(const std::vector<Block>& blocks, Problems& problems) {
  std::map<std::string, std::string> owners;  // block of the mesh -> section that names it
  const auto clash = [&](const Block& block, const std::string& taken, const std::string& owner) {
    problems.add("Blocks > " + block.name + " > Block Names",
                 "'" + taken + "' is named twice: here and in Blocks > " + owner + "; expected once");
  };
  for (const Block& block : blocks) {
    for (const std::string& one : block.block_names) {
      if (one == "default") {
        if (!owners.emplace(one, block.name).second) clash(block, one, owners[one]);
        continue;
      }
      const auto taken = one == "all" ? owners.begin() : owners.find(owners.count("all") ? "all" : one);
      if (taken != owners.end()) clash(block, one == "all" ? taken->first : one, taken->second);
      owners.emplace(one, block.name);
    }
  }
}

}  // namespace

Section blocks_section() {
  return {.name = name,
          .required = true,
          .meaning = "Material and neighborhood of the blocks of the mesh.",
          .sections = {{.name = any_name,
                        .required = true,
                        .meaning = "One or more blocks of the mesh; each belongs to one section at most.",
                        .keys = {block_names, material, horizon, horizon_factor, separate_body, across_voids,
                                 damage_model, initial_temperature}}}};
}

bool asks_for_temperature(const DamageModel& model) {
  const auto* johnson_cook =
      model.ductility ? std::get_if<materials::JohnsonCookFailure>(&model.ductility->criterion) : nullptr;
  return johnson_cook && johnson_cook->constants[4] != 0;
}

bool knows_temperature(const Material& material) {
  return std::visit([]<class L>(const L&) { return materials::tells_heat<L>; }, material.law);
}

void check_temperature(const Values& section, const Material& material, Problems& problems) {
  if (!section.given(initial_temperature) || material.name.empty() || knows_temperature(material)) return;
  problems.add(section.path_to(initial_temperature),
               "given, but material '" + material.name +
                   "' does not depend on it; expected one with Softening, another Flow Stress, Heating, an Equation of "
                   "State or a Shear Modulus Slope");
}

// The energy of a bond is defined only if both ends are ordinary.
void check_bond_energies(const std::vector<Block>& all, const std::vector<Material>& materials,
                         const std::vector<NamedDamageModel>& models, Problems& problems) {
  const auto by_energy = [&models](const Block& block) {
    const DamageModel* model = damage_model_of(block, models);
    return model && model->critical_bond_energy;
  };
  const auto may_break_so = [&](const Block& block) {
    if (block.separate_body) return by_energy(block);
    return std::any_of(all.begin(), all.end(), [&](const Block& b) { return !b.separate_body && by_energy(b); });
  };
  for (const Block& block : all) {
    if (block.material >= static_cast<int>(materials.size()) || !may_break_so(block)) continue;
    const Material& of_block = materials[block.material];
    if (of_block.formulation == Formulation::ordinary) continue;
    problems.add("Blocks > " + block.name + " > " + (by_energy(block) ? damage_model.name : material.name),
                 "bonds of material '" + of_block.name +
                     "' cannot break by Damage Model 'Bond Energy': by correspondence their forces are not along them, "
                     "and what one holds depends on how the body has turned; expected the Material Model 'Elastic' in "
                     "all blocks of the body, or Damage Model 'Critical Stretch'");
  }
}

// Bonds also break by the Damage Model of the other end, so that all blocks of a body lose some.
void check_laws_that_break(const std::vector<Block>& all, const std::vector<Material>& materials,
                           const std::vector<NamedDamageModel>& models, Problems& problems) {
  const auto may_break = [&](const Block& block) {
    if (block.separate_body) return block.damage_model.has_value();
    return std::any_of(all.begin(), all.end(), [](const Block& b) { return !b.separate_body && b.damage_model; });
  };
  for (const Block& block : all) {
    if (block.material >= static_cast<int>(materials.size()) || !may_break(block)) continue;
    const Material& of_block = materials[block.material];
    const DamageModel* own = damage_model_of(block, models);
    const bool is_shock = std::holds_alternative<materials::ShockJ2>(of_block.law) && !(own && own->ductility);
    if (!is_shock && !std::holds_alternative<materials::Hyperelastic>(of_block.law)) continue;
    const std::string why = is_shock
                                ? "it has an Equation of State, and what its points hold is not known once they "
                                  "carry no stress; expected one without"
                                : "the stress of a Hyperelastic point would follow the jump of its deformation "
                                  "gradient, and breaks would give energy; expected another law, or no Damage Model";
    problems.add("Blocks > " + block.name + " > " + (block.damage_model ? damage_model.name : material.name),
                 "bonds of material '" + of_block.name + "' cannot break" +
                     (block.damage_model ? "" : " by the Damage Model of another block of the body") + ": " + why +
                     (block.damage_model ? "" : ", or a Separate Body"));
  }
}

void check_damage_model(const Values& section, const Material& material, const NamedDamageModel& named,
                        Problems& problems) {
  const DamageModel& model = named.model;
  const bool is_known = !material.name.empty();
  if (is_known && model.ductility && !materials::failing(material.law, *model.ductility)) {
    problems.add(section.path_to(damage_model),
                 "points of material '" + material.name + "' cannot fail by model '" + named.name +
                     "': expected the Material Model 'Elastic Plastic Correspondence' without an Equation of State");
  }
  if (is_known && model.is_gradual &&
      ((material.formulation != Formulation::quadratic &&
        residual_of(material.stabilization) != ResidualKind::both_gradients) ||
       !materials::cracking(material.law, 1))) {
    problems.add(
        section.path_to(damage_model),
        "material '" + material.name + "' cannot crack by model '" + named.name +
            "': expected the Material Model 'Elastic Correspondence' with Stabilization 'Mean Gradient' or Formulation "
            "'Quadratic Correspondence'");
  }
  if (is_known && asks_for_temperature(model) && !knows_temperature(material)) {
    problems.add(section.path_to(damage_model),
                 "'" + named.name + "' has D5, but material '" + material.name +
                     "' does not know its temperature; expected one that does, or no D5");
  }
}

std::optional<int> find_damage_model(const Values& section, const Material& material,
                                     const std::vector<NamedDamageModel>& models, Problems& problems) {
  if (!section.has(damage_model)) return std::nullopt;
  const int found = find_named(section, damage_model, *section[damage_model], models, "Damage Models", problems);
  if (found < static_cast<int>(models.size())) check_damage_model(section, material, models[found], problems);
  return found;
}

const DamageModel* damage_model_of(const Block& block, const std::vector<NamedDamageModel>& models) {
  const bool is_known = block.damage_model && *block.damage_model < static_cast<int>(models.size());
  return is_known ? &models[*block.damage_model].model : nullptr;
}

std::vector<Block> read_blocks(const Values& deck, const std::vector<Material>& materials,
                               const std::vector<NamedDamageModel>& damage_models, Problems& problems) {
  std::vector<Block> all;
  for (const Values& section : deck.section(name).sections()) {
    check_exactly_one(section, horizon, horizon_factor, problems);
    const int of_material = find_named(section, material, materials, "Materials", problems);
    const Material& made_of = of_material < static_cast<int>(materials.size()) ? materials[of_material] : Material();
    check_temperature(section, made_of, problems);
    all.push_back({.name = section.name(),
                   .block_names = section[block_names],
                   .material = of_material,
                   .horizon = section[horizon],
                   .horizon_factor = section[horizon_factor],
                   .separate_body = section[separate_body],
                   .across_voids = section[across_voids],
                   .damage_model = find_damage_model(section, made_of, damage_models, problems),
                   .initial_temperature = section[initial_temperature]});
  }
  check_overlaps(all, problems);
  check_bond_energies(all, materials, damage_models, problems);
  check_laws_that_break(all, materials, damage_models, problems);
  return all;
}

}  // namespace strut::deck
