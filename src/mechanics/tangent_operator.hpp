// The linearized forces: for the critical time step and for Newton's iterations.
#pragma once

#include <vector>

#include "mechanics/body.hpp"

namespace strut {

struct PointTangent;

// Collective. Applies the linearized operator in the current state to a field v: result = −f(v) (N/m⁴ times v's unit).
// `directions`: a copy of the body's sites that holds v in place of y.
// `tangents`: of the owned points by correspondence (tangent.hpp); null: those of the elastic moduli, without the
// geometric stiffness (of the order stress/modulus), which ordinary points never include.
// `scratch`: overwritten; a copy of body.force_states, or these themselves if no bond may break in the next step:
// breaks read the force states of the last sum of forces.
void apply_tangent(const Body& body, Halo& halo, std::vector<Site>& directions,
                   const std::vector<PointTangent>* tangents, ForceStates& scratch, std::vector<Vector>& result);

}  // namespace strut
