// Inside mechanics: quadratic correspondence, from the positions of a block's points to their force states.
#pragma once

#include "mechanics/formulation/stress_pass.hpp"

namespace strut {

void advance_quadratic(Body& body, MaterialBlock& block, const StressPass& pass, const LaneGroups& groups,
                       StepReport& report);

// Sets F, R and stress of each point, for output, from those of its cell.
void diagnose_cells(Body& body, const MaterialBlock& block, const LaneGroups& groups);

}  // namespace strut
