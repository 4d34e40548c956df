// Every field that mechanics keeps for the points of one rank.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/deduplicated.hpp"
#include "base/fields.hpp"
#include "mechanics/expansion.hpp"
#include "mechanics/force_states.hpp"
#include "mechanics/integration_points.hpp"
#include "mechanics/material_block.hpp"
#include "topology/domain.hpp"

namespace strut {

class LatticeSums;
class QuadraticFits;

// 2ⁿ for a small n. A call of std::ldexp for each point would take a hundredth of the time of a step.
inline double power_of_two(int n) { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + n) << 52); }

// The fields of the owned points of a body; time_levels has entries for ghosts, too.
struct PointFields {
  FieldSet fields;
  PointField<MaterialPoint> points = fields.add<std::vector<MaterialPoint>>(At::point, parts_of_material_point());
  PointField<double> density = fields.of_points<double>(
      {.name = "density", .unit = "kg/m³", .meaning = "of inertia: with what mass scaling adds"});
  PointField<double> mass_scale =
      fields.of_points<double>({.name = "mass_scale",
                                .unit = "1",
                                .meaning = "the inertia by mass scaling over that of the material; 0: none",
                                .variable = "Mass_Scale"},
                               When::if_used);
  PointField<Vector> velocity = fields.of_points<Vector>(
      {.name = "velocity", .unit = "m/s", .meaning = "at the mid-step after the time", .persistent = true});
  PointField<Vector> previous_velocity = fields.of_points<Vector>(
      {.name = "previous_velocity", .unit = "m/s", .meaning = "at the mid-step before the time", .persistent = true});
  // Sum over the phases of a step: each point's own state sets it, then bonds, contact and loads add to it.
  PointField<Vector> force_density = fields.of_points<Vector>({.name = "force_density",
                                                               .unit = "N/m³",
                                                               .meaning = "Force per reference volume",
                                                               .persistent = true,
                                                               .variable = "Force_Density",
                                                               .nodal = true});
  PointField<double> residual = fields.of_points<double>(  // current after a step with diagnostics
      {.name = "residual", .unit = "m⁵", .meaning = "Σ ω V |η − F ξ|²", .persistent = true});
  PointField<double> bond_work = fields.of_points<double>(  // current after a step with diagnostics
      {.name = "bond_work",
       .unit = "J/m³",
       .meaning = "energy of the springs on both ends' gradients",
       .persistent = true},
      When::if_used);
  FieldRef<Deduplicated<Symmetric>> shape_inverse = fields.add<Deduplicated<Symmetric>>(
      At::point, {{.name = "shape_inverse", .unit = "1/m⁵", .meaning = "K⁻¹", .width = 6}});
  FieldRef<Deduplicated<Vector>> first_moment = fields.add<Deduplicated<Vector>>(
      At::point, {{.name = "first_moment", .unit = "m⁴", .meaning = "Σ ω V ξ", .width = 3}});
  // Allocated only if bonds may break (fracture/fracture.hpp).
  PointField<double> damage =
      fields.of_points<double>({.name = "damage",
                                .unit = "1",
                                .meaning = "1 − volume of the points still bonded to this one / of all at first",
                                .persistent = true,
                                .variable = "Damage"},
                               When::if_used);
  PointField<double> fracture_energy = fields.of_points<double>(
      {.name = "fracture_energy", .unit = "J", .meaning = "dissipated by its bonds that broke", .persistent = true},
      When::if_used);
  PointField<double> averaged_indicator = fields.of_points<double>({.name = "averaged_indicator",
                                                                    .unit = "1",
                                                                    .meaning = "criterion of ductile failure, averaged",
                                                                    .persistent = true},
                                                                   When::if_used);
  PointField<std::uint8_t> released =
      fields.of_points<std::uint8_t>({.name = "released",
                                      .unit = "1",
                                      .meaning = "1: the bonds left to it hold no deformation gradient",
                                      .persistent = true},
                                     When::if_used);
  PointField<PointExpansion> expansion =
      fields.add<std::vector<PointExpansion>>(At::point,
                                              {{.name = "thermal_strain",
                                                .unit = "1",
                                                .meaning = "α (T − T₀) by a prescribed temperature",
                                                .persistent = true,
                                                .variable = "Thermal_Strain",
                                                .width = 1},
                                               {.name = "expansion_pull",
                                                .unit = "J/m³",
                                                .meaning = "work of expansion, by its strain",
                                                .persistent = true,
                                                .width = 1},
                                               {.name = "expansion_work",
                                                .unit = "J/m³",
                                                .meaning = "work of expansion so far",
                                                .persistent = true,
                                                .width = 1},
                                               {.name = "reference_temperature",
                                                .unit = "K",
                                                .meaning = "T₀ of the expansion",
                                                .persistent = true,
                                                .width = 1}},
                                              When::if_used);
  // Time-step levels of owned points and ghosts; empty without substeps. MultiTimeStepping chooses and saves them.
  PointField<std::uint8_t> time_levels =
      fields.of_points<std::uint8_t>({.name = "time_levels",
                                      .unit = "1",
                                      .meaning = "the level h of a step of its own, Δt/2ʰ",
                                      .variable = "Time_Step_Level"},
                                     When::if_used);
};

struct Body : PointFields {
  Domain domain;  // solvers update the current positions y of its sites
  Influence influence = Influence::one;
  std::vector<MaterialBlock> blocks;  // in the order of domain.cloud.block_names

  std::vector<HeatedPoints> heated;        // points whose temperature a condition prescribes
  std::vector<double> expansion_of_sites;  // thermal strain ε of owned points and ghosts; empty if not needed

  ForceStates force_states;  // of owned points and ghosts

  std::shared_ptr<QuadraticFits> fits;  // of owned points by quadratic correspondence; null without any

  // Workspaces for the sums over families on lattices, one for each of domain.families.lattices.
  std::vector<std::shared_ptr<LatticeSums>> lattice_sums;

  int owned() const { return domain.owned; }
  // True if the stress of the point advances in the substeps of this time-step level.
  bool is_active(int i, int level) const { return time_levels.empty() || time_levels[i] >= level; }
  // Length of the point's own step over that of a step of `level`, 2^(level − h).
  double step_fraction(int i, int level = 0) const {
    return time_levels.empty() ? 1 : power_of_two(level - time_levels[i]);
  }
  const MaterialBlock& block_of(int i) const { return blocks[domain.cloud.blocks[i]]; }
  // Energy of the stabilization springs, J/m³ of reference volume; current after a step with diagnostics.
  double stabilization_work(int i) const {
    const bool in_bonds = block_of(i).has_springs(ResidualKind::both_gradients);
    return in_bonds ? bond_work[i] : 0.5 * points[i].stabilization * residual[i];
  }
  bool has_springs(ResidualKind residual) const {
    return std::any_of(blocks.begin(), blocks.end(), [&](const MaterialBlock& b) { return b.has_springs(residual); });
  }
  double mass(int i) const { return density[i] * domain.volume(i); }
  // Mass of the point over that of its cell: below 1 where a non-reflecting end takes off a part (setup/open_ends.cpp).
  double inertia_fraction(int i) const {
    return density[i] / (block_of(i).material.density * (mass_scale.empty() ? 1 : mass_scale[i]));
  }
  Vector current(int i) const { return domain.current(i); }
  // Integration point q of block.points[k].
  MaterialPoint integration_point(const MaterialBlock& block, std::size_t k, int q) const {
    return block.is_quadratic() ? block.cells[block.index(k, q)] : points[block.points[k]];
  }
  // True if bonds of an owned point have broken.
  bool has_lost_bonds(int i) const { return !domain.families.broken.empty() && !domain.families.broken[i].empty(); }
  // True if bonds of the block, or of a block bonded to it, may break; without an argument, if any bonds may.
  bool may_break(std::size_t block) const;
  bool may_break() const;
  Vector displacement(int i) const { return current(i) - domain.reference(i); }
};

inline bool Body::may_break(std::size_t block) const {
  const auto breaks = [&](const MaterialBlock& other) {
    const std::size_t b = static_cast<std::size_t>(&other - blocks.data());
    return other.material.damage && domain.blocks[b].body == domain.blocks[block].body;
  };
  return std::any_of(blocks.begin(), blocks.end(), breaks);
}
inline bool Body::may_break() const {
  return std::any_of(blocks.begin(), blocks.end(),
                     [](const MaterialBlock& b) { return b.material.damage.has_value(); });
}

// Compiled once, in make_body.cpp.
extern template class FieldOf<std::vector<MaterialPoint>>;
extern template class FieldOf<Deduplicated<Symmetric>>;
extern template class FieldOf<Deduplicated<Vector>>;
extern template class FieldOf<std::vector<PointExpansion>>;
extern template class FieldOf<std::vector<Vector>>;

}  // namespace strut
