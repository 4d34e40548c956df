// The section Materials.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deck/forward.hpp"
#include "deck/problems.hpp"
#include "materials/laws.hpp"
#include "mechanics/formulation/formulation.hpp"
#include "mechanics/stabilization.hpp"

namespace strut::deck {

struct Material {
  std::string name;
  double density = 0;  // kg/m³
  Formulation formulation{};
  materials::AnyLaw law;  // ordinary: Elastic
  // Only with laws by correspondence:
  Stabilization stabilization = NoStabilization();  // without its coefficient
  std::optional<double> stabilization_coefficient;
  double linear_viscosity{}, quadratic_viscosity{};
  double thermal_expansion = 0;  // α, 1/K, by a prescribed temperature
};

Section materials_section();
std::vector<Material> read_materials(const Values& deck, Problems& problems);

// Loads the library of each material that has one, by its path from the folder of the deck, and tries it with steps of
// an undeformed point.
void load_user_libraries(std::vector<Material>& materials, const std::filesystem::path& folder, Problems& problems);

}  // namespace strut::deck
