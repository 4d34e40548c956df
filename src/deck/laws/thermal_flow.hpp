// The flow stress of a metal that may be hot: the sections Flow Stress and Softening, beside those of flow_stress.hpp.
#pragma once

#include <vector>

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/thermal_flow.hpp"

namespace strut::deck {

std::vector<Section> thermal_flow_sections();

// Whether the deck asks for one that depends on temperature.
bool has_thermal_flow(const Values& material);
materials::ThermalFlow make_thermal_flow(const Values& material, Problems& problems);

}  // namespace strut::deck
