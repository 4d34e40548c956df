// The section Materials.
#pragma once

#include <string>
#include <vector>

#include "deck/forward.hpp"
#include "materials/laws.hpp"

namespace strut::deck {

enum class StabilizationType { none, silling, mean_gradient };
enum class Formulation { correspondence, ordinary, quadratic };

struct Material {
  std::string name;
  double density = 0;  // kg/m³
  Formulation formulation{};
  materials::AnyLaw law;  // ordinary: Elastic
  // By correspondence.
  StabilizationType stabilization{};
  double linear_viscosity{}, quadratic_viscosity{};
  double stabilization_coefficient{};  // in units of (λ + 2μ)/(tr K/3), dimensionless
};

Section materials_section();
std::vector<Material> read_materials(const Values& deck, Problems& problems);

}  // namespace strut::deck
