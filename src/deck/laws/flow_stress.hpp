// The flow stress of a law: the key "Yield Stress" and the sections Hardening and Rate.
#pragma once

#include <string>

#include "deck/problems.hpp"
#include "deck/schema.hpp"
#include "deck/values.hpp"
#include "materials/flow_stress.hpp"

namespace strut::deck {

Section flow_stress_section();
materials::FlowStress make_flow_stress(const Values& material, Problems& problems);

// Reports any of these keys if the deck also gives a flow stress of another form.
void refuse_flow_stress(const Values& material, const std::string& flow, Problems& problems);

}  // namespace strut::deck
