// From the places of the points to the force on each, by state-based peridynamics.
#pragma once

#include "mechanics/bond_breaking.hpp"
#include "mechanics/step_report.hpp"

namespace strut {

// Collective. Advances F, R, stress and state from the last positions to the current ones (owned entries of sites) over
// dt. Halo exchanges run behind interior points. dt = 0 leaves stress and state alone. `with_diagnostics`: also what
// forces do not need but a look at the body does, the energy of the stabilization, and F, R and stress of ordinary
// points, which are a view of their families only. `time`: at the end of the step, s. `breaking`: bonds break by it,
// where dt > 0. force_density then holds what the points' own states give to the force on them, for the one sum_forces
// that is to follow.
StepReport advance_stress(Body& body, double dt, bool with_diagnostics, double time = 0,
                          BondBreaking* breaking = nullptr);

// Collective; once after advance_stress. force_density, f = Σ {T − T'} V (internal force, N/m³); of a subcycled
// point, the part of its stress that acts at the end of a whole step.
void sum_forces(Body& body, bool with_diagnostics, BondBreaking* breaking = nullptr);

// Both.
StepReport advance_stress_and_force(Body& body, double dt, bool with_diagnostics, BondBreaking* breaking = nullptr);

// The same for a step of any size, as an implicit solver takes it: rotations to round-off.
StepReport advance_by_any_step(Body& body, double dt, bool with_diagnostics, BondBreaking* breaking = nullptr);

}  // namespace strut
