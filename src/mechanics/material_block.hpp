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
#include "mechanics/law_points.hpp"
#include "mechanics/stabilization/stabilization.hpp"
#include "topology/domain.hpp"

namespace strut {

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

}  // namespace strut
