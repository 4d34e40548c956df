// Inside mechanics: quadratic correspondence, from the places of the points of a block to the state of each.
#pragma once

#include "mechanics/formulation/stress_pass.hpp"

namespace strut {

void advance_quadratic(Body& body, MaterialBlock& block, const StressPass& pass, const LaneGroups& groups,
                       StepReport& report);

// F and R of each point, and its stress, from those of its cell.
void diagnose_cells(Body& body, const MaterialBlock& block, const LaneGroups& groups);

}  // namespace strut
