// The points of one block of the mesh on a rank, and their material.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/fields.hpp"
#include "base/math/tiles.hpp"
#include "materials/laws.hpp"
#include "mechanics/damage_model.hpp"
#include "mechanics/formulation/formulation.hpp"
#include "mechanics/integration_points.hpp"
#include "mechanics/stabilization.hpp"
#include "topology/domain.hpp"

namespace strut {

// Artificial viscosity of von Neumann & Richtmyer (1950) and Landshoff (1955): where the volume shrinks at the rate D,
// a pressure q = ρ l |D| (b₁ c + b₂² l |D|) resists it; l is the spacing of points, c the speed of longitudinal waves.
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
  double thermal_expansion = 0;  // α, 1/K
};

// The law's state of the integration point `index`.
template <class L>
typename L::State state_in(const small::Tiles& states, std::size_t index) {
  std::array<double, materials::state_size<L>> values{};
  for (std::size_t c = 0; c < values.size(); ++c) values[c] = states.at(index, c);
  return materials::from_columns<L>(values);
}

// The points of one block of the mesh on this rank, with their law's state.
struct MaterialBlock {
  std::string name;
  BlockMaterial material;
  std::vector<int> points;  // owned points, ascending
  int interior = 0;         // number of points that need no ghost; they come first

  FieldSet fields;
  // The law's state variables at all integration points, one row for each variable.
  FieldRef<small::Tiles> state = fields.add<small::Tiles>(At::integration_point, {});
  // Integration points of quadratic correspondence; other formulations use body.points.
  FieldRef<CellPoints> cells = fields.add<CellPoints>(At::integration_point, CellPoints::parts(), When::if_used);
  PointField<std::uint8_t> flowed = fields.of_points<std::uint8_t>(
      {.name = "flowed",
       .unit = "1",
       .meaning = "1 where the metal of a cell by quadratic correspondence has flowed, 2 where it began to under a "
                  "pressure above 0.8 of its flow stress",
       .persistent = true,
       .variable = "Flowed"},
      When::if_used);  // begin_flow
  PointField<OrdinaryPoint> ordinary =
      fields.add<std::vector<OrdinaryPoint>>(At::point, OrdinaryPoint::parts(), When::if_used);
  PointField<ViscousPoint> viscous =
      fields.add<std::vector<ViscousPoint>>(At::integration_point, ViscousPoint::parts(), When::if_used);

  // True if a point of the block, or a neighbor of one, has this formulation: forces are summed over these.
  bool feels_correspondence = false, feels_ordinary = false, feels_quadratic = false;

  // The body moves rigidly, without strain (rigid_motion.hpp), so that nothing is computed.
  bool in_rigid_motion = false;

  // The integration points of each cell share their change of volume from the start, not only once they flow.
  bool shares_volume = false;
  double rest_frequency_bound = 0;  // 1/s, the largest of its undeformed points times their fraction of the step

  int lattice = -1;            // index in domain.families.lattices if its points are on one
  SelectedPoints off_stencil;  // points of a lattice that have lost bonds: their sums use neighbor lists

  std::size_t first_integration_point = 0;  // index of the first of `cells` among those of all blocks

  // Integration points: one per point, points[k] at k; or four per cell, in tiles of as many cells as there are SIMD
  // lanes. Interior and boundary points begin tiles of their own; the rest of their last tiles stays unused.
  int points_per_cell() const { return is_quadratic() ? 4 : 1; }
  std::size_t integration_points() const {
    return is_quadratic() ? 4 * in_tiles(in_tiles(interior) + points.size() - interior) : points.size();
  }
  std::size_t index(std::size_t k, int q) const {
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
  typename L::State state_of(std::size_t index) const {
    return state_in<L>(state, index);
  }
  // The elastic moduli of an integration point in its present state.
  materials::Moduli moduli(std::size_t index) const;

  bool is_ordinary() const { return material.formulation == Formulation::ordinary; }
  bool is_quadratic() const { return material.formulation == Formulation::quadratic; }
  // True if it has springs on this kind of residual (stabilization.hpp).
  bool has_springs(ResidualKind residual) const {
    return residual_of(material.stabilization) == residual && coefficient_of(material.stabilization) > 0;
  }
  // C of a point's springs on the residual of its own gradient, Pa/m⁵; 0 without any.
  double own_springs_of(const MaterialPoint& point) const {
    return has_springs(ResidualKind::own_gradient) ? point.stabilization : 0;
  }

 private:
  static std::size_t in_tiles(std::size_t cells) {
    return (cells + small::Tiles::width - 1) / small::Tiles::width * small::Tiles::width;
  }
};

// Compiled once, in make_body.cpp.
extern template class FieldOf<small::Tiles>;
extern template class FieldOf<CellPoints>;
extern template class FieldOf<std::vector<OrdinaryPoint>>;
extern template class FieldOf<std::vector<ViscousPoint>>;

}  // namespace strut
