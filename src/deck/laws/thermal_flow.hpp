// The flow stress of metals with temperature: the sections Flow Stress and Softening, in addition to flow_stress.hpp.
#pragma once

#include <vector>

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/thermal_flow.hpp"

namespace strut::deck {

std::vector<Section> thermal_flow_sections();

// True if the deck asks for a flow stress that depends on temperature.
bool has_thermal_flow(const Values& material);
materials::ThermalFlow make_thermal_flow(const Values& material, Problems& problems);

}  // namespace strut::deck
