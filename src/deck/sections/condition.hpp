// One of the Boundary Conditions.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "base/math/function.hpp"
#include "base/math/tensors.hpp"

namespace strut::deck {

enum class ConditionType {
  initial_velocity,
  prescribed_displacement,
  prescribed_velocity,
  body_force,      // N per m³ of reference volume
  symmetry_plane,  // the points of the set keep their distance to the plane through them with this normal
  rigid_plane,     // tools: points of the set stay outside
  rigid_cylinder,
  rigid_box,
  open_end  // waves leave through the layer of points as if the body went on behind it
};

struct Condition {
  std::string name;
  ConditionType type = ConditionType::initial_velocity;
  std::string node_set;             // of mesh or deck, a block's name, or "all"
  int component = 0;                // 0 x, 1 y, 2 z; unused for planes and tools
  Function value;                   // m/s, m, m/s, N/m³; unused for planes and tools
  Vector point = Vector::Zero();    // m, on a plane or an axis
  Vector normal = Vector::UnitX();  // of any length but zero
  // Of tools:
  Vector axis = Vector::UnitX();                          // of any length but zero
  double radius = 0;                                      // m
  Vector lower = Vector::Zero(), upper = Vector::Ones();  // corners, m
  double friction{};                                      // Coulomb's coefficient
  std::array<std::optional<Function>, 3> travel;          // along x, y, z, of t only, m
};

}  // namespace strut::deck
