#include "setup/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "mechanics/expected_error.hpp"
#include "mechanics/thin_members.hpp"

namespace strut {

bool is_quadratic(const deck::Material& material) { return material.formulation == Formulation::quadratic; }

const deck::Block* section_of(const deck::Deck& deck, const std::string& block) {
  const deck::Block* general = nullptr;
  for (const deck::Block& section : deck.blocks) {
    for (const std::string& name : section.block_names) {
      if (name == block) return &section;
      if (name == "all" || name == "default") general = &section;
    }
  }
  return general;
}

void check_blocks(const deck::Deck& deck, const PointCloud& cloud, deck::Problems& problems) {
  for (const deck::Block& section : deck.blocks) {
    for (const std::string& name : section.block_names) {
      const auto& valid = cloud.block_names;
      if (name == "all" || name == "default" || std::find(valid.begin(), valid.end(), name) != valid.end()) continue;
      problems.add("Blocks > " + section.name + " > Block Names",
                   "the mesh has no block '" + name + "'" + did_you_mean(name, valid) + "; it has " + joined(valid));
    }
  }
  for (const std::string& name : cloud.block_names) {
    if (section_of(deck, name)) continue;
    problems.add("Blocks", "block '" + name + "' of the mesh has no material: name it in a section's Block Names");
  }
}

namespace {

std::optional<DamageModel> damage_of(const deck::Deck& deck, const deck::Block& section) {
  if (!section.damage_model) return std::nullopt;
  return deck.damage_models[*section.damage_model].model;
}

// Where bonds break by their stretch, springs as soft as they are elsewhere would let the tip of a crack open by
// motions that no point's deformation gradient sees: it would grow at half the fracture energy (inputs/fracture).
Stabilization stabilization_of(const deck::Material& material, const std::optional<DamageModel>& damage) {
  constexpr double usual = 0.01, if_bonds_break = 0.3;  // as the key says (deck/sections/materials.cpp)
  const bool breaks_by_stretch = damage && !damage->ductility;
  return with_coefficient(material.stabilization,
                          material.stabilization_coefficient.value_or(breaks_by_stretch ? if_bonds_break : usual));
}

// The metal of a block whose points may fail is a law of its own; the deck has been asked whether there is one.
materials::AnyLaw law_of(const deck::Material& material, const deck::Block& section,
                         const std::optional<DamageModel>& damage) {
  materials::AnyLaw law =
      damage && damage->ductility ? materials::failing(material.law, *damage->ductility).value() : material.law;
  const auto set_temperature = [&section]<class L>(L& one) {
    if constexpr (materials::tells_heat<L>)
      one.set_initial_temperature(section.initial_temperature.value_or(materials::room_temperature));
  };
  std::visit(set_temperature, law);
  return law;
}

}  // namespace

std::vector<BlockMaterial> block_materials(const deck::Deck& deck, const PointCloud& cloud) {
  std::vector<BlockMaterial> materials;
  for (const std::string& name : cloud.block_names) {
    const deck::Block& section = *section_of(deck, name);
    const deck::Material& material = deck.materials[section.material];
    const std::optional<DamageModel> damage = damage_of(deck, section);
    materials.push_back({material.density,
                         law_of(material, section, damage),
                         stabilization_of(material, damage),
                         material.formulation,
                         {material.linear_viscosity, material.quadratic_viscosity},
                         damage});
  }
  return materials;
}

// Sections that are bodies of their own are numbered by their place, from 1; all others are body 0.
std::vector<BlockBonds> block_bonds(const deck::Deck& deck, const PointCloud& cloud) {
  std::vector<BlockBonds> bonds;
  for (const std::string& name : cloud.block_names) {
    const deck::Block* section = section_of(deck, name);
    const int place = static_cast<int>(section - deck.blocks.data());
    const int body = section->separate_body ? place + 1 : 0;
    bonds.push_back(section->horizon_factor ? BlockBonds::per_spacing(*section->horizon_factor, body)
                                            : BlockBonds(*section->horizon, body));
    const deck::Material& material = deck.materials[section->material];
    const bool by_touch = is_quadratic(material) && cloud.joined;
    const bool is_alike = deck.discretization.influence == Influence::one;  // others fade with the distance
    bonds.back().touching = by_touch && is_alike && !section->across_voids.value_or(false);
    bonds.back().through_material = !section->across_voids.value_or(!(by_touch && !is_alike));
    const bool any = bonds.back().touching || bonds.back().through_material;
    bonds.back().may_lose_bonds = section->damage_model || !deck.discretization.cracks.empty();
    if (any || material.formulation != Formulation::correspondence) {
      bonds.back().families = FamilyKind::lists;
    }
  }
  return bonds;
}

// The mean spacing of each block's points over all ranks, m; 0 where it has none.
std::vector<double> mean_spacings(const PointCloud& cloud, const Communicator& communicator) {
  std::vector<double> sums(2 * cloud.block_names.size(), 0);  // spacings and number of points of each block
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    sums[2 * cloud.blocks[i]] += cloud.spacings[i];
    sums[2 * cloud.blocks[i] + 1] += 1;
  }
  communicator.sum(sums);
  std::vector<double> result;
  for (std::size_t b = 0; b < sums.size(); b += 2) result.push_back(sums[b] / std::max(1.0, sums[b + 1]));
  return result;
}

// A horizon in m that is smaller than the spacing, or a hundred times as large, is a slip of units.
void check_horizons(const deck::Deck& deck, const PointCloud& cloud, const std::vector<double>& spacings,
                    deck::Problems& problems) {
  for (std::size_t b = 0; b < cloud.block_names.size(); ++b) {
    const deck::Block* section = section_of(deck, cloud.block_names[b]);
    if (!section || !section->horizon || spacings[b] == 0) continue;  // check_blocks tells of blocks without a section
    if (*section->horizon > spacings[b] && *section->horizon < 20 * spacings[b]) continue;
    std::ostringstream text;
    text << *section->horizon << " m does not fit the points of block " << cloud.block_names[b]
         << ", whose mean spacing is " << spacings[b]
         << " m: expected between 1 and 20 spacings, usually 2 to 4 (is the mesh in m?)";
    problems.add("Blocks > " + section->name + " > Horizon", text.str());
  }
}

namespace {

// Of ordinary points.
std::string stiffness_of_thin(Influence influence, double horizon, double thickness) {
  constexpr double worth_saying = 0.1;
  const double found = tension_stiffness_found(influence, horizon, thickness);
  if (std::abs(found - 1) < worth_saying) return "";
  std::ostringstream text;
  text.precision(2);
  text << "bars so thick were found " << 100 * std::abs(found - 1) << " % too " << (found > 1 ? "stiff" : "soft")
       << " in tension by the material model 'Elastic' (along the axes of a lattice); 'Elastic Correspondence' keeps "
          "Young's modulus";
  return text.str();
}

// Of correspondence.
std::string bending_of_thin(double horizon, double thickness) {
  constexpr double worth_saying = 0.9;
  const double kept = bending_stiffness_kept(horizon, thickness);
  if (kept >= worth_saying) return "";
  std::ostringstream text;
  text.precision(2);
  text << "so thin they keep about " << 100 * kept << " % of their bending stiffness; by Formulation 'Quadratic "
       << "Correspondence' expect " << expected_error_text(thickness, "");
  return text.str();
}

// Of quadratic correspondence.
std::string resolution_of_thin(const materials::AnyLaw& law, double thickness, bool whole) {
  constexpr double worth_saying = 0.05;
  if (!(thickness > 0) || expected_error(thickness).stiffness < worth_saying) return "";
  const bool flows = std::visit([]<class L>(const L&) { return materials::tells_flow<L>; }, law);
  return "expect " + expected_error_text(thickness, flows ? "in the plateau" : "", whole) +
         "; tools/study --converge spacing measures it (docs/resolution.md)";
}

std::string told_of_thin(const MaterialBlock& block, Influence influence, double horizon, double thickness,
                         bool whole) {
  switch (block.material.formulation) {
    case Formulation::ordinary:
      return stiffness_of_thin(influence, horizon, thickness);
    case Formulation::correspondence:
      return bending_of_thin(horizon, thickness);
    case Formulation::quadratic:
      return resolution_of_thin(block.material.law, thickness, whole);
  }
  return "";
}

// Collective. Whether the points of each block are elements of one volume, as voxels are.
std::vector<bool> of_whole_cells(const Domain& domain) {
  constexpr double alike = 1e-6;  // volumes of files in single precision
  const std::size_t blocks = domain.blocks.size();
  std::vector<double> volumes(2 * blocks, -std::numeric_limits<double>::max());  // the largest; the smallest, negative
  for (int i = 0; i < domain.owned; ++i) {
    double *largest = &volumes[domain.cloud.blocks[i]], *least = largest + blocks;
    *largest = std::max(*largest, domain.volume(i)), *least = std::max(*least, -domain.volume(i));
  }
  domain.communicator.max(volumes);
  std::vector<bool> whole;
  for (std::size_t b = 0; b < blocks; ++b)
    whole.push_back(domain.cloud.at == PointsAt::elements && -volumes[blocks + b] > (1 - alike) * volumes[b]);
  return whole;
}

}  // namespace

std::string thin_members(const Body& body) {
  const std::vector<double> all = thicknesses(body.domain);
  const std::vector<bool> whole = of_whole_cells(body.domain);
  std::ostringstream text;
  text.precision(2);
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const double spacing = body.domain.blocks[b].spacing;
    const double horizon = spacing > 0 ? body.domain.blocks[b].largest / spacing : 0;
    const std::string found = told_of_thin(body.blocks[b], body.influence, horizon, all[b], whole[b]);
    if (found.empty()) continue;
    text << "block '" << body.blocks[b].name << "': members are " << all[b] << " spacings thick (4 volume/surface); "
         << found << "\n";
  }
  return text.str();
}

namespace {

// What fails at once at its yield stress, J/m²: half of what a point of a metal then holds, over the crack's length.
constexpr auto least_fracture_energy = []<class L>(const L& law) -> double {
  if constexpr (materials::takes_crack_length<L>) {
    const auto [bulk, shear] = law.moduli();
    const double yield = law.flow_stress(law.virgin_state());
    return 0.5 * law.length * yield * yield * (3 * bulk + shear) / (18 * bulk * shear);
  } else {
    return 0;
  }
};

}  // namespace

std::string sudden_failure(const Body& body) {
  std::ostringstream text;
  text.precision(2);
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const MaterialBlock& block = body.blocks[b];
    if (!block.material.damage || !block.material.damage->ductility || !(body.domain.blocks[b].spacing > 0)) continue;
    const double given = block.material.damage->ductility->fracture_energy;
    const double least = std::visit(least_fracture_energy, block.material.law);
    if (!(given > 0) || given >= least) continue;
    text << "block '" << block.name << "': points hold more energy when they yield than its Fracture Energy, so they "
         << "fail at once; expected more than " << least << " J/m², or a smaller spacing\n";
  }
  return text.str();
}

std::string noisy_cracks(const Body& body) {
  std::string text;
  for (const MaterialBlock& block : body.blocks) {
    if (!block.is_quadratic() || !block.material.damage || block.material.damage->ductility) continue;
    text += "WARNING: block '" + block.name +
            "' breaks bonds by Formulation 'Quadratic Correspondence': its cracks take 0.6 to 1.6 of their fracture "
            "energy, and the four law points of a cell, which have no mirror image of their own, decide on the order "
            "of breaks: expect no symmetric crack. Another Formulation is within 10 %\n";
  }
  return text;
}

// By docs/theory.md, By the energy of a bond: the part of the dilatation that a bond takes with it counts against it
// where K > 5/3 G. Criteria of energy look at that bond by bond, those of stretch do not.
std::string breaks_under_pressure(const Body& body) {
  std::string text;
  for (const MaterialBlock& block : body.blocks) {
    const auto& damage = block.material.damage;
    if (!damage || !block.is_ordinary()) continue;
    const auto [bulk, shear] = std::visit([](const auto& law) { return law.moduli(); }, block.material.law);
    if (!(bulk > (5.0 / 3 + 1e-9) * shear)) continue;
    text += "block '" + block.name + "': bonds break by their " +
            (damage->critical_bond_energy ? "energy" : "stretch") + ", and Poisson's ratio is above 0.25: " +
            (damage->critical_bond_energy ? "several that break in one step" : "some that break") +
            " under pressure may give some energy (a thousandth of all was seen); told where Fracture_Energy falls "
            "below -1 %\n";
  }
  return text;
}

}  // namespace strut
