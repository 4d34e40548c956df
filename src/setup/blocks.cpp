#include "setup/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "base/text.hpp"

namespace strut {

bool is_quadratic(const deck::Material& material) { return material.formulation == Formulation::quadratic; }

namespace {

const deck::Block* naming_section(const deck::Deck& deck, const std::string& block) {
  const deck::Block* general = nullptr;
  for (const deck::Block& section : deck.blocks) {
    for (const std::string& name : section.block_names) {
      if (name == block) return &section;
      if (name == "all" || name == "default") general = &section;
    }
  }
  return general;
}

}  // namespace

const deck::Block* section_of(const deck::Deck& deck, const std::string& block) {
  const deck::Block* section = naming_section(deck, block);
  return section || deck.blocks.empty() ? section : &deck.blocks.front();
}

void check_blocks(const deck::Deck& deck, const PointCloud& cloud, const std::vector<double>& spacings,
                  deck::Problems& problems) {
  for (const deck::Block& section : deck.blocks) {
    for (const std::string& name : section.block_names) {
      const auto& valid = cloud.block_names;
      if (name == "all" || name == "default" || std::find(valid.begin(), valid.end(), name) != valid.end()) continue;
      const bool has_blank =
          std::ranges::any_of(valid, [](const std::string& one) { return one.find(' ') != one.npos; });
      problems.add(
          "Blocks > " + section.name + " > Block Names",
          "the mesh has no block '" + name + "'" + did_you_mean(name, valid) + "; it has " + joined(valid) +
              (has_blank
                   ? " (blanks separate names here: only 'all' or 'default' can mean a block whose name has a blank)"
                   : ""));
    }
  }
  for (std::size_t b = 0; b < cloud.block_names.size(); ++b) {
    const std::string& name = cloud.block_names[b];
    if (spacings[b] == 0 || naming_section(deck, name)) continue;
    problems.add("Blocks", "block '" + name + "' of the mesh has no material: name it in a section's Block Names");
  }
}

namespace {

std::optional<DamageModel> damage_of(const deck::Deck& deck, const deck::Block& section) {
  if (!section.damage_model) return std::nullopt;
  return deck.damage_models[*section.damage_model].model;
}

Stabilization stabilization_of(const deck::Material& material, const std::optional<DamageModel>& damage, PointsAt at) {
  const bool breaks_by_stretch = damage && !damage->ductility;
  const double coefficient = material.stabilization_coefficient.value_or(
      usual_coefficient(material.law, material.stabilization, breaks_by_stretch, at));
  return with_coefficient(material.stabilization, coefficient);
}

// The law of a block's metal; points that may fail have a law of their own, whose existence the deck's check ensures.
materials::AnyLaw law_of(const deck::Material& material, const deck::Block& section,
                         const std::optional<DamageModel>& damage) {
  materials::AnyLaw law =
      damage && damage->ductility ? materials::failing(material.law, *damage->ductility).value() : material.law;
  if (damage && damage->is_gradual) law = materials::cracking(law, damage->fracture_energy).value();
  const auto set_temperature = [&section]<class L>(L& one) {
    if constexpr (materials::tells_heat<L>)
      one.set_initial_temperature(section.initial_temperature.value_or(materials::room_temperature));
  };
  std::visit(set_temperature, law);
  return law;
}

}  // namespace

// If bonds break by their stretch, springs of the usual stiffness would let the tip of a crack open by motions that no
// point's deformation gradient sees, and it would grow at half the fracture energy (inputs/fracture). An elastomer
// would give way by such motions under pressure: its stress becomes as large as its shear modulus, beside which the
// usual springs are soft. Foams that compact would be crushed layer by layer at nodes: the outer ones, half as thick,
// take 5/6 of the stress, and springs must bear the rest of the plateau. Silling's resist bending, too, and are less
// stiff.
double usual_coefficient(const materials::AnyLaw& law, const Stabilization& stabilization, bool breaks_by_stretch,
                         PointsAt at) {
  constexpr double usual = 0.01, stiff = 0.3, stiffest_of_foam = 1;
  if (breaks_by_stretch) return stiff;
  const double modulus =
      materials::moduli_of(law).longitudinal() * (std::holds_alternative<SillingStabilization>(stabilization) ? 4 : 1);
  const auto of_foam = [&](double plateau) {
    return at == PointsAt::nodes ? std::clamp(20 * plateau / modulus, usual, stiffest_of_foam) : usual;
  };
  if (const auto* foam = std::get_if<materials::DeshpandeFleck>(&law)) return of_foam(foam->plateau);
  if (const auto* foam = std::get_if<materials::PolymerFoam>(&law)) return of_foam(foam->uniaxial_yield);
  const auto* elastomer = std::get_if<materials::Hyperelastic>(&law);
  return elastomer ? std::clamp(4 * elastomer->moduli().shear / modulus, usual, stiff) : usual;
}

std::vector<BlockMaterial> block_materials(const deck::Deck& deck, const PointCloud& cloud) {
  std::vector<BlockMaterial> materials;
  for (const std::string& name : cloud.block_names) {
    const deck::Block& section = *section_of(deck, name);
    const deck::Material& material = deck.materials[section.material];
    const std::optional<DamageModel> damage = damage_of(deck, section);
    materials.push_back({material.density,
                         law_of(material, section, damage),
                         stabilization_of(material, damage, cloud.at),
                         material.formulation,
                         {material.linear_viscosity, material.quadratic_viscosity},
                         damage,
                         material.thermal_expansion});
  }
  return materials;
}

namespace {

// True if the points of a block can soften in front of a crack: by the mean gradient it opens between two layers.
bool can_soften(const BlockMaterial& material, const BlockHorizons& block) {
  if (material.formulation == Formulation::quadratic) return true;
  const double reach = block.largest / block.spacing;
  return material.formulation == Formulation::correspondence && reach > 1.05 && reach < 1.95 &&
         residual_of(material.stabilization) == ResidualKind::both_gradients;
}

}  // namespace

// One critical stretch takes 0.2 to 1.6 times the fracture energy by correspondence (docs/decisions.md, Cracks whose
// stress falls before bonds break).
void soften_cracks(const deck::Deck& deck, const Domain& domain, std::vector<BlockMaterial>& materials) {
  if (deck.solver.quasi_static) return;  // equilibria break bonds by their stretch
  for (std::size_t b = 0; b < materials.size(); ++b) {
    BlockMaterial& material = materials[b];
    std::optional<DamageModel>& damage = material.damage;
    if (!damage || damage->ductility || damage->critical_bond_energy || damage->is_gradual) continue;
    const auto softening = materials::cracking(material.law, damage->fracture_energy);
    if (!(damage->fracture_energy > 0) || !softening || !can_soften(material, domain.blocks[b])) continue;
    damage->is_gradual = true;
    material.law = *softening;
  }
}

namespace {

Vector cell_of(const deck::Grid& grid) {
  return grid.length.cwiseQuotient(Vector(grid.points[0], grid.points[1], grid.points[2]));
}

}  // namespace

std::array<int, 3> box_reach(const deck::Grid& grid, const deck::Block& section) {
  const Vector cell = cell_of(grid);
  const double horizon = section.horizon.value_or(section.horizon_factor.value_or(0) * std::cbrt(cell.prod()));
  std::array<int, 3> reach;
  for (int c = 0; c < 3; ++c) {
    const double cells = horizon / cell[c];
    reach[c] = static_cast<int>(std::min(std::floor(cells + 0.5), static_cast<double>(grid.points[c])));
  }
  return reach;
}

namespace {

// Makes the families the boxes that io::make_grid has marked by shared nodes. The search must reach their corners.
void take_boxes(const deck::Grid& grid, const deck::Block& section, BlockBonds& bonds) {
  const Vector cell = cell_of(grid);
  const std::array<int, 3> reach = box_reach(grid, section);
  const double corner = cell.cwiseProduct(Vector(reach[0], reach[1], reach[2])).norm();
  bonds.horizon = bonds.horizon_at(std::cbrt(cell.prod()));
  bonds.in_spacings = false;
  bonds.touching = true;
  bonds.families = FamilyKind::lists;
  bonds.horizon = std::max(bonds.horizon, 1.001 * corner / bonds.search_factor());
}

}  // namespace

// Sections that are separate bodies are numbered by their index, from 1; all others are body 0.
std::vector<BlockBonds> block_bonds(const deck::Deck& deck, const PointCloud& cloud) {
  std::vector<BlockBonds> bonds;
  for (const std::string& name : cloud.block_names) {
    const deck::Block* section = section_of(deck, name);
    const int place = static_cast<int>(section - deck.blocks.data());
    const int body = section->separate_body ? place + 1 : 0;
    bonds.push_back(section->horizon_factor ? BlockBonds::per_spacing(*section->horizon_factor, body)
                                            : BlockBonds(*section->horizon, body));
    const deck::Material& material = deck.materials[section->material];
    const bool by_touch = is_quadratic(material) && cloud.has_shared_nodes;
    const bool is_alike = deck.discretization.influence == Influence::one;  // others decrease with distance
    bonds.back().touching = by_touch && is_alike && !section->across_voids.value_or(false);
    bonds.back().visible_only = !section->across_voids.value_or(!(by_touch && !is_alike));
    const bool any = bonds.back().touching || bonds.back().visible_only;
    bonds.back().may_lose_bonds =
        section->damage_model || !deck.discretization.cracks.empty() || !deck.discretization.shells.empty();
    if (any || material.formulation != Formulation::correspondence) {
      bonds.back().families = FamilyKind::lists;
    }
    if (deck.discretization.grid.boxes) take_boxes(deck.discretization.grid, *section, bonds.back());
  }
  return bonds;
}

std::vector<double> mean_spacings(const PointCloud& cloud, const Communicator& communicator) {
  std::vector<double> sums(2 * cloud.block_names.size(), 0);  // sum of spacings and number of points for each block
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    sums[2 * cloud.blocks[i]] += cloud.spacings[i];
    sums[2 * cloud.blocks[i] + 1] += 1;
  }
  communicator.sum(sums);
  std::vector<double> result;
  for (std::size_t b = 0; b < sums.size(); b += 2) result.push_back(sums[b] / std::max(1.0, sums[b + 1]));
  return result;
}

void check_horizons(const deck::Deck& deck, const PointCloud& cloud, const std::vector<double>& spacings,
                    deck::Problems& problems) {
  for (std::size_t b = 0; b < cloud.block_names.size(); ++b) {
    const deck::Block* section = naming_section(deck, cloud.block_names[b]);
    if (!section || !section->horizon || spacings[b] == 0) continue;  // check_blocks reports blocks without a section
    if (deck.discretization.grid.boxes || deck.discretization.degenerate == deck::DegeneratePoints::keep) continue;
    if (*section->horizon > spacings[b] && *section->horizon < 20 * spacings[b]) continue;
    problems.add("Blocks > " + section->name + " > Horizon",
                 text_of(*section->horizon, " m does not fit the points of block ", cloud.block_names[b],
                         ", whose mean spacing is ", spacings[b],
                         " m: expected between 1 and 20 spacings, usually 2 to 4 (is the mesh in m?)"));
  }
}

double wave_speed(const BlockMaterial& material) {
  return std::sqrt(materials::moduli_of(material.law).longitudinal() / material.density);
}

double mass_of(const Body& body) {
  double mass = 0;
  for (int i = 0; i < body.owned(); ++i) mass += body.block_of(i).material.density * body.domain.volume(i);
  return body.domain.communicator.sum(mass);
}

std::string mass_of_shared_nodes(const Body& body, const std::vector<double>& taken) {
  constexpr double worth_telling = 0.01;
  const std::size_t blocks = body.blocks.size();
  double more = 0;  // kg, mass by which the points exceed the mesh
  for (std::size_t of_point = 0; of_point < blocks && !taken.empty(); ++of_point) {
    for (std::size_t of_element = 0; of_element < blocks; ++of_element) {
      more += taken[of_point * blocks + of_element] *
              (body.blocks[of_point].material.density - body.blocks[of_element].material.density);
    }
  }
  const double mass = mass_of(body);
  if (std::abs(more) <= worth_telling * (mass - more)) return "";
  return text_of(
      std::setprecision(4), "WARNING: the mass is ", mass, " kg, that of the elements ", mass - more,
      " kg: a node that blocks of two densities share has the density of the block that stands first in the mesh; "
      "Points \"Elements\" or a finer mesh keep the mass\n");
}

namespace {

// True if points of the two blocks may behave differently.
bool are_unlike(const deck::Deck& deck, const std::string& one, const std::string& other) {
  const deck::Block &a = *section_of(deck, one), &b = *section_of(deck, other);
  return a.material != b.material || a.damage_model != b.damage_model || a.initial_temperature != b.initial_temperature;
}

}  // namespace

std::string conditions_at_shared_nodes(const deck::Deck& deck, const Body& body, const std::vector<double>& taken) {
  constexpr double worth_telling = 0.01;  // of the volume
  constexpr const char* reason =
      ": a node that blocks share is of the block that stands first in the mesh; expected Points \"Elements\"\n";
  if (taken.empty()) return "";
  const std::size_t blocks = body.blocks.size();
  std::vector<double> of_points(blocks, 0);
  for (int i = 0; i < body.owned(); ++i) of_points[body.domain.cloud.blocks[i]] += body.domain.volume(i);
  body.domain.communicator.sum(of_points);
  std::vector<double> of_elements = of_points;
  double all = 0, other = 0;  // m³; `other`: of elements beside nodes of another material
  std::string text;
  for (std::size_t p = 0; p < blocks; ++p) {
    all += of_points[p];
    for (std::size_t e = 0; e < blocks; ++e) {
      const double volume = taken[p * blocks + e];
      if (volume == 0) continue;
      const std::string &here = body.domain.cloud.block_names[p], &there = body.domain.cloud.block_names[e];
      of_elements[e] += volume, of_elements[p] -= volume;
      if (are_unlike(deck, here, there)) other += volume;
      if (body.domain.blocks[p].body == body.domain.blocks[e].body) continue;
      text += text_of("WARNING: blocks '", here, "' and '", there,
                      "' are separate bodies that share nodes, all of which "
                      "are of '",
                      here, "': '", there,
                      "' begins a cell away from it, and contact begins only when the gap has "
                      "closed; expected bodies with nodes of their own, or Points \"Elements\"\n");
    }
  }
  if (other > worth_telling * all)
    text += text_of("WARNING: ", std::setprecision(2), 100 * other / all,
                    " % of the elements' volume has the material, damage model or initial temperature of another block",
                    reason);
  for (const deck::Condition& condition : deck.conditions) {
    const auto at = std::ranges::find(body.domain.cloud.block_names, condition.node_set);
    const std::size_t k = at - body.domain.cloud.block_names.begin();
    if (k == blocks || std::holds_alternative<RigidTool>(condition.kind) ||
        std::holds_alternative<SymmetryPlane>(condition.kind))
      continue;
    if (std::abs(of_points[k] - of_elements[k]) <= worth_telling * of_elements[k]) continue;
    text += text_of("WARNING: Boundary Conditions > ", condition.name, " acts on ", std::setprecision(3), of_points[k],
                    " m³, and the elements of block '", condition.node_set, "' have ", of_elements[k], " m³", reason);
  }
  return text;
}

}  // namespace strut
