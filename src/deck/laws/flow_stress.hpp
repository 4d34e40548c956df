// The flow stress of metals: the key "Yield Stress" and the sections Hardening and Rate; with temperature the sections
// Flow Stress and Softening, too.
#pragma once

#include <vector>

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/thermal_flow.hpp"

namespace strut::deck {

Section flow_stress_section();
materials::FlowStress make_flow_stress(const Values& material, Problems& problems);

std::vector<Section> thermal_flow_sections();

// True if the deck asks for a flow stress that depends on temperature.
bool has_thermal_flow(const Values& material);
materials::ThermalFlow make_thermal_flow(const Values& material, Problems& problems);

}  // namespace strut::deck
