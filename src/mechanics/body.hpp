// All that mechanics knows of the points of one rank: the dictionary of fields.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/deduplicated.hpp"
#include "base/fields.hpp"
#include "base/math/rotation.hpp"
#include "base/math/tensors.hpp"
#include "base/math/tiles.hpp"
#include "materials/laws.hpp"
#include "mechanics/damage_model.hpp"
#include "mechanics/formulation/formulation.hpp"
#include "mechanics/stabilization/stabilization.hpp"
#include "topology/domain.hpp"
#include "topology/site.hpp"

namespace strut {

// What a bond reads of an end by correspondence: a tensor by columns, and in their fourth lanes up to three numbers.
struct alignas(32) TensorRecord {
  Eigen::Array4d column[3];
};

// A = P K⁻¹ − C F and C, of the springs on the residual of the end's own gradient (0: none); 1 if the end has failed; 1
// if bonds of it have broken in this step, where it has springs on the residual of both ends' gradients.
struct ForceState : TensorRecord {
  double& stiffness() { return column[0][3]; }
  double stiffness() const { return column[0][3]; }
  double& failed() { return column[1][3]; }
  double failed() const { return column[1][3]; }
  double& lost_bonds() { return column[2][3]; }
  double lost_bonds() const { return column[2][3]; }
};

// F, and of the springs on the residual of both ends' gradients C, the share of the step at whose end they act, and
// which stabilization they are (its index in the variant).
struct GradientState : TensorRecord {
  double& stiffness() { return column[0][3]; }
  double stiffness() const { return column[0][3]; }
  double& step_share() { return column[1][3]; }
  double kind() const { return column[2][3]; }
};

// The same of an ordinary end, whose force state along the bond is t = ω (a |ξ| + b e).
struct alignas(16) ScalarState {
  double a = 0, b = 0;  // (3K − 5μ) θ/m; 15 μ/m; Pa/m⁵
};

// The same of an end by quadratic correspondence (quadratic_bonds.hpp): first and second force state, the part of the
// consistency correction, and 1 if all places of the end have failed.
struct alignas(64) QuadraticState {
  double first[9] = {}, second[18] = {}, correction[9] = {}, offset[3] = {}, failed = 0;
  static constexpr int size = 40;

  // Half of this one and half of the other, but for the mark.
  void take_half_of(const QuadraticState& other) {
    for (int n = 0; n < 9; ++n) first[n] = 0.5 * (first[n] + other.first[n]);
    for (int n = 0; n < 18; ++n) second[n] = 0.5 * (second[n] + other.second[n]);
    for (int n = 0; n < 9; ++n) correction[n] = 0.5 * (correction[n] + other.correction[n]);
    for (int n = 0; n < 3; ++n) offset[n] = 0.5 * (offset[n] + other.offset[n]);
  }
};

// One entry a point, ghosts too, in every formulation that the scene has: zero where the point is of another, so that a
// bond between any two is the sum over the formulations.
struct ForceStates {
  std::vector<ForceState> tensors;
  std::vector<ScalarState> scalars;
  std::vector<GradientState> gradients;  // empty where no block has a stabilization by the gradients of both ends
  std::vector<QuadraticState> quadratics;

  // Whether point i, or a ghost, has failed.
  bool has_failed(std::size_t i) const {
    return (!tensors.empty() && tensors[i].failed() > 0) || (!quadratics.empty() && quadratics[i].failed > 0);
  }
  double bytes() const {
    return static_cast<double>(tensors.size() * sizeof(ForceState) + scalars.size() * sizeof(ScalarState) +
                               gradients.size() * sizeof(GradientState) + quadratics.size() * sizeof(QuadraticState));
  }
};

// What only the point itself reads.
struct MaterialPoint {
  Tensor deformation_gradient = Tensor::Identity();  // F
  Rotation rotation;                                 // R
  Symmetric stress = Symmetric::Zero();              // unrotated Cauchy stress, Pa
  double stabilization = 0;                          // C of the stabilization, Pa/m⁵
};

// The numbers of a material point, in the order of its parts.
template <class Point>
requires std::same_as<std::remove_const_t<Point>, MaterialPoint>
auto& number_of(Point& point, int n) {
  if (n < 9) return point.deformation_gradient.data()[n];
  if (n < 15) return point.rotation.number(n - 9);
  return n < 21 ? point.stress[n - 15] : point.stabilization;
}
inline std::vector<FieldPart> parts_of_material_point() {
  return {{.name = "deformation_gradient", .unit = "1", .meaning = "F", .kept = true, .width = 9},
          {.name = "rotation", .unit = "1", .meaning = "R of F = V R, two columns", .kept = true, .width = 6},
          {.name = "stress",
           .unit = "Pa",
           .meaning = "Rᵀ σ R",
           .kept = true,
           .variable = "Unrotated_Cauchy_Stress",
           .width = 6},
          {.name = "stabilization",
           .unit = "Pa/m⁵",
           .meaning = "C of the stabilization; none is left of a failed point",
           .kept = true,
           .width = 1}};
}

// The law points of quadratic correspondence in tiles: of each F by columns, the six numbers of R, the stress.
class CellPoints {
 public:
  static constexpr int rotation = 9, stress = 15, size = 21;  // where they begin; all numbers
  static std::vector<FieldPart> parts() {
    return {{.name = "cell_deformation_gradient", .unit = "1", .meaning = "F", .kept = true, .width = rotation},
            {.name = "cell_rotation", .unit = "1", .meaning = "R", .kept = true, .width = stress - rotation},
            {.name = "cell_stress", .unit = "Pa", .meaning = "Rᵀ σ R", .kept = true, .width = size - stress}};
  }

  void resize(std::size_t places) { numbers_.assign(places, numbers_of(MaterialPoint())); }
  std::size_t places() const { return numbers_.size(); }
  MaterialPoint operator[](std::size_t place) const {
    MaterialPoint point;
    for (int n = 0; n < size; ++n) number_of(point, n) = numbers_.at(place, n);
    return point;
  }
  void set(std::size_t place, const MaterialPoint& point) {
    const auto numbers = numbers_of(point);
    for (int n = 0; n < size; ++n) numbers_.at(place, n) = numbers[n];
  }
  double& at(std::size_t place, int n) { return numbers_.at(place, n); }
  double at(std::size_t place, int n) const { return numbers_.at(place, n); }
  small::Tiles& tiles() { return numbers_; }
  double bytes() const { return numbers_.bytes(); }

 private:
  static std::array<double, size> numbers_of(const MaterialPoint& point) {
    std::array<double, size> numbers;
    for (int n = 0; n < size; ++n) numbers[n] = number_of(point, n);
    return numbers;
  }

  small::Tiles numbers_;
};

// What an ordinary point has besides.
struct OrdinaryPoint {
  double weighted_volume = 0;  // m = Σ ω |ξ|² V = tr K, m⁵
  double dilatation = 0;       // θ
  double energy = 0;           // W, J/m³; current after a step with diagnostics

  static constexpr double OrdinaryPoint::*numbers[] = {&OrdinaryPoint::weighted_volume, &OrdinaryPoint::dilatation,
                                                       &OrdinaryPoint::energy};
  static std::vector<FieldPart> parts() {
    return {{.name = "weighted_volume", .unit = "m⁵", .meaning = "m", .width = 1},
            {.name = "dilatation", .unit = "1", .meaning = "θ", .kept = true, .width = 1},
            {.name = "energy", .unit = "J/m³", .meaning = "W", .kept = true, .width = 1}};
  }
};

// What the artificial viscosity of a block keeps of a point.
struct ViscousPoint {
  double pressure = 0;  // J q of the last step, Pa
  double work = 0;      // taken so far, J per m³ of reference volume
  double damping = 0;   // part of the critical damping of the fastest wave between points
  double edge = 0;      // of a cube as large as the whole cell, of which a node on a symmetry plane has a part, m

  static constexpr double ViscousPoint::*numbers[] = {&ViscousPoint::pressure, &ViscousPoint::work,
                                                      &ViscousPoint::damping, &ViscousPoint::edge};
  static std::vector<FieldPart> parts() {
    return {
        {.name = "viscous_pressure",
         .unit = "Pa",
         .meaning = "of the artificial viscosity, times J",
         .kept = true,
         .variable = "Viscous_Pressure",
         .width = 1},
        {.name = "viscous_work",
         .unit = "J/m³",
         .meaning = "what the artificial viscosity has taken",
         .kept = true,
         .variable = "Viscous_Work_Density",
         .width = 1},
        {.name = "viscous_damping", .unit = "1", .meaning = "part of the critical damping", .kept = true, .width = 1},
        {.name = "edge", .unit = "m", .meaning = "of a cube as large as the cell", .width = 1}};
  }
};

// Artificial viscosity of von Neumann & Richtmyer (1950) and Landshoff (1955): where the volume shrinks at the rate D,
// a pressure q = ρ l |D| (b₁ c + b₂² l |D|) resists it, l the distance of points and c the speed of longitudinal waves.
struct Viscosity {
  double linear = 0, quadratic = 0;  // b₁, b₂
  bool any() const { return linear > 0 || quadratic > 0; }
};

struct BlockMaterial {
  double density = 0;  // kg/m³
  materials::AnyLaw law;
  Stabilization stabilization = NoStabilization();  // by correspondence; other formulations need none
  Formulation formulation = Formulation::correspondence;
  Viscosity viscosity = {};  // by correspondence
  std::optional<DamageModel> damage = {};
};

// The state of a law point among those of all.
template <class L>
typename L::State state_in(const small::Tiles& states, std::size_t place) {
  std::array<double, materials::state_size<L>> values{};
  for (std::size_t c = 0; c < values.size(); ++c) values[c] = states.at(place, c);
  return materials::from_columns<L>(values);
}

// The points of one block of the mesh on this rank, with their law's state.
struct MaterialBlock {
  std::string name;
  BlockMaterial material;
  std::vector<int> points;  // owned points, ascending
  int interior = 0;         // so many of them need no ghost

  FieldSet fields;
  // The law's own, number by number.
  FieldRef<small::Tiles> state = fields.add<small::Tiles>(At::integration_point, {});
  // Integration points of quadratic correspondence; in other formulations body.points are these.
  FieldRef<CellPoints> cells = fields.add<CellPoints>(At::integration_point, CellPoints::parts(), When::if_used);
  PointField<std::uint8_t> flowed =
      fields.of_points<std::uint8_t>({.name = "flowed",
                                      .unit = "1",
                                      .meaning = "1 where the metal of a cell by quadratic correspondence has flowed",
                                      .kept = true,
                                      .variable = "Flowed"},
                                     When::if_used);  // flow.hpp
  PointField<OrdinaryPoint> ordinary =
      fields.add<std::vector<OrdinaryPoint>>(At::point, OrdinaryPoint::parts(), When::if_used);
  PointField<ViscousPoint> viscous =
      fields.add<std::vector<ViscousPoint>>(At::integration_point, ViscousPoint::parts(), When::if_used);

  // The formulations of all that its points are bonded to, themselves included: what its forces are summed over.
  bool feels_correspondence = false, feels_ordinary = false, feels_quadratic = false;

  // Its body moves as a whole, without strain (rigid_motion.hpp): there is nothing to compute.
  bool in_rigid_motion = false;
  double rest_frequency_bound = 0;  // 1/s, the largest of its points, as a part of their steps, in rigid motion

  int lattice = -1;            // in domain.families.lattices, where its points sit on one
  SelectedPoints off_stencil;  // of these, who have lost bonds: their sums go by lists

  std::size_t first_law_point = 0;  // of `cells`, among those of all blocks

  // Law points: one a point, points[k] at k. Or four places of its cell, in tiles of as many cells as kernels take side
  // by side: interior points and others begin tiles of their own, and what they leave of their last ones stays unused.
  int places_a_point() const { return is_quadratic() ? 4 : 1; }
  std::size_t law_points() const {
    return is_quadratic() ? 4 * in_tiles(in_tiles(interior) + points.size() - interior) : points.size();
  }
  std::size_t place(std::size_t k, int q) const {
    if (!is_quadratic()) return k;
    const std::size_t slot = slot_of_cell(k);
    return (slot / small::Tiles::width * 4 + q) * small::Tiles::width + slot % small::Tiles::width;
  }
  // The position of the cell of points[k] among the slots of all tiles of cells.
  std::size_t slot_of_cell(std::size_t k) const {
    const auto inside = static_cast<std::size_t>(interior);
    return k < inside ? k : k - inside + in_tiles(inside);
  }
  template <class L>
  typename L::State state_of(std::size_t place) const {
    return state_in<L>(state, place);
  }
  // The elastic moduli of a law point in its present state.
  materials::Moduli moduli(std::size_t place) const {
    return std::visit([&]<class L>(const L& law) { return materials::moduli_of(law, state_of<L>(place)); },
                      material.law);
  }

  bool is_ordinary() const { return material.formulation == Formulation::ordinary; }
  bool is_quadratic() const { return material.formulation == Formulation::quadratic; }
  // Whether it has springs on such residuals (stabilization/residual.hpp).
  bool has_springs(ResidualKind residual) const {
    return residual_of(material.stabilization) == residual && coefficient_of(material.stabilization) > 0;
  }
  // C of the springs of one of its points on the residual of its own gradient.
  double own_springs_of(const MaterialPoint& point) const {
    return has_springs(ResidualKind::own_gradient) ? point.stabilization : 0;
  }

 private:
  static std::size_t in_tiles(std::size_t cells) {
    return (cells + small::Tiles::width - 1) / small::Tiles::width * small::Tiles::width;
  }
};

class LatticeSums;
class QuadraticFits;

// 2ⁿ of a small n. A call of std::ldexp for each point would be a hundredth of a step.
inline double power_of_two(int n) { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + n) << 52); }

// The fields of the owned points of a body.
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
      {.name = "velocity", .unit = "m/s", .meaning = "at the mid-step after the time", .kept = true});
  PointField<Vector> previous_velocity = fields.of_points<Vector>(
      {.name = "previous_velocity", .unit = "m/s", .meaning = "at the mid-step before the time", .kept = true});
  // A sum that the phases of a step build up: what the points' own states give begins it, bonds, contact and loads add.
  PointField<Vector> force_density = fields.of_points<Vector>(
      {.name = "force_density",
       .unit = "N/m³",
       .meaning = "internal force and loads, per reference volume; where points are subcycled, what acts at the end of "
                  "a step",
       .kept = true,
       .variable = "Force_Density",
       .nodal = true});
  PointField<double> residual = fields.of_points<double>(  // current after a step with diagnostics
      {.name = "residual", .unit = "m⁵", .meaning = "Σ ω V |η − F ξ|², by correspondence", .kept = true});
  PointField<double> bond_work = fields.of_points<double>(  // as current
      {.name = "bond_work", .unit = "J/m³", .meaning = "energy of the springs on both ends' gradients", .kept = true},
      When::if_used);
  FieldRef<Deduplicated<Symmetric>> shape_inverse = fields.add<Deduplicated<Symmetric>>(
      At::point, {{.name = "shape_inverse", .unit = "1/m⁵", .meaning = "K⁻¹", .width = 6}});
  FieldRef<Deduplicated<Vector>> first_moment = fields.add<Deduplicated<Vector>>(
      At::point, {{.name = "first_moment", .unit = "m⁴", .meaning = "Σ ω V ξ", .width = 3}});
  // Where bonds may break (fracture/fracture.hpp).
  PointField<double> damage = fields.of_points<double>(
      {.name = "damage",
       .unit = "1",
       .meaning = "1 − the volume of the points that are still bonded to it / of all that were",
       .kept = true,
       .variable = "Damage"},
      When::if_used);
  PointField<double> fracture_energy = fields.of_points<double>(
      {.name = "fracture_energy", .unit = "J", .meaning = "dissipated by its bonds that broke", .kept = true},
      When::if_used);
  PointField<std::uint8_t> released =
      fields.of_points<std::uint8_t>({.name = "released",
                                      .unit = "1",
                                      .meaning = "1: the bonds left to it hold no deformation gradient",
                                      .kept = true},
                                     When::if_used);
  // Multi-time-stepping; ghosts, too, and of no point where it is empty: it chooses them anew, and keeps its choice.
  PointField<std::uint8_t> time_levels =
      fields.of_points<std::uint8_t>({.name = "time_levels",
                                      .unit = "1",
                                      .meaning = "the level h of a step of its own, Δt/2ʰ",
                                      .variable = "Time_Step_Level"},
                                     When::if_used);
};

struct Body : PointFields {
  Domain domain;  // y of its sites is what solvers move
  Influence influence = Influence::one;
  std::vector<MaterialBlock> blocks;  // as domain.cloud.block_names

  ForceStates force_states;  // of owned points and ghosts

  std::shared_ptr<QuadraticFits> fits;  // of owned points by quadratic correspondence, where there are any

  // Workspaces of the sums over the families on lattices, as domain.families.lattices.
  std::vector<std::shared_ptr<LatticeSums>> lattice_sums;

  int owned() const { return domain.owned; }
  // The step of a point's stress as a part of the one of a level.
  double share(int i, int level = 0) const { return time_levels.empty() ? 1 : power_of_two(level - time_levels[i]); }
  const MaterialBlock& block_of(int i) const { return blocks[domain.cloud.blocks[i]]; }
  // Energy of the stabilization, J/m³, as current as the residual.
  double stabilization_work(int i) const {
    const bool in_bonds = block_of(i).has_springs(ResidualKind::both_gradients);
    return in_bonds ? bond_work[i] : 0.5 * points[i].stabilization * residual[i];
  }
  bool has_springs(ResidualKind residual) const {
    return std::any_of(blocks.begin(), blocks.end(), [&](const MaterialBlock& b) { return b.has_springs(residual); });
  }
  double mass(int i) const { return density[i] * domain.volume(i); }
  // What is its own of the inertia of its cell, 1 but where a condition takes a part for another body's.
  double inertia_share(int i) const {
    return density[i] / (block_of(i).material.density * (mass_scale.empty() ? 1 : mass_scale[i]));
  }
  Vector current(int i) const { return domain.current(i); }
  // The law point of block.points[k] at the place q.
  MaterialPoint law_point(const MaterialBlock& block, std::size_t k, int q) const {
    return block.is_quadratic() ? block.cells[block.place(k, q)] : points[block.points[k]];
  }
  // Whether bonds of an owned point have broken.
  bool has_lost_bonds(int i) const { return !domain.families.broken.empty() && !domain.families.broken[i].empty(); }
  // Whether bonds of a block's points, or of those that it is bonded to, may break; whether any may.
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

}  // namespace strut
